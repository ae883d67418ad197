//! A hash index from the content of a node to its place: open addressing, with the nodes left in
//! the graph.

use super::{Node, NodeId};

/// In each slot the place of a node plus one, below as many bits of its hash as there is room for; 0 for
/// an empty slot. The number of slots is a power of two, at most half of them taken: a place plus one
/// takes fewer bits than a slot's number.
#[derive(Clone, Debug)]
pub(super) struct Index {
    slots: Vec<u32>,
    /// Number of slots, as a power of 2.
    bits: u32,
    /// Bits of a slot that hold a place plus one.
    places: u32,
}

/// Initial number of slots, as a power of 2.
const FIRST: u32 = 9;

impl Index {
    pub fn new() -> Self {
        Self::with_bits(FIRST)
    }

    fn with_bits(bits: u32) -> Self {
        Self { slots: vec![0; 1 << bits], bits, places: (1 << bits) - 1 }
    }

    /// Returns the slot at which the search for a hash begins, and the bits of it that slots keep.
    #[inline]
    fn split(&self, hash: u64) -> (usize, u32) {
        // A wrapping shift needs no test of its length.
        (hash.wrapping_shr(64 - self.bits) as usize, hash as u32 & !self.places)
    }

    /// Finds the place of an equal node. Otherwise notes the place after the last node for this one
    /// and returns `None`.
    #[inline]
    pub fn find_or_note(&mut self, node: Node, nodes: &[Node]) -> Option<NodeId> {
        if 2 * nodes.len() >= self.slots.len() {
            self.grow(self.bits + 2, nodes);
        }
        let (mut slot, own) = self.split(hash(node));
        let places = self.places;
        loop {
            let taken = self.slots[slot];
            if taken == 0 {
                self.slots[slot] = own | (nodes.len() as u32 + 1);
                return None;
            }
            // Most other nodes have another hash, and are not looked at.
            if taken & !places == own {
                let place = (taken & places) - 1;
                if nodes[place as usize] == node {
                    return Some(NodeId(place));
                }
            }
            slot = (slot + 1) & (self.slots.len() - 1);
        }
    }

    /// Makes room for so many nodes in all.
    pub fn reserve(&mut self, count: usize, nodes: &[Node]) {
        let bits = (2 * count + 2).next_power_of_two().trailing_zeros();
        if bits > self.bits {
            self.grow(bits, nodes);
        }
    }

    #[cold]
    fn grow(&mut self, bits: u32, nodes: &[Node]) {
        *self = Self::with_bits(bits);
        for (place, node) in nodes.iter().enumerate() {
            let (mut slot, own) = self.split(hash(*node));
            while self.slots[slot] != 0 {
                slot = (slot + 1) & (self.slots.len() - 1);
            }
            self.slots[slot] = own | (place as u32 + 1);
        }
    }
}

/// Multiplicative (Fibonacci) hash, of which the upper bits are used: content times an odd number
/// near 2^64 over the golden ratio, twice, since arguments in the upper half of the content reach
/// the upper bits by the lower half of the number alone.
#[inline]
fn hash(node: Node) -> u64 {
    const GOLDEN: u64 = 0x9E37_79B9_7F4A_7C15;
    let (name, a, b) = match node {
        Node::Constant(index) => (0, index, 0),
        Node::Input(input) => (1, input, 0),
        Node::Unary(function, a) => (2 + function as u64, a.0, 0),
        Node::Power(a, exponent) => (16, a.0, exponent),
        Node::Binary(operation, a, b) => (17 + operation as u64, a.0, b.0),
    };
    let content = u64::from(a) << 32 | u64::from(b);
    let once = (content ^ name << 58 ^ name << 26).wrapping_mul(GOLDEN);
    (once ^ once >> 32).wrapping_mul(GOLDEN)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::BinaryOperation;

    #[test]
    fn every_node_is_found_again_however_room_was_made() {
        let node = |k: u32| match k % 3 {
            0 => Node::Input(k),
            1 => Node::Binary(BinaryOperation::Mul, NodeId(k / 7), NodeId(k)),
            _ => Node::Power(NodeId(k), k % 5),
        };
        for reserved in [0, 1000, 5000] {
            let (mut index, mut nodes) = (Index::new(), Vec::new());
            for k in 0..20_000 {
                if k == 100 {
                    index.reserve(nodes.len() + reserved, &nodes);
                }
                assert_eq!(index.find_or_note(node(k), &nodes), None, "node {k} is new");
                nodes.push(node(k));
                let earlier = k.wrapping_mul(2_654_435_761) % (k + 1);
                let found = index.find_or_note(node(earlier), &nodes);
                assert_eq!(found, Some(NodeId(earlier)), "node {earlier} after {k}");
            }
        }
    }
}
