//! Witness of a refutation: a state at which a claim fails, printed so that it can be typed in
//! again.

use super::evidence::Witness;
use super::point::named;
use crate::case::Case;
use crate::formula::Type;
use crate::mechanics::Model;

/// Makes a witness from a printed state, with its index under the seed if it has one, the residual
/// there, and a bound on its error.
pub fn witness(
    case: &Case,
    index: Option<u64>,
    printed: &[String],
    (residual, error_bound): (f64, f64),
) -> Witness {
    let (parameters, state) = named(&case.model, printed);
    let kinds = case.model.free_parameters().map(|parameter| parameter.kind);
    let parameters =
        parameters.into_iter().zip(kinds).map(|((name, value), kind)| (name, listed(kind, &value)));
    let kinds = case.model.state.iter().map(|variable| variable.kind);
    let state: Vec<String> = state
        .iter()
        .zip(kinds)
        .map(|((name, value), kind)| format!("{name}={}", listed(kind, value)))
        .collect();
    let parameters = parameters.collect();
    Witness { index, parameters, state: state.join(" "), residual, error_bound, digits: None }
}

/// Writes a state to four decimals, for sentences.
pub fn briefly(model: &Model, state: &[f64]) -> String {
    let short = |value: &f64| {
        let text = format!("{value:.4}");
        let text = text.trim_end_matches('0').trim_end_matches('.');
        if text == "-0" { "0".to_string() } else { text.to_string() }
    };
    let mut rest = state;
    let mut parts = Vec::new();
    for variable in &model.state {
        let (own, others) = rest.split_at(variable.len());
        rest = others;
        let digits: Vec<String> = own.iter().map(short).collect();
        parts.push(format!(
            "{} = {}",
            variable.name,
            variable.kind.listed(&digits, ["[", ", ", "]"])
        ));
    }
    parts.join(", ")
}

/// Writes a value as `--set` and `--state` read it: a number, a list, or rows of lists.
fn listed(kind: Type, components: &[String]) -> String {
    kind.listed(components, ["[", ",", "]"])
}
