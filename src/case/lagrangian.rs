//! The table `[lagrangian]`: kinetic energy, potential, constraints.

use super::entries::mistake_at;
use super::equations;
use super::error::{Mistake, Problem};
use super::field::{self, GivenRate};
use super::formulas::{formula, inside};
use super::holonomic;
use super::section::{CaseTable, SpannedStr};
use super::shaped;
use super::systems::Reading;
use crate::formula::{Formula, Type, canonical_name};
use crate::mechanics::{
    AccelerationSolver, Algebra, Dependence, Lagrangian, LevelEquation, System, TIME, Variable,
    VariableRole, Vocabulary,
};

/// Reads the table; state and abbreviations are declared, and the level becomes the constraints.
/// `None` where there is a mistake.
pub fn read(
    reading: &mut Reading<'_, '_>,
    section: &CaseTable<'_>,
    vakonomic: bool,
) -> Option<System> {
    let vocabulary = &reading.vocabulary;
    let scalar = |text: &SpannedStr, what: &str| {
        formula(text, vocabulary, what, Some(Type::Scalar), Dependence::Configuration)
    };
    let kinetic = section.required("kinetic", "add kinetic = \"m*x'²/2\"");
    let kinetic = section.keep(kinetic.and_then(|text| scalar(&text, "the kinetic energy")));
    let potential = section.text("potential");
    let read =
        |text: Option<SpannedStr>| text.map(|text| scalar(&text, "the potential")).transpose();
    let potential = section.keep(potential.and_then(read));
    let level =
        equations::equations_in(section, "constraints", vocabulary, Dependence::Configuration);
    let variables = &reading.state.variables;
    let names = |key| section.keep(named(section, key, variables));
    let (quasi, multipliers) = (names("quasi-velocities"), names("multipliers"));
    let carried = carried(reading);
    let (quasi, multipliers, mut level) = (quasi?, multipliers?, level?);
    section.keep(counted(section, &multipliers, level.len(), vakonomic))?;
    level.extend(reading.rotations(true));
    let roles = roles(section, variables, &quasi, &multipliers, carried)?;
    let algebra = section.keep(algebra(section, variables, &quasi, &roles));
    let forces = forces(section, vocabulary, variables, &roles);
    let (constraints, level) = section.keep(constraints(level, reading, &roles, vakonomic))?;
    let system = System::Lagrangian(Box::new(Lagrangian {
        kinetic: kinetic?,
        potential: potential?,
        constraints,
        roles,
        algebra: algebra?,
        forces: forces?,
        vakonomic,
        solver: AccelerationSolver::ELIMINATION,
    }));
    reading.level = level;
    Some(system)
}

/// Lists the constraints on the velocities, and the equations of the level: a constraint on the
/// coordinates alone is one of these, and its rate is both.
fn constraints(
    given: Vec<(String, Formula)>,
    reading: &Reading<'_, '_>,
    roles: &[VariableRole],
    vakonomic: bool,
) -> Result<(Vec<Formula>, Vec<LevelEquation>), Mistake> {
    let (mut constraints, mut level) = (Vec::new(), Vec::new());
    let names = holonomic::Names {
        vocabulary: &reading.vocabulary,
        abbreviations: &reading.abbreviations,
        variables: &reading.state.variables,
        roles,
    };
    for (text, function) in given {
        let rate = match vakonomic {
            true => None,
            false => holonomic::rate(&function, &names)
                .map_err(|error| Mistake::new(None, Problem::Formula(error)))?,
        };
        let sides = equations::both_sides(&text, &reading.vocabulary);
        constraints.push(rate.clone().unwrap_or_else(|| function.clone()));
        let derivative = rate.map(|rate| (equations::rate_text(&text, &reading.vocabulary), rate));
        level.push(equations::level_equation(text, function, sides));
        level.extend(derivative.map(|(text, rate)| equations::level_equation(text, rate, None)));
    }
    Ok((constraints, level))
}

/// Checks that a vakonomic system has a multiplier for each constraint, and others have none.
fn counted(
    section: &CaseTable<'_>,
    multipliers: &[usize],
    constraints: usize,
    vakonomic: bool,
) -> Result<(), Mistake> {
    if multipliers.len() == if vakonomic { constraints } else { 0 } {
        return Ok(());
    }
    let message =
        format!("{} multipliers are given for {constraints} constraints", multipliers.len());
    let remedy = match vakonomic {
        true => "name a state variable for each constraint: multipliers = [\"λ\"]",
        false => "a nonholonomic system has none: their values are the names μ1, μ2, …",
    };
    Err(section.complaint(Problem::Other { message, remedy: remedy.to_string() }))
}

/// Role of each state variable; `None` where one is not known.
fn roles(
    section: &CaseTable<'_>,
    variables: &[Variable],
    quasi: &[usize],
    multipliers: &[usize],
    carried: Vec<GivenRate>,
) -> Option<Vec<VariableRole>> {
    let mut roles = Some(Vec::new());
    for ((index, variable), rate) in variables.iter().enumerate().zip(carried) {
        let velocity = variables.iter().position(|v| v.name == format!("{}'", variable.name));
        let of = variable.name.strip_suffix('\'');
        let is_velocity =
            quasi.contains(&index) || variables.iter().any(|v| Some(v.name.as_str()) == of);
        let role = match (rate, velocity) {
            _ if multipliers.contains(&index) => {
                let place = multipliers.iter().position(|own| *own == index).unwrap_or_default();
                Some(VariableRole::Multiplier(place))
            }
            _ if is_velocity => Some(VariableRole::Velocity),
            (GivenRate::Given(rate), _) => Some(VariableRole::Carried(rate)),
            (GivenRate::Broken, _) => None,
            (GivenRate::Missing, Some(velocity)) if variables[velocity].kind == variable.kind => {
                Some(VariableRole::Coordinate(velocity))
            }
            _ if variable.name == TIME && variable.kind == Type::Scalar => Some(VariableRole::Time),
            _ => {
                let name = &shaped::written(variable).name;
                if !section.mistakes().has_failed(&format!("{name}'")) {
                    section.mistakes().add(section.complaint(Problem::Other {
                        message: format!("`{name}` is not a velocity, and has none"),
                        remedy: format!(
                            "declare `{name}'` in [state], or give its rate in [field], or name it \
                             in quasi-velocities or multipliers"
                        ),
                    }));
                }
                None
            }
        };
        match (&mut roles, role) {
            (Some(roles), Some(role)) => roles.push(role),
            _ => roles = None,
        }
    }
    roles
}

/// State variables named in a list.
fn named(
    section: &CaseTable<'_>,
    key: &'static str,
    variables: &[Variable],
) -> Result<Vec<usize>, Mistake> {
    let texts = if section.value(key).is_some() { section.texts(key)? } else { Vec::new() };
    texts
        .iter()
        .map(|text| {
            let name = canonical_name(&text.value).unwrap_or_default();
            variables.iter().position(|variable| variable.name == name).ok_or_else(|| {
                let message = format!("`{}` is not a state variable", text.value);
                mistake_at(text, message, "declare it in [state]")
            })
        })
        .collect()
}

/// Rates given by `[field]`.
fn carried(reading: &Reading<'_, '_>) -> Vec<GivenRate> {
    let variables = &reading.state.variables;
    match reading.root.table("field") {
        Some(section) => {
            field::given_rates(&section, variables, reading.names(), Dependence::Configuration)
        }
        None => variables.iter().map(|_| GivenRate::Missing).collect(),
    }
}

fn algebra(
    section: &CaseTable<'_>,
    variables: &[Variable],
    quasi: &[usize],
    roles: &[VariableRole],
) -> Result<Algebra, Mistake> {
    let start = |index: usize| variables[..index].iter().map(Variable::len).sum::<usize>();
    if let Some(text) = section.text("algebra")? {
        let vectors: Vec<usize> =
            quasi.iter().copied().filter(|i| variables[*i].kind == Type::VECTOR).collect();
        return match (text.value.as_str(), vectors.as_slice()) {
            ("so(3)", [index]) if quasi.len() == 1 => Ok(Algebra::Rotations(start(*index))),
            ("so(3)", _) => {
                let message = "so(3) acts on one vector of quasi-velocities".to_string();
                Err(mistake_at(&text, message, "write quasi-velocities = [\"ω\"] with ω a vector"))
            }
            (found, _) => {
                let message = format!("`{found}` is not a known algebra");
                let remedy = "write \"so(3)\", or leave it out: the commutators are computed from \
                              [field] where the coordinates are as many as the velocities";
                Err(mistake_at(&text, message, remedy))
            }
        };
    }
    if quasi.is_empty() {
        return Ok(Algebra::Commuting);
    }
    let count = |keep: &dyn Fn(&VariableRole) -> bool| -> usize {
        let kept = roles.iter().zip(variables).filter(|(role, _)| keep(role));
        kept.map(|(_, variable)| variable.len()).sum()
    };
    let velocities = count(&|role| matches!(role, VariableRole::Velocity));
    let coordinates =
        count(&|role| matches!(role, VariableRole::Coordinate(_) | VariableRole::Carried(_)));
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

/// Reads forces by the components of the velocities that they act on; `None` where there is a
/// mistake.
fn forces(
    section: &CaseTable<'_>,
    vocabulary: &Vocabulary,
    variables: &[Variable],
    roles: &[VariableRole],
) -> Option<Vec<(usize, Formula)>> {
    let mut forces = Some(Vec::new());
    if let Some(table) = section.keep(section.section("forces"))? {
        for (key, value) in table.entries() {
            let text = table.as_text(key.get_ref(), value);
            let read =
                text.and_then(|text| force(&text, key.get_ref(), vocabulary, variables, roles));
            match (&mut forces, section.keep(read)) {
                (Some(forces), Some(read)) => forces.extend(read),
                _ => forces = None,
            }
        }
    }
    forces
}

/// Reads a force, component by component.
fn force(
    text: &SpannedStr,
    key: &str,
    vocabulary: &Vocabulary,
    variables: &[Variable],
    roles: &[VariableRole],
) -> Result<Vec<(usize, Formula)>, Mistake> {
    let name = canonical_name(key).unwrap_or_default();
    let index = variables.iter().position(|variable| variable.name == name);
    let velocity = index.and_then(|index| match roles[index] {
        VariableRole::Coordinate(velocity) => Some(velocity),
        VariableRole::Velocity => Some(index),
        _ => None,
    });
    let Some(velocity) = velocity else {
        let message = format!("`{key}` is not a coordinate or quasi-velocity");
        return Err(mistake_at(text, message, "name the coordinate on which the force acts"));
    };
    let first: usize = variables[..velocity].iter().map(Variable::len).sum();
    let kind = variables[velocity].kind;
    let whole = formula(text, vocabulary, "a force", Some(kind), Dependence::Configuration)?;
    if kind == Type::Scalar {
        return Ok(vec![(first, whole)]);
    }
    let component = |(place, index): (usize, &String)| {
        let ends = ("(", format!("){index}"));
        let ends = (ends.0, ends.1.as_str());
        let reach = Dependence::Configuration;
        Ok((first + place, inside(text, ends, vocabulary, "a force", Some(Type::Scalar), reach)?))
    };
    kind.indices().iter().enumerate().map(component).collect()
}
