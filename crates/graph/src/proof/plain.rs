//! Bounds for programs of + − × ÷ and integer powers alone, for checkers outside of the tool.

use crate::graph::{Expr, Graph, Step};
use crate::number::{Function, Operation};

use super::bounds::{Bounds, Source};

/// Bounds degree and height of the numerators of some values, all inputs uniform, by Theorem 1 of
/// docs/soundness.md; `None` if they contain other operations than + − × ÷ and integer powers.
pub fn rational_bounds(graph: &Graph, outputs: &[Expr]) -> Option<(f64, f64)> {
    let reached = graph.reached(outputs.iter().copied());
    let is_rational = |step: Step<'_>| match step {
        Step::Constant(_) | Step::Input(_) => true,
        Step::Unary(function, _) => matches!(function, Function::Neg | Function::Recip),
        Step::Binary(operation, ..) => operation != Operation::Pow,
        Step::Power(_, exponent) => exponent.to_integer().is_some(),
    };
    if !graph.steps().zip(&reached).all(|(step, reached)| !reached || is_rational(step)) {
        return None;
    }
    let bounds = Bounds::of(graph, &reached, &vec![Source::Uniform; graph.inputs()]);
    outputs.iter().try_fold((0f64, 0f64), |(degree, height), output| {
        let (d, h) = bounds.numerator(graph.place(*output))?;
        Some((degree.max(d), height.max(h)))
    })
}

#[cfg(test)]
mod tests {
    use num_dual::DualNum;

    use super::*;
    use crate::graph::record;

    fn bounds(build: impl FnOnce(&[Expr]) -> Expr) -> Option<(f64, f64)> {
        let (graph, value) = record(2, build).expect("records");
        rational_bounds(&graph, &[value])
    }

    #[test]
    fn rational_values_are_bounded_and_others_are_not() {
        assert_eq!(bounds(|x| x[0] * x[1] + x[0]), Some((2.0, 1.0)), "x y + x");
        let inverted = bounds(|x| ((x[0] + x[1]).recip() * x[0]).recip());
        assert_eq!(inverted, Some((1.0, 1.0)), "(x + y)/x: what is inverted twice is above");
        assert_eq!(bounds(|x| x[0].sqrt()), None, "a root");
        assert_eq!(bounds(|x| x[0].exp()), None, "a function");
    }
}
