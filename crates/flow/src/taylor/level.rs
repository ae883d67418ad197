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

/// Number of steps from one look at the level to the next.
pub(crate) const STRIDE: u64 = 8;
/// Roundings of the state by which it may be off the level.
const ROUNDINGS: f64 = 1024.0;
/// Distance from the level, relative to the state, from which on a Newton step is not trusted.
const FAR: f64 = 1e-3;
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

    /// Shortest Newton step to the level.
    fn step(&self, state: &[DoubleDouble]) -> Option<Vec<f64>> {
        let mut evaluator = Evaluator::new(&self.tape, DoubleDoubles);
        evaluator.run(&state[..self.tape.inputs()]);
        let outputs: Vec<f64> = evaluator.outputs().map(|value| value.hi).collect();
        let (values, slopes) = outputs.split_at(self.equations);
        let jacobian = DMatrix::from_row_slice(self.equations, self.dimension, slopes);
        let square = &jacobian * jacobian.transpose();
        let weights = square.lu().solve(&DVector::from_column_slice(values))?;
        let step = jacobian.transpose() * weights;
        step.iter().all(|x| x.is_finite()).then(|| step.iter().copied().collect())
    }

    /// Moves a state to the level if it is off by more than `rounding` relative to its size.
    fn correct(&self, state: &mut [DoubleDouble], rounding: f64) -> bool {
        let norm = |parts: &mut dyn Iterator<Item = f64>| parts.map(|x| x * x).sum::<f64>().sqrt();
        let mut moved = false;
        for _ in 0..MOST_STEPS {
            let Some(step) = self.step(state) else { break };
            let own = &mut state[..self.dimension];
            let (size, still) =
                (norm(&mut step.iter().copied()), norm(&mut own.iter().map(|x| x.hi)));
            let least = if moved { rounding } else { ROUNDINGS * rounding };
            if size <= least * still || size > FAR * still {
                break;
            }
            for (x, dx) in own.iter_mut().zip(step) {
                *x = *x - DoubleDouble::from_f64(dx);
            }
            moved = true;
        }
        moved
    }
}

impl<T: SeriesNumber> Stepper<T> {
    /// Puts motions back on the level of their system.
    pub(crate) fn keep_level(&mut self) {
        let Some(level) = self.level.clone() else { return };
        for lane in 0..T::LANES {
            if !self.lanes[lane].steps.is_multiple_of(STRIDE)
                || self.lanes[lane].step.leading() == 0.0
            {
                continue;
            }
            let mut state = self.pairs(lane);
            if level.correct(&mut state, T::EPSILON) {
                self.place(lane, &state);
            }
        }
    }
}
