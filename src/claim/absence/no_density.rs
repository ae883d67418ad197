//! No invariant density of a class.

use super::Absent;

/// No density P^(1/α) with a polynomial P of at most this degree; nor, where P is a polynomial in all
/// variables of the state, exp P.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NoDensity {
    /// In the velocities where these are known apart, else in all variables of the state.
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
