//! Fixed and periodic points of the section map.

use super::{Beginning, Motional, Stated, count, number, point, word};
use crate::claim::{Reader, ValueShape};

/// Stability of a periodic point, by its multipliers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stability {
    /// Two complex conjugate multipliers of modulus 1.
    Elliptic,
    /// Two real multipliers, one above 1 and one below in modulus.
    Hyperbolic,
    /// Both multipliers below 1 in modulus.
    Sink,
    /// Both multipliers above 1 in modulus.
    Source,
}

impl Stability {
    /// All kinds, with their names.
    pub const ALL: [(&'static str, Self); 4] = [
        ("elliptic", Stability::Elliptic),
        ("hyperbolic", Stability::Hyperbolic),
        ("sink", Stability::Sink),
        ("source", Stability::Source),
    ];
}

/// The claim that a point of the section is periodic; its orbit has the given properties.
#[derive(Clone, Debug)]
pub struct PeriodicPoint {
    /// Start of Newton's method for the point.
    pub beginning: Beginning,
    /// Coordinates l and L/G of the point.
    pub at: [Stated; 2],
    /// Number of crossings of a period.
    pub period: usize,
    /// Length of the period in time.
    pub time: Option<Stated>,
    /// Stability of the point.
    pub stability: Option<Stability>,
    /// Product of the multipliers.
    pub product: Option<Stated>,
    /// Modulus of complex multipliers.
    pub modulus: Option<Stated>,
    /// Argument of complex multipliers.
    pub argument: Option<Stated>,
    /// Larger one of two real multipliers.
    pub multiplier: Option<Stated>,
}

impl Motional for PeriodicPoint {
    const NAME: &'static str = "periodic-point";
    const COMPANIONS: &'static [&'static str] =
        &["period", "time", "stability", "product", "modulus", "argument", "multiplier"];
    const SHAPES: &'static [(&'static str, ValueShape)] = &[(Self::NAME, ValueShape::List)];

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        let at = point(from, Self::NAME)?.ok_or_else(|| from.missing(Self::NAME))?;
        let found = Self {
            beginning: Beginning::Section(at.clone()),
            at,
            period: count(from, "period", 1)?.unwrap_or(1),
            time: number(from, "time")?,
            stability: word(from, "stability", &Stability::ALL)?,
            product: number(from, "product")?,
            modulus: number(from, "modulus")?,
            argument: number(from, "argument")?,
            multiplier: number(from, "multiplier")?,
        };
        if found.multiplier.is_some() && (found.modulus.is_some() || found.argument.is_some()) {
            let message = "multipliers are complex or real, and here both".to_string();
            let remedy = "give modulus and argument, or the larger real multiplier";
            return Err(from.complaint("multiplier", message, remedy));
        }
        Ok(found)
    }

    fn beginning(&self) -> &Beginning {
        &self.beginning
    }

    fn text(&self) -> String {
        let named = |stability| Stability::ALL.iter().find(|(_, one)| *one == stability);
        let kind =
            self.stability.and_then(named).map_or(String::new(), |(name, _)| format!("{name}, "));
        let period = match self.period {
            1 => "fixed point".to_string(),
            n => format!("period {n}"),
        };
        format!("{kind}{period} {}", self.beginning.text())
    }
}
