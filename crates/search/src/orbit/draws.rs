//! The map from random draws to parameters and states.

use super::super::SearchError;
use liouville::graph::{Expr, Step, Tape, record};
use liouville::number::BinaryOperation;
use liouville::number::rational::Rational;
use liouville::scalar::Scalar;
use liouville::verdict::Sampler;

/// The map from draws to parameters and states without the terms 0·√(…) by which a state out of its
/// declared range has no value: modulo a prime there are no ranges.
pub fn without_ranges(sampler: &Sampler) -> Result<Tape, SearchError> {
    let graph = sampler.graph();
    let reached = graph.reached(sampler.made().iter().copied());
    let is_zero =
        |place: usize| matches!(graph.step(place), Step::Constant(value) if value.is_zero());
    let (made, outputs) = record(graph.inputs(), |inputs| {
        let zero = Expr::rational(&Rational::from(0));
        let values = graph.replay(&reached, inputs, |_, step, _| match step {
            Step::Binary(BinaryOperation::Mul, a, b) if is_zero(a) || is_zero(b) => Some(zero),
            _ => None,
        });
        let value = |own: &Expr| values[graph.place(*own)].unwrap_or(zero);
        sampler.made().iter().map(value).collect::<Vec<_>>()
    })?;
    Ok(Tape::new(&made, &outputs))
}
