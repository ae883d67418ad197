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
    for found in own.found.iter().filter(|own| own.with.is_empty()) {
        let Some(function) = &found.function else { continue };
        let Ok(formula) = case.formula(&field.back(function.text())) else { continue };
        let claim = match found.kind {
            "integral" => Claim::integral(&formula),
            "density" => Claim::density(&formula),
            _ => continue,
        };
        let judged = judged_alone(case, claim, effort)?;
        let Some(judged) = judged.filter(|own| own.verdict == Verdict::Proved) else { continue };
        match found.kind {
            "integral" => tell(case, &formula, judged, effort, report)?,
            _ if report.functions("density").next().is_some() => {}
            _ => report.found.push(Found::new("density", &formula, None, judged, &case.model)),
        }
    }
    if field.is_whole {
        report.orbits.extend(own.orbits);
        report.excluded.extend(own.excluded.into_iter().map(|own| Excluded {
            ansatz: field.back(&own.ansatz),
            theorem: field.back(&own.theorem),
            ..own
        }));
    }
    Ok(())
}
