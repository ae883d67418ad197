//! Variants of a system with another potential, rotor or force, and with further free constants.

use liouville::case::Case;
use liouville::formula::{Formula, FormulaError, Type};
use liouville::mechanics::{
    Dependence, Draw, Meaning, Model, Parameter, ParameterOrigin, Potential, Range, SamplerSpec,
    System,
};

/// Adds a term to the potential of a model; `None` if the system admits no potential, or if the term
/// is not a function of the configuration.
pub fn with_potential(model: &Model, further: &Formula) -> Option<Model> {
    let mut changed = model.clone();
    match &mut changed.system {
        System::Lagrangian(own) => {
            own.potential = Some(match &own.potential {
                None => further.clone(),
                Some(before) => (before + further).ok()?,
            });
            return Some(changed);
        }
        System::Hamiltonian(own) => {
            own.function = (&own.function + further).ok()?;
            return Some(changed);
        }
        System::FlatBase(own) => {
            own.potential = Some(match &own.potential {
                None => further.clone(),
                Some(before) => (before + further).ok()?,
            });
            return Some(changed);
        }
        _ => {}
    }
    let body = changed.system.body_mut()?;
    let potential = match &body.potential {
        None => further.clone(),
        Some(Potential::Formula(own)) => (own + further).ok()?,
        Some(Potential::Arbitrary(_)) => return None,
    };
    let vocabulary = &changed.vocabulary;
    let reach = vocabulary.reach(&potential).map_or(Dependence::Parameters, |entry| entry.reach);
    if potential.value_type() != Type::Scalar || reach > Dependence::Configuration {
        return None;
    }
    body.potential = Some(Potential::Formula(potential));
    Some(changed)
}

/// Adds terms to the rates of components of a field's state; `None` if the system is no field.
pub fn with_rates(model: &Model, further: &[(usize, Formula)]) -> Option<Model> {
    let mut changed = model.clone();
    let System::Field(rates) = &mut changed.system else { return None };
    let zero = Formula::number(0);
    let mut start = 0;
    for (variable, rate) in model.state.iter().zip(rates) {
        let own = start..start + variable.len();
        start = own.end;
        if !further.iter().any(|(component, _)| own.contains(component)) {
            continue;
        }
        let added = |component| {
            further.iter().find(|(own, _)| *own == component).map_or(&zero, |(_, term)| term)
        };
        let parts: Vec<&Formula> = own.map(added).collect();
        let addition = match (variable.kind, parts.as_slice()) {
            (Type::Scalar, [only]) => only.bracketed(),
            (Type::Vector(_), parts) => Formula::vector(parts).ok()?,
            _ => return None,
        };
        *rate = (rate.bracketed() + &addition).ok()?;
    }
    Some(changed)
}

/// Adds a term that is linear in the velocities or momenta to the function that the equations of motion
/// are made of; `None` if they are not made of one.
pub fn with_gyroscopic(model: &Model, further: &Formula) -> Option<Model> {
    let mut changed = model.clone();
    let function = match &mut changed.system {
        System::Lagrangian(own) => &mut own.kinetic,
        System::Hamiltonian(own) => &mut own.function,
        _ => return None,
    };
    *function = (function.bracketed() + further).ok()?;
    Some(changed)
}

/// Adds a rotor to a model; `None` if it has one already, or admits none.
pub fn with_gyrostat(model: &Model, rotor: &Formula) -> Option<Model> {
    let mut changed = model.clone();
    let own = match &mut changed.system {
        System::FlatBase(body) => &mut body.gyrostat,
        system => &mut system.body_mut()?.gyrostat,
    };
    if own.is_some() || rotor.value_type() != Type::VECTOR {
        return None;
    }
    *own = Some(rotor.clone());
    Some(changed)
}

/// Adds `count` free numbers to the case and returns them.
pub fn with_constants(
    case: &Case,
    letter: &str,
    count: usize,
) -> Result<(Case, Vec<Formula>), FormulaError> {
    with_numbers(case, &free_names(case, letter, count))
}

/// Names that a case does not use: a letter and a number.
pub fn free_names(case: &Case, letter: &str, count: usize) -> Vec<String> {
    let is_free = |name: &String| case.model.vocabulary.find(name).is_none();
    (1..).map(|k| format!("{letter}{k}")).filter(is_free).take(count).collect()
}

/// Adds free numbers with these names to the case and returns them.
pub fn with_numbers(case: &Case, names: &[String]) -> Result<(Case, Vec<Formula>), FormulaError> {
    let mut extended = case.clone();
    let model = &mut extended.model;
    for name in names {
        let meaning = Meaning::Parameter(model.parameters.len());
        let range = Range::between((-2, 1), (2, 1));
        model.parameters.push(Parameter {
            name: name.clone(),
            kind: Type::Scalar,
            origin: ParameterOrigin::Free(SamplerSpec::Scalar(Draw::Within(range))),
        });
        model.vocabulary.add(name, meaning, Type::Scalar, Dependence::Parameters);
    }
    let constants: Result<Vec<Formula>, FormulaError> =
        names.iter().map(|name| Formula::name(name, &model.vocabulary)).collect();
    let constants = constants?;
    Ok((extended, constants))
}
