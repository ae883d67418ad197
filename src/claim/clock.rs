//! Time as a variable of the state, as in a file whose formulas use `t`.

use super::statement::Objection;
use crate::graph::record;
use crate::mechanics::{Model, Phase, TIME};

/// Index of the variable `t`, if it is one of the state and its rate is 1.
pub fn clock(model: &Model) -> Option<usize> {
    let index = model.state.iter().position(|variable| variable.name == TIME)?;
    let before = model.state[..index].iter().map(|variable| variable.kind.size()).sum::<usize>();
    let parameters = model.free_components();
    if model.system.is_map() {
        return None;
    }
    let recorded = record(parameters + model.dimension(), |inputs| {
        let (parameters, state) = inputs.split_at(parameters);
        Phase::new(model, parameters, state).field().get(before).copied()
    });
    let (graph, rate) = recorded.ok()?;
    graph.constant_value(rate?).filter(|rate| rate.is_one()).map(|_| index)
}

/// Objection to a claim that rests on the field being 0, where time is a variable.
pub fn never_rests(model: &Model, name: &str) -> Option<Objection> {
    clock(model).map(|_| Objection {
        message: format!("`{name}`: `t` is a variable of rate 1 here, so that nothing rests"),
        remedy: "remove `t` from [state] if only claims use it; points that rest need equations without `t`",
    })
}
