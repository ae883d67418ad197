//! Deep trees: long chains of terms and factors are abridged, so that boxes do not nest as deeply.

use std::cell::Cell;

use super::Layout;
use super::paper::{Bonded, BoxStrength, MOST_SHOWN, Paper};
use crate::formula::arena::{Arena, NodeId, NodeOperation};

/// Number of levels of a tree above which chains in it are abridged; brackets nest less.
const MOST_LEVELS: usize = 500;
/// Number of levels that are set; what lies deeper is left out.
const MOST_SET: usize = 800;

/// Depth of a tree.
pub struct Chains {
    /// Number of levels of each node; empty where the tree is not deep.
    levels: Vec<usize>,
    /// Number of levels being set.
    set: Cell<usize>,
}

/// A level being set.
pub struct Level<'c>(&'c Cell<usize>);

impl Drop for Level<'_> {
    fn drop(&mut self) {
        self.0.set(self.0.get() - 1);
    }
}

impl Chains {
    /// Counts the levels; operands stand before what is made of them.
    pub fn new(arena: &Arena) -> Self {
        let mut levels: Vec<usize> = Vec::with_capacity(arena.nodes.len());
        for node in &arena.nodes {
            let mut below = 0;
            node.operation.on(|operand| {
                below = below.max(levels[operand]);
                operand
            });
            levels.push(below + 1);
        }
        if levels.last().is_none_or(|count| *count <= MOST_LEVELS) {
            levels.clear();
        }
        Self { levels, set: Cell::new(0) }
    }

    /// Begins a level. `None` where there are too many.
    pub fn enter(&self) -> Option<Level<'_>> {
        let count = self.set.get();
        (count < MOST_SET).then(|| {
            self.set.set(count + 1);
            Level(&self.set)
        })
    }
}

impl Paper<'_> {
    /// Sets `a + b − … + c` and the like, of which each operation is the left side of the next: the
    /// first two parts and the last. `None` where the chain is short, or the tree is not deep.
    pub(super) fn abridged(&self, node: NodeId, inline: bool) -> Option<Bonded> {
        if self.chains.levels.is_empty() {
            return None;
        }
        let (bond, ..) = self.link(node)?;
        let (mut links, mut first) = (Vec::new(), node);
        while let Some((own, left, sign, right)) = self.link(first)
            && own == bond
        {
            links.push((sign, right));
            first = left;
        }
        let [(last_sign, last), .., (gap, _), (sign, second)] = &links[..] else { return None };
        if links.len() < MOST_SHOWN {
            return None;
        }
        let part = |part: NodeId| self.at(part, bond.tighter(), inline);
        let left = if bond == BoxStrength::Cross { bond.tighter() } else { bond };
        let row = vec![
            self.at(first, left, inline),
            Layout::Sign(sign),
            part(*second),
            Layout::Sign(gap),
            Layout::Sign("…"),
            Layout::Sign(last_sign),
            part(*last),
        ];
        Some((Layout::Row(row), bond))
    }

    /// Operation of a chain: its strength, its left side, its sign and its right side. A number stands
    /// on either side of a vector.
    fn link(&self, node: NodeId) -> Option<(BoxStrength, NodeId, &'static str, NodeId)> {
        use NodeOperation::*;
        let levels = &self.chains.levels;
        let (bond, a, sign, b) = match &self.arena.nodes[node].operation {
            Add(a, b) => (BoxStrength::Sum, a, "+", b),
            Subtract(a, b) => (BoxStrength::Sum, a, "−", b),
            Cross(a, b) => (BoxStrength::Cross, a, "×", b),
            Outer(a, b) => (BoxStrength::Cross, a, "⊗", b),
            Divide(a, b) => (BoxStrength::Product, a, "/", b),
            Scale(a, b) if levels[*a] < levels[*b] => (BoxStrength::Product, b, "·", a),
            Multiply(a, b) | Scale(a, b) | Apply(a, b) | Compose(a, b) => {
                (BoxStrength::Product, a, "·", b)
            }
            _ => return None,
        };
        Some((bond, *a, sign, *b))
    }
}
