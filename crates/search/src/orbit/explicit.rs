//! Lagrangian systems whose accelerations have too many denominators, as fields of their positions and
//! independent velocities.

use liouville::case::Case;
use liouville::claim::Claim;
use liouville::formula::Formula;
use liouville::verdict::Verdict;

use super::super::ask::judged_alone;
use super::super::integrals::tell;
use super::super::report::Excluded;
use super::super::{Effort, Found, FoundKind, Given, SearchError, SearchReport};
use super::adjoin::ExplicitField;

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
    super::search(&field.case, &effort.in_names_of(&field.case), further, &mut own, progress)?;
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
    let read = |own: &Formula| case.formula(&back(own.text())).ok();
    let Some(formula) = found.function().and_then(read) else { return Ok(()) };
    let mut with = Vec::new();
    for own in &found.with {
        let Some(own) = own.mapped(read) else { return Ok(()) };
        with.push(own);
    }
    let claim = match (found.kind, with.as_slice()) {
        (FoundKind::Integral, []) => Claim::integral(&formula),
        (FoundKind::Density, []) if report.functions(FoundKind::Density).next().is_none() => {
            Claim::density(&formula)
        }
        (FoundKind::ConstantRate, [Given::Rate(rate)]) => Claim::rate(&formula, rate),
        (FoundKind::DarbouxPolynomial, [Given::Cofactor(cofactor)]) => {
            Claim::rate(&formula, &(cofactor * &formula)?)
        }
        _ => return Ok(()),
    };
    if report.has(found.kind, formula.text().trim()) {
        return Ok(());
    }
    let judged = judged_alone(case, claim, effort)?;
    let Some(judged) = judged.filter(|own| own.verdict == Verdict::Proved) else { return Ok(()) };
    if found.kind == FoundKind::Integral {
        return tell(case, &formula, judged, effort, report);
    }
    report
        .found
        .push(Found { with, ..Found::new(found.kind, &formula, None, judged, &case.model) });
    Ok(())
}
