//! The largest Lyapunov exponent of a motion.

use super::{Beginning, Motional, Stated, number, time, word};
use crate::claim::Reader;

/// Growth of the distance between neighbouring motions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Growth {
    /// Exponential growth: chaos.
    Positive,
    /// No exponential growth or decay: a regular motion, or one attracted by such.
    Zero,
}

/// The claim that the largest exponent is positive, or 0, with a value if one is given.
#[derive(Clone, Debug)]
pub struct Exponent {
    /// Sign of the exponent.
    pub growth: Growth,
    /// Value of the exponent, in the time of the equations.
    pub value: Option<Stated>,
    /// Start of the motion.
    pub beginning: Beginning,
    /// Length of the motion in time.
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
            Growth::Zero => "the exponent 0",
        };
        format!("{growth} from {}", self.beginning.text())
    }
}
