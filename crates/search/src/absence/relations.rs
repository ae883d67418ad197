//! Absence of Darboux polynomials, whose zeros are invariant relations.

use std::time::Duration;

use super::super::orbit::{self, no_others};
use super::super::{Effort, FoundKind, Halt, SearchError, SearchReport};
use super::{AbsenceCase, AbsenceOutcome};
use liouville::claim::ClaimKind;
use liouville::formula::{Formula, Type};
use liouville::verdict::Verdict;

/// Largest number of steps of the eliminations: some seconds.
const STEPS: f64 = 4e9;

/// Longest time of a search for a polynomial that contradicts a claim that is not proved.
const MOST_TIME: Duration = Duration::from_secs(10);

/// Time of such a search, within what is left.
fn time_of_search(effort: &Effort) -> Duration {
    effort.halt.left().map_or(MOST_TIME, |left| left.min(MOST_TIME))
}

/// Judges the claim that all Darboux polynomials up to a degree are products of factors of those
/// that the case claims and that are proved.
pub fn no_invariant_relation(
    asked: &AbsenceCase<'_>,
    degree: u32,
) -> Result<AbsenceOutcome, SearchError> {
    // Known integrals are not polynomials that are counted here, and no others matter than those of this degree.
    let lower = asked.effort.degree.min(degree);
    let effort = &Effort { terms: Vec::new(), degree: lower, ..asked.effort.clone() };
    let case = asked.case;
    let mut known: Vec<Formula> = Vec::new();
    for (claim, report) in case.claims.iter().zip(asked.reports) {
        if let (ClaimKind::Relation(own), Verdict::Proved) = (&claim.kind, report.verdict)
            && own.function.value_type() == Type::Scalar
        {
            known.push(own.function.clone());
        }
    }
    let reason = match no_others::shown(case, effort, &known, [degree], STEPS)? {
        Ok(shown) => {
            let names: Vec<String> = (0..case.model.dimension())
                .map(|component| case.model.component_name(component))
                .collect();
            let statement = no_others::statement(&names.join(", "), degree, &known);
            return Ok(AbsenceOutcome::Excluded {
                theorem: asked.theorem(&statement),
                counted: format!(
                    "{} monomials on {} random lines, error < 2^{:.0}",
                    shown.monomials, shown.primes, shown.error_log2
                ),
            });
        }
        Err(reason) => reason,
    };
    let mut report = SearchReport::default();
    // Functions in other claims would be adjoined to the polynomials.
    let mut alone = case.clone();
    alone.claims.retain(|claim| matches!(claim.kind, ClaimKind::Relation(_)));
    let effort = &Effort { halt: Halt::within(time_of_search(effort)), ..effort.clone() };
    match orbit::search(&alone, effort, false, &mut report, &mut |_| {}) {
        Err(SearchError::Stopped) => {}
        other => other?,
    }
    for found in report.found.iter().filter(|found| found.verdict == Verdict::Proved) {
        let Some(function) = found.function() else { continue };
        // F − c is a relation for each number c, and few of these are among the known ones.
        let (what, others) = match found.kind {
            FoundKind::DarbouxPolynomial => ("invariant relation", known.as_slice()),
            FoundKind::Integral if found.with.is_empty() => {
                ("integral, each level of which is an invariant relation", [].as_slice())
            }
            _ => continue,
        };
        if no_others::is_other(case, effort, function, others, degree)? {
            return Ok(AbsenceOutcome::Exhibited(format!("{what}, proved: {}", found.text())));
        }
    }
    Ok(AbsenceOutcome::Open(reason))
}
