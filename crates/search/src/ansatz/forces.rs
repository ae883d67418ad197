//! Variants of a body with another potential or rotor, and with further free constants.

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
    let mut extended = case.clone();
    let model = &mut extended.model;
    let is_free = |name: &String| case.model.vocabulary.find(name).is_none();
    let names: Vec<String> =
        (1..).map(|k| format!("{letter}{k}")).filter(is_free).take(count).collect();
    for name in &names {
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

/// Σ constant · part, with brackets around each part that is a scalar; `None` without parts.
pub fn combination<'t>(
    parts: impl Iterator<Item = (&'t Formula, &'t Formula)>,
) -> Result<Option<Formula>, FormulaError> {
    appended(None, parts)
}

/// A formula plus Σ constant · part; `None` for an empty sum.
pub fn appended<'t>(
    first: Option<&Formula>,
    parts: impl Iterator<Item = (&'t Formula, &'t Formula)>,
) -> Result<Option<Formula>, FormulaError> {
    let mut sum: Option<Formula> = first.cloned();
    for (constant, part) in parts {
        let term = match part.value_type() {
            Type::Scalar => (constant * part.bracketed())?,
            _ => (constant * part)?,
        };
        sum = Some(match sum {
            None => term,
            Some(before) => (before + &term)?,
        });
    }
    Ok(sum)
}
