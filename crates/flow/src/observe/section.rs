//! Behaviour of the crossings of one orbit: convergence to a cycle, confinement to a part of the
//! section.

use std::f64::consts::PI;

use super::judgement::MotionJudgement;
use super::scene::FollowedCase;
use crate::{Crossing, FlowError, MeasuredNumber};
use liouville::claim::motion::{Confined, LimitCycle, SectionCoordinate};
use liouville::number::rational::Rational;

fn distance(a: &Crossing, b: &Crossing) -> f64 {
    let turn = (a.at[0] - b.at[0]) / (2.0 * PI);
    libm::hypot(2.0 * PI * (turn - turn.round()), a.at[1] - b.at[1])
}

/// Tests whether the crossings tend to a cycle.
///
/// The displacement |x_(k+n) - x_k| has to fall to half in each quarter of the run, or to the
/// difference between f64 and double-double after a turn. Its decline gives the remaining distance
/// to the cycle.
pub fn limit_cycle(
    claim: &LimitCycle,
    scene: &FollowedCase<'_>,
) -> Result<MotionJudgement, FlowError> {
    let crossings = scene.crossings(&claim.beginning, 0, claim.crossings)?.crossings;
    let period = claim.period;
    let last = crossings.len() - 1;
    // The largest displacement over one turn of the cycle, the last of them ending at `end`.
    let displacement = |end: usize, step: usize| {
        let of = |k: usize| distance(&crossings[end - k], &crossings[end - k - step]);
        (0..period).map(of).fold(0.0, f64::max)
    };
    let quarter = last / 4;
    let falls = [2 * quarter, 3 * quarter, last].map(|end| displacement(end, period));
    let blur = scene.map()?.blur(crossings[last].at, period)?;
    let mut judgement = MotionJudgement::default();
    let shown = |value: f64| MeasuredNumber { value, error: blur };
    judgement.show("displacement halfway", shown(falls[0]));
    judgement.show("displacement at the end", shown(falls[2]));
    // Accumulated rounding moves a cycle that is about to vanish by its square root.
    let floor = libm::sqrt(blur * (last / period) as f64);
    if falls[2] > blur && falls.windows(2).any(|pair| pair[1] > pair[0] / 2.0) {
        let turns: Vec<f64> = (1..last / period)
            .rev()
            .map(|turn| displacement(last - (turn - 1) * period, period))
            .collect();
        match course(&turns[turns.len() / 4..]) {
            _ if falls[2] <= floor => {
                judgement.leave_open("they rest up to rounding: follow fewer".to_string());
            }
            Course::Wanders => judgement.refute("the crossings do not come to rest".to_string()),
            Course::Falls => judgement.leave_open("they come to rest slowly".to_string()),
            Course::Rises => judgement.leave_open(
                "they still go apart, and may come to rest elsewhere: follow more".to_string(),
            ),
            Course::Stays => judgement.leave_open(
                "they neither come nearer nor go away, and may come to rest more slowly than this run \
                 shows: follow more"
                    .to_string(),
            ),
        }
        return Ok(judgement);
    }
    let left = remaining(falls, (quarter / period).max(1), blur);
    for divisor in (1..period).filter(|n| period.is_multiple_of(*n)) {
        if displacement(last, divisor) <= falls[2] + left {
            judgement.refute(format!("the period is {divisor}"));
        }
    }
    if let Some(point) = &claim.point {
        let stated = Crossing { at: [point[0].value, point[1].value], ..crossings[last] };
        let nearest = (0..period)
            .map(|k| &crossings[last - k])
            .min_by(|a, b| distance(a, &stated).total_cmp(&distance(b, &stated)));
        for (axis, quantity) in ["l", "L/G"].into_iter().enumerate() {
            let value = nearest.map_or(f64::NAN, |crossing| crossing.at[axis]);
            judgement.compare(quantity, MeasuredNumber { value, error: left }, &point[axis]);
        }
    }
    Ok(judgement)
}

/// Course of the displacements of a run that does not come to rest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Course {
    /// They fall from window to window.
    Falls,
    /// They rise.
    Rises,
    /// They do neither, and change little.
    Stays,
    /// They do neither, fall to half, and rise to twice as much again.
    Wanders,
}

/// Number of windows whose largest displacements are compared. A spiral is seen at all its sides in a
/// window, so that these fall or rise with it.
const WINDOWS: usize = 8;

/// Course of displacements, turn by turn.
fn course(turns: &[f64]) -> Course {
    let width = turns.len().div_ceil(WINDOWS).max(1);
    let largest = |window: &[f64]| window.iter().copied().fold(0.0, f64::max);
    let tops: Vec<f64> = turns.chunks(width).map(largest).collect();
    if tops.windows(2).all(|pair| pair[1] < pair[0]) {
        return Course::Falls;
    }
    if tops.windows(2).all(|pair| pair[1] > pair[0]) {
        return Course::Rises;
    }
    let (mut top, mut bottom) = (0.0_f64, f64::INFINITY);
    for turn in turns {
        if *turn > 2.0 * bottom {
            return Course::Wanders;
        }
        top = top.max(*turn);
        if *turn < top / 2.0 {
            bottom = bottom.min(*turn);
        }
    }
    Course::Stays
}

/// Remaining sum of a geometric decline: d r/(1 - r), where d is the last displacement, and r the
/// factor from one turn to the next, over `turns` turns between the given displacements.
fn remaining([_, before, last]: [f64; 3], turns: usize, blur: f64) -> f64 {
    let factor = libm::pow(last / before, 1.0 / turns as f64);
    match factor < 1.0 {
        true => (last * factor / (1.0 - factor)).max(blur),
        false => blur.max(last),
    }
}

/// Tests whether the crossings stay in a part of the section, or the stated number of them does.
pub fn confined(claim: &Confined, scene: &FollowedCase<'_>) -> Result<MotionJudgement, FlowError> {
    let orbit = scene.crossings(&claim.beginning, claim.skip, claim.crossings)?;
    let axis = match claim.axis {
        SectionCoordinate::L => 0,
        SectionCoordinate::Z => 1,
    };
    let values = orbit.crossings.iter().map(|crossing| crossing.at[axis]);
    let [least, most] = &claim.between;
    let is_beyond = |x: &f64| *x <= least.value || *x >= most.value;
    let beyond = values.clone().filter(is_beyond).count();
    let start = (f64::INFINITY, f64::NEG_INFINITY);
    let (low, high) = values.fold(start, |(low, high), x| (low.min(x), high.max(x)));
    let mut judgement = MotionJudgement::default();
    let rounded = |value: f64| MeasuredNumber { value, error: f64::EPSILON * value.abs() };
    judgement.show("lowest", rounded(low));
    judgement.show("highest", rounded(high));
    let all = orbit.crossings.len();
    let told = format!("{beyond} of {all} crossings are beyond");
    let [inside, needed] = [all - beyond, all].map(|count| Rational::from(count as i64));
    if inside < &claim.share * &needed {
        judgement.refute(told);
    } else if beyond > 0 {
        judgement.remark = Some(told);
    }
    Ok(judgement)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spiral_is_no_wandering() {
        // Displacements of spirals on ellipses of the ratio k, turned by 0.7 a turn.
        let spiral = |factor: f64, k: f64| {
            let of = |turn: i32| {
                let angle = 0.7 * f64::from(turn);
                libm::pow(factor, f64::from(turn))
                    * libm::hypot(k * libm::cos(angle), libm::sin(angle))
            };
            course(&(0..800).map(of).collect::<Vec<_>>())
        };
        for k in [1.0, 1.5, 3.0, 30.0] {
            assert_eq!(spiral(0.9999, k), Course::Falls, "{k}");
            assert_eq!(spiral(1.0001, k), Course::Rises, "{k}");
        }
        let passing: Vec<f64> =
            (0..800).map(|turn| f64::from((turn - 500) * (turn - 500)) + 1.0).collect();
        assert_eq!(course(&passing), Course::Wanders, "near, and away again");
        for angle in [0.9, 1.1, 1.3, 2.0] {
            let of = |turn| 2.0 + libm::sin(angle * f64::from(turn)) / 2.0;
            let curve: Vec<f64> = (0..800).map(of).collect();
            assert_ne!(course(&curve), Course::Wanders, "an invariant curve");
        }
        assert_eq!(course(&[]), Course::Falls, "no turns, and nothing refuted");
    }

    #[test]
    fn a_geometric_decline_tells_what_is_left() {
        // d = 2^-k: after the displacement 2^-20 an equal distance remains.
        let falls = [10, 15, 20].map(|k| libm::pow(2.0, -f64::from(k)));
        let left = remaining(falls, 5, 1e-16);
        assert!((left / falls[2] - 1.0).abs() < 1e-12, "left: {left:e}");
        assert_eq!(remaining([1e-3, 1e-3, 2e-3], 5, 1e-16), 2e-3, "no decline");
    }
}
