//! Claims of absence for each combination of listed values: one invariant for one of them contradicts the claim.

use std::time::Duration;

use super::super::lists::{HAS_LISTS, ListedCase, combinations, first_values};
use super::super::local::Coordinates;
use super::super::{Effort, SearchError};
use super::known::ProvedIntegrals;
use super::{AbsenceCase, AbsenceOutcome, MOST_TIME};
use crate::Halt;
use liouville::case::Case;
use liouville::claim::absence::Absence;
use liouville::formula::Formula;
use liouville::verdict::{ClaimReport, Options};

/// Largest number of combinations that are judged.
const MOST: usize = 8;

/// Judges a claim that no count decides for all listed values together; `None` if no parameter has a list of
/// several values, or the count takes each of them.
pub fn judged(
    case: &Case,
    kind: &Absence,
    coordinates: &Result<Coordinates, SearchError>,
    (reports, others): (&[ClaimReport], &[Formula]),
    options: Options,
) -> Result<Option<AbsenceOutcome>, SearchError> {
    let is_of_velocities = coordinates.is_ok() && !matches!(kind, Absence::NoInvariantRelation(_));
    if is_of_velocities || first_values(case).is_none() {
        return Ok(None);
    }
    let all = combinations(case).unwrap_or_default();
    let mut open = (all.len() > MOST || all.is_empty()).then(|| HAS_LISTS.to_string());
    let mut theorems: Vec<(String, String)> = Vec::new();
    let share = MOST_TIME / all.len().clamp(1, MOST) as u32;
    for ListedCase { case: fixed, values } in all.iter().take(MOST) {
        match with_values(case, fixed, kind, (reports, others), (options, share))? {
            AbsenceOutcome::Exhibited(what) => {
                return Ok(Some(AbsenceOutcome::Exhibited(format!("for {values}, {what}"))));
            }
            AbsenceOutcome::Open(reason) | AbsenceOutcome::Bounded(reason) => {
                open = open.or_else(|| Some(format!("for {values}: {reason}")));
            }
            AbsenceOutcome::Excluded { theorem, counted } => {
                theorems.push((theorem, counted));
            }
        }
    }
    if let Some(reason) = open {
        return Ok(Some(AbsenceOutcome::Open(reason)));
    }
    let Some((theorem, counted)) = theorems.first().cloned() else {
        return Ok(Some(AbsenceOutcome::Open(HAS_LISTS.to_string())));
    };
    let is_same = theorems.iter().all(|(other, _)| *other == theorem);
    let each = theorems.into_iter().zip(&all);
    let each: Vec<String> =
        each.map(|((own, _), listed)| format!("{own} ({})", listed.values)).collect();
    // The functions that are counted may differ.
    let theorem = if is_same { theorem } else { each.join(" ") };
    Ok(Some(AbsenceOutcome::Excluded { theorem, counted }))
}

/// Finds an invariant for one combination of listed values, where the count for all of them together leaves the claim open.
pub fn contradicted(
    case: &Case,
    kind: &Absence,
    (reports, others): (&[ClaimReport], &[Formula]),
    options: Options,
) -> Result<Option<String>, SearchError> {
    if first_values(case).is_none() {
        return Ok(None);
    }
    let all = combinations(case).unwrap_or_default();
    let share = MOST_TIME / all.len().clamp(1, MOST) as u32;
    for ListedCase { case: fixed, values } in all.iter().take(MOST) {
        let found = with_values(case, fixed, kind, (reports, others), (options, share))?;
        if let AbsenceOutcome::Exhibited(what) = found {
            return Ok(Some(format!("for {values}, {what}")));
        }
    }
    Ok(None)
}

/// Judges a claim for one combination of listed values, within a share of the time.
fn with_values(
    case: &Case,
    fixed: &Case,
    kind: &Absence,
    (reports, others): (&[ClaimReport], &[Formula]),
    (options, share): (Options, Duration),
) -> Result<AbsenceOutcome, SearchError> {
    let effort = Effort { options, ..Effort::default() };
    // What is proved for all values is proved for each.
    let known = ProvedIntegrals::of(fixed, (reports, others), &effort)?;
    let coordinates = Coordinates::of(fixed);
    let mut asked = AbsenceCase::new(fixed, (&known, &coordinates), reports, options);
    asked.effort.halt = Halt::within(share);
    asked.named = &case.model;
    Ok(asked.judge(kind).unwrap_or_else(|error| AbsenceOutcome::Open(error.to_string())))
}
