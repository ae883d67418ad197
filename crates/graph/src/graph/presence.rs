//! Operations that were recorded and that other values do without.

use super::{Expr, Graph, Step, literally, with_graph};
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

/// Returns the inverses of the arguments of all roots and fractional powers in some values, recorded
/// literally: where one of them has no value, what was written is at the end of its domain.
pub fn edges(values: &[Expr]) -> Vec<Expr> {
    let arguments: Vec<Expr> = with_graph(|graph| {
        let reached = graph.reached(values.iter().copied());
        let argument = |place: usize| match graph.step(place) {
            Step::Unary(UnaryFunction::Sqrt, a) => Some(graph.at(a)),
            Step::Power(a, exponent) if exponent.to_integer().is_none() => Some(graph.at(a)),
            _ => None,
        };
        (0..graph.len()).filter(|place| reached[*place]).filter_map(argument).collect()
    });
    literally(|| arguments.into_iter().map(|a| a.apply(UnaryFunction::Recip)).collect())
}
