//! Values that vanish on no open set, though symbols stand for functions in them.
//!
//! A value built by arithmetic without division, and by functions that are analytic on ℝ, is analytic on all
//! of ℝⁿ. It vanishes on no open set if it is not 0 at one point: intervals there decide.

use crate::graph::{Graph, Step};
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};

use super::bounds::InputDistribution;
use super::classes::Classes;
use super::domain::Region;
use super::extent::Extent;

/// Whether a value that is not 0 with symbols in the place of its functions vanishes on no open set.
pub(super) fn vanishes_nowhere_openly(
    graph: &Graph,
    place: usize,
    sources: &[InputDistribution],
) -> bool {
    let reached = graph.reached_from(&[place]);
    let steps = || graph.steps().zip(&reached).filter(|(_, own)| **own).map(|(step, _)| step);
    if !steps().any(|step| step.is_transcendental()) {
        return true;
    }
    if !steps().all(|step| is_entire(&step, sources)) {
        return false;
    }
    let number = |input: usize| Rational::new(2 * input as i64 + 3, 3 * input as i64 + 5);
    let point: Vec<Extent> = (0..graph.inputs()).map(|input| Extent::at(&number(input))).collect();
    let region = Region { graph, inputs: &point, facts: &[], classes: &Classes::default() };
    region.known_sign(place).is_some_and(|known| !known.may_vanish)
}

/// Whether a step is analytic for all real arguments.
fn is_entire(step: &Step<'_>, sources: &[InputDistribution]) -> bool {
    use UnaryFunction::{Atan, Cos, Exp, Neg, Sin};
    match step {
        Step::Constant(_) | Step::Unary(Neg | Exp | Sin | Cos | Atan, _) => true,
        Step::Input(input) => sources.get(*input) == Some(&InputDistribution::Uniform),
        Step::Binary(operation, ..) => {
            matches!(operation, BinaryOperation::Add | BinaryOperation::Sub | BinaryOperation::Mul)
        }
        Step::Power(_, exponent) => exponent.to_integer().is_some_and(|own| own >= 0),
        Step::Unary(..) => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::{Expr, record};
    use crate::scalar::Scalar;
    use num_dual::DualNum;

    fn of(value: impl Fn(&[Expr]) -> Expr) -> bool {
        let (graph, value) = record(2, |inputs| value(inputs)).expect("recorded");
        let sources = [InputDistribution::Uniform, InputDistribution::Sign];
        vanishes_nowhere_openly(&graph, graph.place(value), &sources)
    }

    #[test]
    fn only_values_that_are_seen_not_to_vanish_count() {
        assert!(of(|x| x[0].sin()));
        assert!(of(|x| x[0].exp() - x[0]));
        assert!(of(|x| x[0] * x[0] * x[1]), "without functions the symbols decide");
        let number = |value: i64| Expr::rational(&Rational::from(value));
        // 16 atan(1/5) − 4 atan(1/239) − 4 atan 1 = 0.
        let machin = |x: &[Expr]| {
            let atan = |below: i64| (number(1) / number(below)).atan();
            (atan(5) * number(16) - atan(239) * number(4) - atan(1) * number(4)) * x[0]
        };
        assert!(!of(machin));
        assert!(!of(|x| x[0].ln()), "not analytic everywhere");
        assert!(!of(|x| x[0].sin() * x[1]), "a sign is no variable");
    }
}
