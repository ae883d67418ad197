//! A state at which a claim fails, written down so that it can be typed in again.

use super::evidence::Witness;
use super::point::named;
use super::sampler::Sampler;
use crate::case::Case;
use crate::formula::Type;

/// State `index` with the residual that was found there in `bits` bits, and a bound on its error.
pub fn witness(
    case: &Case,
    sampler: &Sampler,
    index: u64,
    bits: u32,
    (residual, error_bound): (f64, f64),
) -> Witness {
    let (parameters, state) = named(&case.model, &sampler.printed(index, bits));
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

/// A value as `--set` and `--state` take it: a number, a list, rows of lists.
fn listed(kind: Type, components: &[String]) -> String {
    kind.listed(components, ["[", ",", "]"])
}
