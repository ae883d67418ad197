//! Does a parametrisation fill the level set? The rank of its derivative tells.

use nalgebra::DMatrix;
use num_dual::Dual;
use num_traits::{One, Zero};

use super::sampler::LANES;
use crate::case::Case;
use crate::claim::Place;
use crate::graph::{Evaluator, Expr, Fault, Tape, record};
use crate::mechanics::Draws;
use crate::number::float::Float;

/// The largest rank of the chart's derivative by its inputs, over one block of states.
///
/// Numerical: a pivot counts when it is above the root of the rounding error against the largest.
/// The rank can only be underrated, by a chart that is nearly degenerate everywhere.
pub fn rank(case: &Case, draws: &Draws, parameter_draws: usize, seed: u64) -> Result<usize, Fault> {
    let model = &case.model;
    let inputs = draws.len() - parameter_draws;
    let level = Place::level(model);
    let (graph, slopes) = record(draws.len(), |numbers| {
        let (parameters, state) = model.make_parameters(numbers);
        let parameters: Vec<Dual<Expr>> = parameters.into_iter().map(Dual::from_re).collect();
        (0..inputs)
            .flat_map(|seeded| {
                let slope = |k| if k == seeded { Expr::one() } else { Expr::zero() };
                let lifted: Vec<Dual<Expr>> =
                    state.iter().enumerate().map(|(k, x)| Dual::new(*x, slope(k))).collect();
                case.chart.point(model, &level.kept, &parameters, &lifted)
            })
            .map(|component| component.eps)
            .collect::<Vec<_>>()
    })?;
    let tape = Tape::new(&graph, &slopes);
    let mut evaluator = Evaluator::new(&tape, Float::<1>);
    let rank_at = |index: u64| {
        let point: Vec<[f64; 1]> =
            draws.state(seed, index).iter().map(|value| [value.to_f64().0]).collect();
        evaluator.run(&point);
        let slopes = evaluator.outputs().map(|block| block[0]);
        let matrix = DMatrix::from_iterator(model.dimension(), inputs, slopes);
        if matrix.iter().any(|x| !x.is_finite()) {
            return 0;
        }
        let pivots: Vec<f64> =
            matrix.full_piv_lu().u().diagonal().iter().map(|pivot| pivot.abs()).collect();
        let largest = pivots.iter().copied().fold(0.0, f64::max);
        pivots.iter().filter(|pivot| **pivot > largest * f64::EPSILON.sqrt()).count()
    };
    Ok((0..LANES as u64).map(rank_at).max().unwrap_or(0))
}
