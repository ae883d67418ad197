//! Plain values of functions by the rules of Taylor programs, which keep small values of max, min, tanh,
//! sinh and the like.

use crate::taylor::number::SeriesNumber;
use crate::taylor::program::{Rule, TaylorProgram};
use crate::taylor::series::Series;

/// Order of the series that are bound and not used.
const LEAST_ORDER: usize = 2;

impl TaylorProgram {
    /// Whether a function in it has a rule that its formula alone does not give.
    pub(crate) fn has_own_rules(&self) -> bool {
        let is_own =
            |rule: &Rule| matches!(rule, Rule::Sign(_) | Rule::Saturating { .. } | Rule::Near(..));
        self.instructions.iter().any(|own| is_own(&own.rule))
    }
}

/// Rates and further functions of a program at states, one at a time.
pub(crate) struct PlainValues<T: SeriesNumber>(Series<T>);

impl<T: SeriesNumber> PlainValues<T> {
    pub(crate) fn new(program: &TaylorProgram) -> Self {
        Self(Series::new(program, LEAST_ORDER))
    }

    /// Computes all values at a state, with the signs that moduli have there.
    pub(crate) fn run(&mut self, state: &[T]) {
        // An argument may have other signs in it, which come before its own.
        for _ in 0..=self.0.signs() {
            self.0.probe(state);
            let wrong = (0..self.0.signs()).find(|sign| {
                let value = self.0.probed_argument(*sign).leading();
                let is_positive = self.0.is_positive(*sign, 0);
                if is_positive { value < 0.0 } else { value > 0.0 }
            });
            let Some(sign) = wrong else { return };
            self.0.turn(sign, 0);
        }
    }

    pub(crate) fn rates(&self) -> impl Iterator<Item = T> {
        (0..self.0.components()).map(|index| self.0.probed_rate(index))
    }

    pub(crate) fn outputs(&self) -> impl Iterator<Item = T> {
        (0..self.0.outputs()).map(|index| self.0.probed_output(index))
    }
}
