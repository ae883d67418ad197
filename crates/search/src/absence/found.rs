//! Invariants that parts of a search find where a count leaves room for them.

use super::super::products::degree_in_state;
use super::super::{Found, FoundKind, SearchError, SearchReport, densities, integrals, orbit};
use super::{AbsenceCase, claimed_densities};
use liouville::formula::Formula;
use liouville::verdict::Verdict;

/// A part of a search.
pub type Part<'p> = &'p mut dyn FnMut(&mut SearchReport) -> Result<(), SearchError>;

/// Runs parts of a search until a find of a report is proved, of a kind, and wanted; writes it.
pub fn first(
    parts: &mut [Part<'_>],
    report: &mut SearchReport,
    kind: FoundKind,
    is_wanted: &dyn Fn(&Formula) -> Result<bool, SearchError>,
) -> Result<Option<String>, SearchError> {
    let mut seen = 0;
    for part in parts {
        match part(report) {
            Err(SearchError::Stopped) => {}
            other => other?,
        }
        for found in &report.found[seen..] {
            // What holds for one listed value says nothing of the others.
            let is_own = found.verdict == Verdict::Proved && found.with.is_empty();
            let function = found.function().filter(|_| is_own && found.kind == kind);
            if let Some(function) = function
                && is_wanted(function)?
            {
                return Ok(Some(shown(kind.name(), found)));
            }
        }
        seen = report.found.len();
    }
    Ok(None)
}

/// Returns a proved integral that is a polynomial up to a degree in all variables, and no function of the known ones.
pub fn integral(asked: &AbsenceCase<'_>, most: u32) -> Result<Option<String>, SearchError> {
    let (case, effort) = (asked.case, &asked.effort);
    let mut parts: [Part<'_>; 2] =
        [&mut |report| integrals::integrals(case, effort, report), &mut |report| {
            orbit::search(case, effort, false, report, &mut |_| {})
        }];
    let is_wanted = |function: &Formula| {
        let degree = degree_in_state(case, function, effort.options.seed)?;
        Ok(degree.is_some_and(|degree| degree <= most) && asked.is_new(function)?)
    };
    first(&mut parts, &mut SearchReport::default(), FoundKind::Integral, &is_wanted)
}

/// Returns a proved density of the class of a claim that a search finds.
pub fn density(asked: &AbsenceCase<'_>, most: u32) -> Result<Option<String>, SearchError> {
    if !claimed_densities::has_class(asked) {
        return Ok(None);
    }
    let (case, effort) = (asked.case, &asked.effort);
    let mut parts: [Part<'_>; 2] =
        [&mut |report| densities::densities(case, effort, report), &mut |report| {
            orbit::search(case, effort, false, report, &mut |_| {})
        }];
    let is_wanted = |function: &Formula| claimed_densities::is_of_class(asked, function, most);
    first(&mut parts, &mut SearchReport::default(), FoundKind::Density, &is_wanted)
}

/// Writes a find with the definitions of the names that it uses.
pub fn shown(what: &str, found: &Found) -> String {
    let names: Vec<String> =
        found.abbreviations.iter().map(|(name, text)| format!("{name} = {text}")).collect();
    let names = if names.is_empty() { String::new() } else { format!(", {}", names.join(", ")) };
    let remark = found.evidence.remark.as_ref().map(|remark| format!("; {remark}"));
    format!("{what}, proved: {}{names}{}", found.text(), remark.unwrap_or_default())
}
