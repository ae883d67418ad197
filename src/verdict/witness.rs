//! A state at which a claim fails, written down so that it can be typed in again.

use super::evidence::Witness;
use super::point::named;
use crate::case::Case;

/// A state as it is printed, with its number under the seed if it has one, the residual that was
/// found there, and a bound on its error.
pub fn witness(
    case: &Case,
    index: Option<u64>,
    printed: &[String],
    (residual, error_bound): (f64, f64),
) -> Witness {
    let (parameters, state) = named(&case.model, printed);
    let parameters = parameters.into_iter().map(|(name, value)| (name, listed(&value)));
    let state: Vec<String> =
        state.iter().map(|(name, value)| format!("{name}={}", listed(value))).collect();
    let parameters = parameters.collect();
    Witness { index, parameters, state: state.join(" "), residual, error_bound, digits: None }
}

/// A value as `--set` and `--state` take it: a number, a list, rows of lists.
fn listed(components: &[String]) -> String {
    match components {
        [one] => one.clone(),
        [_, _, _] => format!("[{}]", components.join(",")),
        _ => {
            let rows: Vec<String> = components.chunks(3).map(listed).collect();
            format!("[{}]", rows.join(","))
        }
    }
}
