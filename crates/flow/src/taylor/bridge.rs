//! Steps across the branch points of powers and roots of moduli, as of max(x, 0)^(3/2) and |v|^(3/2) at 0.
//!
//! There the field is continuous, and has no series. A motion whose base A crosses 0 with a rate that is
//! not 0 goes on, and is the only one: with A in place of the time, du/dA = F(u, A, A^q) is smooth in u and
//! continuous in A. Taylor steps towards A = 0 shrink with the distance; once that is short enough, a step
//! of the classical method of Runge and Kutta leads across: if it differs from two of half the length by
//! more than rounding, it comes too early. Behind it Taylor steps grow again. Over the step the motion is
//! the cubic polynomial with its values and rates at the ends.

use crate::taylor::number::SeriesNumber;
use crate::taylor::stepper::Stepper;
use crate::taylor::watch::Edge;

/// Multiple of its rounding by which a base may be off 0.
const DOUBT: f64 = 4.0;
/// Length of a step across in times to the zero, and least ratio to the Taylor step.
const BEYOND: f64 = 2.0;
const LONGER: f64 = 1.25;
/// Part of A that its second term may reach at the zero: where A touches 0, it is a quarter or more.
const BENT: f64 = 0.125;
/// Number of lengths tried from a zero on, and the ratio of one to the next.
const MOST_LENGTHS: i32 = 48;
const SHORTER: f64 = 0.25;
/// Size of a component, as a part of that of the state, from which on its own size counts.
const SMALL: f64 = 1.0 / 128.0;

/// A step in plain numbers.
struct Bridge<One> {
    length: One,
    /// Changes of the state, and rates at the beginning and at the end.
    changes: Vec<One>,
    rates: [Vec<One>; 2],
    /// Values of the further functions at the beginning, in the middle, and at the end.
    outputs: [Vec<One>; 3],
}

impl<T: SeriesNumber> Stepper<T> {
    /// Replaces the steps of motions that come to branch points, or begin there.
    pub(crate) fn bridge_branches(&mut self) {
        if self.series.voids().next().is_none() {
            return;
        }
        for lane in 0..T::LANES {
            let at_once = self.lanes[lane].edge.filter(|(_, after)| after.leading() == 0.0);
            let is_lost = matches!(at_once, Some((Edge::Watched(_), _)));
            if self.lanes[lane].lost.is_some() || is_lost {
                continue;
            }
            let count = self.series.voids().count();
            let wanted = (0..count).find_map(|index| self.length_across(index, lane));
            match wanted {
                None => {}
                Some(Across::Over(length)) => {
                    if let Some(bridge) = self.across(lane, length) {
                        self.take(lane, &bridge);
                    }
                }
                Some(Across::From(longest)) => match self.longest_across(lane, longest) {
                    Some(bridge) => self.take(lane, &bridge),
                    None => self.lanes[lane].lost = Some(Edge::Divisor),
                },
            }
        }
    }

    /// Length of a step that leads across the zero of a base, if one is due.
    fn length_across(&self, index: usize, lane: usize) -> Option<Across> {
        let (void, place, base) = self.series.voids().nth(index)?;
        let motion = &self.lanes[lane];
        let terms: Vec<T::One> = base.iter().map(|x| x.lane(lane)).collect();
        let (first, rate) = (terms[0].leading(), terms[1].leading());
        let left = (motion.until - motion.time).hi;
        let direction = left.signum();
        let is_void = void.lane(lane).leading() > 0.0;
        if is_void && terms.iter().all(|term| term.leading() == 0.0) {
            return None;
        }
        let rises = rate * direction > 0.0 || rate == 0.0;
        let error = || DOUBT * self.series.value_error(place, lane, &self.peaks);
        if is_void || rises {
            let longest = left.abs().min(self.natural_time(lane));
            // What stays 0 up to rounding has no zero to leave. Beside it the series of a root ends at once.
            let reach = T::EPSILON.powf(0.25) * longest / motion.unit;
            let known = if is_void { terms.len() } else { 2 };
            let size = |k: usize| terms[k].leading().abs() * libm::pow(reach, k as f64);
            let grows = || (1..known).map(size).fold(0.0, f64::max) > error();
            let since = (first / rate).abs() * motion.unit;
            let is_near = since <= T::EPSILON.powf(0.75) * self.natural_time(lane);
            let begins = is_void || is_near || first <= error();
            return (begins && grows()).then_some(Across::From(longest));
        }
        let time = (first / rate).abs();
        let bend = terms.get(2).map_or(0.0, |x| x.leading().abs()) * time * time;
        let length = BEYOND * time * motion.unit;
        let is_due = bend <= BENT * first
            && length < left.abs()
            && length > LONGER * motion.length().abs()
            && length < T::EPSILON.powf(0.25) * self.natural_time(lane);
        is_due.then_some(Across::Over(length))
    }

    /// Time in which a motion changes by its own size.
    pub(super) fn natural_time(&self, lane: usize) -> f64 {
        let [still, moving, ..] = self.sizes.norms.map(|norm| norm.lane(lane).leading());
        let time = if still > 0.0 { still / moving } else { moving.recip() };
        if time.is_finite() { time * self.lanes[lane].unit } else { f64::INFINITY }
    }

    /// The longest step of several that agrees with two halves.
    fn longest_across(&mut self, lane: usize, longest: f64) -> Option<Bridge<T::One>> {
        let longest = if longest.is_finite() { longest } else { 1.0 };
        (1..=MOST_LENGTHS)
            .find_map(|n| self.across(lane, longest * libm::pow(SHORTER, f64::from(n))))
    }

    /// A step of this length, if it agrees with two halves to rounding.
    fn across(&mut self, lane: usize, length: f64) -> Option<Bridge<T::One>> {
        let motion = &self.lanes[lane];
        let length = T::One::float(length.copysign((motion.until - motion.time).hi));
        let half = length * T::One::float(0.5);
        let start: Vec<T::One> = self.state.iter().map(|x| x.lane(lane)).collect();
        let from = |changes: &[T::One]| -> Vec<T::One> {
            start.iter().zip(changes).map(|(x, d)| *x + *d).collect()
        };
        let first = self.rates_at(lane, &start)?;
        let outputs = self.outputs_at(lane);
        let whole = self.runge_kutta(lane, &start, &first, length)?;
        let one = self.runge_kutta(lane, &start, &first, half)?;
        let middle = from(&one);
        let rates = self.rates_at(lane, &middle)?;
        let halfway = self.outputs_at(lane);
        let other = self.runge_kutta(lane, &middle, &rates, half)?;
        let changes: Vec<T::One> = one.iter().zip(&other).map(|(x, y)| *x + *y).collect();
        let last = self.rates_at(lane, &from(&changes))?;
        let outputs = [outputs, halfway, self.outputs_at(lane)];
        let peaks: Vec<f64> = self.peaks.iter().map(|x| x.lane(lane).leading()).collect();
        let largest = peaks.iter().copied().fold(0.0, f64::max);
        let agrees = whole.iter().zip(&changes).zip(&peaks).all(|((x, y), peak)| {
            (*x - *y).leading().abs() <= T::EPSILON * peak.max(SMALL * largest)
        });
        agrees.then_some(Bridge { length, changes, rates: [first, last], outputs })
    }

    /// Changes of the state over a step of the classical method of fourth order.
    fn runge_kutta(
        &mut self,
        lane: usize,
        start: &[T::One],
        first: &[T::One],
        length: T::One,
    ) -> Option<Vec<T::One>> {
        let moved = |rates: &[T::One], by: T::One| -> Vec<T::One> {
            start.iter().zip(rates).map(|(x, rate)| *x + *rate * by).collect()
        };
        let half = length * T::One::float(0.5);
        let second = self.rates_at(lane, &moved(first, half))?;
        let third = self.rates_at(lane, &moved(&second, half))?;
        let fourth = self.rates_at(lane, &moved(&third, length))?;
        let sixth = length * T::One::float(6.0).recip();
        let change = |k: usize| {
            let middle = second[k] + third[k];
            (first[k] + middle + middle + fourth[k]) * sixth
        };
        Some((0..start.len()).map(change).collect())
    }

    /// Rates of a motion at another state, with the signs that moduli have there; `None` where the field
    /// has no value.
    fn rates_at(&mut self, lane: usize, state: &[T::One]) -> Option<Vec<T::One>> {
        let all: Vec<T> = self
            .state
            .iter()
            .zip(state)
            .map(|(x, own)| T::from_lanes(|other| if other == lane { *own } else { x.lane(other) }))
            .collect();
        // An argument may have other signs in it, which come before its own.
        for _ in 0..=self.series.signs() {
            self.series.probe(&all);
            let wrong = (0..self.series.signs()).find(|sign| {
                let value = self.series.probed_argument(*sign).lane(lane).leading();
                match self.series.is_positive(*sign, lane) {
                    true => value < 0.0,
                    false => value > 0.0,
                }
            });
            let Some(sign) = wrong else { break };
            self.series.turn(sign, lane);
        }
        let rates: Vec<T::One> =
            (0..state.len()).map(|index| self.series.probed_rate(index).lane(lane)).collect();
        rates.iter().all(|rate| rate.leading().is_finite()).then_some(rates)
    }

    /// Further functions at the state that was probed last.
    fn outputs_at(&self, lane: usize) -> Vec<T::One> {
        let output = |index: usize| self.series.probed_output(index).lane(lane);
        (0..self.series.outputs()).map(output).collect()
    }

    /// Makes a step the present one.
    fn take(&mut self, lane: usize, bridge: &Bridge<T::One>) {
        let unit = T::One::float(self.lanes[lane].unit);
        let step = bridge.length * T::One::float(self.lanes[lane].unit.recip());
        let by = step.recip();
        let [two, three] = [2.0, 3.0].map(T::One::float);
        for (index, change) in bridge.changes.iter().enumerate() {
            let [first, last] = [0, 1].map(|end| bridge.rates[end][index] * unit);
            let mean = *change * by;
            let second = (three * mean - two * first - last) * by;
            let third = (first + last - two * mean) * by * by;
            self.series.put_component(index, lane, [first, second, third]);
        }
        for index in 0..self.series.outputs() {
            let [first, middle, last] = [0, 1, 2].map(|place| bridge.outputs[place][index]);
            let rate = (two * two * middle - three * first - last) * by;
            let second = two * (first - two * middle + last) * by * by;
            self.series.put_output(index, lane, [first, rate, second]);
        }
        self.sampled.is_present = false;
        // The series that the step takes the place of may have no numbers.
        let soundness = self.sizes.soundness;
        self.sizes.soundness = T::from_lanes(|other| match other == lane {
            true => T::One::ZERO,
            false => soundness.lane(other),
        });
        let motion = &mut self.lanes[lane];
        (motion.step, motion.edge, motion.halves, motion.is_cut) = (step, None, 0, true);
        (motion.is_stuck, motion.is_faint) = (false, false);
        // Behind the zero the signs are those of the arguments there.
        (motion.is_settled, motion.came_to) = (false, None);
    }
}

/// A step at a branch point.
enum Across {
    /// Over a zero, of this length.
    Over(f64),
    /// From a zero on, of at most this length.
    From(f64),
}
