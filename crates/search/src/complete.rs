//! Whether there can be integrals besides those found.

use super::ask::{judged_alone, proved_energy};
use super::local::Coordinates;
use super::{Effort, SearchError, SearchReport};
use liouville::case::Case;
use liouville::claim::{Claim, MOST_COMPARED};
use liouville::formula::Formula;
use liouville::verdict::Verdict;

/// Whether the energy and the integrals found are proved to be as many independent ones as a motion in these
/// coordinates has: any other one is a function of them near almost every state.
pub fn are_all(case: &Case, effort: &Effort, report: &SearchReport) -> Result<bool, SearchError> {
    let Ok(coordinates) = Coordinates::of(case) else { return Ok(false) };
    let own = report.of_case("integral").filter(|own| own.verdict == Verdict::Proved);
    let mut all: Vec<Formula> = proved_energy(case, effort)?.into_iter().collect();
    all.extend(own.filter_map(|own| own.function.clone()));
    if all.len() + 1 != coordinates.count() || all.len() > MOST_COMPARED {
        return Ok(false);
    }
    let judged = judged_alone(case, Claim::independent(all), effort)?;
    Ok(judged.is_some_and(|judged| judged.verdict == Verdict::Proved))
}
