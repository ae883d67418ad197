//! Steps over which each function in the field is resolved in proportion to its own size.
//!
//! A pulse e^(−t²) is far below the rounding of the state before it comes. Its terms show it all the
//! same: they grow along the order. A step is so short that the last terms of each function, and of
//! each component of the state, are small beside its largest.

use crate::taylor::number::SeriesNumber;
use crate::taylor::stepper::Stepper;
use liouville::graph::{Kernel, with_widest_vectors};

/// Part of the way to a pole that a step may take: the terms of order n have to be below this to the n-th
/// power, relative to the largest.
const REACH: f64 = 0.5;
/// Part of the state's size below which a component has a step of its own, as accurate as the state's.
const SMALL: f64 = 1.0 / 128.0;
/// Number of orders from the terms by which the last ones are measured, up to these.
const APART: usize = 4;
/// Number of last terms among which two are looked for that are not 0.
const LATE: usize = 6;
/// Size of a function below which its terms may underflow, as products of two numbers do.
const TINY: f64 = 1e-140;
/// The same of a component of the state: products of two numbers of its size are nothing beside it.
const TINY_STATE: f64 = f64::MIN_POSITIVE;
/// Exponent of an exponential function below which its terms may.
const FAINT: f64 = -320.0;
/// Growth of the exponent over a step which is possible from there on.
const RISE: f64 = 40.0;
/// Part of a step below which it is not shortened, and multiple of the time's rounding.
const LEAST: f64 = 1.0 / (1u64 << 40) as f64;
const LAST_PLACES: f64 = 4096.0;
/// Number of times that a step is halved for an exponent.
const MOST_HALVES: usize = 60;

impl<T: SeriesNumber> Stepper<T> {
    /// Shortens steps over which a function in the field, or a component of the state, is not resolved.
    pub(crate) fn keep_functions(&mut self) {
        let mut limits = std::mem::take(&mut self.limits);
        limits.clear();
        limits.resize(T::LANES, f64::INFINITY);
        with_widest_vectors(Resolution { stepper: self, limits: &mut limits, is_entire: true });
        for (argument, rate) in self.series.exponents() {
            for (index, limit) in limits.iter_mut().enumerate() {
                let first = argument[0].lane(index).leading();
                let weight = rate.map_or(1.0, |rate| -rate * first.signum());
                if weight * first < FAINT {
                    let step = self.lanes[index].step.leading();
                    let step = step.abs().min(*limit).copysign(step);
                    *limit = limit.min(faint(argument, weight, index, step));
                }
            }
        }
        for (near, argument, reach) in self.series.nears() {
            for (index, limit) in limits.iter_mut().enumerate() {
                if near.lane(index).leading() > 0.0 {
                    let step = self.lanes[index].step.leading().abs().min(*limit);
                    *limit = limit.min(within(argument, reach, index, step));
                }
            }
        }
        // A zero of high order of a function without poles is passed, not approached for ever.
        for (lane, limit) in self.lanes.iter().zip(&mut limits) {
            let step = lane.step.leading().abs();
            let least =
                (LEAST * step).max(LAST_PLACES * T::EPSILON * lane.time.hi.abs() / lane.unit);
            *limit = limit.max(least.min(step));
        }
        with_widest_vectors(Resolution { stepper: self, limits: &mut limits, is_entire: false });
        for (lane, limit) in self.lanes.iter_mut().zip(&limits) {
            let step = lane.step.leading();
            if step.abs() > *limit {
                lane.step = T::One::float(limit.copysign(step));
            }
        }
        self.limits = limits;
    }
}

/// Work of comparing the last terms with the first.
struct Resolution<'s, T: SeriesNumber> {
    stepper: &'s Stepper<T>,
    limits: &'s mut [f64],
    /// Whether the functions without poles are looked at, or else the others and the state.
    is_entire: bool,
}

impl<T: SeriesNumber> Kernel for Resolution<'_, T> {
    #[inline(always)]
    fn run(self) {
        let Self { stepper, limits, is_entire } = self;
        let steps = T::from_lanes(|lane| stepper.lanes[lane].step) * T::float(1.0 / REACH);
        let last = Powers::new(steps, stepper.series.order() - 1);
        for row in stepper.series.functions(is_entire) {
            last.limit(row, TINY, limits);
        }
        if is_entire {
            return;
        }
        let last = last.next();
        let strict = libm::exp(-stepper.kappa);
        let lengths = T::from_lanes(|lane| stepper.lanes[lane].step);
        let own = Powers::new(lengths * T::float(strict.recip()), stepper.series.order());
        let [still, moving, ..] = stepper.sizes.norms;
        let norm = still.larger(moving * lengths);
        for row in 0..stepper.dimension() {
            let terms = stepper.series.component(row);
            last.limit(terms, TINY_STATE, limits);
            own.limit_small(terms, (norm, strict), limits);
        }
    }
}

/// Powers of the steps over their reach.
struct Powers<T> {
    first: T,
    /// Those of the last two orders.
    last: [T; 2],
}

impl<T: SeriesNumber> Powers<T> {
    #[inline(always)]
    fn new(steps: T, order: usize) -> Self {
        let first = T::ZERO.larger(steps);
        let before = (2..order).fold(first, |power, _| power * first);
        Self { first, last: [before, before * first] }
    }

    /// Those of one order more.
    #[inline(always)]
    fn next(self) -> Self {
        Self { last: [self.last[1], self.last[1] * self.first], ..self }
    }

    /// Lowers the limits of the lanes in which a component is small beside the state, and not known as
    /// well as it: the state's own step takes no account of it.
    #[inline(always)]
    fn limit_small(&self, terms: &[T], (norm, reach): (T, f64), limits: &mut [f64]) {
        let count = terms.len();
        let step = self.first * T::float(reach);
        let size = T::ZERO.larger(terms[0]).larger(terms[1] * step);
        let first = T::ZERO.larger(terms[0]).larger(terms[1] * self.first);
        let last = T::ZERO.larger(terms[count - 2] * self.last[0]);
        let last = last.larger(terms[count - 1] * self.last[1]);
        for (lane, limit) in limits.iter_mut().enumerate() {
            let [size, norm, first, last] =
                [size, norm, first, last].map(|x| x.lane(lane).leading());
            let last = if last == 0.0 { first } else { last };
            if size < SMALL * norm && last >= first && last > TINY_STATE {
                *limit = limit.min(resolved(terms, lane, reach));
            }
        }
    }

    /// Lowers the limits of the lanes in which the last terms are not small beside the first.
    #[inline(always)]
    fn limit(&self, terms: &[T], tiny: f64, limits: &mut [f64]) {
        let count = terms.len();
        let first = T::ZERO.larger(terms[0]).larger(terms[1] * self.first);
        let last = T::ZERO.larger(terms[count - 2] * self.last[0]);
        let last = last.larger(terms[count - 1] * self.last[1]);
        for (lane, limit) in limits.iter_mut().enumerate() {
            let [first, last] = [first, last].map(|x| x.lane(lane).leading());
            // Where terms underflow they tell nothing.
            let last = if last == 0.0 { first } else { last };
            if last >= first && last > tiny {
                *limit = limit.min(resolved(terms, lane, REACH));
            }
        }
    }
}

/// Longest step over which the last two terms that are not 0 are small beside the largest of those
/// before; one in four terms may be 0, as in functions of x⁴.
fn resolved<T: SeriesNumber>(terms: &[T], lane: usize, reach: f64) -> f64 {
    let size = |n: usize| libm::log(terms[n].lane(lane).leading().abs());
    let count = terms.len();
    let last = (count.saturating_sub(LATE)..count).rev().filter(|n| size(*n) > f64::NEG_INFINITY);
    let radii = last.take(2).map(|n| {
        let last = size(n) - n as f64 * libm::log(reach);
        let before = (0..n + 2 - APART.min(n)).map(|k| (size(k) - last) / (n - k) as f64);
        before.fold(f64::NEG_INFINITY, f64::max)
    });
    match libm::exp(radii.fold(f64::INFINITY, f64::min)) {
        step if step > 0.0 => step,
        // All terms before are 0, or one is not finite.
        _ => f64::INFINITY,
    }
}

/// Length of a step over which an argument stays within reach of 0.
fn within<T: SeriesNumber>(argument: &[T], reach: f64, lane: usize, step: f64) -> f64 {
    let size = |step: f64| {
        argument.iter().rev().fold(0.0, |sum, x| sum * step + x.lane(lane).leading().abs())
    };
    let halves = (0..MOST_HALVES as i32).map(|n| libm::ldexp(step, -n));
    halves.into_iter().find(|step| size(*step) <= reach).unwrap_or(0.0)
}

/// Length of a step over which an exponent that is far below 0 does not grow too much.
fn faint<T: SeriesNumber>(exponent: &[T], weight: f64, lane: usize, step: f64) -> f64 {
    let at = |n: usize| weight * exponent[n].lane(lane).leading();
    let most = RISE.max(FAINT - at(0));
    let rise = |step: f64| {
        let (mut power, mut sum) = (1.0, 0.0);
        for n in 1..exponent.len() {
            power *= step;
            sum += (at(n) * power).max(0.0);
        }
        sum
    };
    let halves = (0..MOST_HALVES).scan(step, |step, _| {
        let own = *step;
        *step *= 0.5;
        Some(own)
    });
    halves.into_iter().find(|step| rise(*step) <= most).unwrap_or(0.0).abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Terms of e^(a t) times a factor.
    fn exponential(factor: f64, a: f64) -> Vec<f64> {
        (0..20)
            .scan(factor, |term, n| {
                let own = *term;
                *term *= a / f64::from(n + 1);
                Some(own)
            })
            .collect()
    }

    fn limit(terms: &[f64], step: f64) -> f64 {
        let mut limits = [f64::INFINITY];
        Powers::new(step / REACH, terms.len() - 1).limit(terms, TINY, &mut limits);
        limits[0].min(step)
    }

    #[test]
    fn terms_that_grow_shorten_steps() {
        for factor in [1.0, 1e-40, 1e-150] {
            let found = limit(&exponential(factor, 20.0), 14.0);
            assert!(found > 0.2 && found < 0.6, "{factor:e}: {found}");
            assert_eq!(limit(&exponential(factor, 20.0), 0.1), 0.1, "{factor:e}");
        }
        let pole: Vec<f64> = (0..20).map(|n| 2f64.powi(n)).collect();
        assert!((limit(&pole, 3.0) - 0.25).abs() < 1e-12, "half the way to the pole");
        assert_eq!(limit(&pole, 0.2), 0.2);
    }

    #[test]
    fn what_vanishes_shortens_nothing() {
        assert_eq!(limit(&[0.0; 20], 1e30), 1e30);
        let mut terms = [0.0; 20];
        terms[1] = 1.0;
        assert_eq!(limit(&terms, 1e30), 1e30, "a polynomial");
        terms[19] = 1e-20;
        assert!(limit(&terms, 1e30) < 10.0);
        let rounding: Vec<f64> =
            (0..20).map(|n| if n == 0 { 1.0 } else { 1e-17 / 0.2f64.powi(n) }).collect();
        assert_eq!(limit(&rounding, 0.1), 0.1, "a constant up to rounding");
    }

    #[test]
    fn an_exponent_rises_to_where_terms_are_seen() {
        let exponent = [-2000.0, 1000.0, 0.0];
        assert_eq!(faint(&exponent, 1.0, 0, 1.0), 1.0);
        assert_eq!(faint(&exponent, 1.0, 0, 8.0), 1.0);
        assert_eq!(faint(&[1000.0, -500.0], -2.0, 0, 1.0), 1.0, "with a weight");
        assert_eq!(faint(&exponent, 1.0, 0, -8.0), 8.0, "it falls");
        assert_eq!(faint(&[-400.0, 1000.0], 1.0, 0, 1.0), 0.0625);
    }
}
