//! Whether there can be integrals besides those found.

use super::ansatz::monomials::AnsatzVariables;
use super::ask::{judged_alone, proved_energy};
use super::local::Coordinates;
use super::origin::RemarkOrigin;
use super::{Effort, FoundKind, SearchError, SearchReport};
use liouville::case::Case;
use liouville::claim::{Claim, MOST_COMPARED};
use liouville::formula::Formula;
use liouville::verdict::Verdict;

/// Whether the energy and the integrals found are proved to be as many independent ones as a motion in these
/// coordinates has: any other one is a function of them near almost every state.
pub fn are_all(case: &Case, effort: &Effort, report: &SearchReport) -> Result<bool, SearchError> {
    let Ok(coordinates) = Coordinates::of(case) else { return Ok(false) };
    let own = report.of_case(FoundKind::Integral).filter(|own| own.verdict == Verdict::Proved);
    let mut all: Vec<Formula> = proved_energy(case, effort)?.into_iter().collect();
    all.extend(own.filter_map(|own| own.function().cloned()));
    if all.len() + 1 != coordinates.count() || all.len() > MOST_COMPARED {
        return Ok(false);
    }
    let judged = judged_alone(case, Claim::independent(all), effort)?;
    Ok(judged.is_some_and(|judged| judged.verdict == Verdict::Proved))
}

/// Tells the first degree at which more integrals are counted than known, in place of an earlier one; not
/// where they are functions of those known.
pub fn note_missing(case: &Case, effort: &Effort, report: &mut SearchReport) {
    report.remarks.retain(|remark| remark.origin != RemarkOrigin::MoreCounted);
    if report.is_complete {
        return;
    }
    let may_find_more = !effort.ansatz.wanted && AnsatzVariables::of(case).is_some();
    let counts = report.counts.iter().filter(|count| !count.free);
    let missing = counts.filter(|count| count.dimension > count.known).map(|count| count.degree);
    if let Some(degree) = missing.min() {
        let text = match may_find_more {
            true => format!(
                "more integrals of degree {degree} are counted than known: --ansatz looks for them among \
                 polynomials"
            ),
            false => format!(
                "the count leaves room for more integrals of degree {degree} than are known: the number is an \
                 upper bound, and coefficients may be any functions of the positions, such as solutions of \
                 linear equations, where the search tries formulas"
            ),
        };
        report.remark_of(RemarkOrigin::MoreCounted, text);
    }
}
