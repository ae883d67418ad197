//! Sets to which motions keep at late times, told apart by distances between samples.
//!
//! Two motions keep to one set if the samples of each lie as near to those of the other as the later
//! ones of a motion lie to its own earlier ones. Distances are those across the motion: what is along
//! it, up to the next sample, does not count. So there is none for a point, little for a cycle, and that
//! of points strewn over a strange attractor. Motions that close in on points are told apart by these, in
//! whatever direction they come.

use liouville::order::StableOrder;

/// Number of samples of a motion, at times that share no period with it.
pub const SAMPLES: usize = 160;
/// Distance, in spacings of samples, up to which samples lie in one set.
const NEAR: f64 = 4.0;
/// Distance that counts as none, as a share of the widths.
const NONE: f64 = 1e-6;
/// Ratio of the distances from the last sample in the later half to those in the earlier half, up to which
/// a motion closes in on it.
const CLOSER: f64 = 0.75;
/// The same for a motion that comes to rest there, as far as a motion of the same length from its end on
/// confirms; a steady drift has 1/2, and one that slows down evenly 1/4.
const ARRIVING: f64 = 0.1;
/// Ratio of the sizes of the first and the last quarter of a motion and the one from its end on, below
/// which they count as different: 80 samples show the size of a cycle to about a hundredth.
const STEADY: f64 = 0.9;
/// Distance between the ends of a motion's samples, against the size of the earlier half of them, from
/// which on it runs away: what grows exponentially has most of its samples near the first.
const RUNAWAY: f64 = 100.0;
/// Largest number of sets.
pub const MOST_SETS: usize = 32;

/// Values at a time, and how far they go on until the next sample.
#[derive(Clone, Debug)]
struct Sample {
    at: Vec<f64>,
    way: Vec<f64>,
}

/// Change of the size of a set along its first motion.
///
/// Sizes are the largest distances among few samples, and those of chaos fall or rise four times in turn by
/// chance, so that a change counts if it is still seen when the motion is followed for longer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Change {
    /// It stays, or comes and goes.
    Steady,
    /// It grows or shrinks all the time, as around a weak focus.
    Goes,
    /// It shrinks as fast as that of a motion that comes to rest.
    Vanishes,
}

/// Samples of a motion at late times, row by row.
#[derive(Clone, Debug)]
pub struct Tail {
    rows: Vec<Sample>,
    /// Distance of the later half of the samples from the earlier one, across the motion.
    spread: f64,
    /// Distance of the later half of the samples from the last one, if the motion comes to rest there.
    rest: Option<f64>,
    is_settled: bool,
}

impl Tail {
    /// Measures samples, in the order of their times, and their rates times the time between two of them;
    /// `widths` are the units of their components.
    pub fn new(samples: &[Vec<f64>], ways: &[Vec<f64>], widths: &[f64]) -> Self {
        let scaled = |row: &Vec<f64>| row.iter().zip(widths).map(|(x, width)| x / width).collect();
        let rows = samples.iter().zip(ways);
        let rows: Vec<Sample> =
            rows.map(|(at, way)| Sample { at: scaled(at), way: scaled(way) }).collect();
        let (early, late) = rows.split_at(rows.len() / 2);
        let own = distance(early, early, true, squared).max(NONE);
        // What moves on leaves its earlier places behind, farther than they are from each other.
        let returns = distance(late, early, false, squared).max(NONE) <= NEAR * own;
        let spread = distance(late, early, false, across).max(NONE);
        let [before, after] = farther_and_nearer(&rows);
        let arrives = after <= NONE.max(ARRIVING * before);
        let rest = arrives.then_some(after.max(NONE));
        let is_settled = (returns || arrives) && !runs_away(&rows);
        Self { rows, spread, rest, is_settled }
    }

    /// Whether the motion returns to where it was.
    pub fn is_settled(&self) -> bool {
        self.is_settled
    }

    /// Whether all samples are one point.
    pub fn is_point(&self) -> bool {
        let Some(first) = self.rows.first() else { return false };
        self.rows.iter().all(|row| squared(row, first) <= NONE * NONE)
    }

    /// Whether the motion comes to rest at a point.
    pub fn rests(&self) -> bool {
        self.rest.is_some()
    }

    /// Whether the later half of the samples keeps nearer to the last one than the earlier half: a motion
    /// on a cycle does not.
    pub fn closes_in(&self) -> bool {
        let [before, after] = farther_and_nearer(&self.rows);
        !self.rows.is_empty() && after <= CLOSER * before
    }

    /// Change of size through the samples of one motion, the last of which are followed longest. The first
    /// two show that it may change; whether it goes on, the others.
    pub fn change(tails: &[&Self]) -> Change {
        let Some(last) = tails.last() else { return Change::Steady };
        let count = last.rows.len().max(1) as f64;
        let width = last.rows.first().map_or(0, |row| row.at.len());
        let middle = (0..width).map(|k| last.rows.iter().map(|row| row.at[k]).sum::<f64>() / count);
        let centre = Sample { at: middle.collect(), way: Vec::new() };
        let halves = |tail: &&Self| {
            let (early, late) = tail.rows.split_at(tail.rows.len() / 2);
            [early, late]
                .map(|half| half.iter().map(|row| squared(row, &centre)).fold(0.0, f64::max).sqrt())
        };
        let sizes: Vec<f64> = tails.iter().flat_map(halves).collect();
        let (first, last) = (sizes[0], sizes[sizes.len() - 1]);
        let falls = sizes.windows(2).all(|pair| pair[1] < pair[0] || pair[1] <= NONE);
        let rises = sizes.windows(2).all(|pair| pair[1] > pair[0]);
        // From one look to the next; between the first two no more is asked than in all.
        let ratios: Vec<f64> = sizes[1..]
            .iter()
            .step_by(2)
            .zip(sizes[3..].iter().step_by(2))
            .skip(1)
            .map(|(a, b)| b / a)
            .collect();
        let goes_on = |limit: f64| ratios.iter().all(|ratio| *ratio < limit) || last <= NONE;
        match () {
            () if first.max(last) <= NONE => Change::Steady,
            () if falls && last <= NONE.max(ARRIVING * ARRIVING * first) && goes_on(ARRIVING) => {
                Change::Vanishes
            }
            () if falls && last < STEADY * first && goes_on(STEADY) => Change::Goes,
            () if rises
                && first < STEADY * last
                && ratios.iter().all(|ratio| *ratio * STEADY > 1.0) =>
            {
                Change::Goes
            }
            () => Change::Steady,
        }
    }

    /// Whether the samples lie in the same set as those of another motion.
    pub fn is_with(&self, other: &Self) -> bool {
        if let (Some(own), Some(others)) = (self.rest, other.rest) {
            let lasts = self.rows.last().zip(other.rows.last());
            return lasts.is_some_and(|(a, b)| squared(a, b).sqrt() <= NEAR * own.max(others));
        }
        let reach = NEAR * self.spread.max(other.spread);
        distance(&self.rows, &other.rows, false, across) <= reach
            && distance(&other.rows, &self.rows, false, across) <= reach
    }
}

/// Whether the last sample is far away from all earlier ones.
fn runs_away(rows: &[Sample]) -> bool {
    let (Some(first), Some(last)) = (rows.first(), rows.last()) else { return false };
    let early = rows[..rows.len() / 2].iter().map(|row| squared(row, first)).fold(0.0, f64::max);
    squared(first, last).sqrt() > NONE.max(RUNAWAY * early.sqrt())
}

/// Largest distances from the last sample in the earlier and in the later half.
fn farther_and_nearer(rows: &[Sample]) -> [f64; 2] {
    let Some(last) = rows.last() else { return [f64::INFINITY; 2] };
    let (early, late) = rows.split_at(rows.len() / 2);
    [early, late].map(|half| half.iter().map(|row| squared(row, last)).fold(0.0, f64::max).sqrt())
}

/// Distance of two samples, squared.
fn squared(a: &Sample, b: &Sample) -> f64 {
    a.at.iter().zip(&b.at).map(|(x, y)| (x - y) * (x - y)).sum()
}

/// Distance of a sample from the piece of a motion through another, squared: what is along it does not
/// count.
fn across(a: &Sample, b: &Sample) -> f64 {
    let (all, size) = (squared(a, b), b.way.iter().map(|x| x * x).sum::<f64>());
    if size == 0.0 || !size.is_finite() {
        return all;
    }
    let apart = a.at.iter().zip(&b.at).map(|(x, y)| x - y);
    let along: f64 = apart.zip(&b.way).map(|(x, u)| x * u).sum::<f64>() / size;
    let beyond = along - along.clamp(-1.0, 1.0);
    (all + (beyond * beyond - along * along) * size).max(0.0)
}

/// Median over some points of the distance from the nearest one of others; not from itself, if these
/// are the same ones. Infinite if there are none.
fn distance(
    from: &[Sample],
    to: &[Sample],
    are_same: bool,
    measure: impl Fn(&Sample, &Sample) -> f64,
) -> f64 {
    let nearest = |(place, row): (usize, &Sample)| {
        let others = to.iter().enumerate().filter(|(other, _)| !are_same || *other != place);
        let apart = others.map(|(_, other)| (squared(row, other), other));
        let nearest = apart.min_by(|(one, _), (other, _)| one.total_cmp(other));
        nearest.map_or(f64::INFINITY, |(_, other)| measure(row, other))
    };
    let mut all: Vec<f64> = from.iter().enumerate().map(nearest).collect();
    all.order_by(f64::total_cmp);
    all.get(all.len() / 2).map_or(f64::INFINITY, |middle| middle.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chaos::late::chance;

    /// Samples at the times of basins: k and a chance.
    fn tail(at: impl Fn(f64) -> [f64; 2]) -> Tail {
        let time = |k: usize| k as f64 + chance(k);
        let rows: Vec<Vec<f64>> = (0..SAMPLES).map(|k| at(time(k)).to_vec()).collect();
        let way = |k: usize| {
            let (own, next) = (at(time(k)), at(time(k) + 1e-5));
            [0, 1].map(|i| (next[i] - own[i]) / 1e-5).to_vec()
        };
        let ways: Vec<Vec<f64>> = (0..SAMPLES).map(way).collect();
        Tail::new(&rows, &ways, &[1.0, 1.0])
    }

    fn circle(radius: f64, period: f64, phase: f64) -> Tail {
        tail(|t| {
            let angle = std::f64::consts::TAU * (t / period + phase);
            [radius * angle.cos(), radius * angle.sin()]
        })
    }

    #[test]
    fn motions_on_one_cycle_are_together_at_any_phase_and_period() {
        let golden = 0.618_033_988_749_894_9;
        let regular = [1.0, 2.0, 0.5, 3.7, 40.0, 79.0, 1.0 + golden, 1.0 / golden, golden * golden];
        for period in regular.into_iter().chain((1..200).step_by(5).map(|k| f64::from(k) / 37.0)) {
            let (own, other) = (circle(1.0, period, 0.0), circle(1.0, period, 0.37));
            assert!(own.is_settled() && other.is_settled() && !own.is_point(), "{period}");
            assert!(own.is_with(&other), "{period}");
            assert!(!own.is_with(&circle(1.5, period, 0.0)), "another cycle, {period}");
            assert!(!own.is_with(&circle(1.02, period, 0.0)), "a cycle near it, {period}");
            assert!(!own.is_with(&tail(|_| [0.0; 2])), "the point inside, {period}");
        }
    }

    #[test]
    fn points_are_apart_unless_they_are_one() {
        let at = |x: f64| tail(move |t| [x + 0.1 * (-t / 8.0).exp(), 0.0]);
        assert!(at(0.0).is_settled());
        assert!(at(0.0).is_with(&tail(|_| [0.0, 0.0])), "also where one has come less near");
        assert!(!tail(|_| [0.0; 2]).is_with(&tail(|_| [1e-3, 0.0])));
        assert!(tail(|_| [0.3, 0.0]).is_point());
        assert!(at(0.0).closes_in() && !circle(1.0, 3.7, 0.0).closes_in());
    }

    #[test]
    fn what_comes_to_rest_is_told_by_where_whatever_its_direction() {
        // Damped swings along a line, and on ellipses
        let swing = |x: f64, turn: f64, width: f64| {
            tail(move |t| {
                let size = 0.1 * (-t / 32.0).exp();
                let (along, beside) = (size * (0.7 * t).cos(), width * size * (1.9 * t).sin());
                [
                    x + turn.cos() * along - turn.sin() * beside,
                    turn.sin() * along + turn.cos() * beside,
                ]
            })
        };
        for turn in [0.0, 0.3, 2.1] {
            for width in [0.0, 0.5] {
                let own = swing(0.0, turn, width);
                assert!(own.is_settled() && own.rests(), "{turn}, {width}");
                assert!(own.is_with(&swing(0.0, turn + 1.0, 0.5)), "{turn}, {width}");
                assert!(!own.is_with(&swing(0.2, turn, width)), "{turn}, {width}");
                assert!(own.is_with(&tail(|_| [0.0; 2])), "{turn}, {width}");
            }
        }
    }

    #[test]
    fn the_size_of_a_set_goes_around_a_weak_focus() {
        let spiral = |from: f64, size: fn(f64) -> f64| {
            tail(move |t| {
                let t = t + from;
                [size(t) * t.cos(), size(t) * t.sin()]
            })
        };
        // The later halves of two motions of 320 samples
        let change =
            |size: fn(f64) -> f64| Tail::change(&[&spiral(160.0, size), &spiral(480.0, size)]);
        assert_eq!(change(|t| t.powf(-0.5)), Change::Goes, "a cubic friction");
        assert_eq!(change(|t| t.powf(-0.25)), Change::Goes, "one of degree 5");
        assert_eq!(change(|t| t.powf(0.5)), Change::Goes, "outwards");
        assert_eq!(change(|t| (-t / 40.0).exp()), Change::Vanishes);
        assert_eq!(change(|_| 1.0), Change::Steady, "a cycle");
        assert_eq!(change(|t| 1.0 + (-t / 20.0).exp()), Change::Steady, "the way to a cycle");
        assert_eq!(change(|t| 1.0 + 0.3 * (0.37 * t).sin()), Change::Steady, "a torus");
        assert_eq!(change(|_| 0.0), Change::Steady, "a point");
    }

    #[test]
    fn a_change_goes_on_when_it_is_looked_at_for_longer() {
        let look = |from: f64, length: f64, size: fn(f64) -> f64| {
            tail(move |t| {
                let t = from + t * length;
                [size(t) * t.cos(), size(t) * t.sin()]
            })
        };
        let change = |size: fn(f64) -> f64| {
            let looks = [(160.0, 1.0), (480.0, 1.0), (960.0, 2.0), (1920.0, 4.0)]
                .map(|(from, length)| look(from, length, size));
            Tail::change(&looks.each_ref())
        };
        assert_eq!(change(|t| t.powf(-0.25)), Change::Goes);
        assert_eq!(change(|t| t.powf(0.25)), Change::Goes);
        assert_eq!(change(|t| (-t / 60.0).exp()), Change::Vanishes);
        assert_eq!(change(|t| 1e-4 + (-t / 60.0).exp()), Change::Steady, "a small cycle");
        assert_eq!(change(|t| 1.0 + (-t / 200.0).exp()), Change::Steady, "a slow way to a cycle");
    }

    #[test]
    fn what_drifts_is_not_settled() {
        assert!(!tail(|t| [(1.0 - t / 160.0).powi(2), 0.0]).is_settled(), "a stop");
        assert!(!tail(|t| [t, 0.0]).is_settled(), "a line");
        assert!(!tail(|t| [(t / 30.0).exp(), 0.0]).is_settled(), "growth");
        assert!(!tail(|t| [(t - 160.0).exp(), 0.0]).is_settled(), "growth far beyond the widths");
        assert!(!tail(|t| [t / 40.0, t.sin()]).is_settled(), "a slow drift");
        assert!(!circle(1.0, 1000.0, 0.0).is_settled(), "a part of a turn");
    }
}
