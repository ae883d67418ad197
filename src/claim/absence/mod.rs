//! Claims of absence: no integral, density or invariant relation of a class exists.
//!
//! These claims have no residual; the counts of `search` decide them. Each kind is one file.

mod no_density;
mod no_integral;
mod no_invariant_relation;

use super::kinds::statements;
use super::{Reader, ValueShape};

pub use no_density::NoDensity;
pub use no_integral::NoIntegral;
pub use no_invariant_relation::NoInvariantRelation;

/// A kind of claim of absence.
pub trait Absent: Clone {
    /// Key in case files, and name in reports.
    const NAME: &'static str;
    /// Keys that may accompany the statement.
    const COMPANIONS: &'static [&'static str] = &[];
    /// Those of its keys whose values are more than a text.
    const SHAPES: &'static [(&'static str, ValueShape)] = &[(Self::NAME, ValueShape::Table)];
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

statements! {
    /// A statement of absence.
    Absence,
    /// Keys of the statements that a claim of absence can make.
    ABSENCES,
    NoIntegral,
    NoDensity,
    NoInvariantRelation,
}

impl Absence {
    /// Returns the claim in a few words.
    pub fn text(&self) -> String {
        match self {
            Absence::NoIntegral(claim) => claim.text(),
            Absence::NoDensity(claim) => claim.text(),
            Absence::NoInvariantRelation(claim) => claim.text(),
        }
    }
}
