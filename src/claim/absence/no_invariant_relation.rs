//! Absence of invariant relations besides those that are known.

use super::Absent;

/// The claim that every Darboux polynomial of at most a given degree is a product of factors of
/// those that the file claims as invariant relations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NoInvariantRelation {
    /// Degree in all state variables.
    pub degree: u32,
}

impl Absent for NoInvariantRelation {
    const NAME: &'static str = "no-invariant-relation";
    const DEGREES: std::ops::RangeInclusive<u32> = 1..=12;

    fn of_degree(degree: u32) -> Self {
        Self { degree }
    }

    fn text(&self) -> String {
        format!("no further invariant relation of degree ≤ {}", self.degree)
    }
}
