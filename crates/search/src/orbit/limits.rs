//! Limits of the searches along orbits.

use std::cell::Cell;

use super::super::budget::STEPS;
use super::super::{Effort, SearchError};

/// Share of the time of a count that coefficients may take which depend on the parameters.
const SHARE: f64 = 0.25;

/// Elementary steps that parts of a search may still take.
pub struct StepsLeft {
    /// Those of the search for coefficients which depend on the parameters.
    coefficients: Cell<f64>,
    /// Those that have been taken of these.
    taken: Cell<f64>,
    /// Those of series along lines of states.
    series: Cell<f64>,
    /// Time of a count.
    seconds: f64,
}

impl StepsLeft {
    /// Those of an effort.
    pub fn of(effort: &Effort) -> Self {
        let all = effort.seconds * STEPS;
        Self {
            coefficients: Cell::new(SHARE * all),
            taken: Cell::new(0.0),
            series: Cell::new(all),
            seconds: effort.seconds,
        }
    }

    /// Takes some for coefficients; `false` if none are left.
    pub fn takes(&self, steps: f64) -> bool {
        self.coefficients.set(self.coefficients.get() - steps);
        self.taken.set(self.taken.get() + steps);
        self.coefficients.get() > 0.0
    }

    /// Number of those taken for coefficients; 0 where they are not limited.
    pub fn taken(&self) -> f64 {
        if self.coefficients.get().is_finite() { self.taken.get() } else { 0.0 }
    }

    /// Takes some for series that are about to be computed; fails if fewer are left.
    pub fn takes_series(&self, steps: f64) -> Result<(), SearchError> {
        if steps > self.series.get() {
            return Err(SearchError::Series { seconds: self.seconds });
        }
        self.series.set(self.series.get() - steps);
        Ok(())
    }

    /// Lifts the limits, where the time of the search is limited.
    pub fn lift(&self) {
        self.coefficients.set(f64::INFINITY);
        self.series.set(f64::INFINITY);
    }
}

/// Limits of one round of a search.
#[derive(Clone, Copy)]
pub struct RoundLimits {
    /// Largest number of monomials of a relation.
    pub monomials: usize,
    /// Largest degree of a relation.
    pub degree: u32,
    /// Largest number of steps of an elimination on a line.
    pub steps: f64,
    /// Largest number of steps for polynomial integrals class by class.
    pub graded: f64,
}

/// Limits without a limit of time.
pub const MODEST: RoundLimits = RoundLimits { monomials: 300, degree: 8, steps: 4e7, graded: 4e8 };

/// The same where functions are further variables.
pub const EXTENDED: RoundLimits =
    RoundLimits { monomials: 400, degree: 8, steps: 4e7, graded: 4e8 };

/// Limits that follow while there is time.
pub const FURTHER: [RoundLimits; 4] = [
    RoundLimits { monomials: 500, degree: 16, steps: 2e8, graded: 2e9 },
    RoundLimits { monomials: 900, degree: 24, steps: 2e9, graded: 2e10 },
    RoundLimits { monomials: 1700, degree: 24, steps: 2e10, graded: 2e11 },
    RoundLimits { monomials: 3200, degree: 24, steps: 2e11, graded: 2e12 },
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_counted_until_the_limits_are_lifted() {
        let steps = StepsLeft::of(&Effort { seconds: 1.0, ..Effort::default() });
        assert!(steps.takes(0.2 * STEPS), "a quarter may be taken");
        assert!(!steps.takes(0.2 * STEPS), "nothing is left");
        assert!((steps.taken() - 0.4 * STEPS).abs() < 1.0, "both are counted");
        assert!(steps.takes_series(2.0 * STEPS).is_err(), "series have a limit of their own");
        steps.lift();
        assert!(steps.takes(STEPS) && steps.takes_series(2.0 * STEPS).is_ok());
        assert!(steps.taken() < 1.0, "without limits nothing is counted");
    }
}
