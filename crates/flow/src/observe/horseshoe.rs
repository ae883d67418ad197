//! Horseshoes, proved by covering relations, and the integrals that they exclude.

use super::closed_orbit::{compare_period, doubt, far};
use super::ground::Ground;
use super::judgement::MotionJudgement;
use super::scene::FollowedCase;
use crate::{
    FlowError, HorseshoeTrace, MeasuredNumber, Obstacle, ProvedHorseshoe, Request, prove_horseshoe,
};
use liouville::claim::motion::Horseshoe as Claim;
use liouville::verdict::Options;

/// Proves the horseshoe of a claim.
pub fn judge(
    claim: &Claim,
    scene: &FollowedCase<'_>,
    options: &Options,
) -> Result<MotionJudgement, FlowError> {
    by(claim, scene, options, prove_horseshoe).map(|(judgement, _)| judgement)
}

/// Judges a claim by a horseshoe that `proof` encloses; returns the horseshoe too.
pub fn by(
    claim: &Claim,
    scene: &FollowedCase<'_>,
    options: &Options,
    proof: impl FnOnce(&Request<'_>) -> Result<ProvedHorseshoe, Obstacle>,
) -> Result<(MotionJudgement, Option<ProvedHorseshoe>), FlowError> {
    let mut judgement = MotionJudgement::default();
    let found = Ground::of(claim.into(), scene, options)?
        .and_then(|ground| Ok((ground.chaotic(proof)?, ground)));
    match &found {
        Ok((found, ground)) => {
            weigh(claim, found, &mut judgement);
            doubt(ground, &claim.period, (&found.start, found.times[0]), &mut judgement);
        }
        Err(reason) => judgement.leave_open(reason.clone()),
    }
    Ok((judgement, found.ok().map(|(found, _)| found)))
}

/// Compares a horseshoe with the claim.
fn weigh(claim: &Claim, found: &ProvedHorseshoe, judgement: &mut MotionJudgement) {
    let [short, _] = found.times;
    if let Some(reason) = far("saddle", found.moved, (&claim.period, short)) {
        judgement.leave_open(reason);
        return;
    }
    judgement.note(
        "period",
        MeasuredNumber { value: short.mid, error: short.rad },
        Some(&claim.period),
    );
    compare_period(&claim.period, short, judgement);
    judgement.theorem = Some(theorem(found, claim.excludes_integral));
}

fn theorem(found: &ProvedHorseshoe, excludes_integral: bool) -> String {
    let [short, long] = found.times.map(|time| time.mid);
    // Printed bounds are rounded down.
    let down = |x: f64, unit: f64| libm::floor(x * unit) / unit;
    let room = found.trace.map_or(String::new(), |HorseshoeTrace { margin, .. }| {
        let [unstable, stable] = [margin.unstable, margin.stable].map(|x| down(x, 100.0));
        format!(", room {unstable} and {stable}")
    });
    let horseshoe = format!(
        "near the saddle of period {short:.6} two loops of covering relations, of times {short:.3} and \
         {long:.3}, start from one rectangle of half sides {:.1e}, the second along a homoclinic orbit \
         ({} relations{room}); so the flow has a horseshoe, of entropy ≥ {} per unit of time",
        found.half[0],
        found.relations,
        down(found.entropy, 1e4),
    );
    if !excludes_integral {
        return horseshoe;
    }
    let near = if found.persists { " and all near them" } else { "" };
    format!(
        "{horseshoe}; so every real-analytic integral near its motions depends on the level, the energy \
         and the integrals that are known, for these parameters{near}"
    )
}
