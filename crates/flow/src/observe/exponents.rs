//! Lyapunov exponents and mean divergences of long runs.
//!
//! Ten blocks give the standard errors. A sign must also be that of the later five alone:
//! transients look like chaos that disappears later. A regular motion shows (ln t)/t in place of 0.

use super::judgement::{ERRORS, MotionJudgement};
use super::scene::FollowedCase;
use crate::{Estimate, FlowError, MeasuredNumber};
use liouville::claim::motion::{Exponent, Growth, MeanDivergence, Tendency};

fn measured(estimate: Estimate) -> MeasuredNumber {
    MeasuredNumber { value: estimate.mean, error: estimate.error }
}

/// Compares the largest exponent with the claim.
pub fn exponent(claim: &Exponent, scene: &FollowedCase<'_>) -> Result<MotionJudgement, FlowError> {
    let found = scene.exponents(&claim.beginning, claim.time)?.largest;
    let mut judgement = MotionJudgement::default();
    match &claim.value {
        Some(stated) => judgement.compare_mean("exponent", measured(found), stated),
        None => judgement.show("exponent", measured(found)),
    }
    judgement.expect(growth(found, claim.time), claim.growth, "sign of the exponent");
    Ok(judgement)
}

/// Growth of a motion. Zero: in the end not above that of a regular motion; positive: above it and
/// three errors.
fn growth(found: Estimate, time: f64) -> Option<Growth> {
    let regular = libm::log(time.max(std::f64::consts::E)) / time;
    if found.later <= regular {
        return Some(Growth::Zero);
    }
    let least = regular.max(ERRORS * found.error);
    (found.mean.min(found.later) > least).then_some(Growth::Positive)
}

/// Compares the mean divergence with the claim.
pub fn mean_divergence(
    claim: &MeanDivergence,
    scene: &FollowedCase<'_>,
) -> Result<MotionJudgement, FlowError> {
    let found = scene.exponents(&claim.beginning, claim.time)?.divergence;
    let mut judgement = MotionJudgement::default();
    match &claim.value {
        Some(stated) => judgement.compare_mean("mean divergence", measured(found), stated),
        None => judgement.show("mean divergence", measured(found)),
    }
    judgement.expect(tendency(found), claim.tendency, "sign of the mean divergence");
    Ok(judgement)
}

/// Sign of a mean divergence, if it is beyond three errors and the same in the later half.
fn tendency(found: Estimate) -> Option<Tendency> {
    if found.mean.abs() <= ERRORS * found.error {
        return Some(Tendency::Zero);
    }
    match found.mean * found.later > 0.0 {
        true if found.mean < 0.0 => Some(Tendency::Negative),
        true => Some(Tendency::Positive),
        false => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sign_needs_three_errors() {
        let of = |mean, error| Estimate { mean, error, later: mean };
        assert_eq!(growth(of(0.08, 0.01), 1e4), Some(Growth::Positive), "far above");
        assert_eq!(growth(of(0.0005, 0.01), 1e4), Some(Growth::Zero), "as (ln t)/t");
        assert_eq!(growth(of(0.01, 0.004), 1e4), None, "neither");
        let transient = Estimate { mean: 0.04, error: 0.001, later: 0.0002 };
        assert_eq!(growth(transient, 1e4), Some(Growth::Zero), "gone in the later half");
        assert_eq!(tendency(of(-0.01, 0.001)), Some(Tendency::Negative), "ten errors");
        assert_eq!(tendency(of(-0.01, 0.004)), Some(Tendency::Zero), "two and a half");
        let turns = Estimate { mean: 0.01, error: 0.001, later: -0.001 };
        assert_eq!(tendency(turns), None, "another sign later");
    }
}
