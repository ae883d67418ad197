//! Claims about motion: tested by computing motions, and confirmed or refuted by numbers.
//!
//! ```text
//! claims about motion ─▶ orbits, exponents, periodic points ─▶ numbers with errors ─▶ verdicts
//! ```
//!
//! Closed orbits, horseshoes and states at a time of a motion are proved, by enclosures; all other
//! claims are only observed. There a stated number agrees with a computed one if they differ by no
//! more than the last stated digit and the estimated error of the computation: the spread of blocks,
//! or the difference between f64 and double-double.

mod closed_orbit;
mod contacts;
mod density;
mod exponents;
mod ground;
mod horseshoe;
mod judgement;
mod limit;
mod periodic;
mod reaches;
mod scene;
mod section;
mod settling;

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use rayon::prelude::*;

use crate::halt::Halt;
use crate::{FlowError, Obstacle, Request};
use crate::{HorseshoeData, ProofData, ProvedHorseshoe, ProvedOrbit, replay, replay_horseshoe};
use liouville::case::{Case, MotionClaim};
use liouville::claim::motion::MotionKind;
use liouville::verdict::{
    self, CaseReport, ClaimReport, Evidence, JudgeError, Method, Options, Trust, Verdict,
};

pub use closed_orbit::theorem_about;
pub use density::evidence_against_density;

use judgement::MotionJudgement;
use scene::FollowedCase;

/// Judges all claims of a case, those about motion last.
pub fn judge(case: &Case, options: &Options) -> Result<CaseReport, JudgeError> {
    let mut report = verdict::judge(case, options)?;
    report.claims.extend(observe(case, options));
    report.motions_left = 0;
    Ok(report)
}

/// Tests all claims about motion of a case.
pub fn observe(case: &Case, options: &Options) -> Vec<ClaimReport> {
    let mut reports = Vec::new();
    observe_each(case, options, &mut |report| reports.push(report));
    reports
}

/// Judges the claims about motion on the threads of the pool at work, and hands over the reports in
/// the order of the claims, each once those before it are made.
pub fn observe_each(case: &Case, options: &Options, keep: &mut (dyn FnMut(ClaimReport) + Send)) {
    if let Some(parts) = case.time_parts() {
        observe_each(&parts.without_time, options, keep);
        return observe_each(&parts.with_time, options, keep);
    }
    let scene = FollowedCase::new(case, options.seed);
    let halt = Halt::current();
    let waiting: BTreeMap<usize, ClaimReport> = BTreeMap::new();
    let state = Mutex::new((0, waiting, keep));
    case.motions.par_iter().with_max_len(1).enumerate().for_each(|(place, claim)| {
        let judge = || report(claim, judged(claim, &scene, options), options);
        let found = halt.clone().over(judge);
        let mut state = state.lock().unwrap_or_else(PoisonError::into_inner);
        let (next, waiting, keep) = &mut *state;
        waiting.insert(place, found);
        while let Some(found) = waiting.remove(next) {
            keep(found);
            *next += 1;
        }
    });
}

/// Proves a claim about a closed orbit, and returns the report with the orbit and the data of its
/// proof. `None` for other claims, and where there is no proof.
pub fn proof(
    case: &Case,
    claim: &MotionClaim,
    options: &Options,
) -> Option<(ClaimReport, ProvedOrbit)> {
    orbit(case, claim, options, crate::prove).ok()
}

/// The same for a claim about a horseshoe.
pub fn proof_of_horseshoe(
    case: &Case,
    claim: &MotionClaim,
    options: &Options,
) -> Option<(ClaimReport, ProvedHorseshoe)> {
    chaos(case, claim, options, crate::prove_horseshoe).ok()
}

/// Judges a claim about a closed orbit by the data of a proof, replayed in balls of integers.
///
/// # Errors
/// The reason why the data do not prove the claim.
pub fn verify(
    case: &Case,
    claim: &MotionClaim,
    data: &ProofData,
    options: &Options,
) -> Result<(ClaimReport, ProvedOrbit), String> {
    orbit(case, claim, options, |request| replay(request, data))
}

/// Judges a claim about a horseshoe by the data of a proof, replayed in balls of integers.
///
/// # Errors
/// The reason why the data do not prove the claim.
pub fn verify_horseshoe(
    case: &Case,
    claim: &MotionClaim,
    data: &HorseshoeData,
    options: &Options,
) -> Result<(ClaimReport, ProvedHorseshoe), String> {
    chaos(case, claim, options, |request| replay_horseshoe(request, data))
}

/// Returns the case in which a claim is judged, and the claim as it is read there.
fn home<'c>(case: &'c Case, claim: &'c MotionClaim) -> (&'c Case, &'c MotionClaim) {
    let home = case.home(&claim.name);
    (home, home.motions.iter().find(|own| own.name == claim.name).unwrap_or(claim))
}

fn orbit(
    case: &Case,
    claim: &MotionClaim,
    options: &Options,
    proof: impl FnOnce(&Request<'_>) -> Result<ProvedOrbit, Obstacle>,
) -> Result<(ClaimReport, ProvedOrbit), String> {
    let (case, claim) = home(case, claim);
    let MotionKind::ClosedOrbit(kind) = &claim.kind else {
        return Err("the claim is not about a closed orbit".to_string());
    };
    let scene = FollowedCase::new(case, options.seed);
    concluded(claim, closed_orbit::by(kind, &scene, options, proof), options)
}

fn chaos(
    case: &Case,
    claim: &MotionClaim,
    options: &Options,
    proof: impl FnOnce(&Request<'_>) -> Result<ProvedHorseshoe, Obstacle>,
) -> Result<(ClaimReport, ProvedHorseshoe), String> {
    let (case, claim) = home(case, claim);
    let MotionKind::Horseshoe(kind) = &claim.kind else {
        return Err("the claim is not about a horseshoe".to_string());
    };
    let scene = FollowedCase::new(case, options.seed);
    concluded(claim, horseshoe::by(kind, &scene, options, proof), options)
}

/// Report on a claim that is proved, with what was found.
fn concluded<T>(
    claim: &MotionClaim,
    found: Result<(MotionJudgement, Option<T>), FlowError>,
    options: &Options,
) -> Result<(ClaimReport, T), String> {
    let (judgement, found) = found.map_err(|problem| format!("{problem}: {}", problem.help()))?;
    let report = report(claim, Ok(judgement), options);
    match (report.verdict, found) {
        (Verdict::Proved, Some(found)) => Ok((report, found)),
        _ => Err(report.evidence.reason.unwrap_or_else(|| "the claim is not proved".to_string())),
    }
}

fn judged(
    claim: &MotionClaim,
    scene: &FollowedCase<'_>,
    options: &Options,
) -> Result<MotionJudgement, FlowError> {
    match &claim.kind {
        MotionKind::Exponent(claim) => exponents::exponent(claim, scene),
        MotionKind::MeanDivergence(claim) => exponents::mean_divergence(claim, scene),
        MotionKind::PeriodicPoint(claim) => periodic::judge(claim, scene),
        MotionKind::LimitCycle(claim) => section::limit_cycle(claim, scene),
        MotionKind::Confined(claim) => section::confined(claim, scene),
        MotionKind::LimitOfMotion(claim) => limit::judge(claim, scene),
        MotionKind::Contacts(claim) => contacts::judge(claim, scene),
        MotionKind::ClosedOrbit(claim) => closed_orbit::judge(claim, scene, options),
        MotionKind::Horseshoe(claim) => horseshoe::judge(claim, scene, options),
        MotionKind::Reaches(claim) => reaches::judge(claim, scene),
    }
}

fn report(
    claim: &MotionClaim,
    found: Result<MotionJudgement, FlowError>,
    options: &Options,
) -> ClaimReport {
    let (verdict, mut evidence) = match found {
        Ok(judgement) => judgement.conclude(),
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
    let is_enough = enough || verdict == Verdict::Proved;
    ClaimReport {
        name: claim.name.clone(),
        formula: Some(claim.kind.text()),
        kind: claim.kind.name(),
        source: claim.source.clone(),
        place: format!("from {}", claim.kind.beginning().text()),
        expect: claim.expect,
        verdict,
        agrees: verdict.agrees(claim.expect, is_enough),
        cell: None,
        note: claim.note.clone(),
        evidence,
    }
}
