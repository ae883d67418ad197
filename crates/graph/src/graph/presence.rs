//! Operations that were recorded and that other values do without.

use super::{Expr, Graph, Step};
use crate::number::{BinaryOperation, UnaryFunction};

impl Graph {
    /// Operations without a value at some arguments that occur in `written`, and not in `kept`.
    pub fn left_out(&self, kept: &[Expr], written: &[Expr]) -> Vec<Expr> {
        let kept = self.reached(kept.iter().copied());
        let all = self.reached(written.iter().copied());
        let is_partial = |step: Step<'_>| match step {
            Step::Unary(UnaryFunction::Recip | UnaryFunction::Sqrt | UnaryFunction::Ln, _) => true,
            Step::Binary(BinaryOperation::Pow, ..) => true,
            Step::Power(_, exponent) => exponent.is_negative() || exponent.to_integer().is_none(),
            _ => false,
        };
        let lost = (0..self.len()).filter(|place| all[*place] && !kept[*place]);
        lost.filter(|place| is_partial(self.step(*place))).map(|place| self.at(place)).collect()
    }
}
