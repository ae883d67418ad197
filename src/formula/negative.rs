//! Negatives of formulas.

use std::ops::Neg;

use super::Formula;
use super::arena::{NodeId, NodeOperation};
use super::bond::Bond;
use super::compose::Draft;
use super::typing::{Builder, Operand};
use crate::number::rational::Rational;

impl Formula {
    /// Negative; of a product that of its first factor.
    fn negative(&self) -> Formula {
        if let Some(positive) = self.without_sign() {
            return positive;
        }
        if let Some(number) = self.constant().filter(Rational::is_negative) {
            return Formula::number(-&number);
        }
        let mut draft = Draft::default();
        draft.write("−");
        if self.bond() == Bond::Product {
            let negate = |builder: &mut Builder<'_>, leaf: &Operand| {
                Ok(builder.negate(leaf, 0..leaf.span.end))
            };
            if let Ok(negative) = draft.led(self, negate) {
                return negative;
            }
            // a negative always exists; brackets are the other way to write it
            return self.bracketed().negative();
        }
        let a = draft.place(self, self.bond() < Bond::Prefix);
        let Draft { text, arena } = draft;
        let mut builder = Builder { arena, text: &text };
        builder.negate(&a, 0..a.span.end);
        let arena = builder.arena;
        Formula { text, arena }
    }

    /// First factor of a product without brackets, as the node whose text begins the formula.
    pub(super) fn first_factor(&self) -> NodeId {
        let nodes = &self.arena.nodes;
        let mut at = nodes.len() - 1;
        loop {
            let (a, b) = match nodes[at].operation {
                NodeOperation::Multiply(a, b)
                | NodeOperation::Scale(a, b)
                | NodeOperation::Apply(a, b)
                | NodeOperation::Compose(a, b)
                | NodeOperation::Divide(a, b) => (a, b),
                _ => return at,
            };
            let begins = |node: &NodeId| nodes[*node].span.start == nodes[at].span.start;
            match [a, b].into_iter().find(begins) {
                Some(first) => at = first,
                None => return at,
            }
        }
    }

    /// The formula without the sign that its text begins with, if that is of the whole or of the
    /// first factor of a product: the negative of −a is a.
    fn without_sign(&self) -> Option<Formula> {
        let signed = self.first_factor();
        let NodeOperation::Negate(inner) = self.arena.nodes[signed].operation else { return None };
        let text = self.written();
        let rest = text.strip_prefix(['−', '-'])?;
        let cut = self.leading() + text.len() - rest.len();
        let mut draft = Draft::default();
        draft.write(rest);
        draft.graft_without(self, signed, inner, cut);
        let Draft { text, arena } = draft;
        Some(Formula { text, arena })
    }
}

impl Neg for &Formula {
    type Output = Formula;

    fn neg(self) -> Formula {
        self.negative()
    }
}

impl Neg for Formula {
    type Output = Formula;

    fn neg(self) -> Formula {
        self.negative()
    }
}
