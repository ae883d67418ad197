//! `[lagrangian]`: kinetic energy, potential, constraints.

use super::body::formula;
use super::error::{CaseError, Problem};
use super::field;
use super::section::{Section, Text};
use super::systems::Reading;
use crate::formula::{Formula, Type, canonical_name};
use crate::mechanics::{
    Algebra, Lagrangian, LevelEquation, LevelFunction, Reach, Role, System, Variable, Vocabulary,
};

fn other(text: &Text, message: String, remedy: &str) -> CaseError {
    CaseError::at(text.span.clone(), Problem::Other { message, remedy: remedy.to_string() })
}

/// Reads it; state and abbreviations are declared, and the level becomes the constraints.
pub fn read(
    reading: &mut Reading<'_, '_>,
    section: &Section<'_>,
    vakonomic: bool,
) -> Result<System, CaseError> {
    let vocabulary = &reading.vocabulary;
    let scalar = |text: &Text, what: &str| {
        formula(text, vocabulary, what, Some(Type::Scalar), Reach::Configuration)
    };
    let kinetic = section.required("kinetic", "add kinetic = \"m*x'²/2\"")?;
    let kinetic = scalar(&kinetic, "the kinetic energy")?;
    let potential = match section.text("potential")? {
        Some(text) => Some(scalar(&text, "the potential")?),
        None => None,
    };
    let level = field::equations_in(section, "constraints", vocabulary, Reach::Configuration)?;
    let constraints: Vec<Formula> = level.iter().map(|(_, function)| function.clone()).collect();
    let variables = reading.state.variables.clone();
    let names = |key| named(section, key, &variables);
    let (quasi, multipliers) = (names("quasi-velocities")?, names("multipliers")?);
    if multipliers.len() != if vakonomic { constraints.len() } else { 0 } {
        let message = format!(
            "{} multipliers stand beside {} constraints",
            multipliers.len(),
            constraints.len()
        );
        let remedy = match vakonomic {
            true => "name a state variable for each constraint: multipliers = [\"λ\"]",
            false => "a nonholonomic system has none: their values are the names μ1, μ2, …",
        };
        return Err(section.complaint(Problem::Other { message, remedy: remedy.to_string() }));
    }
    let carried = carried(reading, vocabulary)?;
    let mut roles = Vec::new();
    for (index, variable) in variables.iter().enumerate() {
        let velocity = variables.iter().position(|v| v.name == format!("{}'", variable.name));
        let of = variable.name.strip_suffix('\'');
        let is_velocity =
            quasi.contains(&index) || variables.iter().any(|v| Some(v.name.as_str()) == of);
        let rate = carried.iter().find(|(carried, _)| *carried == index).map(|(_, rate)| rate);
        roles.push(match (rate, velocity) {
            _ if multipliers.contains(&index) => Role::Multiplier,
            _ if is_velocity => Role::Velocity,
            (Some(rate), _) => Role::Carried(rate.clone()),
            (None, Some(velocity)) if variables[velocity].kind == variable.kind => {
                Role::Coordinate(velocity)
            }
            _ => {
                let name = &variable.name;
                return Err(section.complaint(Problem::Other {
                    message: format!("`{name}` is neither a velocity nor has it one"),
                    remedy: format!(
                        "declare `{name}'` in [state], or give its rate in [field], or name it in \
                         quasi-velocities or multipliers"
                    ),
                }));
            }
        });
    }
    let algebra = algebra(section, &variables, &quasi, &roles)?;
    let forces = forces(section, vocabulary, &variables, &roles)?;
    reading.level = level
        .into_iter()
        .map(|(text, function)| LevelEquation { text, function: LevelFunction::Formula(function) })
        .collect();
    Ok(System::Lagrangian(Box::new(Lagrangian {
        kinetic,
        potential,
        constraints,
        roles,
        algebra,
        forces,
        vakonomic,
    })))
}

/// The state variables that a list names.
fn named(
    section: &Section<'_>,
    key: &'static str,
    variables: &[Variable],
) -> Result<Vec<usize>, CaseError> {
    let texts = if section.value(key).is_some() { section.texts(key)? } else { Vec::new() };
    texts
        .iter()
        .map(|text| {
            let name = canonical_name(&text.value).unwrap_or_default();
            variables.iter().position(|variable| variable.name == name).ok_or_else(|| {
                let message = format!("`{}` is no state variable", text.value);
                other(text, message, "declare it in [state]")
            })
        })
        .collect()
}

/// The rates that `[field]` gives.
fn carried(
    reading: &Reading<'_, '_>,
    vocabulary: &Vocabulary,
) -> Result<Vec<(usize, Formula)>, CaseError> {
    let Some(section) = reading.root.section("field")? else { return Ok(Vec::new()) };
    let variables = &reading.state.variables;
    let mut rates = Vec::new();
    for (key, value) in section.entries() {
        let name = canonical_name(key.get_ref()).unwrap_or_default();
        let plain = name.strip_suffix('\'').unwrap_or(&name);
        let text = section.as_text(key.get_ref(), value)?;
        let Some(index) = variables.iter().position(|variable| variable.name == plain) else {
            let message = format!("`{}` is the rate of no state variable", key.get_ref());
            return Err(other(&text, message, "declare the variable in [state]"));
        };
        let kind = Some(variables[index].kind);
        let what = format!("the rate of {plain}");
        rates.push((index, formula(&text, vocabulary, &what, kind, Reach::Configuration)?));
    }
    Ok(rates)
}

fn algebra(
    section: &Section<'_>,
    variables: &[Variable],
    quasi: &[usize],
    roles: &[Role],
) -> Result<Algebra, CaseError> {
    let start = |index: usize| variables[..index].iter().map(Variable::len).sum::<usize>();
    if let Some(text) = section.text("algebra")? {
        let vectors: Vec<usize> =
            quasi.iter().copied().filter(|i| variables[*i].kind == Type::VECTOR).collect();
        return match (text.value.as_str(), vectors.as_slice()) {
            ("so(3)", [index]) if quasi.len() == 1 => Ok(Algebra::Rotations(start(*index))),
            ("so(3)", _) => {
                let message = "so(3) acts on one vector of quasi-velocities".to_string();
                Err(other(&text, message, "write quasi-velocities = [\"ω\"] with ω a vector"))
            }
            (found, _) => {
                let message = format!("`{found}` is no algebra that is known");
                let remedy = "write \"so(3)\", or leave it out: the commutators are computed from \
                              [field] where the coordinates are as many as the velocities";
                Err(other(&text, message, remedy))
            }
        };
    }
    if quasi.is_empty() {
        return Ok(Algebra::Commuting);
    }
    let count = |keep: &dyn Fn(&Role) -> bool| -> usize {
        let kept = roles.iter().zip(variables).filter(|(role, _)| keep(role));
        kept.map(|(_, variable)| variable.len()).sum()
    };
    let velocities = count(&|role| matches!(role, Role::Velocity));
    let coordinates = count(&|role| matches!(role, Role::Coordinate(_) | Role::Carried(_)));
    if velocities == coordinates {
        return Ok(Algebra::Frame);
    }
    Err(section.complaint(Problem::Other {
        message: format!(
            "{velocities} velocities and {coordinates} coordinates: the commutators of the \
             quasi-velocities are not determined"
        ),
        remedy:
            "give as many coordinates as velocities, with their rates in [field], or algebra = \
                 \"so(3)\""
                .to_string(),
    }))
}

fn forces(
    section: &Section<'_>,
    vocabulary: &Vocabulary,
    variables: &[Variable],
    roles: &[Role],
) -> Result<Vec<(usize, Formula)>, CaseError> {
    let Some(table) = section.section("forces")? else { return Ok(Vec::new()) };
    let mut forces = Vec::new();
    for (key, value) in table.entries() {
        let text = table.as_text(key.get_ref(), value)?;
        let name = canonical_name(key.get_ref()).unwrap_or_default();
        let index = variables.iter().position(|variable| variable.name == name);
        let velocity = index.and_then(|index| match roles[index] {
            Role::Coordinate(velocity) => Some(velocity),
            Role::Velocity => Some(index),
            _ => None,
        });
        let scalar = velocity.filter(|velocity| variables[*velocity].kind == Type::Scalar);
        let Some(velocity) = scalar else {
            let message = format!("`{}` is no scalar coordinate or quasi-velocity", key.get_ref());
            return Err(other(&text, message, "name what the force acts on"));
        };
        let component = variables[..velocity].iter().map(Variable::len).sum();
        let kind = Some(Type::Scalar);
        forces
            .push((component, formula(&text, vocabulary, "a force", kind, Reach::Configuration)?));
    }
    Ok(forces)
}
