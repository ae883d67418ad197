//! Slopes of the constraints of a Lagrangian system at states: where all of one vanish, the motion is not determined.

use num_traits::{One, Zero};

use super::run::Run;
use super::sampler::TAPE_LANES;
use crate::graph::{Expr, record};
use crate::mechanics::{LevelFunction, Model, Phase, System};
use crate::number::ball::{Ball, Balls};

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
    let flat = &lagrangian.constraints[(0..count).find(is_flat)?];
    let is_own = |function: &LevelFunction| match function {
        LevelFunction::Formula(function) => function.text() == flat.text(),
        _ => false,
    };
    let equation = model.level.iter().find(|own| is_own(&own.function));
    Some(equation.map_or_else(|| flat.text().to_string(), |own| own.text.clone()))
}
