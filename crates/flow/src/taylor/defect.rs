//! Control of the defect: a step is halved until the derivative of its polynomial is the field, at
//! its end and, where the field has functions that can be 0 up to rounding for a while, at a place
//! within.
//!
//! Steps come from the last coefficients alone. A term that is tiny where a step begins and grows within
//! it does not show there, nor do terms behind a gap in the series, as in x'' = −x⁷ from x = 0.

use crate::taylor::number::SeriesNumber;
use crate::taylor::pace::Lane;
use crate::taylor::stepper::{Accuracy, Stepper};
use crate::taylor::watch::Edge;
use liouville::graph::{Kernel, with_widest_vectors};

/// Multiple of the first term left out, by which the polynomial and the field may differ over a step.
const MARGIN: f64 = 300.0;
/// Multiple of the bound of their rounding, by which they may differ in any case.
const ROUNDINGS: f64 = 64.0;
/// Smallest number of f64: the second part of a rate that is a pair has at least this error.
const LEAST_NUMBER: f64 = 5e-324;
/// Number of times that a step is halved.
const MOST_HALVES: usize = 60;
/// Number of halves of a step from which on a quotient whose square underflows is to blame.
const FAINT_HALVES: u32 = 8;
/// Part of a step up to an operation without a value at which its end is looked at.
const BEFORE_EDGE: f64 = 0.875;
/// Part of 1 by which the place within a step moves from step to step: it is in step with nothing.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// Polynomials of the present steps at some times.
pub(crate) struct Sampled<T> {
    times: T,
    /// Whether the samples are those of the present expansions.
    pub(crate) is_present: bool,
    /// Change of the state since the beginning, and its derivative.
    pub(crate) increments: Vec<T>,
    slopes: Vec<T>,
    states: Vec<T>,
    /// Difference from the field over a step that is allowed, relative to the state.
    tolerance: f64,
    /// Largest difference from the field.
    gap: T,
    /// 0 where the field is finite, or else NaN.
    soundness: T,
}

impl<T: SeriesNumber> Sampled<T> {
    pub(crate) fn new(dimension: usize, accuracy: Accuracy) -> Self {
        let zeros = || vec![T::ZERO; dimension];
        let (increments, slopes, states) = (zeros(), zeros(), zeros());
        let count = (accuracy.order + 1) as f64;
        let tolerance = MARGIN * count * libm::exp(-accuracy.kappa * count);
        let (times, gap, soundness) = (T::ZERO, T::ZERO, T::ZERO);
        let is_present = false;
        Self { times, is_present, increments, slopes, states, tolerance, gap, soundness }
    }

    /// Whether the samples were taken at these times.
    #[inline(always)]
    pub(crate) fn is_at(&self, times: T) -> bool {
        (0..T::LANES).all(|lane| self.times.lane(lane).pair() == times.lane(lane).pair())
    }
}

/// Place within a step, as a part of it, that differs from step to step.
pub(crate) fn inside<One>(lane: &Lane<One>) -> f64 {
    let turn = GOLDEN * lane.steps as f64;
    0.25 + 0.5 * (turn - libm::floor(turn))
}

impl<T: SeriesNumber> Stepper<T> {
    /// Halves steps until their polynomials follow the field.
    pub(crate) fn keep_defect(&mut self) {
        let has_pulses = self.series.has_pulses();
        for _ in 0..MOST_HALVES {
            let fits_inside = !has_pulses || self.follow_field(inside);
            let end = |lane: &Lane<T::One>| match lane.edge {
                Some((Edge::Sign(_), _)) | None => 1.0,
                Some(_) => BEFORE_EDGE,
            };
            if self.follow_field(end) && fits_inside {
                break;
            }
        }
    }

    /// Whether all steps follow the field at a part of their length; halves those that do not.
    fn follow_field(&mut self, share: impl Fn(&Lane<T::One>) -> f64) -> bool {
        self.sample(share);
        with_widest_vectors(Comparison(self));
        let mut holds = true;
        for index in 0..T::LANES {
            if self.is_judged(index) && !self.follows_field(index) {
                let lane = &mut self.lanes[index];
                lane.step = lane.step * T::One::float(0.5);
                lane.is_stuck = !lane.moves();
                lane.halves += 1;
                lane.is_faint = lane.halves >= FAINT_HALVES && self.series.is_faint(index);
                holds = false;
            }
        }
        holds
    }

    /// Computes the polynomials, and the field and the further functions at their states, at a part of
    /// the length of each step.
    pub(crate) fn sample(&mut self, share: impl Fn(&Lane<T::One>) -> f64) {
        let times = T::from_lanes(|lane| {
            let lane = &self.lanes[lane];
            lane.step * T::One::float(share(lane))
        });
        if self.sampled.is_at(times) && self.sampled.is_present {
            return;
        }
        (self.sampled.times, self.sampled.is_present) = (times, true);
        with_widest_vectors(Sampling(self));
        self.series.probe(&self.sampled.states);
    }

    /// Time of a motion's sample, after its present state.
    pub(crate) fn sampled_time(&self, lane: usize) -> T::One {
        self.sampled.times.lane(lane)
    }

    /// Bound of the error of a further function at the sample.
    pub(crate) fn output_error(&self, output: usize, index: usize) -> f64 {
        let known = self.sampled_sizes(index).map(|[size, _]| T::EPSILON * size);
        ROUNDINGS * self.series.output_error(output, index, known.collect())
    }

    fn is_judged(&self, index: usize) -> bool {
        let lane = &self.lanes[index];
        let is_given_up = lane.is_stuck || lane.is_faint;
        lane.step.leading() != 0.0 && lane.moves() && !is_given_up && self.is_regular(index)
    }

    /// Whether the polynomial follows the field at the sample, as well as rounding lets tell.
    fn follows_field(&self, index: usize) -> bool {
        let at = |value: T| value.lane(index).leading();
        let length = self.lanes[index].step.leading().abs();
        let [still, moving, ..] = self.sizes.norms.map(at);
        let allowed = self.sampled.tolerance * still.max(moving * length);
        if at(self.sampled.soundness) != 0.0 || !length.is_finite() {
            return false;
        }
        at(self.sampled.gap) * length <= allowed || self.is_rounding(index, allowed / length)
    }

    /// Whether no component differs by more than is allowed, and rounding.
    fn is_rounding(&self, index: usize, allowed: f64) -> bool {
        let sizes: Vec<[f64; 2]> = self.sampled_sizes(index).collect();
        let known: Vec<f64> = sizes.iter().map(|[size, _]| T::EPSILON * size).collect();
        let errors = self.series.rate_errors(index, known);
        (0..self.dimension()).all(|row| {
            let rate = self.series.probed_rate(row) * self.series.units;
            let gap = self.sampled.slopes[row] - rate;
            let unit = self.lanes[index].unit;
            let rounding = (errors[row] + LEAST_NUMBER) * unit + T::EPSILON * sizes[row][1];
            gap.lane(index).leading().abs() <= allowed + ROUNDINGS * rounding
        })
    }

    /// Sizes of the terms of each component and of its derivative at the sample.
    fn sampled_sizes(&self, index: usize) -> impl Iterator<Item = [f64; 2]> {
        let time = self.sampled.times.lane(index).leading().abs();
        (0..self.dimension()).map(move |row| {
            let terms = self.series.component(row).iter().enumerate().rev();
            terms.fold([0.0; 2], |[sum, slope], (n, term)| {
                let size = term.lane(index).leading().abs();
                let steep = if n > 0 { slope * time + n as f64 * size } else { slope };
                [sum * time + size, steep]
            })
        })
    }
}

/// Work of evaluating the polynomials of the present steps.
struct Sampling<'s, T: SeriesNumber>(&'s mut Stepper<T>);

impl<T: SeriesNumber> Kernel for Sampling<'_, T> {
    #[inline(always)]
    fn run(self) {
        let stepper = self.0;
        let times = stepper.sampled.times;
        for row in 0..stepper.dimension() {
            let terms = stepper.series.component(row);
            let (mut sum, mut slope) = (T::ZERO, T::ZERO);
            for coefficient in terms[1..].iter().rev() {
                slope = sum.fused(slope, times).settled();
                sum = coefficient.fused(sum, times).settled();
            }
            let increment = sum * times;
            stepper.sampled.increments[row] = increment;
            stepper.sampled.slopes[row] = sum.fused(slope, times).settled();
            stepper.sampled.states[row] = terms[0] + increment;
        }
    }
}

/// Work of comparing them with the field.
struct Comparison<'s, T: SeriesNumber>(&'s mut Stepper<T>);

impl<T: SeriesNumber> Kernel for Comparison<'_, T> {
    #[inline(always)]
    fn run(self) {
        let stepper = self.0;
        let (mut gap, mut soundness) = (T::ZERO, T::ZERO);
        for (row, slope) in stepper.sampled.slopes.iter().enumerate() {
            let rate = stepper.series.probed_rate(row) * stepper.series.units;
            gap = gap.larger(*slope - rate);
            soundness = soundness + rate * T::ZERO;
        }
        (stepper.sampled.gap, stepper.sampled.soundness) = (gap, soundness);
    }
}
