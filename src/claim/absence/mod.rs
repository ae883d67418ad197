//! Claims of absence: no integral, density or invariant relation of a class exists.
//!
//! These claims have no residual; the counts of `search` decide them. Each kind is one file.

mod no_density;
mod no_integral;
mod no_invariant_relation;

use super::Reader;

pub use no_density::NoDensity;
pub use no_integral::NoIntegral;
pub use no_invariant_relation::NoInvariantRelation;

/// A kind of claim of absence.
pub trait Absent: Clone {
    /// Key in case files, and name in reports.
    const NAME: &'static str;
    /// Allowed degrees.
    const DEGREES: std::ops::RangeInclusive<u32>;

    /// Makes the claim for a degree.
    fn of_degree(degree: u32) -> Self;

    /// Returns the claim in a few words.
    fn text(&self) -> String;

    /// Reads the claim.
    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        let (least, most) = (Self::DEGREES.start(), Self::DEGREES.end());
        let remedy =
            format!("write {} = {{ degree = N }} with N from {least} to {most}", Self::NAME);
        let Some(text) = from.text_inside(Self::NAME, "degree", &remedy)? else {
            return Err(from.missing(Self::NAME));
        };
        match text.parse() {
            Ok(degree) if Self::DEGREES.contains(&degree) => Ok(Self::of_degree(degree)),
            _ => {
                let message = format!("`{text}` is not a degree");
                Err(from.complaint_inside(Self::NAME, "degree", message, &remedy))
            }
        }
    }
}

/// A statement of absence.
#[derive(Clone, Debug)]
pub enum Absence {
    /// Absence of further integrals.
    NoIntegral(NoIntegral),
    /// Absence of a density.
    NoDensity(NoDensity),
    /// Absence of further invariant relations.
    NoInvariantRelation(NoInvariantRelation),
}

/// Keys of the statements that a claim of absence can make.
pub const ABSENCES: &[&str] = &[NoIntegral::NAME, NoDensity::NAME, NoInvariantRelation::NAME];

impl Absence {
    /// Reads the statement of `key`, one of [`ABSENCES`].
    pub fn read<R: Reader>(key: &str, from: &R) -> Option<Result<Self, R::Error>> {
        match key {
            NoIntegral::NAME => Some(NoIntegral::read(from).map(Absence::NoIntegral)),
            NoDensity::NAME => Some(NoDensity::read(from).map(Absence::NoDensity)),
            NoInvariantRelation::NAME => {
                Some(NoInvariantRelation::read(from).map(Absence::NoInvariantRelation))
            }
            _ => None,
        }
    }

    /// Returns the name of the kind in case files and reports.
    pub fn name(&self) -> &'static str {
        match self {
            Absence::NoIntegral(_) => NoIntegral::NAME,
            Absence::NoDensity(_) => NoDensity::NAME,
            Absence::NoInvariantRelation(_) => NoInvariantRelation::NAME,
        }
    }

    /// Returns the claim in a few words.
    pub fn text(&self) -> String {
        match self {
            Absence::NoIntegral(claim) => claim.text(),
            Absence::NoDensity(claim) => claim.text(),
            Absence::NoInvariantRelation(claim) => claim.text(),
        }
    }
}
