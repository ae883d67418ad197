//! The mean of div v along a motion.

use super::{Beginning, Motional, Stated, number, time, word};
use crate::claim::Reader;

/// What becomes of volumes along a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tendency {
    /// They shrink: the motion is drawn to an attractor.
    Negative,
    /// They are kept on average.
    Zero,
    /// They grow.
    Positive,
}

/// The mean of the divergence on the level has a sign; and a value, if one is given.
#[derive(Clone, Debug)]
pub struct MeanDivergence {
    /// Which sign is claimed.
    pub tendency: Tendency,
    /// In the time of the equations.
    pub value: Option<Stated>,
    /// Where the motion starts.
    pub beginning: Beginning,
    /// How long it is followed.
    pub time: f64,
}

impl Motional for MeanDivergence {
    const NAME: &'static str = "mean-divergence";
    const COMPANIONS: &'static [&'static str] = &["start", "state", "time", "value"];

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        let words = [
            ("negative", Tendency::Negative),
            ("zero", Tendency::Zero),
            ("positive", Tendency::Positive),
        ];
        let tendency = word(from, Self::NAME, &words)?.ok_or_else(|| from.missing(Self::NAME))?;
        let (value, beginning, time) =
            (number(from, "value")?, Beginning::read(from)?, time(from)?);
        Ok(Self { tendency, value, beginning, time })
    }

    fn beginning(&self) -> &Beginning {
        &self.beginning
    }

    fn text(&self) -> String {
        let tendency = match self.tendency {
            Tendency::Negative => "volume shrinks",
            Tendency::Zero => "volume is kept on average",
            Tendency::Positive => "volume grows",
        };
        format!("{tendency} from {}", self.beginning.text())
    }
}
