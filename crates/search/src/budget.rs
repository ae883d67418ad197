//! Limit on the work of an elimination, counted while it is done.
//!
//! How long an elimination takes depends on how sparse its rows stay: the bound by the cube of the
//! unknowns is hundreds to thousands of times too high for a chain of oscillators. So the steps that
//! are really taken are counted, which gives the same answer on every machine, however busy.

use super::echelon::Echelon;
use super::{Effort, Halt, SearchError};

/// Lower bound on the elementary steps of an elimination per second.
pub const STEPS: f64 = 1e9;

/// A limit on the steps and the memory of eliminations.
pub struct Budget<'e> {
    halt: &'e Halt,
    steps: f64,
    bytes: f64,
}

impl<'e> Budget<'e> {
    /// Makes the limit of an effort.
    pub fn of(effort: &'e Effort) -> Self {
        let bytes = effort.ansatz.megabytes as f64 * 1e6;
        Self { halt: &effort.halt, steps: effort.seconds * STEPS, bytes }
    }

    /// Makes no limit, but that the search may be stopped.
    pub fn unlimited(halt: &'e Halt) -> Self {
        Self { halt, steps: f64::INFINITY, bytes: f64::INFINITY }
    }

    /// Fails once the search is to stop, or the elimination has done or kept more than the limit.
    pub fn check(&self, echelon: &Echelon) -> Result<(), SearchError> {
        self.halt.check()?;
        let unknowns = echelon.columns();
        if echelon.steps() as f64 > self.steps {
            return Err(SearchError::Long { unknowns, seconds: self.steps / STEPS });
        }
        if echelon.bytes() as f64 > self.bytes {
            return Err(SearchError::Large { unknowns, megabytes: (self.bytes / 1e6) as u64 });
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use liouville::number::prime::Modulus;

    use super::*;

    #[test]
    fn work_and_memory_are_limited() {
        let m = Modulus::new(2_305_843_009_213_693_951);
        let mut echelon = Echelon::new(100, m);
        let effort = Effort::default();
        let budget = |seconds: f64, megabytes: u64| {
            let ansatz = crate::Ansatz { megabytes, ..effort.ansatz.clone() };
            Effort { seconds, ansatz, ..effort.clone() }
        };
        for row in 0..100u64 {
            echelon.push((0..100).map(|k| m.integer((row + 2) * k * k + row * row + 1)).collect());
        }
        assert!(echelon.steps() > 10_000 && echelon.bytes() > 0, "{} steps", echelon.steps());
        assert!(Budget::of(&budget(1.0, 1)).check(&echelon).is_ok(), "a small matrix");
        let found = Budget::of(&budget(1e-6, 1)).check(&echelon);
        assert!(matches!(found, Err(SearchError::Long { unknowns: 100, .. })), "{found:?}");
        let found = Budget::of(&budget(1.0, 0)).check(&echelon);
        assert!(matches!(found, Err(SearchError::Large { unknowns: 100, .. })), "{found:?}");
        assert!(Budget::unlimited(&effort.halt).check(&echelon).is_ok(), "no limit");
    }
}
