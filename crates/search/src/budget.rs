//! Limit on the work of an elimination, counted while it is done.
//!
//! The time of an elimination depends on the sparsity of its rows: the bound by the cube of the
//! unknowns is hundreds to thousands of times too high for a chain of oscillators. So the steps that
//! are really taken are counted, which gives the same answer on every machine, however busy.

use super::echelon::Echelon;
use super::reduced::ReducedEchelon;
use super::{Effort, Halt, SearchError};

/// An elimination that counts what it does.
pub trait Elimination {
    /// Number of unknowns.
    fn unknowns(&self) -> usize;

    /// Number of entries looked at so far.
    fn work(&self) -> u64;

    /// Number of bytes kept.
    fn size(&self) -> u64;
}

impl Elimination for Echelon {
    fn unknowns(&self) -> usize {
        self.columns()
    }

    fn work(&self) -> u64 {
        self.steps()
    }

    fn size(&self) -> u64 {
        self.bytes()
    }
}

impl Elimination for ReducedEchelon {
    fn unknowns(&self) -> usize {
        self.columns()
    }

    fn work(&self) -> u64 {
        self.steps()
    }

    fn size(&self) -> u64 {
        self.bytes()
    }
}

/// Lower bound on the elementary steps of an elimination per second.
pub const STEPS: f64 = 1e9;

/// Bytes that an entry of an equation takes: a column, a value, and room to grow.
const ENTRY: f64 = 24.0;

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

    /// Tells how many rows an elimination has taken up.
    pub fn tell(&self, done: usize, all: usize) {
        self.halt.meter().set(done, all);
    }

    /// Whether work of so many steps that cannot be stopped may be done, and ends in time.
    pub fn allows(&self, steps: f64) -> bool {
        let left = self.halt.left().map_or(f64::INFINITY, |left| left.as_secs_f64() * STEPS);
        steps <= self.steps.min(left)
    }

    /// Fails where so many entries of equations are too many to make or to keep.
    pub fn admits(&self, unknowns: usize, entries: f64) -> Result<(), SearchError> {
        if entries > self.steps {
            return Err(self.long(unknowns));
        }
        if entries * ENTRY > self.bytes {
            return Err(self.large(unknowns));
        }
        Ok(())
    }

    fn long(&self, unknowns: usize) -> SearchError {
        SearchError::Long { unknowns, seconds: self.steps / STEPS }
    }

    fn large(&self, unknowns: usize) -> SearchError {
        SearchError::Large { unknowns, megabytes: (self.bytes / 1e6) as u64 }
    }

    /// Fails once the search is to stop, or the elimination has done or kept more than the limit.
    pub fn check(&self, elimination: &impl Elimination) -> Result<(), SearchError> {
        self.halt.check()?;
        let unknowns = elimination.unknowns();
        if elimination.work() as f64 > self.steps {
            return Err(self.long(unknowns));
        }
        if elimination.size() as f64 > self.bytes {
            return Err(self.large(unknowns));
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
            let ansatz = crate::Ansatz { megabytes, ..effort.ansatz };
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
        assert!(Budget::of(&budget(1.0, 1)).allows(1e9), "a second");
        assert!(!Budget::of(&budget(1.0, 1)).allows(1e9 + 1.0), "more than a second");
        let timed = Halt::within(std::time::Duration::from_secs(60));
        assert!(Budget::unlimited(&timed).allows(1e9), "a second of a minute");
        assert!(!Budget::unlimited(&timed).allows(1e12), "a thousand seconds");
        let limit = Budget::of(&effort);
        assert!(limit.admits(10, 1e6).is_ok(), "a million entries are made in no time");
        assert!(matches!(limit.admits(10, 1e8), Err(SearchError::Large { .. })), "2.4 GB");
        assert!(
            matches!(limit.admits(10, 1e12), Err(SearchError::Long { .. })),
            "a thousand seconds"
        );
        assert!(Budget::unlimited(&effort.halt).check(&echelon).is_ok(), "no limit");
    }
}
