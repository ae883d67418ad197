//! Units of time in which expansions are made: powers of 2 near the last steps.
//!
//! Near a feature of length d the coefficients of order n are some d⁻ⁿ, which overflows in order 34
//! from d = 10⁻⁹ on. In units of d they are of the size of the state. A power of 2 changes no digit of
//! them; steps of usual lengths have the unit 1.

use crate::taylor::number::SeriesNumber;
use crate::taylor::stepper::Stepper;

/// Exponents of units are multiples of this one; it leaves the coefficients of order 34 finite.
const GRAIN: i32 = 32;
/// Length of a first step above which its unit is looked at; that of a motion without an end is below.
const LONG: f64 = (1u64 << 51) as f64;
/// Number of units that are tried at a state: each is shorter than the one before.
const MOST_UNITS: usize = 8;

/// Unit of time for steps near this one.
fn unit(step: f64) -> f64 {
    let exponent = if step > 0.0 { libm::ilogb(step) } else { 0 };
    let grains = (exponent + GRAIN / 2).div_euclid(GRAIN);
    if grains == 0 { 1.0 } else { libm::ldexp(1.0, GRAIN * grains) }
}

impl<T: SeriesNumber> Stepper<T> {
    /// Expands all motions at their states, in units in which the coefficients are finite.
    pub(crate) fn expand_in_units(&mut self) {
        for lane in &mut self.lanes {
            lane.unit = unit(lane.former);
        }
        self.set_units();
        self.expand_at_state();
        for _ in 0..MOST_UNITS {
            if !self.shorten_units() {
                return;
            }
            self.set_units();
            self.expand_at_state();
        }
        for lane in 0..T::LANES {
            self.lanes[lane].has_series = self.is_regular(lane);
        }
    }

    /// Lengthens the units of motions that begin, and whose steps would be longer than any usual time: the
    /// coefficients of what is slow underflow in the unit 1.
    pub(crate) fn lengthen_units(&mut self) {
        let mut longer = vec![false; T::LANES];
        for (lane, longer) in longer.iter_mut().enumerate() {
            let own = &self.lanes[lane];
            let left = (own.until - own.time).hi.abs();
            if own.former != 0.0 || own.unit != 1.0 || self.step_size(lane).min(left) <= LONG {
                continue;
            }
            let rates = self.pairs(lane).into_iter().zip(self.velocity(lane));
            let scales = rates.map(|(x, rate)| (x.hi / rate).abs());
            let slowest = scales.filter(|scale| scale.is_finite()).fold(0.0, f64::max);
            let unit = unit(slowest.min(left));
            *longer = unit > 1.0;
            self.lanes[lane].unit = unit.max(1.0);
        }
        if !longer.contains(&true) {
            return;
        }
        self.set_units();
        self.expand_at_state();
        let mut fails = false;
        for (lane, longer) in longer.into_iter().enumerate() {
            if longer && !self.is_regular(lane) {
                self.lanes[lane].unit = 1.0;
                fails = true;
            }
        }
        if fails {
            if T::LANES == 1 {
                self.series.clear();
            }
            self.set_units();
            self.expand_at_state();
        }
    }

    /// Shortens the units of motions with a velocity whose coefficients are not finite.
    fn shorten_units(&mut self) -> bool {
        let mut any = false;
        for lane in 0..T::LANES {
            let own = &self.lanes[lane];
            let is_lost = !own.has_series || self.is_regular(lane);
            if is_lost || own.until.hi == own.time.hi {
                continue;
            }
            let rates = self.velocity(lane);
            if rates.iter().all(|rate| rate.is_finite()) {
                let size = |parts: &mut dyn Iterator<Item = f64>| {
                    parts.fold(0.0, |a: f64, x| a.max(x.abs()))
                };
                let state = self.state.iter().map(|x| x.lane(lane).leading());
                let scale = size(&mut state.clone()) / size(&mut rates.into_iter());
                let shorter = self.lanes[lane].unit * libm::ldexp(1.0, -GRAIN);
                // A state of 0 has no scale of time.
                let own = if scale > 0.0 && scale.is_finite() { unit(scale) } else { shorter };
                self.lanes[lane].unit = shorter.min(own);
                any = true;
            }
        }
        if any && T::LANES == 1 {
            self.series.clear();
        }
        any
    }

    fn set_units(&mut self) {
        let units = T::from_lanes(|lane| T::One::float(self.lanes[lane].unit));
        self.series.measure_in(units);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_of_usual_lengths_have_the_unit_1() {
        for step in [0.0, 1.0, 3e-5, 3e4] {
            assert_eq!(unit(step), 1.0, "{step:e}");
        }
        for step in [1e-9, 1e-40, 1e-300, 1e9, 1e300] {
            let ratio = step / unit(step);
            assert!((1e-5..1e5).contains(&ratio), "{step:e} is {ratio:e} units");
        }
    }
}
