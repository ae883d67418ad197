//! Stepping along motions: step sizes from the series, compensated states, dense output.
//!
//! The step is ρ e^(-κ), ρ the least of (‖x₀‖/‖x_n‖)^(1/n) over the last two orders, with maximum
//! norms (Jorba, Zou 2005, with κ in place of their 2 + 0.7/(n - 1)). The field does not depend on
//! time, so that each lane takes its own step.

use std::ops::Range;
use std::sync::Arc;

use crate::halt::Halt;
use crate::taylor::defect::Sampled;
use crate::taylor::level::Level;
use crate::taylor::number::SeriesNumber;
use crate::taylor::pace::Lane;
use crate::taylor::program::TaylorProgram;
use crate::taylor::series::{Series, increment};
use crate::taylor::watch::Presence;
use liouville::graph::{Kernel, with_widest_vectors};
use liouville::number::double_double::DoubleDouble;

/// Order of the series, and step size constant κ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Accuracy {
    /// Highest power of the step that is kept.
    pub order: usize,
    /// Constant κ of the step ρ e^(-κ); the first term left out is about e^(-κ(order + 1)) of the
    /// state.
    pub kappa: f64,
}

impl Accuracy {
    /// Accuracy for f64: e^(-κ·21) is a tenth of a unit in the last place.
    pub const FLOAT: Self = Self { order: 20, kappa: 1.85 };
    /// Accuracy of seven digits: e^(-κ·13) is about 10⁻⁸.
    pub const ROUGH: Self = Self { order: 12, kappa: 1.4 };
    /// Accuracy for double-double.
    pub const PAIR: Self = Self { order: 34, kappa: 2.15 };
}

/// Time that stands for no end.
const NEVER: f64 = 1e15;

/// Motions in lockstep, one in each lane.
pub struct Stepper<T: SeriesNumber> {
    pub(crate) series: Series<T>,
    pub(crate) kappa: f64,
    /// State, and its rounding remainder.
    pub(crate) state: Vec<T>,
    rest: Vec<T>,
    /// Largest sizes of the components, and of the divisors, so far.
    pub(crate) peaks: Vec<T>,
    pub(crate) heights: Vec<T>,
    pub(crate) lanes: Vec<Lane<T::One>>,
    pub(crate) sizes: Sizes<T>,
    pub(crate) sampled: Sampled<T>,
    /// Longest steps over which all functions are resolved.
    pub(crate) limits: Vec<f64>,
    /// Level to which the motions are kept.
    pub(crate) level: Option<Arc<Level>>,
    /// Whether the field jumps where a sign changes.
    pub(crate) jumps: bool,
    /// Values that the motions have to have, if they are known.
    pub(crate) presence: Option<Arc<Presence>>,
    pub(crate) halt: Halt,
}

/// Sizes of the present expansions.
#[derive(Clone, Copy)]
pub(crate) struct Sizes<T> {
    /// Maximum norms of the state's coefficients of orders 0 and 1, and of the last two orders.
    pub(crate) norms: [T; 4],
    /// 0 where all coefficients of the first and the last order are finite, or else NaN.
    pub(crate) soundness: T,
}

impl<T: SeriesNumber> Stepper<T> {
    /// Prepares motions of a program's field; each lane needs a start.
    pub fn new(program: &TaylorProgram, accuracy: Accuracy) -> Self {
        let series = Series::new(program, accuracy.order);
        let idle = Lane::new(DoubleDouble::default());
        let state = vec![T::ZERO; program.dimension()];
        Self {
            heights: vec![T::ZERO; series.divisors().count()],
            series,
            kappa: accuracy.kappa,
            rest: state.clone(),
            peaks: state.clone(),
            state,
            lanes: vec![idle; T::LANES],
            sizes: Sizes { norms: [T::ZERO; 4], soundness: T::ZERO },
            sampled: Sampled::new(program.dimension(), accuracy),
            limits: Vec::new(),
            level: program.level.clone(),
            jumps: program.jumps,
            presence: program.presence.clone(),
            halt: Halt::current(),
        }
    }

    /// Number of components of the state.
    pub(crate) fn dimension(&self) -> usize {
        self.state.len()
    }

    /// Starts a motion at time 0 that ends at time `until`, which may be negative.
    pub fn start(&mut self, lane: usize, state: &[DoubleDouble], until: DoubleDouble) {
        if T::LANES == 1 {
            self.series.clear();
        }
        let peaks = self.peaks.iter_mut().chain(&mut self.heights);
        peaks.for_each(|peak| set(peak, lane, T::One::ZERO));
        self.place(lane, state);
        self.lanes[lane] = Lane::new(until);
    }

    /// Starts a motion at time 0 that somebody else ends, after a number of steps.
    pub fn start_open(&mut self, lane: usize, state: &[DoubleDouble], backwards: bool) {
        let until = if backwards { -NEVER } else { NEVER };
        self.start(lane, state, DoubleDouble::from_f64(until));
        self.lanes[lane].is_open = true;
    }

    /// Moves a motion to another state, at the same time.
    pub fn place(&mut self, lane: usize, state: &[DoubleDouble]) {
        for (index, value) in state.iter().enumerate() {
            let (value, rest) = T::One::split(*value);
            set(&mut self.state[index], lane, value);
            set(&mut self.rest[index], lane, rest);
        }
        (self.lanes[lane].is_settled, self.lanes[lane].has_series) = (false, true);
    }

    /// Multiplies some components of a motion's state.
    pub fn scale(&mut self, lane: usize, components: Range<usize>, factor: T::One) {
        for row in components {
            for part in [&mut self.state[row], &mut self.rest[row]] {
                let scaled = part.lane(lane) * factor;
                set(part, lane, scaled);
            }
        }
    }

    /// Sets the time to which a motion goes at last, in parts.
    pub fn aim(&mut self, lane: usize, time: f64) {
        self.lanes[lane].aim = DoubleDouble::from_f64(time);
    }

    /// Lets a motion that runs away end soon, as one of many.
    pub fn hasten(&mut self, lane: usize) {
        self.lanes[lane].pace.is_hasty = true;
    }

    /// Changes the final time of a motion.
    pub fn extend(&mut self, lane: usize, until: DoubleDouble) {
        self.lanes[lane].until = until;
    }

    /// Expands all motions at their states and chooses their steps.
    pub fn expand(&mut self) {
        self.face_signs();
        self.expand_in_units();
        self.lengthen_units();
        self.settle_signs();
        for index in 0..T::LANES {
            let size = self.step_size(index);
            let still = self.sizes.norms[0].lane(index).leading();
            let lane = &mut self.lanes[index];
            lane.visit(still);
            (lane.is_cut, lane.edge, lane.halves) = (false, None, 0);
            let left = (lane.until - lane.time) * DoubleDouble::from_f64(lane.unit.recip());
            lane.step = if size < left.hi.abs() {
                T::One::float(size.copysign(left.hi))
            } else {
                T::One::split(left).0
            };
        }
        self.keep_functions();
        self.keep_branches();
        self.keep_quotients();
        self.keep_values();
        self.keep_signs();
        self.keep_defect();
        self.bridge_branches();
        self.lanes.iter_mut().for_each(Lane::begin);
    }

    /// Expands all motions at their states, with the signs that moduli have.
    pub(crate) fn expand_at_state(&mut self) {
        self.series.expand(&self.state);
        self.sampled.is_present = false;
        with_widest_vectors(ErrorMeasure(self));
    }

    /// Makes neighbouring motions, in groups of `together`, take the same step.
    pub fn keep_pace(&mut self, together: usize) {
        for group in self.lanes.chunks_mut(together) {
            let steps = group.iter().map(|lane| lane.step * T::One::float(lane.unit));
            let shortest =
                steps.reduce(|a, b| if a.leading().abs() <= b.leading().abs() { a } else { b });
            if let Some(step) = shortest {
                let own = |unit: f64| step * T::One::float(unit.recip());
                group.iter_mut().for_each(|lane| lane.step = own(lane.unit));
            }
        }
    }

    /// Puts all states after a fraction of their steps into `states`, without the remainders.
    pub fn within(&self, share: f64, states: &mut Vec<T>) {
        states.clear();
        with_widest_vectors(Within(self, share, states));
    }

    /// Present step of a motion.
    pub fn step(&self, lane: usize) -> T::One {
        self.lanes[lane].step * T::One::float(self.lanes[lane].unit)
    }

    /// Velocity of a motion at its present state.
    pub fn velocity(&self, lane: usize) -> Vec<f64> {
        let speed = |row: usize| self.series.component(row)[1].lane(lane).leading();
        (0..self.state.len()).map(|row| speed(row) / self.lanes[lane].unit).collect()
    }

    /// Whether a motion stands still: its velocity is exactly 0.
    pub fn rests(&self, lane: usize) -> bool {
        let speed = |row: usize| self.series.component(row)[1].lane(lane).leading();
        (0..self.state.len()).all(|row| speed(row) == 0.0)
    }

    /// Takes the steps.
    pub fn advance(&mut self) {
        with_widest_vectors(Advance(self));
        self.lanes.iter_mut().for_each(Lane::advance);
        self.turn_signs();
        self.keep_level();
    }

    /// Whether a motion has reached its end.
    pub fn is_done(&self, lane: usize) -> bool {
        let motion = &self.lanes[lane];
        let left = motion.until - motion.time;
        left.hi.abs() <= f64::EPSILON * motion.length().abs()
    }

    /// Time of a motion.
    pub fn time(&self, lane: usize) -> DoubleDouble {
        self.lanes[lane].time
    }

    /// Number of steps that a motion has taken.
    pub fn steps(&self, lane: usize) -> u64 {
        self.lanes[lane].steps
    }

    /// State of a motion.
    pub fn pairs(&self, lane: usize) -> Vec<DoubleDouble> {
        let parts = self.state.iter().zip(&self.rest);
        parts.map(|(x, rest)| x.lane(lane).pair() + rest.lane(lane).pair()).collect()
    }

    /// Present piece of a motion.
    pub fn piece(&self, lane: usize) -> MotionPiece<'_, T> {
        MotionPiece { stepper: self, lane }
    }

    /// Length of the step that the last two orders suggest, in the unit of the expansion.
    pub(crate) fn step_size(&self, lane: usize) -> f64 {
        let order = self.series.order();
        let norms = self.sizes.norms.map(|norm| norm.lane(lane).leading());
        let [still, moving, before_last, last] = norms;
        // A state that is exactly 0 has no size; its velocity has.
        let (first, size) = if still > 0.0 { (0, still) } else { (1, moving) };
        let size = libm::log(size);
        let radius = |n: usize, norm: f64| (size - libm::log(norm)) / (n - first) as f64;
        libm::exp(radius(order - 1, before_last).min(radius(order, last)) - self.kappa)
    }
}

/// Work of measuring the present expansions.
struct ErrorMeasure<'s, T: SeriesNumber>(&'s mut Stepper<T>);

impl<T: SeriesNumber> Kernel for ErrorMeasure<'_, T> {
    #[inline(always)]
    fn run(self) {
        let stepper = self.0;
        let order = stepper.series.order();
        let mut sizes = Sizes { norms: [T::ZERO; 4], soundness: T::ZERO };
        for row in 0..stepper.state.len() {
            let coefficients = stepper.series.component(row);
            stepper.peaks[row] = stepper.peaks[row].larger(coefficients[0]);
            for (norm, n) in sizes.norms.iter_mut().zip([0, 1, order - 1, order]) {
                *norm = norm.larger(coefficients[n]);
            }
            // A constant without a value is in order 1 alone.
            let ends = coefficients[1] + coefficients[order];
            sizes.soundness = sizes.soundness + ends * T::ZERO;
        }
        stepper.sizes = sizes;
    }
}

fn set<T: SeriesNumber>(target: &mut T, lane: usize, value: T::One) {
    let old = *target;
    *target = T::from_lanes(|other| if other == lane { value } else { old.lane(other) });
}

/// Work of advancing all states to the ends of their steps.
struct Advance<'s, T: SeriesNumber>(&'s mut Stepper<T>);

impl<T: SeriesNumber> Kernel for Advance<'_, T> {
    #[inline(always)]
    fn run(self) {
        let stepper = self.0;
        let steps = T::from_lanes(|lane| stepper.lanes[lane].step);
        // The ends of most steps are known from the control of the defect.
        let is_known = stepper.sampled.is_at(steps);
        for (row, (state, rest)) in stepper.state.iter_mut().zip(&mut stepper.rest).enumerate() {
            let increment = match is_known {
                true => stepper.sampled.increments[row],
                false => increment(stepper.series.component(row), steps),
            };
            T::advance(state, rest, increment);
        }
    }
}

/// Work of finding states within the steps.
struct Within<'s, T: SeriesNumber>(&'s Stepper<T>, f64, &'s mut Vec<T>);

impl<T: SeriesNumber> Kernel for Within<'_, T> {
    #[inline(always)]
    fn run(self) {
        let Self(stepper, share, states) = self;
        let steps = T::from_lanes(|lane| stepper.lanes[lane].step * T::One::float(share));
        for (row, state) in stepper.state.iter().enumerate() {
            states.push(*state + increment(stepper.series.component(row), steps));
        }
    }
}

/// A motion between two steps, as polynomials in the time since the first, in a unit of its own.
pub struct MotionPiece<'s, T: SeriesNumber> {
    stepper: &'s Stepper<T>,
    lane: usize,
}

impl<T: SeriesNumber> MotionPiece<'_, T> {
    /// Time at which the piece begins.
    pub fn begin(&self) -> DoubleDouble {
        self.stepper.lanes[self.lane].time
    }

    /// Duration in the unit of the piece; negative backwards in time.
    pub fn length(&self) -> T::One {
        self.stepper.lanes[self.lane].step
    }

    /// Unit of time of the piece.
    pub fn unit(&self) -> f64 {
        self.stepper.lanes[self.lane].unit
    }

    /// Duration of a time after the beginning that is given in the unit of the piece.
    pub fn duration(&self, after: T::One) -> DoubleDouble {
        after.pair() * DoubleDouble::from_f64(self.unit())
    }

    /// Time of the motion at a time after the beginning.
    pub fn time(&self, after: T::One) -> DoubleDouble {
        self.begin() + self.duration(after)
    }

    /// A duration in the unit of the piece.
    pub fn after(&self, duration: DoubleDouble) -> DoubleDouble {
        duration * DoubleDouble::from_f64(self.unit().recip())
    }

    /// Coefficients of a further function of the program.
    pub fn output(&self, index: usize) -> Vec<T::One> {
        self.stepper.series.output(index).iter().map(|x| x.lane(self.lane)).collect()
    }

    /// State at a time after the beginning, in the unit of the piece.
    pub fn state(&self, after: T::One) -> Vec<DoubleDouble> {
        let stepper = self.stepper;
        (0..stepper.state.len())
            .map(|row| {
                let coefficients = stepper.series.component(row);
                let mut sum = T::One::ZERO;
                for coefficient in coefficients[1..].iter().rev() {
                    sum = (sum + coefficient.lane(self.lane)) * after;
                }
                let rest = stepper.rest[row].lane(self.lane) + sum;
                stepper.state[row].lane(self.lane).pair() + rest.pair()
            })
            .collect()
    }
}
