//! Homogeneity of typed support functions; others are meant on the unit sphere.

use num_traits::One;

use crate::graph::{Evaluator, Expr, Tape, record};
use crate::mechanics::calculus::DualPoint;
use crate::mechanics::elimination::dot;
use crate::mechanics::{Chart, DrawSource, Model, NORMAL, Phase, Shape};
use crate::number::Domain;
use crate::number::ball::Ball;
use crate::proof::{Group, GroupOutcome, Prover};

/// Number of states at which Euler's relation is tested.
const STATES: u64 = 4;

/// Replacement for `shape`: its extension off the sphere; `None` if h is homogeneous of degree 1.
///
/// Euler's relation (γ,∇h) = h is evaluated at a few states on the unit sphere and off it. Where a
/// ball excludes 0, or a prime field does, or h is not defined off the sphere, the body's support
/// function is |γ| h(γ/|γ|); for a homogeneous h that would be the same function.
pub fn extension(model: &Model, shape: &Shape) -> Option<Shape> {
    let Shape::Support(formula) = shape else { return None };
    let mut draws = model.parameter_draws();
    draws.extend(Chart::Rolling.draws(&[], &[false, false]));
    let (graph, defects) = record(draws.len(), |inputs| {
        let (free, state) = model.make_parameters(inputs);
        let defect = |kept: [bool; 2]| {
            let mut point = Chart::Rolling.point(model, &kept, &free, state);
            point.resize(model.dimension(), Expr::one());
            let jet = DualPoint::new(Phase::new(model, &free, &point));
            let slope = jet.gradient(|at| at.scalar(formula));
            let gamma = 3 * NORMAL..3 * NORMAL + 3;
            dot(&slope[gamma.clone()], &point[gamma]) - jet.phase.scalar(formula)
        };
        [defect([true, true]), defect([false, true])]
    })
    .ok()?;
    let tape = Tape::new(&graph, &defects);
    let mut evaluator = Evaluator::new(&tape, Ball::<1>);
    let numbers = DrawSource::new(&draws);
    let homogeneous = (0..STATES).all(|index| {
        let values = numbers.state(0, index);
        let inputs: Vec<_> = values.into_iter().map(|value| Ball::<1>.values(&[value])).collect();
        evaluator.run(&inputs);
        evaluator.outputs().all(|ball| ball.is_defined(0) && !ball.excludes_zero(0))
    });
    // A defect below rounding is visible in a prime field.
    let prover = Prover { sources: &[], extents: &[], seed: 0 };
    let homogeneous = homogeneous
        && !matches!(
            prover.prove(&graph, &[Group::of(defects.to_vec())]).as_deref(),
            Ok([GroupOutcome::NonZero(_)])
        );
    (!homogeneous).then(|| Shape::SupportOnSphere(formula.clone()))
}
