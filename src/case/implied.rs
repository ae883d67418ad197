//! Equations of a level and constraints that follow from others, or contradict them.

use crate::graph::{literally, record};
use crate::mechanics::{
    Lagrangian, LevelEquation, LevelFunction, Meaning, Model, Phase, Quantity, System,
    VocabularyEntry,
};
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
    let mut implied = found.implied;
    implied.sort_unstable();
    for place in implied.into_iter().rev() {
        model.leave_out(place);
    }
    Ok(remarks)
}

/// Whether an equation of the level is one of these texts, or an entry of one.
pub fn is_one_of(equation: &LevelEquation, texts: &[String]) -> bool {
    texts.iter().any(|own| own == equation.written())
}

/// Leaves out constraints of a nonholonomic system on velocities that are combinations of the others with rational
/// multiples, as polynomials: the rate of a constraint on coordinates, or one that is stated twice. Returns a
/// remark on each. Reactions are not determined then, and have no names.
pub fn leave_out_constraints(model: &mut Model) -> Vec<String> {
    let found = implied_constraints(model);
    if found.is_empty() {
        return Vec::new();
    }
    let remark = |(_, equation): &(usize, usize)| {
        let text = &model.level[*equation].text;
        format!(
            "`{text}` follows from the other constraints, and is left out; their reactions have no names, as \
             they are not unique"
        )
    };
    let remarks = found.iter().map(remark).collect();
    for (constraint, equation) in found.into_iter().rev() {
        if let System::Lagrangian(lagrangian) = &mut model.system {
            lagrangian.constraints.remove(constraint);
        }
        model.leave_out(equation);
    }
    model.vocabulary = model.vocabulary.only(|entry| !is_reaction(entry));
    remarks
}

/// Whether an entry is the name of a reaction.
pub fn is_reaction(entry: &VocabularyEntry) -> bool {
    matches!(entry.meaning, Meaning::Quantity(Quantity::Reaction(_)))
}

/// Whether the equations of motion or the abbreviations contain reactions.
pub fn uses_reactions(model: &Model) -> bool {
    let formulas = model.dynamics().into_iter().chain(&model.abbreviations).chain(&model.extension);
    let mut used =
        formulas.flat_map(|formula| model.vocabulary.uses(formula, &model.abbreviations));
    used.any(is_reaction)
}

/// Places of the constraints among the equations of the level, and whether each is the rate of the equation before it;
/// `None` where the level is not theirs.
pub fn places_of_constraints(lagrangian: &Lagrangian, model: &Model) -> Option<Vec<(bool, usize)>> {
    let (mut places, mut place) = (Vec::new(), 0);
    for constraint in &lagrangian.constraints {
        let is_own = |place: usize| match model.level.get(place).map(|own| &own.function) {
            Some(LevelFunction::Formula(function)) => function.text() == constraint.text(),
            _ => false,
        };
        let is_rate = !is_own(place);
        place += usize::from(is_rate);
        if !is_own(place) {
            return None;
        }
        places.push((is_rate, place));
        place += 1;
    }
    Some(places)
}

/// Lists such constraints by their number and that of their equation of the level.
fn implied_constraints(model: &Model) -> Vec<(usize, usize)> {
    let System::Lagrangian(lagrangian) = &model.system else { return Vec::new() };
    if lagrangian.vakonomic || lagrangian.constraints.len() < 2 || uses_reactions(model) {
        return Vec::new();
    }
    let Some(places) = places_of_constraints(lagrangian, model) else { return Vec::new() };
    let recorded = record(model.free_components() + model.dimension(), |inputs| {
        let (parameters, state) = inputs.split_at(model.free_components());
        let phase = Phase::new(model, parameters, state);
        let value = |constraint| phase.scalar(constraint);
        literally(|| lagrangian.constraints.iter().map(value).collect::<Vec<_>>())
    });
    let Ok((graph, values)) = recorded else { return Vec::new() };
    let may_be_left_out: Vec<bool> = places.iter().map(|(is_rate, _)| !is_rate).collect();
    let found = LinearDependence::of(&graph, &values, &may_be_left_out);
    if found.contradiction.is_some() {
        return Vec::new();
    }
    found.implied.into_iter().map(|index| (index, places[index].1)).collect()
}
