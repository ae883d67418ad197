//! Claims about motion: tested by computing motions, and confirmed or refuted by numbers.
//!
//! ```text
//! case ─ claims about motion ─▶ orbits, exponents, periodic points ─▶ numbers with errors ─▶ verdicts
//! ```
//!
//! Closed orbits and states reached are enclosed, and so proved; all else is observed. There a
//! stated number agrees with a computed one if they differ by no more than the last stated digit and the error that the computation itself shows: the spread of
//! blocks, or the difference between f64 and double-double.

mod closed_orbit;
mod contacts;
mod density;
mod exponents;
mod finding;
mod limit;
mod periodic;
mod reaches;
mod scene;
mod section;

use crate::FlowError;
use liouville::case::{Case, Expect, MotionClaim};
use liouville::claim::motion::Motion;
use liouville::verdict::{
    self, CaseReport, ClaimReport, Evidence, JudgeError, Method, Options, Trust, Verdict,
};

pub use density::evidence_against_density;

use finding::Finding;
use scene::Scene;

/// Judges all claims of a case, those about motion last.
pub fn judge(case: &Case, options: &Options) -> Result<CaseReport, JudgeError> {
    let mut report = verdict::judge(case, options)?;
    report.claims.extend(observe(case, options));
    report.motions_left = 0;
    Ok(report)
}

/// Tests all claims about motion of a case.
pub fn observe(case: &Case, options: &Options) -> Vec<ClaimReport> {
    let scene = Scene::new(case, options.seed);
    let look = |claim| look(claim, &scene, options);
    case.motions.iter().map(|claim| report(claim, look(claim), options)).collect()
}

fn look(claim: &MotionClaim, scene: &Scene<'_>, options: &Options) -> Result<Finding, FlowError> {
    match &claim.kind {
        Motion::Exponent(claim) => exponents::exponent(claim, scene),
        Motion::MeanDivergence(claim) => exponents::mean_divergence(claim, scene),
        Motion::PeriodicPoint(claim) => periodic::look(claim, scene),
        Motion::LimitCycle(claim) => section::limit_cycle(claim, scene),
        Motion::Confined(claim) => section::confined(claim, scene),
        Motion::LimitOfMotion(claim) => limit::look(claim, scene),
        Motion::Contacts(claim) => contacts::look(claim, scene),
        Motion::ClosedOrbit(claim) => closed_orbit::look(claim, scene, options),
        Motion::Reaches(claim) => reaches::look(claim, scene),
    }
}

fn report(
    claim: &MotionClaim,
    found: Result<Finding, FlowError>,
    options: &Options,
) -> ClaimReport {
    let (verdict, mut evidence) = match found {
        Ok(finding) => finding.conclude(),
        Err(problem) => {
            let reason = Some(format!("{problem}: {}", problem.help()));
            let method = Method::Motion;
            (Verdict::Undecided, Evidence { method, reason, ..Evidence::default() })
        }
    };
    let enough = options.trust != Trust::Proof;
    if verdict == Verdict::Confirmed && !enough {
        evidence.reason = Some("a proof was asked for, and motions are only observed".to_string());
    }
    let agrees = match claim.expect {
        Expect::Open => true,
        Expect::Holds => verdict == Verdict::Proved || verdict == Verdict::Confirmed && enough,
        Expect::Fails => verdict == Verdict::Refuted,
    };
    ClaimReport {
        name: claim.name.clone(),
        formula: Some(claim.kind.text()),
        kind: claim.kind.name(),
        source: claim.source.clone(),
        place: format!("from {}", claim.kind.beginning().text()),
        expect: claim.expect,
        verdict,
        agrees,
        cell: None,
        note: claim.note.clone(),
        evidence,
    }
}
