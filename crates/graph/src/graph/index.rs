//! A hash index from the content of a node to its place: open addressing, with the nodes left in
//! the graph.

use super::{Node, NodeId};

/// Places plus one, 0 for an empty slot. The number of slots is a power of two, at most half of
/// them taken.
#[derive(Debug)]
pub(super) struct Index {
    slots: Vec<u32>,
    shift: u32,
}

/// Initial number of slots, as a power of 2.
const FIRST: u32 = 9;

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
            self.grow(nodes);
        }
        let slot = self.slot(node, nodes);
        if self.slots[slot] > 0 {
            return Some(NodeId(self.slots[slot] - 1));
        }
        self.slots[slot] = nodes.len() as u32 + 1;
        None
    }

    /// Finds the slot of an equal node, or an empty slot.
    #[inline]
    fn slot(&self, node: Node, nodes: &[Node]) -> usize {
        let mut slot = (mixed(node) >> self.shift) as usize;
        while self.slots[slot] > 0 && nodes[self.slots[slot] as usize - 1] != node {
            slot = (slot + 1) & (self.slots.len() - 1);
        }
        slot
    }

    #[cold]
    fn grow(&mut self, nodes: &[Node]) {
        *self = Self::with_bits(64 - self.shift + 2);
        for (place, node) in nodes.iter().enumerate() {
            let slot = self.slot(*node, nodes);
            self.slots[slot] = place as u32 + 1;
        }
    }
}

/// Multiplicative (Fibonacci) hash, of which the upper bits are used: content times an odd number
/// near 2^64 over the golden ratio.
#[inline]
fn mixed(node: Node) -> u64 {
    let (name, a, b) = match node {
        Node::Constant(index) => (0, index, 0),
        Node::Input(input) => (1, input, 0),
        Node::Unary(function, a) => (2 + function as u64, a.0, 0),
        Node::Power(a, exponent) => (16, a.0, exponent),
        Node::Binary(operation, a, b) => (17 + operation as u64, a.0, b.0),
    };
    let content = u64::from(a) << 32 | u64::from(b);
    (content ^ name << 58 ^ name << 26).wrapping_mul(0x9E37_79B9_7F4A_7C15)
}
