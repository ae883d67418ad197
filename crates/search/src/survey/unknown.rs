//! Results of the search beyond the families, found and excluded.

use serde::Serialize;

use super::definitions::define;
use super::question::TestedClaim;
use crate::{CountReport, Effort, Excluded, Found, FoundKind, Given, Halt, search};
use liouville::case::Case;
use liouville::case::Expect;
use liouville::claim::{Claim, ClaimKind};
use liouville::mechanics::System;
use liouville::verdict::{ClaimReport, Options, Verdict};

/// Degree in the velocities up to which integrals are counted: a fraction of a second.
const DEGREE: u32 = 4;

/// Time in seconds above which a count is left out.
const SECONDS: f64 = 2.0;

/// Outcome of a search.
#[derive(Clone, Debug, Default, Serialize)]
pub struct SearchOutcome {
    /// Numbers of integrals, degree by degree.
    pub counts: Vec<CountReport>,
    /// Families excluded by theorems.
    pub excluded: Vec<Excluded>,
    /// Parts that could not be carried out, with reasons.
    pub remarks: Vec<String>,
    /// Invariants found, as claims with verdicts.
    #[serde(skip)]
    pub tested: Vec<TestedClaim>,
}

impl SearchOutcome {
    /// Runs the search; its failures become remarks.
    pub fn of(case: &Case, options: &Options, halt: &Halt, progress: &mut dyn FnMut(&str)) -> Self {
        let effort = Effort {
            degree: DEGREE,
            blind: true,
            seconds: SECONDS,
            options: *options,
            halt: halt.clone(),
            ..Effort::default()
        };
        // The families contain the symmetry fields of bodies.
        let is_body = !matches!(
            case.model.system,
            System::Lagrangian(_) | System::Hamiltonian(_) | System::Field(_) | System::Map(_)
        );
        let is_new = |one: &Found| !is_body || one.kind != FoundKind::SymmetryField;
        match search(case, &effort, progress) {
            Ok(report) => Self {
                counts: report.counts,
                excluded: report.excluded,
                remarks: report.remarks.into_iter().map(|own| own.text).collect(),
                tested: report
                    .found
                    .into_iter()
                    .filter(is_new)
                    .map(|one| of_search(case, one))
                    .collect(),
            },
            Err(error) => Self { remarks: vec![error.to_string()], ..Self::default() },
        }
    }

    /// Returns the degree up to which there is no integral independent of the energy.
    pub fn excluded_to(&self) -> Option<u32> {
        // Powers of the energy are integrals: a count below their number is wrong and proves
        // nothing.
        if self.counts.iter().any(|count| count.dimension < count.known) {
            return None;
        }
        let is_empty = |count: &&CountReport| count.dimension == count.known;
        let forms = self.counts.iter().filter(|count| !count.mixed).take_while(is_empty);
        // A count of all terms up to a degree covers the lower degrees.
        let whole = self.counts.iter().filter(|count| count.mixed && !count.free).filter(is_empty);
        forms.chain(whole).map(|count| count.degree).max()
    }
}

/// Source of what the search has found.
const OF_SEARCH: &str = "found by the search";

/// Whether a density of the search is proved to be one that the case claims, up to a factor.
pub fn is_claimed_density(case: &Case, options: &Options, found: &ClaimReport) -> bool {
    if found.kind != FoundKind::Density.name() || found.source != OF_SEARCH {
        return false;
    }
    let Some(own) = found.formula.as_ref().and_then(|text| case.formula(text).ok()) else {
        return false;
    };
    let claimed = case.claims.iter().filter(|claim| matches!(claim.kind, ClaimKind::Density(_)));
    claimed.filter_map(|claim| claim.kind.formula()).any(|other| {
        // They are the same up to a factor where their quotient is constant.
        let Ok(quotient) = &own.bracketed() / &other.bracketed() else { return false };
        let judged = case.judge(&[Claim::independent(vec![quotient])], options);
        judged.is_ok_and(|judged| judged.claims.iter().all(|own| own.verdict == Verdict::Refuted))
    })
}

/// Makes a finding from a result of the search, with the names that the search added.
pub fn of_search(case: &Case, found: Found) -> TestedClaim {
    let names = found.abbreviations.iter().map(|(name, text)| define(name, text)).collect();
    let field: Vec<_> = found.fields.iter().map(|(name, own)| define(name, own.text())).collect();
    let claim = ClaimReport {
        name: found.kind.name().replace('-', " "),
        formula: Some(found.text().to_string()),
        kind: found.kind.name(),
        source: OF_SEARCH.to_string(),
        place: "level".to_string(),
        expect: Expect::Open,
        verdict: found.verdict,
        agrees: true,
        cell: None,
        note: None,
        evidence: found.evidence,
    };
    let values = found.with.iter().find_map(|own| match own {
        Given::Value(values) => Some(values.clone()),
        _ => None,
    });
    let with = found.with.iter().map(|own| format!("with the {} {}", own.name(), own.text()));
    let with: Vec<String> = with.collect();
    let remark = (!with.is_empty()).then(|| with.join("; "));
    let tested = TestedClaim { values, remark, ..TestedClaim::found(case, claim, names) };
    let rate = found.with.iter().find(|own| matches!(own, Given::Rate(_) | Given::Cofactor(_)));
    match rate {
        Some(rate) => tested.with_rate(case, rate.name(), rate.text()),
        None if field.is_empty() => tested,
        None => tested.with_field(case, &field),
    }
}
