//! Operations that may have no value: what they need of an argument, and those that were recorded
//! and that other values do without.

use super::{Expr, Graph, Step, literally, with_graph};
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};

/// Requirement of an operation on one of its arguments, without which it has no value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Need {
    /// The argument is not 0.
    pub nonzero: bool,
    /// The argument is not negative.
    pub not_negative: bool,
    /// The value may be unbounded near a zero of the argument.
    pub is_pole: bool,
}

impl Need {
    /// Whether a number is as needed.
    pub(super) fn is_met_by(self, value: &Rational) -> bool {
        !(self.nonzero && value.is_zero() || self.not_negative && value.is_negative())
    }

    /// Whether an argument that is as needed here is as needed there, too.
    pub fn includes(self, other: Self) -> bool {
        (self.nonzero || !other.nonzero) && (self.not_negative || !other.not_negative)
    }

    /// Requirement of two operations on the same argument.
    pub fn and(self, other: Self) -> Self {
        Self {
            nonzero: self.nonzero || other.nonzero,
            not_negative: self.not_negative || other.not_negative,
            is_pole: self.is_pole || other.is_pole,
        }
    }
}

impl Step<'_> {
    /// Returns the argument on which it depends whether the operation has a value, and what is needed
    /// of it; `None` for an operation that has a value wherever its arguments have one.
    pub fn need(&self) -> Option<(usize, Need)> {
        let inverse = Need { nonzero: true, is_pole: true, not_negative: false };
        let root = Need { not_negative: true, ..Need::default() };
        match *self {
            Step::Unary(function, a) => match function {
                UnaryFunction::Recip => Some((a, inverse)),
                UnaryFunction::Sqrt => Some((a, root)),
                UnaryFunction::Ln => Some((a, inverse.and(root))),
                UnaryFunction::Neg
                | UnaryFunction::Abs
                | UnaryFunction::Exp
                | UnaryFunction::Sin
                | UnaryFunction::Cos
                | UnaryFunction::Atan => None,
            },
            Step::Binary(BinaryOperation::Pow, a, _) => Some((a, inverse.and(root))),
            Step::Power(a, exponent) => {
                let is_whole = |number: &Rational| number.to_integer().is_some();
                let is_negative = exponent.is_negative();
                let has_value_at_0 = !is_negative && is_whole(&(exponent * &Rational::from(2)));
                let need = Need {
                    nonzero: !has_value_at_0,
                    not_negative: !is_whole(exponent),
                    is_pole: is_negative,
                };
                (need != Need::default()).then_some((a, need))
            }
            Step::Binary(..) | Step::Constant(_) | Step::Input(_) => None,
        }
    }
}

impl Graph {
    /// Lists the arguments of operations among some places of which something is needed, in the order
    /// of the operations.
    pub fn needs<'g>(&'g self, of: &'g [bool]) -> impl Iterator<Item = (usize, Need)> + use<'g> {
        let steps = self.steps().zip(of).filter(|(_, is_asked)| **is_asked);
        steps.filter_map(|(step, _)| step.need())
    }

    /// Operations without a value at some arguments that occur in `written`, and not in `kept`.
    pub fn left_out(&self, kept: &[Expr], written: &[Expr]) -> Vec<Expr> {
        let kept = self.reached(kept.iter().copied());
        let all = self.reached(written.iter().copied());
        let lost = (0..self.len()).filter(|place| all[*place] && !kept[*place]);
        lost.filter(|place| self.step(*place).need().is_some())
            .map(|place| self.at(place))
            .collect()
    }
}

/// Returns the operations without a value at some arguments that values of the recording under way contain, and
/// others do not.
pub fn left_out(kept: &[Expr], written: &[Expr]) -> Vec<Expr> {
    with_graph(|graph| graph.left_out(kept, written))
}

/// Returns the inverses of the arguments of all roots and fractional powers in some values, recorded
/// literally: where one of them has no value, what was written is at the end of its domain.
pub fn edges(values: &[Expr]) -> Vec<Expr> {
    let arguments: Vec<Expr> = with_graph(|graph| {
        let reached = graph.reached(values.iter().copied());
        let argument = |place: usize| match graph.step(place) {
            step @ (Step::Unary(UnaryFunction::Sqrt, _) | Step::Power(..)) => {
                let (a, need) = step.need()?;
                need.not_negative.then(|| graph.at(a))
            }
            _ => None,
        };
        (0..graph.len()).filter(|place| reached[*place]).filter_map(argument).collect()
    });
    literally(|| arguments.into_iter().map(|a| a.apply(UnaryFunction::Recip)).collect())
}

/// Whether some values contain a modulus, or the root of a square: what is made of them may be 0 on an open
/// set, as x + |x|.
pub fn has_moduli(values: &[Expr]) -> bool {
    let is_square = |graph: &Graph, place: usize| match graph.step(place) {
        Step::Binary(BinaryOperation::Mul, a, b) => a == b,
        Step::Power(_, exponent) => exponent.to_integer().is_some_and(|power| power % 2 == 0),
        _ => false,
    };
    with_graph(|graph| {
        let graph = &*graph;
        graph.has_step(values, |step| match step {
            Step::Unary(UnaryFunction::Abs, _) => true,
            Step::Unary(UnaryFunction::Sqrt, a) | Step::Power(a, _) => {
                is_root(&step) && is_square(graph, a)
            }
            _ => false,
        })
    })
}

fn is_root(step: &Step<'_>) -> bool {
    let is_power = matches!(step, Step::Unary(UnaryFunction::Sqrt, _) | Step::Power(..));
    is_power && step.need().is_some_and(|(_, need)| need.not_negative)
}

/// Returns the logarithms of which some values contain the product with 0.
pub fn logarithms_times_zero(values: &[Expr]) -> Vec<Expr> {
    with_graph(|graph| {
        let reached = graph.reached(values.iter().copied());
        let is_zero =
            |place: usize| matches!(graph.step(place), Step::Constant(value) if value.is_zero());
        let is_logarithm =
            |place: &usize| matches!(graph.step(*place), Step::Unary(UnaryFunction::Ln, _));
        let logarithm = |place: usize| match graph.step(place) {
            Step::Binary(BinaryOperation::Mul, a, b) if is_zero(a) => Some(b).filter(is_logarithm),
            Step::Binary(BinaryOperation::Mul, a, b) if is_zero(b) => Some(a).filter(is_logarithm),
            _ => None,
        };
        let found = (0..graph.len()).filter(|place| reached[*place]).filter_map(logarithm);
        found.map(|place| graph.at(place)).collect()
    })
}

#[cfg(test)]
mod tests {
    use super::super::record;
    use super::*;
    use crate::scalar::Scalar;
    use num_dual::DualNum;

    /// Need of the input of a graph of one operation.
    fn need(build: impl FnOnce(Expr) -> Expr) -> Option<Need> {
        let (graph, made) = record(1, |x| build(x[0])).expect("records");
        graph.step(graph.place(made)).need().map(|(_, need)| need)
    }

    #[test]
    fn an_operation_says_what_it_needs() {
        let [nonzero, not_negative, is_pole] = [true; 3];
        let root = Need { not_negative, ..Need::default() };
        let every = Need { nonzero, not_negative, is_pole };
        let power = |text: &'static str| {
            need(move |x| x.power(&text.parse::<Rational>().expect("a number")))
        };
        assert_eq!(need(|x| x.recip()), Some(Need { nonzero, is_pole, ..Need::default() }));
        assert_eq!(need(|x| x.sqrt()), Some(root));
        assert_eq!(need(|x| x.ln()), Some(every));
        assert_eq!(need(|x| x.powd(x)), Some(every));
        assert_eq!(power("1/3"), Some(Need { nonzero, not_negative, is_pole: false }));
        // Smaller multiples of 1/2 are written as products.
        assert_eq!(power("4194305/2"), Some(root), "0 to half of a whole number is 0");
        assert_eq!(power("4194304"), None);
        for total in [|x: Expr| x.sin(), |x: Expr| x.exp(), |x: Expr| x.atan(), |x: Expr| x * x] {
            assert_eq!(need(total), None);
        }
    }
}
