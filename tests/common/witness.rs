//! Witnesses of refutations: at the state, typed in again, the residual's enclosure excludes 0 and
//! meets the reported one.

use std::path::Path;

use liouville::case::{Case, Setting};
use liouville::verdict::{ClaimReport, Method, Verdict, Witness, evaluate, read_state};

/// Checks the witness of a claim of a case; claims without one pass, if they may have none.
pub fn check(path: &Path, claim: &ClaimReport) -> Result<(), String> {
    // Dependent functions, residuals that are constant, and absences are refuted without a state.
    let by_a_state = claim.kind != "independent"
        && !matches!(claim.evidence.method, Method::Folding | Method::Count);
    if claim.verdict != Verdict::Refuted || !by_a_state {
        return Ok(());
    }
    let witness = claim.evidence.witness.as_ref().ok_or("there is no witness")?;
    let (residual, bound) = again(path, &claim.name, witness)?;
    if residual.abs() <= bound {
        return Err(format!("{residual:e} ± {bound:e} at the witness does not refute"));
    }
    let apart = (residual - witness.residual).abs();
    match apart <= bound + witness.error_bound {
        true => Ok(()),
        false => Err(format!("{residual:e} at the witness, against {:e}", witness.residual)),
    }
}

/// Finds the component of a claim's residual at its witness that is nearest to the reported value:
/// midpoint and error bound.
fn again(path: &Path, claim: &str, witness: &Witness) -> Result<(f64, f64), String> {
    let setting =
        |(name, value): (&String, &String)| Setting { name: name.clone(), value: value.clone() };
    let settings: Vec<Setting> = witness.parameters.iter().map(setting).collect();
    let mut case = Case::read(path, &settings).1.map_err(|error| error.to_string())?;
    // The others are not evaluated for nothing.
    case.claims.retain(|own| own.name == claim);
    let state = read_state(&case, &witness.state).map_err(|error| error.to_string())?;
    let point = evaluate(&case, Some(&state), 1, 0).map_err(|error| error.to_string())?;
    let own = point.claims.iter().find(|(name, _, _)| name == claim);
    let (_, _, residual) = own.ok_or("the claim is lost")?;
    let apart = |value: &(f64, f64)| (value.0 - witness.residual).abs();
    let nearest = residual.iter().flatten().copied().min_by(|a, b| apart(a).total_cmp(&apart(b)));
    nearest.ok_or_else(|| "the residual has no value at the witness".to_string())
}
