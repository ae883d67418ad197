//! Lagrangian systems whose accelerations have too many denominators, as fields of their positions and
//! independent velocities.

use liouville::case::Case;
use liouville::claim::Claim;
use liouville::verdict::Verdict;

use super::super::ask::judged_alone;
use super::super::integrals::tell;
use super::super::report::Excluded;
use super::super::{Effort, Found, SearchError, SearchReport};
use super::adjoin::ExplicitField;
use super::darboux;
use super::exponents::CONSTANT_RATE as RATE;

/// Searches the field of such a system; what is found is judged as a claim about the case.
pub fn search(
    case: &Case,
    effort: &Effort,
    further: bool,
    report: &mut SearchReport,
    progress: &mut dyn FnMut(&str),
) -> Result<(), SearchError> {
    let Some(field) = ExplicitField::of(case)? else { return Ok(()) };
    let mut own = SearchReport::default();
    super::search(&field.case, effort, further, &mut own, progress)?;
    let has_orbits = !report.orbits.is_empty();
    for found in &own.found {
        effort.halt.check()?;
        take(case, &|text| field.back(text), found, effort, report)?;
    }
    if field.is_whole && !has_orbits {
        report.orbits.extend(own.orbits);
        report.excluded.extend(own.excluded.into_iter().map(|own| Excluded {
            ansatz: field.back(&own.ansatz),
            theorem: field.back(&own.theorem),
            ..own
        }));
    }
    Ok(())
}

/// Judges a find of another field, whose formulas `back` writes in the names of the case, as a claim about the
/// case, and adds it to the report if it is proved.
pub fn take(
    case: &Case,
    back: &dyn Fn(&str) -> String,
    found: &Found,
    effort: &Effort,
    report: &mut SearchReport,
) -> Result<(), SearchError> {
    let read = |text: &str| case.formula(&back(text)).ok();
    let Some(formula) = found.function.as_ref().and_then(|own| read(own.text())) else {
        return Ok(());
    };
    let claim = match (found.kind, found.with.as_slice()) {
        ("integral", []) => Claim::integral(&formula),
        ("density", []) if report.functions("density").next().is_none() => Claim::density(&formula),
        (RATE, [(_, rate)]) => match read(rate) {
            Some(rate) => Claim::rate(&formula, &rate),
            None => return Ok(()),
        },
        (darboux::KIND, [(_, cofactor)]) => match read(cofactor) {
            Some(cofactor) => Claim::rate(&formula, &(&cofactor * &formula)?),
            None => return Ok(()),
        },
        _ => return Ok(()),
    };
    let text = formula.to_string();
    if report.found.iter().any(|own| own.kind == found.kind && own.formula == text) {
        return Ok(());
    }
    let judged = judged_alone(case, claim, effort)?;
    let Some(judged) = judged.filter(|own| own.verdict == Verdict::Proved) else { return Ok(()) };
    if found.kind == "integral" {
        return tell(case, &formula, judged, effort, report);
    }
    let with = found.with.iter().map(|(what, own)| (*what, back(own))).collect();
    report
        .found
        .push(Found { with, ..Found::new(found.kind, &formula, None, judged, &case.model) });
    Ok(())
}
