//! No integral but those that are known.

use super::Absent;

/// Every integral that is a polynomial of at most this degree is a polynomial in those that the file
/// claims, and the energy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NoIntegral {
    /// In the velocities where these are known apart, else in all variables of the state.
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
