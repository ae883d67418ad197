//! Claims of absence: that there is no integral, or no density, of a class.
//!
//! They have no residual. What cannot be is counted, and `search` counts. Each kind is one file that
//! says what is claimed.

mod no_density;
mod no_integral;

use super::Reader;

pub use no_density::NoDensity;
pub use no_integral::NoIntegral;

/// A kind of claim of absence: how it is read.
pub trait Absent: Clone {
    /// Its key in case files, and its name in reports.
    const NAME: &'static str;
    /// The degrees that can be asked for.
    const DEGREES: std::ops::RangeInclusive<u32>;

    /// Makes it from the degree that stands in the file.
    fn of_degree(degree: u32) -> Self;

    /// Returns the claim in a few words.
    fn text(&self) -> String;

    /// Reads it.
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
                let message = format!("`{text}` is no degree that can be counted");
                Err(from.complaint_inside(Self::NAME, "degree", message, &remedy))
            }
        }
    }
}

/// A statement that something does not exist.
#[derive(Clone, Debug)]
pub enum Absence {
    /// See [`NoIntegral`].
    NoIntegral(NoIntegral),
    /// See [`NoDensity`].
    NoDensity(NoDensity),
}

/// Keys of the statements that a claim of absence can make.
pub const ABSENCES: &[&str] = &[NoIntegral::NAME, NoDensity::NAME];

impl Absence {
    /// Reads the statement that stands under `key`, one of [`ABSENCES`].
    pub fn read<R: Reader>(key: &str, from: &R) -> Option<Result<Self, R::Error>> {
        match key {
            NoIntegral::NAME => Some(NoIntegral::read(from).map(Absence::NoIntegral)),
            NoDensity::NAME => Some(NoDensity::read(from).map(Absence::NoDensity)),
            _ => None,
        }
    }

    /// The kind's name in case files and reports.
    pub fn name(&self) -> &'static str {
        match self {
            Absence::NoIntegral(_) => NoIntegral::NAME,
            Absence::NoDensity(_) => NoDensity::NAME,
        }
    }

    /// Returns the claim in a few words.
    pub fn text(&self) -> String {
        match self {
            Absence::NoIntegral(claim) => claim.text(),
            Absence::NoDensity(claim) => claim.text(),
        }
    }
}
