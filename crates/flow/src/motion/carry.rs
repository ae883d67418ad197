//! Motions followed for the time of a closed orbit.

use crate::error::FlowError;
use crate::taylor::number::SeriesNumber;
use crate::taylor::program::TaylorProgram;
use crate::taylor::stepper::{Accuracy, Stepper};
use liouville::number::double_double::DoubleDouble;

/// Number of steps after which a motion is too long for a closed orbit.
pub const MOST_STEPS: u64 = 1_000_000;

/// Follows a motion for a time.
pub fn carried<T: SeriesNumber<One = T>>(
    program: &TaylorProgram,
    begin: &[DoubleDouble],
    time: DoubleDouble,
    accuracy: Accuracy,
) -> Result<Vec<DoubleDouble>, FlowError> {
    let mut stepper = Stepper::<T>::new(program, accuracy);
    stepper.start(0, begin, time);
    while !stepper.is_done(0) {
        if stepper.steps(0) > MOST_STEPS {
            return Err(FlowError::NoClosedOrbit(time.hi));
        }
        stepper.expand();
        stepper.check(0)?;
        stepper.advance();
    }
    Ok(stepper.pairs(0))
}
