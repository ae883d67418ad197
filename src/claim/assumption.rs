//! Hypotheses on which a proof rests although they are not proved.

use serde::Serialize;

use super::condition::Need;

/// A hypothesis on which a proof rests, neither proved nor seen to fail.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Assumption {
    /// A map takes no two states to one image.
    OneToOne,
    /// A symmetry can be inverted, or new variables are independent, on every part of the states.
    Invertible,
    /// The surface of the body is smooth.
    SmoothSurface,
    /// The volume form to which the criterion for a density refers vanishes for no γ.
    NonzeroVolume,
}

impl Assumption {
    /// Returns the hypothesis that a need is met, for a claim that is not withheld where this is not known.
    pub(crate) fn that(need: &Need) -> Option<Self> {
        match need {
            Need::OneToOne { .. } => Some(Self::OneToOne),
            Need::Rank { .. } => Some(Self::Invertible),
            _ => None,
        }
    }

    /// Returns the hypothesis in words, to follow "assumes that".
    pub fn words(self) -> &'static str {
        match self {
            Self::OneToOne => "Φ is one-to-one",
            Self::Invertible => {
                "the map, or the change of variables, can be inverted on every part of the states"
            }
            Self::SmoothSurface => "the surface is smooth for all γ",
            Self::NonzeroVolume => "the volume form of the criterion is nowhere 0",
        }
    }
}
