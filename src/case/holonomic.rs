//! Constraints on the coordinates of a Lagrangian system: their rates are those on the velocities.

use super::equations;
use crate::formula::{Formula, FormulaError, Scope, Type};
use crate::mechanics::{Dependence, Meaning, Model, Variable, VariableRole, Vocabulary};

/// Names and variables of a Lagrangian system.
pub struct Names<'a> {
    pub vocabulary: &'a Vocabulary,
    pub abbreviations: &'a [Formula],
    pub variables: &'a [Variable],
    pub roles: &'a [VariableRole],
}

/// Returns the rate Σ (∂F/∂q) q' of a constraint F = 0 that contains coordinates and no velocity; `None`
/// for another one.
pub fn rate(function: &Formula, names: &Names<'_>) -> Result<Option<Formula>, FormulaError> {
    let Some(text) = text_of_rate(function, &format!("({function})"), names) else {
        return Ok(None);
    };
    Formula::parse(&text, names.vocabulary).map(Some)
}

/// Returns the rate of a function of the coordinates that is not the one of its text, which is that of `equation`.
pub fn rate_of_simplified(
    function: &Formula,
    equation: &str,
    model: &Model,
    roles: &[VariableRole],
) -> Option<Formula> {
    let mut name = "F".to_string();
    while model.vocabulary.lookup(&name).is_some() {
        name.push('F');
    }
    let mut vocabulary = model.vocabulary.clone();
    let index = model.abbreviations.len();
    vocabulary.define(&name, index, function, Dependence::Configuration);
    let names = Names {
        vocabulary: &vocabulary,
        abbreviations: &model.abbreviations,
        variables: &model.state,
        roles,
    };
    let text = text_of_rate(function, &name, &names)?;
    let rate = Formula::parse(&text, &vocabulary).ok()?;
    let (symbol, _) = vocabulary.lookup(&name)?;
    let text = equations::rate_text(equation, &model.vocabulary);
    Some(rate.with_written_out(symbol, function, &text))
}

/// Writes the rate of a function with a name or a text in brackets.
fn text_of_rate(function: &Formula, name: &str, names: &Names<'_>) -> Option<String> {
    let Names { vocabulary, abbreviations, variables, roles } = names;
    let used = vocabulary.uses(function, abbreviations);
    let is_still = used.iter().all(|entry| match entry.meaning {
        Meaning::State(index) => {
            !matches!(roles[index], VariableRole::Velocity | VariableRole::Multiplier(_))
        }
        Meaning::Quantity(_) => false,
        _ => true,
    });
    let is_used = |index: usize| {
        used.iter().any(|entry| matches!(entry.meaning, Meaning::State(own) if own == index))
    };
    let own = variables.iter().zip(*roles).enumerate().filter(|(index, _)| is_used(*index));
    let terms: Vec<String> =
        own.flat_map(|(_, (variable, role))| terms(name, variable, role, variables)).collect();
    (is_still && !terms.is_empty()).then(|| terms.join(" + "))
}

/// Writes the parts of the rate that a variable contributes.
fn terms(
    function: &str,
    variable: &Variable,
    role: &VariableRole,
    variables: &[Variable],
) -> Vec<String> {
    let slope = format!("∂{function}/∂{}", variable.name);
    let along = |rate: &str| match variable.kind {
        Type::Scalar => format!("{slope}*{rate}"),
        Type::Vector(_) => format!("({slope}, {rate})"),
        Type::Matrix(..) => format!("tr(({slope})ᵀ*{rate})"),
    };
    match role {
        VariableRole::Coordinate(velocity) => vec![along(&variables[*velocity].name)],
        VariableRole::Carried(rates) => match rates.as_slice() {
            [rate] if rate.value_type() == variable.kind => vec![along(&format!("({rate})"))],
            rates => {
                let each = variable.kind.indices().into_iter().zip(rates);
                each.map(|(index, rate)| format!("{slope}{index}*({rate})")).collect()
            }
        },
        VariableRole::Time => vec![slope],
        VariableRole::Velocity | VariableRole::Multiplier(_) => Vec::new(),
    }
}
