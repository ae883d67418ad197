//! Equations of a level that follow from its others, or contradict them.

use super::equations::ENTRY;
use crate::graph::{literally, record};
use crate::mechanics::{LevelEquation, Model, Phase};
use crate::proof::LinearDependence;

/// Leaves out equations of the level that are combinations of the others with rational multiples, as
/// polynomials in state and parameters; returns a remark on each. Those that `is_given` does not accept
/// stay.
///
/// # Errors
/// The text of an equation that contradicts those before it.
pub fn leave_out(
    model: &mut Model,
    is_given: impl Fn(&LevelEquation) -> bool,
) -> Result<Vec<String>, String> {
    let given: Vec<bool> = model.level.iter().map(is_given).collect();
    if !given.contains(&true) || given.len() < 2 {
        return Ok(Vec::new());
    }
    let own: &Model = model;
    let recorded = record(own.free_components() + own.dimension(), |inputs| {
        let (parameters, state) = inputs.split_at(own.free_components());
        let phase = Phase::new(own, parameters, state);
        let value = |equation: &LevelEquation| phase.level_function(&equation.function);
        literally(|| own.level.iter().map(value).collect::<Vec<_>>())
    });
    let Ok((graph, values)) = recorded else { return Ok(Vec::new()) };
    let found = LinearDependence::of(&graph, &values, &given);
    if let Some(index) = found.contradiction.filter(|index| given[*index]) {
        return Err(model.level[index].text.clone());
    }
    let remark = |index: &usize| {
        let text = &model.level[*index].text;
        format!("`{text}` follows from the other equations of the level, and is left out")
    };
    let remarks = found.implied.iter().map(remark).collect();
    let mut places = 0..;
    model.level.retain(|_| !places.next().is_some_and(|place| found.implied.contains(&place)));
    Ok(remarks)
}

/// Whether an equation of the level is one of these texts, or an entry of one.
pub fn is_one_of(equation: &LevelEquation, texts: &[String]) -> bool {
    let text = equation.text.split_once(ENTRY).map_or(&*equation.text, |(text, _)| text);
    texts.iter().any(|own| own == text)
}
