//! A hash index from the content of a node to its place: open addressing, with the nodes left in
//! the graph.

use super::{Node, NodeId};

/// Half a hash above a place plus one, 0 for an empty slot. The number of slots is a power of two, at
/// most half of them taken.
#[derive(Debug)]
pub(super) struct Index {
    slots: Vec<u64>,
    shift: u32,
}

/// Initial number of slots, as a power of 2.
const FIRST: u32 = 9;
/// Upper half of a hash, whose upper bits are those of a slot.
const HALF: u64 = !0 << 32;

impl Index {
    pub fn new() -> Self {
        Self::with_bits(FIRST)
    }

    fn with_bits(bits: u32) -> Self {
        Self { slots: vec![0; 1 << bits], shift: 64 - bits }
    }

    /// Finds the place of an equal node. Otherwise notes the place after the last node for this one
    /// and returns `None`.
    #[inline]
    pub fn find_or_note(&mut self, node: Node, nodes: &[Node]) -> Option<NodeId> {
        if 2 * nodes.len() >= self.slots.len() {
            self.grow();
        }
        let hash = hash(node) & HALF;
        let mut slot = (hash >> self.shift) as usize;
        loop {
            let taken = self.slots[slot];
            if taken == 0 {
                self.slots[slot] = hash | (nodes.len() as u64 + 1);
                return None;
            }
            // Most other nodes have another hash, and are not looked at.
            if taken & HALF == hash {
                let place = taken as u32 - 1;
                if nodes[place as usize] == node {
                    return Some(NodeId(place));
                }
            }
            slot = (slot + 1) & (self.slots.len() - 1);
        }
    }

    #[cold]
    fn grow(&mut self) {
        let mut larger = Self::with_bits(64 - self.shift + 1);
        for taken in self.slots.iter().filter(|taken| **taken != 0) {
            let mut slot = (taken >> larger.shift) as usize;
            while larger.slots[slot] != 0 {
                slot = (slot + 1) & (larger.slots.len() - 1);
            }
            larger.slots[slot] = *taken;
        }
        *self = larger;
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
