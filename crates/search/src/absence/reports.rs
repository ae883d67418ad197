//! Outcomes of claims of absence as reports.

use liouville::case::{AbsenceClaim, Case};
use liouville::verdict::{ClaimReport, Evidence, Method, Verdict};

use super::AbsenceOutcome;

/// Makes the report on a claim, with its verdict compared with the expectation, and the remark on values that were left
/// out.
pub(super) fn report(
    claim: &AbsenceClaim,
    outcome: AbsenceOutcome,
    moving: &Option<(Case, String)>,
) -> ClaimReport {
    let mut evidence = Evidence { method: Method::Count, ..Evidence::default() };
    let verdict = match outcome {
        AbsenceOutcome::Excluded { theorem, counted } => {
            (evidence.theorem, evidence.remark) = (Some(theorem), Some(counted));
            Verdict::Proved
        }
        AbsenceOutcome::Exhibited(what) => {
            evidence.exhibit = Some(what);
            Verdict::Refuted
        }
        AbsenceOutcome::Open(reason) | AbsenceOutcome::Bounded(reason) => {
            evidence.reason = Some(reason);
            Verdict::Undecided
        }
    };
    if let Some((_, remark)) = moving {
        evidence.add_remark(remark.clone());
    }
    ClaimReport {
        name: claim.name.clone(),
        formula: None,
        kind: claim.kind.name(),
        source: claim.source.clone(),
        place: "level".to_string(),
        expect: claim.expect,
        verdict,
        agrees: verdict.agrees(claim.expect, true),
        cell: claim.cell.clone(),
        note: claim.note.clone(),
        evidence,
    }
}

/// Says that all integrals that are counted are known.
pub fn all_known(dimension: usize) -> String {
    match dimension {
        1 => "no integrals but constants".to_string(),
        more => format!(
            "{more} linearly independent integrals at most, constants among them: all known"
        ),
    }
}
