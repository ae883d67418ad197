//! Sizes of polynomials whose coefficients are rational functions of other inputs.

use crate::graph::{Expr, Graph, Step};
use crate::number::{BinaryOperation, UnaryFunction};

use super::bounds::{Bounds, InputDistribution};

/// Bounds on values V/W with one denominator W, which contains coefficients alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PolynomialBounds {
    /// Bound on the degree of all V in the variables.
    pub degree: f64,
    /// Bound on the degree of W and of all V in all inputs.
    pub total: f64,
    /// Log₂ of a bound on the sums of the absolute coefficients of W and of all V.
    pub height: f64,
}

/// Bounds values that are polynomials in the inputs from `first` on, with coefficients that are
/// rational functions of the inputs before.
///
/// `None` if they contain other operations than + − × ÷ and integer powers, or divide by one of these
/// variables, even if it cancels.
pub fn polynomial_bounds(graph: &Graph, values: &[Expr], first: usize) -> Option<PolynomialBounds> {
    let reached = graph.reached(values.iter().copied());
    let mut varies = vec![false; graph.len()];
    for (place, step) in graph.steps().enumerate().filter(|(place, _)| reached[*place]) {
        varies[place] = match step {
            Step::Input(input) => input >= first,
            _ => step.arguments().any(|argument| varies[argument]),
        };
        let is_polynomial = match step {
            Step::Constant(_) | Step::Input(_) | Step::Unary(UnaryFunction::Neg, _) => true,
            Step::Unary(UnaryFunction::Recip, a) => !varies[a],
            Step::Binary(operation, ..) => operation != BinaryOperation::Pow,
            Step::Power(a, exponent) => {
                exponent.to_integer().is_some_and(|power| power >= 0.into() || !varies[a])
            }
            Step::Unary(..) => false,
        };
        if !is_polynomial {
            return None;
        }
    }
    let variable = |input: usize| match input < first {
        // A coefficient has degree 0.
        true => InputDistribution::Sign,
        false => InputDistribution::Uniform,
    };
    let own = Bounds::of(graph, &reached, &(0..graph.inputs()).map(variable).collect::<Vec<_>>());
    let all = Bounds::of(graph, &reached, &vec![InputDistribution::Uniform; graph.inputs()]);
    let none = PolynomialBounds { degree: 0.0, total: 0.0, height: 0.0 };
    values.iter().try_fold(none, |bounds, value| {
        let place = graph.place(*value);
        let (total, height) = all.multiplied_out(place)?;
        Some(PolynomialBounds {
            degree: bounds.degree.max(own.numerator(place)?.0),
            total: bounds.total + total,
            height: bounds.height + height,
        })
    })
}

#[cfg(test)]
mod tests {
    use num_dual::DualNum;

    use super::*;
    use crate::graph::record;

    fn bounds(build: impl FnOnce(&[Expr]) -> Vec<Expr>) -> Option<PolynomialBounds> {
        let (graph, values) = record(3, build).expect("records");
        polynomial_bounds(&graph, &values, 1)
    }

    #[test]
    fn coefficients_are_told_from_variables() {
        let found = bounds(|x| vec![x[1] * x[1] / x[0] + x[2], x[0].powi(3) * x[2]]);
        let found = found.expect("two polynomials in y and z");
        assert_eq!(found.degree, 2.0, "y²/a + z");
        // y² + a z over a, and a³ z
        assert_eq!(found.total, 2.0 + 1.0 + 4.0);
        assert!(found.height >= 1.0 && found.height < 8.0, "{found:?}");
    }

    #[test]
    fn what_divides_by_a_variable_is_refused() {
        assert_eq!(bounds(|x| vec![x[1] / x[2] * x[2]]), None, "y/z z");
        assert_eq!(bounds(|x| vec![x[1].powi(-2)]), None, "y⁻²");
        assert_eq!(bounds(|x| vec![x[0].sqrt() * x[1]]), None, "√a y");
        assert_eq!(bounds(|x| vec![x[1].sin()]), None, "sin y");
    }
}
