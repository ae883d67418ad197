//! Lyapunov exponents and mean divergences of long runs.
//!
//! Ten blocks give the standard errors. A run of the time T does not tell an exponent from 0 below
//! about (ln T)/T, which growth like a power of the time leaves, nor a mean divergence by which
//! volume changes less than between two ends of a bounded motion. So a sign is refuted by the other
//! sign, or by 0 where 0 is claimed; what is within its error of 0 leaves a sign open.

use super::judgement::{ERRORS, MotionJudgement};
use super::scene::FollowedCase;
use crate::motion::lyapunov::{BLOCKS, ENDS, SKIPPED};
use crate::{Estimate, Exponents, FlowError, MeasuredNumber};
use liouville::claim::motion::{Exponent, Growth, MeanDivergence, Stated, Tendency};

/// Sign of a mean, as far as a run shows it.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Sign {
    Negative,
    /// 0 within its errors.
    Zero,
    Positive,
    /// Not known, for a reason.
    Open(OpenSign),
}

/// Reason why a sign is not known.
#[derive(Clone, Copy, Debug, PartialEq)]
enum OpenSign {
    /// The mean is below what the run tells from 0.
    Small,
    /// The whole, its later half and the fit are of different signs, or sizes.
    Changes,
    /// The motion leaves its place as its neighbours leave it.
    Leaves,
}

/// A mean with what its run tells of it.
#[derive(Clone, Copy, Debug)]
struct MeasuredMean {
    found: Estimate,
    /// Error of the transient in the mean: what the fit attributes to it.
    transient: f64,
    /// Largest mean that the run does not tell from 0.
    resolution: f64,
    time: f64,
    sign: Sign,
}

/// Compares the largest exponent with the claim.
pub fn exponent(claim: &Exponent, scene: &FollowedCase<'_>) -> Result<MotionJudgement, FlowError> {
    let found = scene.exponents(&claim.beginning, claim.time)?;
    let measured = growth(&found, scene.case.model.dimension());
    let mut judgement = MotionJudgement::default();
    measured.compare("exponent", claim.value.as_ref(), &mut judgement);
    let (wanted, word) = match claim.growth {
        Growth::Positive => (Sign::Positive, "positive"),
        Growth::Zero => (Sign::Zero, "zero"),
    };
    measured.weigh("exponent", wanted, word, &mut judgement);
    Ok(judgement)
}

/// Growth of a motion with this number of components.
fn growth(found: &Exponents, dimension: usize) -> MeasuredMean {
    let time = found.time.abs();
    let fit = found.trend.fitted();
    let Estimate { mean, error, later } = found.largest;
    // Of linear motions the power is below the number of components; it need not be one of t itself.
    let power = dimension as f64;
    let growth = libm::log(time).max(1.0).max(power * libm::log(1.0 / SKIPPED));
    let resolution = growth / (time * (1.0 - SKIPPED));
    let least = resolution.max(ERRORS * error);
    let is_sharp = ERRORS * error <= resolution;
    // In the later half, and at least twice that of a shear: the unit of time does not matter.
    let half = (1.0 - SKIPPED) / 2.0;
    let regular = libm::log(time).max(-2.0 * libm::log(1.0 - half) / half) / time;
    let all = [mean, later, fit.value];
    let is_leaving = found.trend.is_leaving(time * (1.0 - SKIPPED) / BLOCKS as f64);
    // A mean like that of a power, up to rounding.
    let is_power = fit.value.abs() <= ERRORS * fit.error + f64::EPSILON * largest(&all);
    let sign = match () {
        () if is_leaving => Sign::Open(OpenSign::Leaves),
        () if mean > least && later > least && fit.value > 0.0 => Sign::Positive,
        () if all.iter().all(|x| *x < -least) => Sign::Negative,
        () if is_power && later.abs() <= regular && mean.abs() <= resolution && is_sharp => {
            Sign::Zero
        }
        () if mean.abs() <= least => Sign::Open(OpenSign::Small),
        () => Sign::Open(OpenSign::Changes),
    };
    let transient = ((mean - fit.value).abs() - ERRORS * fit.error).max(0.0);
    MeasuredMean { found: found.largest, transient, resolution, time, sign }
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most: f64, x| most.max(x.abs()))
}

/// Compares the mean divergence with the claim.
pub fn mean_divergence(
    claim: &MeanDivergence,
    scene: &FollowedCase<'_>,
) -> Result<MotionJudgement, FlowError> {
    let found = scene.exponents(&claim.beginning, claim.time)?;
    let measured = volume(found.divergence, found.time.abs());
    let mut judgement = MotionJudgement::default();
    measured.compare("mean divergence", claim.value.as_ref(), &mut judgement);
    let (wanted, word) = match claim.tendency {
        Tendency::Negative => (Sign::Negative, "negative"),
        Tendency::Zero => (Sign::Zero, "zero"),
        Tendency::Positive => (Sign::Positive, "positive"),
    };
    measured.weigh("mean divergence", wanted, word, &mut judgement);
    Ok(judgement)
}

/// Change of volume along a motion.
fn volume(found: Estimate, time: f64) -> MeasuredMean {
    let Estimate { mean, error, later } = found;
    let resolution = ENDS / time;
    let is_settled = mean.abs() > ERRORS * error && mean.abs() > resolution;
    let sign = match () {
        () if mean.abs() <= ERRORS * error => Sign::Zero,
        () if !is_settled => Sign::Open(OpenSign::Small),
        () if mean * later <= 0.0 => Sign::Open(OpenSign::Changes),
        () if mean < 0.0 => Sign::Negative,
        () if mean > 0.0 => Sign::Positive,
        () => Sign::Open(OpenSign::Changes),
    };
    MeasuredMean { found, transient: 0.0, resolution, time, sign }
}

impl MeasuredMean {
    /// Standard error and that of the transient.
    fn error(&self) -> f64 {
        let Estimate { mean, error, .. } = self.found;
        (error + self.transient).max(f64::EPSILON * mean.abs())
    }

    /// Compares the mean with the value stated. Beyond the errors of both the claim is refuted only
    /// if the difference is also beyond what the transient may leave.
    fn compare(&self, quantity: &str, stated: Option<&Stated>, judgement: &mut MotionJudgement) {
        let found = MeasuredNumber { value: self.found.mean, error: self.error() };
        judgement.note(quantity, found, stated);
        let Some(stated) = stated else { return };
        let difference = (found.value - stated.value).abs();
        let own = stated.unit + ERRORS * libm::hypot(self.found.error, stated.error);
        let all = own + ERRORS * self.transient + self.resolution;
        if difference > all {
            judgement.refute(format!("the {quantity} is not {}", stated.text));
        } else if difference.is_nan() || difference > own {
            judgement.leave_open(format!(
                "a run of the time {} does not tell the {quantity} from {}: follow the motion for \
                 longer",
                self.time, stated.text
            ));
        } else if self.transient > own {
            judgement.leave_open(format!("the transient hides the digits of the {quantity}"));
        }
    }

    /// Compares the sign with the one claimed.
    fn weigh(&self, quantity: &str, wanted: Sign, word: &str, judgement: &mut MotionJudgement) {
        let mean = self.found.mean;
        match self.sign {
            sign if sign == wanted => {}
            Sign::Positive | Sign::Negative => {
                judgement.refute(format!("the {quantity} is not {word}"));
            }
            Sign::Zero => judgement.leave_open(format!(
                "the {quantity} is 0 within its error, and one below {:.1e} is not told from 0 in the \
                 time {}",
                self.resolution.max(ERRORS * self.found.error),
                self.time
            )),
            Sign::Open(OpenSign::Small) => judgement.leave_open(format!(
                "a run of the time {} tells the {quantity} from 0 above {:.1e}, and for {:.1e} it \
                 takes the time {:.1e}",
                self.time,
                self.resolution.max(ERRORS * self.found.error),
                mean.abs(),
                self.needed()
            )),
            Sign::Open(OpenSign::Changes) => judgement.leave_open(format!(
                "the {quantity} changes along the run: follow the motion for longer"
            )),
            Sign::Open(OpenSign::Leaves) => judgement.leave_open(
                "the motion goes away as fast as its neighbours, and where it goes the exponent may be \
                 another: follow it until it stays, or start there"
                    .to_string(),
            ),
        }
    }

    /// Time that a run has to take, if the mean stays the same.
    fn needed(&self) -> f64 {
        let Estimate { mean, error, .. } = self.found;
        let spread = ERRORS * error / mean.abs();
        let mut time = self.time * (spread * spread).max(self.resolution / mean.abs()).max(1.0);
        // The resolution falls more slowly than 1/T, by a logarithm.
        for _ in 0..8 {
            let growth = (libm::log(time) / libm::log(self.time)).max(1.0);
            let wanted = self.time * self.resolution * growth / mean.abs();
            time = if wanted.is_finite() { time.max(wanted) } else { time };
        }
        time
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use liouville::verdict::Verdict;

    fn divergence(mean: f64, error: f64, later: f64) -> Sign {
        volume(Estimate { mean, error, later }, 1e4).sign
    }

    #[test]
    fn a_mean_divergence_needs_three_errors_and_volumes_that_change() {
        assert_eq!(divergence(-0.01, 0.001, -0.01), Sign::Negative, "ten errors");
        assert_eq!(divergence(-0.01, 0.004, -0.01), Sign::Zero, "two and a half");
        assert_eq!(divergence(-0.0005, 0.0, -0.0005), Sign::Open(OpenSign::Small), "e^-5 in all");
        assert_eq!(divergence(0.01, 0.001, -0.001), Sign::Open(OpenSign::Changes), "later another");
        assert!(matches!(divergence(f64::NAN, 0.0, 0.0), Sign::Open(_)), "no number");
    }

    #[test]
    fn means_agree_within_three_errors_of_both() {
        let with = |mean, error, time| {
            let stated = Stated::parse("0.035 ± 0.003").expect("a number");
            let mut judgement = MotionJudgement::default();
            let found = volume(Estimate { mean, error, later: mean }, time);
            found.compare("mean", Some(&stated), &mut judgement);
            judgement.conclude().0
        };
        assert_eq!(with(0.044, 0.001, 1e5), Verdict::Confirmed, "within three errors");
        assert_eq!(with(0.047, 0.001, 1e5), Verdict::Refuted, "beyond them and the last digit");
        assert_eq!(with(0.047, 0.001, 1e3), Verdict::Undecided, "ends of the run hide as much");
        assert_eq!(with(f64::NAN, 0.001, 1e5), Verdict::Undecided, "no number");
    }
}
