//! Absence of an invariant density of a class.

use super::Absent;

/// The claim that no density P^(1/α) exists with a polynomial P of at most a given degree, nor one
/// exp P if P is a polynomial in all state variables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NoDensity {
    /// Degree in the velocities, or in all state variables if velocities and positions cannot be
    /// distinguished.
    pub degree: u32,
}

impl Absent for NoDensity {
    const NAME: &'static str = "no-density";
    const DEGREES: std::ops::RangeInclusive<u32> = 0..=4;

    fn of_degree(degree: u32) -> Self {
        Self { degree }
    }

    fn text(&self) -> String {
        format!("no density by polynomials of degree ≤ {}", self.degree)
    }
}
