//! Coordinates that do not occur in the equations of motion: closed orbits come in families of shifted
//! ones, or close only up to a shift.

use crate::error::FlowError;
use crate::motion::recorded::point;
use crate::motion::start::Start;
use liouville::graph::record;
use liouville::mechanics::Model;

/// Names the coordinates for which a search for closed orbits has degenerate equations, if there are
/// any.
pub(crate) fn explained(model: &Model, start: &Start, problem: FlowError) -> FlowError {
    let FlowError::Degenerate(time) = problem else { return problem };
    match names(model, start) {
        Some(names) if !names.is_empty() => FlowError::Cyclic { time, names: names.join(", ") },
        _ => problem,
    }
}

/// Components that occur neither in the rates nor in the level.
fn names(model: &Model, start: &Start) -> Option<Vec<String>> {
    let dimension = model.dimension();
    let (graph, found) = record(dimension, |state| {
        let phase = point(model, &start.parameters, state);
        let level = model.level.iter().map(|equation| phase.level_function(&equation.function));
        level.chain(phase.field().iter().copied()).collect::<Vec<_>>()
    })
    .ok()?;
    let used: Vec<usize> = found.iter().flat_map(|one| graph.inputs_of(*one)).collect();
    let is_free = |place: &usize| !used.contains(place);
    Some((0..dimension).filter(is_free).map(|place| model.component_name(place)).collect())
}
