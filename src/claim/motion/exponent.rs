//! The largest Lyapunov exponent of a motion.

use super::{Beginning, Motional, Stated, number, time, word};
use crate::claim::Reader;

/// Whether neighbouring motions part exponentially.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Growth {
    /// Chaos.
    Positive,
    /// A regular motion, or one that is drawn to such.
    Zero,
}

/// The largest exponent is positive, or not; and has a value, if one is given.
#[derive(Clone, Debug)]
pub struct Exponent {
    /// Which sign is claimed.
    pub growth: Growth,
    /// In the time of the equations.
    pub value: Option<Stated>,
    /// Where the motion starts.
    pub beginning: Beginning,
    /// How long it is followed.
    pub time: f64,
}

impl Motional for Exponent {
    const NAME: &'static str = "exponent";
    const COMPANIONS: &'static [&'static str] = &["start", "state", "time", "value"];

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        let words = [("positive", Growth::Positive), ("zero", Growth::Zero)];
        let growth = word(from, Self::NAME, &words)?.ok_or_else(|| from.missing(Self::NAME))?;
        let (value, beginning, time) =
            (number(from, "value")?, Beginning::read(from)?, time(from)?);
        Ok(Self { growth, value, beginning, time })
    }

    fn beginning(&self) -> &Beginning {
        &self.beginning
    }

    fn text(&self) -> String {
        let growth = match self.growth {
            Growth::Positive => "a positive exponent",
            Growth::Zero => "no positive exponent",
        };
        format!("{growth} from {}", self.beginning.text())
    }
}
