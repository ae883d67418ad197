//! Values at a time of a motion, proved by an enclosure of the state there.

use super::judgement::MotionJudgement;
use super::scene::FollowedCase;
use crate::motion::recorded::{filled, point};
use crate::{Enclosure, FlowError, MeasuredNumber, Obstacle, follow};
use liouville::claim::Components;
use liouville::claim::motion::{Beginning, Reaches};
use liouville::formula::Formula;
use liouville::graph::{Evaluator, Expr, Tape, literally, record};
use liouville::mechanics::{LevelEquation, Model, Phase};
use liouville::number::ball::{Ball, Balls};
use liouville::number::exact::Exact;
use liouville::number::rational::Rational;
use liouville::scalar::Scalar;

/// Relative distance within which the stated time lies from its f64.
const TIME: f64 = 4.0 * f64::EPSILON;

/// Encloses the state of a claim, and compares the function there with its bounds.
pub fn judge(claim: &Reaches, scene: &FollowedCase<'_>) -> Result<MotionJudgement, FlowError> {
    let mut judgement = MotionJudgement::default();
    let (case, model) = (scene.case, &scene.case.model);
    if model.system.has_arbitrary_function() {
        return Err(FlowError::Arbitrary);
    }
    if model.system.is_map() {
        return Err(FlowError::Discrete);
    }
    let reason = if model.free_components() > 0 {
        Some("some parameters have ranges, and a motion is enclosed for fixed values")
    } else if case.one_sided.is_some() {
        Some("under a one-sided constraint no motion is enclosed")
    } else {
        None
    };
    if let Some(reason) = reason {
        judgement.leave_open(reason.to_string());
        return Ok(judgement);
    }
    let Beginning::State(state) = &claim.beginning else { return Err(FlowError::NoStart) };
    let parameters = scene.parameters()?;
    let start = match exact_start(model, &parameters, state)? {
        Ok(start) => start,
        Err(reason) => {
            judgement.leave_open(reason);
            return Ok(judgement);
        }
    };
    let time = Enclosure::about(claim.time, TIME * claim.time);
    match follow(model, &parameters, &start, time) {
        Ok(reached) => {
            weigh(claim, model, &parameters, &reached.state, &mut judgement)?;
            let steps = reached.steps;
            let digits = reached.state.iter().map(|x| x.rad).fold(0.0, f64::max);
            judgement.theorem = Some(format!(
                "the state at t = {} is enclosed within {digits:.1e} by {steps} Taylor steps",
                claim.time_text
            ));
        }
        Err(Obstacle::Motion(problem)) => return Err(problem),
        Err(obstacle) => judgement.leave_open(obstacle.to_string()),
    }
    Ok(judgement)
}

/// Equations of the level, and those that choose halves of it.
fn equations(model: &Model) -> impl Iterator<Item = &LevelEquation> {
    model.level.iter().chain(model.orientations.iter().map(|own| &own.equation))
}

/// Encloses the state of a claim, or returns the reason why it is not known to lie on the level.
fn exact_start(
    model: &Model,
    parameters: &[Rational],
    state: &Components,
) -> Result<Result<Vec<Enclosure>, String>, FlowError> {
    let (graph, outputs) = record(model.dimension(), |inputs| {
        let mut outputs = state.at(&point(model, parameters, inputs));
        let at = Phase::new(model, &filled(parameters, &[], &[]), &outputs);
        let level = equations(model).map(|equation| at.level_function(&equation.function));
        outputs.extend(level.collect::<Vec<_>>());
        outputs
    })?;
    let tape = Tape::new(&graph, &outputs);
    let mut exact = Evaluator::new(&tape, Exact);
    exact.run(&vec![Some(Rational::from(0)); model.dimension()]);
    for (equation, value) in equations(model).zip(exact.outputs().skip(model.dimension())) {
        match value {
            Some(value) if value.is_zero() => {}
            Some(_) => return Ok(Err(format!("the state violates {}", equation.text.trim()))),
            None => {
                let text = equation.text.trim();
                return Ok(Err(format!(
                    "it is not known whether the state satisfies {text}: give rational numbers"
                )));
            }
        }
    }
    let mut balls = Evaluator::new(&tape, Ball::<1>);
    balls.run(&vec![Balls::new([0.0], [0.0]); model.dimension()]);
    let start: Vec<Enclosure> =
        balls.outputs().take(model.dimension()).map(Enclosure::first).collect();
    match start.iter().all(|x| x.is_finite()) {
        true => Ok(Ok(start)),
        false => Ok(Err("the state has no value".to_string())),
    }
}

/// Compares the function with its bounds over a box of states.
fn weigh(
    claim: &Reaches,
    model: &Model,
    parameters: &[Rational],
    state: &[Enclosure],
    judgement: &mut MotionJudgement,
) -> Result<(), FlowError> {
    let formulas: Vec<&Formula> =
        [Some(&claim.function), claim.above.as_ref(), claim.below.as_ref()]
            .into_iter()
            .flatten()
            .collect();
    let (graph, outputs) = record(model.dimension(), |inputs| {
        let at = point(model, parameters, inputs);
        let zero = Expr::rational(&Rational::from(0));
        // As written √x·√x has no value for x < 0, and 0·√x neither.
        let existing = |formula: &&Formula| {
            let written = at.evaluate_literally(formula).components();
            literally(|| written.into_iter().fold(zero, |sum, own| sum + zero * own))
        };
        let mut outputs: Vec<Expr> = formulas.iter().map(existing).collect();
        let value = at.scalar(&claim.function);
        outputs.push(value);
        outputs.extend(claim.above.iter().map(|bound| value - at.scalar(bound)));
        outputs.extend(claim.below.iter().map(|bound| at.scalar(bound) - value));
        outputs
    })?;
    let tape = Tape::new(&graph, &outputs);
    let mut evaluator = Evaluator::new(&tape, Ball::<1>);
    evaluator.run(&state.iter().map(|x| x.block()).collect::<Vec<_>>());
    let values: Vec<Enclosure> = evaluator.outputs().map(Enclosure::first).collect();
    let (existing, values) = values.split_at(formulas.len());
    let missing = formulas.iter().zip(existing).find(|(_, value)| !value.is_finite());
    if let Some((formula, _)) = missing {
        let text = formula.text().trim();
        judgement.leave_open(format!("`{text}` may have no value at the state reached"));
        return Ok(());
    }
    let found = MeasuredNumber { value: values[0].mid, error: values[0].rad };
    judgement.note(claim.function.text().trim(), found, None);
    let bounds = [(&claim.above, "above"), (&claim.below, "below")];
    let given = bounds.iter().filter_map(|(bound, side)| Some((bound.as_ref()?, side)));
    for ((bound, side), margin) in given.zip(&values[1..]) {
        let bound = bound.text().trim();
        if (-*margin).is_positive() {
            judgement.refute(format!("it is not {side} {bound}"));
        } else if !margin.is_positive() {
            judgement
                .leave_open(format!("the enclosure does not decide whether it is {side} {bound}"));
        }
    }
    Ok(())
}
