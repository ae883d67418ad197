//! Integrals of the lowest degrees among those that depend on each other.

use liouville::case::Case;
use liouville::claim::{Claim, MOST_COMPARED};
use liouville::formula::Formula;
use liouville::order::StableOrder;
use liouville::verdict::Verdict;

use super::products::Generators;
use super::{Effort, FoundKind, SearchError, SearchReport, ask};

/// Selects independent ones of the lowest degrees among the energy, and the integrals found, claimed and told as
/// further ones; `None` where these are no others than are told.
pub fn lowest(
    case: &Case,
    effort: &Effort,
    report: &SearchReport,
) -> Result<Option<Generators>, SearchError> {
    let further = report.found.iter().filter(|found| found.kind == FoundKind::FurtherIntegral);
    let further = further.filter_map(|found| found.function().cloned());
    let claimed = report.claimed.iter().map(|own| own.formula.clone());
    let mut others: Vec<Formula> = further.chain(claimed).collect();
    let mut all = Generators::energy(case, effort)?;
    for formula in report.functions(FoundKind::Integral) {
        all.add(case, formula, effort.options.seed)?;
    }
    others.retain(|own| all.formulas().all(|other| other.text() != own.text()));
    let before = all.each().count();
    for formula in &others {
        all.add(case, formula, effort.options.seed)?;
    }
    let mut each: Vec<(Formula, u32)> =
        all.each().map(|(formula, degree)| (formula.clone(), degree)).collect();
    if each.len() == before {
        return Ok(None);
    }
    each.order_by_key(|(_, degree)| *degree);
    let mut kept: Vec<(Formula, u32)> = Vec::new();
    for (formula, degree) in each.into_iter().take(MOST_COMPARED) {
        // What a stopped search has counted is concluded from.
        if effort.halt.check().is_err() {
            return Ok(None);
        }
        let with = kept.iter().map(|(own, _)| own.clone()).chain([formula.clone()]).collect();
        let judged = ask::judged_alone(case, Claim::independent(with), effort)?;
        if judged.is_some_and(|own| own.verdict == Verdict::Proved) {
            kept.push((formula, degree));
        }
    }
    Ok(Some(all.replaced(kept)))
}
