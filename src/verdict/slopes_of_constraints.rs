//! Slopes of the constraints of a Lagrangian system by the velocities: where all of one vanish, the motion is not
//! determined.

use num_traits::{One, Zero};

use super::run::Run;
use super::sampler::{Sampler, TAPE_LANES};
use crate::formula::Formula;
use crate::graph::{Expr, Fault, record};
use crate::mechanics::{Lagrangian, LevelFunction, Meaning, Model, Phase, System, VariableRole};
use crate::number::ball::{Ball, Balls};
use crate::proof::is_nowhere_zero;

/// Returns the text of the first constraint of which no slope by a velocity is known not to be 0 at some of the states.
pub fn slopeless(model: &Model, states: &[Balls<TAPE_LANES>]) -> Option<String> {
    let System::Lagrangian(lagrangian) = &model.system else { return None };
    let velocities = lagrangian.velocities(&model.state);
    let free = model.free_components();
    let recorded = record(free + model.dimension(), |inputs| {
        let (parameters, state) = inputs.split_at(free);
        let at = Phase::new(model, parameters, state).configuration;
        let slopes = |component: &usize| {
            let mut unit = vec![Expr::zero(); model.dimension()];
            unit[*component] = Expr::one();
            let moved = at.lift_state(&unit);
            lagrangian.constraints.iter().map(|f| moved.scalar(f).eps).collect::<Vec<Expr>>()
        };
        velocities.iter().flat_map(slopes).collect::<Vec<Expr>>()
    });
    let (graph, slopes) = recorded.ok()?;
    let values = Run::new(&graph, &slopes, graph.inputs()).at(&Ball::<TAPE_LANES>, states);
    let count = lagrangian.constraints.len();
    let is_slope = |index: usize| (0..TAPE_LANES).any(|k| values.output(index).excludes_zero(k));
    let is_flat = |own: &usize| !(*own..slopes.len()).step_by(count).any(is_slope);
    Some(written(model, &lagrangian.constraints[(0..count).find(is_flat)?]))
}

/// Returns the equation of a constraint as the file writes it.
fn written(model: &Model, constraint: &Formula) -> String {
    let is_own = |function: &LevelFunction| match function {
        LevelFunction::Formula(function) => function.text() == constraint.text(),
        _ => false,
    };
    let equation = model.level.iter().find(|own| is_own(&own.function));
    equation.map_or_else(|| constraint.text().to_string(), |own| own.text.clone())
}

/// Remarks on constraints that hold where a factor of coordinates alone is 0, as (x − y) x' = 0 on x = y: there
/// accelerations have no value. Factors that are nowhere 0 by intervals have none.
pub fn on_still_factors(model: &Model, sampler: &Sampler) -> Result<Vec<String>, Fault> {
    let System::Lagrangian(lagrangian) = &model.system else { return Ok(Vec::new()) };
    let mut remarks = Vec::new();
    if lagrangian.vakonomic {
        return Ok(remarks);
    }
    for constraint in &lagrangian.constraints {
        let factors = constraint.factors().unwrap_or_default();
        let still: Vec<Formula> =
            factors.into_iter().filter(|own| is_still(model, lagrangian, own)).collect();
        if still.is_empty() {
            continue;
        }
        let free = model.free_components();
        let (graph, values) = record(free + model.dimension(), |inputs| {
            let (parameters, state) = inputs.split_at(free);
            let phase = Phase::new(model, parameters, state);
            still.iter().map(|own| phase.scalar(own)).collect::<Vec<Expr>>()
        })?;
        let fixed = vec![None; sampler.recipes().len()];
        let (graph, values) = sampler.compose(&graph, &[values], &fixed)?;
        let extents = sampler.extents();
        let has_none = |value: &Expr| is_nowhere_zero(&graph, &extents, &[], &[*value]);
        if !values.iter().flatten().all(has_none) {
            remarks.push(format!(
                "nothing is said where a factor without velocities of the constraint `{}` is 0: the \
                 accelerations have no value there",
                written(model, constraint)
            ));
        }
    }
    Ok(remarks)
}

/// Whether a formula contains a coordinate, and nothing that velocities are in.
fn is_still(model: &Model, lagrangian: &Lagrangian, formula: &Formula) -> bool {
    let is_moving = |meaning: Meaning| match meaning {
        Meaning::State(index) => {
            matches!(lagrangian.roles[index], VariableRole::Velocity | VariableRole::Multiplier(_))
        }
        Meaning::Quantity(_) => true,
        Meaning::Parameter(_) | Meaning::Abbreviation(_) => false,
    };
    let used = model.vocabulary.uses(formula, &model.abbreviations);
    let is_of_state = used.iter().any(|own| matches!(own.meaning, Meaning::State(_)));
    is_of_state && !used.iter().any(|own| is_moving(own.meaning))
}
