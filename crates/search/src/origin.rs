//! Sources of the statements of a search: by these, and not by their words, they are replaced and withdrawn.

use std::fmt;
use std::ops::Deref;

use serde::Serialize;

/// Source of a theorem of absence.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TheoremOrigin {
    /// A count of integrals in positions and velocities; `free` if it is one of the free motion.
    IntegralCount {
        /// Whether it holds for every potential.
        free: bool,
    },
    /// A count of densities in positions and velocities; `free` likewise.
    DensityCount {
        /// Whether it holds for every potential.
        free: bool,
    },
    /// Relations between monomials along an orbit.
    Orbit,
    /// Darboux polynomials, up to a degree.
    Darboux,
    /// A global ansatz for integrals.
    Ansatz,
    /// Potentials and forces, or gyroscopic terms, that integrals survive.
    Forces,
    /// Brackets.
    Brackets,
}

impl TheoremOrigin {
    /// Whether it is a count in positions and velocities.
    pub fn is_count(self) -> bool {
        matches!(self, Self::IntegralCount { .. } | Self::DensityCount { .. })
    }

    /// Whether it is a search along orbits, up to a degree that grows with the time.
    pub fn is_graded(self) -> bool {
        matches!(self, Self::Orbit | Self::Darboux)
    }

    /// Whether the theorem holds for every potential.
    pub fn is_for_every_potential(self) -> bool {
        matches!(self, Self::IntegralCount { free: true } | Self::DensityCount { free: true })
    }
}

/// Source of a condition on the parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ConditionOrigin {
    /// A claim, or the criterion for a density of the configuration.
    Claim,
    /// Counts of integrals in positions and velocities.
    Counts,
    /// Equations for the coefficients of polynomial integrals.
    Polynomials,
}

/// Source of a remark that others depend on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RemarkOrigin {
    /// More integrals are counted than are known.
    MoreCounted,
    /// A part that is not tried, with the reason.
    NotTried,
    /// Something is found, and not proved.
    Unproved,
    /// A density of a map has coefficients that are not written.
    UnwrittenDensity,
    /// A find has coefficients that are not written.
    Unwritten,
    /// Relations have no small rational coefficients.
    Irrational,
    /// Integrals are not written for the values of lists.
    Lists,
    /// Relations are counted for the first values of lists.
    FirstValues,
    /// Anything else.
    Other,
}

/// A remark in words, with its source.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(transparent)]
pub struct Remark {
    /// The words.
    pub text: String,
    /// The source.
    #[serde(skip)]
    pub origin: RemarkOrigin,
}

impl From<String> for Remark {
    fn from(text: String) -> Self {
        Self { text, origin: RemarkOrigin::Other }
    }
}

impl Deref for Remark {
    type Target = str;
    fn deref(&self) -> &str {
        &self.text
    }
}

impl fmt::Display for Remark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}
