//! Witness of a refutation: a state at which a claim fails, printed so that it can be typed in
//! again.

use super::evidence::Witness;
use super::point::named;
use crate::case::Case;
use crate::formula::Type;

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

/// Writes a value as `--set` and `--state` read it: a number, a list, or rows of lists.
fn listed(kind: Type, components: &[String]) -> String {
    kind.listed(components, ["[", ",", "]"])
}
