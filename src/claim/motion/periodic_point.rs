//! Fixed and periodic points of the section map.

use super::{Beginning, Motional, Stated, count, number, point, word};
use crate::claim::Reader;

/// What the multipliers of a periodic point say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stability {
    /// Two conjugate multipliers of modulus 1.
    Elliptic,
    /// Two real ones, one beyond 1 and one below.
    Hyperbolic,
    /// Both below 1 in modulus.
    Sink,
    /// Both beyond 1.
    Source,
}

impl Stability {
    /// All, with their names.
    pub const ALL: [(&'static str, Self); 4] = [
        ("elliptic", Stability::Elliptic),
        ("hyperbolic", Stability::Hyperbolic),
        ("sink", Stability::Sink),
        ("source", Stability::Source),
    ];
}

/// A point of the section comes back to itself; its orbit has these properties where they are given.
#[derive(Clone, Debug)]
pub struct PeriodicPoint {
    /// The point; Newton's method starts there.
    pub beginning: Beginning,
    /// The point's coordinates l and L/G.
    pub at: [Stated; 2],
    /// After how many crossings.
    pub period: usize,
    /// After what time.
    pub time: Option<Stated>,
    /// What the multipliers say.
    pub stability: Option<Stability>,
    /// The product of the multipliers.
    pub product: Option<Stated>,
    /// The modulus and the argument of complex multipliers.
    pub modulus: Option<Stated>,
    /// See there.
    pub argument: Option<Stated>,
    /// The larger of two real ones.
    pub multiplier: Option<Stated>,
}

impl Motional for PeriodicPoint {
    const NAME: &'static str = "periodic-point";
    const COMPANIONS: &'static [&'static str] =
        &["period", "time", "stability", "product", "modulus", "argument", "multiplier"];

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        let at = point(from, Self::NAME)?.ok_or_else(|| from.missing(Self::NAME))?;
        let found = Self {
            beginning: Beginning::Section(at.clone()),
            at,
            period: count(from, "period")?.unwrap_or(1),
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
