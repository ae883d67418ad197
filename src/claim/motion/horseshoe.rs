//! Horseshoes at a saddle, and the integrals that they exclude.

use super::{Beginning, Motional, Stated, integrals, period, word};
use crate::claim::{Reader, ValueShape};
use crate::formula::Formula;

/// The claim that motions near a closed orbit of saddle kind, with this period, form a horseshoe.
#[derive(Clone, Debug)]
pub struct Horseshoe {
    /// Period of the closed orbit.
    pub period: Stated,
    /// State near the closed orbit.
    pub beginning: Beginning,
    /// Whether the horseshoe is to exclude further analytic integrals.
    pub excludes_integral: bool,
    /// Known integrals besides the level functions and the energy.
    pub integrals: Vec<Formula>,
}

impl Motional for Horseshoe {
    const NAME: &'static str = "horseshoe";
    const COMPANIONS: &'static [&'static str] = &["start", "state", "integral", "integrals"];
    const SHAPES: &'static [(&'static str, ValueShape)] = &[
        ("start", ValueShape::List),
        ("state", ValueShape::ListOrTable),
        ("integrals", ValueShape::List),
    ];

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        Ok(Self {
            period: period(from, Self::NAME, "write that of the saddle, above 0")?,
            beginning: Beginning::read(from)?,
            excludes_integral: word(from, "integral", &[("none", ())])?.is_some(),
            integrals: integrals(from)?,
        })
    }

    fn beginning(&self) -> &Beginning {
        &self.beginning
    }

    fn text(&self) -> String {
        let integral = if self.excludes_integral { ", no further integral" } else { "" };
        let (period, start) = (&self.period.text, self.beginning.text());
        format!("horseshoe at the saddle of period {period} near {start}{integral}")
    }
}
