//! Integrals of a field that a search finds where a count leaves room for them.

use super::super::products::degree_in_state;
use super::super::{SearchError, SearchReport, integrals, orbit};
use super::AbsenceCase;
use super::velocities::{Part, shown};
use liouville::verdict::Verdict;

/// Returns a proved integral that is a polynomial up to a degree in all variables, and no function of the known ones.
pub fn integral(asked: &AbsenceCase<'_>, most: u32) -> Result<Option<String>, SearchError> {
    let (case, effort) = (asked.case, &asked.effort);
    let mut report = SearchReport::default();
    let parts: [Part<'_>; 2] =
        [&mut |report| integrals::integrals(case, effort, report), &mut |report| {
            orbit::search(case, effort, false, report, &mut |_| {})
        }];
    let mut seen = 0;
    for part in parts {
        match part(&mut report) {
            Err(SearchError::Stopped) => {}
            other => other?,
        }
        for found in &report.found[seen..] {
            let is_proved = found.kind == "integral" && found.verdict == Verdict::Proved;
            // What holds for one listed value says nothing of the others.
            let is_own = is_proved && found.with.is_empty();
            let Some(function) = found.function.as_ref().filter(|_| is_own) else { continue };
            let degree = degree_in_state(case, function, effort.options.seed)?;
            if degree.is_some_and(|degree| degree <= most) && asked.is_new(function)? {
                return Ok(Some(shown("integral", found)));
            }
        }
        seen = report.found.len();
    }
    Ok(None)
}
