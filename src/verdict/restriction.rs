//! Restrictions of what a claim that holds says about motions.

use serde::Serialize;

use crate::claim::Need;

/// A restriction of what a claim that holds says about motions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Flaw {
    /// A function of the claim jumps at states that motions can cross.
    Jumps,
    /// A density is infinite at some states.
    Infinite,
    /// Functions are shown to be independent on a part of the states only.
    OnAPart,
    /// A symmetry cannot be inverted, or new variables obey a relation, on a part of the states at least.
    NotInvertible,
    /// The claim is true, and says nothing: its functions are constant, or follow from the field.
    SaysNothing,
    /// The set of the claim contains no state of the declared ranges.
    NoState,
}

/// Returns the restriction of a claim that does not meet a need.
pub(super) fn flaw(need: &Need) -> Option<Flaw> {
    Some(match need {
        Need::Continuous { .. } => Flaw::Jumps,
        Need::Finite { .. } => Flaw::Infinite,
        Need::Rank { .. } => Flaw::NotInvertible,
        Need::Nonzero { .. } => Flaw::SaysNothing,
        Need::Zeros { .. } => Flaw::NoState,
        Need::NotZero { .. }
        | Need::Positive { .. }
        | Need::OneToOne { .. }
        | Need::ValueOnZeros { .. } => return None,
    })
}
