//! Closed orbits, with the change of volume along them.

use super::{Beginning, Motional, Neighbourhood, Stability, Stated, integrals, period, word};
use crate::claim::{Reader, ValueShape};
use crate::formula::Formula;

/// Change of volume along a closed orbit: the sign of the integral of the divergence.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Change {
    /// Contraction.
    Negative,
    /// Expansion.
    Positive,
    /// Either of the two.
    Nonzero,
}

/// The claim that a motion is periodic, with this period.
#[derive(Clone, Debug)]
pub struct ClosedOrbit {
    /// Period.
    pub period: Stated,
    /// Whether it is to be the least one.
    pub is_least: bool,
    /// State near the orbit.
    pub beginning: Beginning,
    /// Change of volume along the orbit.
    pub divergence: Option<Change>,
    /// Stability on the level of the functions that are kept.
    pub stability: Option<Stability>,
    /// Whether the orbit is to exclude densities.
    pub excludes_density: bool,
    /// Integrals that hold the orbit besides the level functions and the energy.
    pub integrals: Vec<Formula>,
    /// Parameters that vary about their values: the claim is about all of these.
    pub parameters: Vec<Neighbourhood>,
}

impl Motional for ClosedOrbit {
    const NAME: &'static str = "closed-orbit";
    const COMPANIONS: &'static [&'static str] = &[
        "start",
        "state",
        "period",
        "divergence",
        "stability",
        "density",
        "integrals",
        "parameters",
    ];
    const SHAPES: &'static [(&'static str, ValueShape)] = &[
        ("start", ValueShape::List),
        ("state", ValueShape::ListOrTable),
        ("integrals", ValueShape::List),
        ("parameters", ValueShape::Table),
    ];

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        let changes = [
            ("negative", Change::Negative),
            ("positive", Change::Positive),
            ("nonzero", Change::Nonzero),
        ];
        Ok(Self {
            period: period(from, Self::NAME, "write its period, above 0")?,
            is_least: word(from, "period", &[("least", ())])?.is_some(),
            beginning: Beginning::read(from)?,
            divergence: word(from, "divergence", &changes)?,
            stability: word(from, "stability", &Stability::ALL)?,
            excludes_density: word(from, "density", &[("none", ())])?.is_some(),
            integrals: integrals(from)?,
            parameters: Neighbourhood::read(from, "parameters")?,
        })
    }

    fn beginning(&self) -> &Beginning {
        &self.beginning
    }

    fn text(&self) -> String {
        let volume = match self.divergence {
            None => "",
            Some(Change::Negative) => ", volume shrinks",
            Some(Change::Positive) => ", volume grows",
            Some(Change::Nonzero) => ", volume changes",
        };
        let named = |stability| Stability::ALL.iter().find(|(_, one)| *one == stability);
        let kind =
            self.stability.and_then(named).map_or(String::new(), |(name, _)| format!("{name}, "));
        let density = if self.excludes_density { ", no density" } else { "" };
        let least = if self.is_least { "least " } else { "" };
        let (period, start) = (&self.period.text, self.beginning.text());
        let varied: Vec<String> = self.parameters.iter().map(Neighbourhood::text).collect();
        let varied = match varied.is_empty() {
            true => String::new(),
            false => format!(", for {}", varied.join(", ")),
        };
        format!(
            "{kind}closed orbit of {least}period {period} near {start}{volume}{density}{varied}"
        )
    }
}
