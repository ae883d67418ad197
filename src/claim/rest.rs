//! Rests of a spinning body near which no density exists.
//!
//! At ω = εγ₀ the normal is at rest. If no moment acts on the body at rest there, K(0,γ₀) = 0, and
//! S×γ₀ = 0, then ω' = O(ε²), while div v = εC₁(γ₀): Liouville's equation, divided by ε → 0, asks
//! for C₁(γ₀) = 0.

use nalgebra::Vector3;
use num_dual::DualNum;

use super::elsewhere::inside;
use crate::graph::{Evaluator, Expr, Tape, record};
use crate::mechanics::{DrawSource, Model, NORMAL, Phase};
use crate::number::Domain;
use crate::number::ball::Ball;
use crate::proof::{Group, GroupOutcome, Prover};
use crate::scalar::Scalar;

/// Number of bodies of the case that are tried.
const BODIES: u64 = 8;

/// A candidate for γ₀, apart from its sign.
#[derive(Clone, Copy)]
enum RestDirection {
    Axis(usize),
    Rotor,
}

/// Finds a rest γ₀, proved for all parameters, at which C₁ is not 0 for some; returns its name.
pub(super) fn without_density(model: &Model) -> Option<String> {
    if !model.system.rest_excludes_densities() || !model.extension.is_empty() {
        return None;
    }
    let rotor = model.system.gyrostat().map(|_| RestDirection::Rotor);
    let directions = [2, 1, 0].map(RestDirection::Axis).into_iter().chain(rotor);
    let both = directions.flat_map(|one| [(one, true), (one, false)]);
    both.into_iter().find(|(one, up)| excludes(model, *one, *up).is_some()).map(|(one, up)| {
        let sign = if up { "" } else { "−" };
        match one {
            RestDirection::Axis(k) => format!("γ = {sign}e{}", k + 1),
            RestDirection::Rotor => format!("γ = {sign}S/|S|"),
        }
    })
}

/// Proves that the direction is a rest and that C₁ is not 0 there.
fn excludes(model: &Model, direction: RestDirection, up: bool) -> Option<()> {
    let draws = model.parameter_draws();
    let (graph, (torque, written, along)) = record(draws.len(), |inputs| {
        let (free, _) = model.make_parameters(inputs);
        let zero = Expr::from(0.0);
        let phase_at = |gamma: Vector3<Expr>| {
            let state = [[zero; 3], gamma.into()].concat();
            Phase::new(model, &free, &state)
        };
        let rotor = |phase: &Phase<'_, Expr>| {
            let value = model.system.gyrostat().map(|rotor| phase.configuration.evaluate(rotor));
            value.map(|value| value.vector().unwrap_or_else(|| Vector3::repeat(Expr::undefined())))
        };
        let sign = Expr::from(if up { 1.0 } else { -1.0 });
        let mut axis = Vector3::repeat(zero);
        match direction {
            RestDirection::Axis(k) => axis[k] = sign,
            RestDirection::Rotor => {
                axis.z = Expr::from(1.0);
                if let Some(rotor) = rotor(&phase_at(axis)) {
                    let length = rotor.dot(&rotor).sqrt();
                    axis = rotor.map(|x| sign * x / length);
                }
            }
        }
        let phase = phase_at(axis);
        let mut torque = phase.field()[..3 * NORMAL].to_vec();
        torque.extend(rotor(&phase).iter().flat_map(|rotor| {
            let across: [Expr; 3] = rotor.cross(&axis).into();
            across
        }));
        let potential = model.system.potential_formula().into_iter();
        let potential = potential.flat_map(|own| phase.evaluate_literally(own).components());
        (torque, inside(potential.collect()), model.system.criterion(&phase).first().copied())
    })
    .ok()?;
    let along = along?;
    let prover = Prover { sources: &[], extents: &[], seed: 1 };
    let outcomes = prover.prove(&graph, &[Group::of(torque.clone())]).ok()?;
    if !matches!(outcomes.as_slice(), [GroupOutcome::Zero(_)]) {
        return None;
    }
    // A potential may have no slope at the rest.
    let outputs: Vec<Expr> = torque.into_iter().chain(written).chain([along]).collect();
    let tape = Tape::new(&graph, &outputs);
    let mut evaluator = Evaluator::new(&tape, Ball::<1>);
    let numbers = DrawSource::new(&draws);
    (0..BODIES).find_map(|index| {
        let values = numbers.state(0, index);
        let inputs: Vec<_> = values.into_iter().map(|value| Ball::<1>.values(&[value])).collect();
        evaluator.run(&inputs);
        let balls: Vec<_> = evaluator.outputs().collect();
        let (along, motion) = balls.split_last()?;
        let exists = motion.iter().all(|ball| ball.is_defined(0));
        (exists && along.is_defined(0) && along.excludes_zero(0)).then_some(())
    })
}
