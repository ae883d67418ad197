//! Constraints on the coordinates of a Lagrangian system: their rates are those on the velocities.

use super::systems::Reading;
use crate::formula::{Formula, FormulaError, Type};
use crate::mechanics::{Meaning, Variable, VariableRole};

/// Returns the rate Σ (∂F/∂q) q' of a constraint F = 0 that contains coordinates and no velocity; `None`
/// for another one.
pub fn rate(
    function: &Formula,
    reading: &Reading<'_, '_>,
    roles: &[VariableRole],
) -> Result<Option<Formula>, FormulaError> {
    let used = reading.vocabulary.uses(function, &reading.abbreviations);
    let is_still = used.iter().all(|entry| match entry.meaning {
        Meaning::State(index) => {
            !matches!(roles[index], VariableRole::Velocity | VariableRole::Multiplier)
        }
        Meaning::Quantity(_) => false,
        _ => true,
    });
    let is_used = |index: usize| {
        used.iter().any(|entry| matches!(entry.meaning, Meaning::State(own) if own == index))
    };
    let variables = &reading.state.variables;
    let own = variables.iter().zip(roles).enumerate().filter(|(index, _)| is_used(*index));
    let terms: Vec<String> =
        own.flat_map(|(_, (variable, role))| terms(function, variable, role, variables)).collect();
    if !is_still || terms.is_empty() {
        return Ok(None);
    }
    Formula::parse(&terms.join(" + "), &reading.vocabulary).map(Some)
}

/// Writes the parts of the rate that a variable contributes.
fn terms(
    function: &Formula,
    variable: &Variable,
    role: &VariableRole,
    variables: &[Variable],
) -> Vec<String> {
    let slope = format!("∂({function})/∂{}", variable.name);
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
        VariableRole::Velocity | VariableRole::Multiplier => Vec::new(),
    }
}
