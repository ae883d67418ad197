//! Absence of integrals besides those that are known.

use super::Absent;

/// The claim that every polynomial integral of at most a given degree is a polynomial in the energy
/// and the integrals that the file claims.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NoIntegral {
    /// Degree in the velocities, or in all state variables if velocities and positions cannot be
    /// distinguished.
    pub degree: u32,
}

impl Absent for NoIntegral {
    const NAME: &'static str = "no-integral";
    const DEGREES: std::ops::RangeInclusive<u32> = 1..=12;

    fn of_degree(degree: u32) -> Self {
        Self { degree }
    }

    fn text(&self) -> String {
        format!("no further integral of degree ≤ {}", self.degree)
    }
}
