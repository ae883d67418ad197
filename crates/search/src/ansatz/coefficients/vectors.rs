//! Vectors that are functions of the parameters, known by their images.

use super::super::super::Halt;
use super::super::system::{LinearSystem, PrimePoint};
use liouville::formula::Formula;

/// A vector whose entries are rational functions of the parameters, known by its images.
pub trait Vectors {
    /// The parameters' coordinates.
    fn names(&self) -> &[Formula];
    /// Condition for an early end.
    fn halt(&self) -> &Halt;
    /// Number of entries.
    fn width(&self) -> usize;
    /// Takes elementary steps from those that the search may take; `false` if none are left.
    fn takes(&self, _steps: f64) -> bool {
        true
    }
    /// Number of elementary steps that have been taken, where they are limited.
    fn taken(&self) -> f64 {
        0.0
    }
    /// Whether products of roots are among its numbers.
    fn multiplies_roots(&self) -> bool {
        true
    }
    /// Image for choice `index` of the parameters modulo the prime with number `prime`, 1 at its
    /// last entry; `None` where there is none.
    fn image(&self, prime: u64, index: u64) -> Option<(PrimePoint, Vec<u64>)>;
}

/// The null vector on some columns of a system.
pub struct NullVector<'s> {
    /// System of equations.
    pub system: &'s LinearSystem,
    /// Columns of the vector.
    pub columns: &'s [usize],
}

impl Vectors for NullVector<'_> {
    fn names(&self) -> &[Formula] {
        self.system.coordinates()
    }

    fn halt(&self) -> &Halt {
        self.system.halt()
    }

    fn width(&self) -> usize {
        self.columns.len()
    }

    fn image(&self, prime: u64, index: u64) -> Option<(PrimePoint, Vec<u64>)> {
        let at = self.system.at(prime, index)?;
        let vectors = self.system.null_space(&at, self.columns).ok()??;
        let one = at.modulus.one();
        let last = vectors.into_iter().next_back().filter(|own| own.last() == Some(&one))?;
        Some((at, last))
    }
}
