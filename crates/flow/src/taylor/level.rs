//! Motions kept on a declared level: where it is unstable across, rounding alone would leave it
//! exponentially, as the sphere of q' = p, p' = −Aq + ((q, Aq) − (p, p))q.
//!
//! A state that is off the level by more than some roundings is put back by Newton steps of least
//! norm. Fields that keep the level by their form are left alone.

use crate::taylor::number::SeriesNumber;
use crate::taylor::stepper::Stepper;
use liouville::graph::{Evaluator, Tape};
use liouville::number::double_double::{DoubleDouble, DoubleDoubles};
use nalgebra::{DMatrix, DVector};

/// Roundings of the state by which a function of the level may be off.
const ROUNDINGS: f64 = 256.0;
/// Part of the distance from the level that a Newton step may leave.
const NEARER: f64 = 0.25;
/// Number of Newton steps, which converge quadratically.
const MOST_STEPS: usize = 3;

/// Functions that are 0 on a level, and their gradients.
#[derive(Debug)]
pub(crate) struct Level {
    tape: Tape,
    equations: usize,
    dimension: usize,
}

impl Level {
    /// A level by a tape of its functions and then their gradients, in a state of this dimension.
    pub(crate) fn new(tape: Tape, equations: usize, dimension: usize) -> Self {
        Self { tape, equations, dimension }
    }

    /// Values of the functions at a state, and their gradients.
    fn values(&self, state: &[DoubleDouble]) -> Vec<f64> {
        let mut evaluator = Evaluator::new(&self.tape, DoubleDoubles);
        evaluator.run(&state[..self.tape.inputs()]);
        evaluator.outputs().map(|value| value.hi).collect()
    }

    /// Largest value, relative to what a relative change of the state by 1 makes of it.
    fn gap(&self, values: &[f64], state: &[DoubleDouble]) -> f64 {
        let (values, slopes) = values.split_at(self.equations);
        let gaps = values.iter().zip(slopes.chunks(self.dimension)).map(|(value, gradient)| {
            let parts = gradient.iter().zip(state);
            let size: f64 = parts.map(|(slope, x)| (slope * x.hi).abs()).sum();
            value.abs() / size.max(f64::MIN_POSITIVE)
        });
        gaps.fold(0.0, f64::max)
    }

    /// Shortest Newton step to the level.
    fn step(&self, values: &[f64]) -> Option<DVector<f64>> {
        let (values, slopes) = values.split_at(self.equations);
        let jacobian = DMatrix::from_row_slice(self.equations, self.dimension, slopes);
        let square = &jacobian * jacobian.transpose();
        let weights = square.lu().solve(&DVector::from_column_slice(values))?;
        let step = jacobian.transpose() * weights;
        step.iter().all(|x| x.is_finite()).then_some(step)
    }

    /// Moves a state to the level if it is off by more than some roundings.
    fn correct(&self, state: &mut [DoubleDouble], rounding: f64) -> bool {
        let mut values = self.values(state);
        let mut gap = self.gap(&values, state);
        if gap.is_nan() || gap <= ROUNDINGS * rounding {
            return false;
        }
        let mut moved = false;
        for _ in 0..MOST_STEPS {
            let Some(step) = self.step(&values) else { break };
            let mut next = state.to_vec();
            for (x, dx) in next.iter_mut().zip(step.iter()) {
                *x = *x - DoubleDouble::from_f64(*dx);
            }
            values = self.values(&next);
            let rest = self.gap(&values, &next);
            // Newton's method is trusted where it brings the state nearer at once.
            if rest.is_nan() || rest > NEARER * gap {
                break;
            }
            state.copy_from_slice(&next);
            (gap, moved) = (rest, true);
            if gap <= rounding {
                break;
            }
        }
        moved
    }
}

impl<T: SeriesNumber> Stepper<T> {
    /// Puts motions back on the level of their system.
    pub(crate) fn keep_level(&mut self) {
        let Some(level) = self.level.clone() else { return };
        for lane in 0..T::LANES {
            if self.lanes[lane].step.leading() == 0.0 {
                continue;
            }
            let mut state = self.pairs(lane);
            if level.correct(&mut state, T::EPSILON) {
                self.place(lane, &state);
            }
        }
    }
}
