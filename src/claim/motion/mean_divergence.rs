//! Mean of div v along a motion.

use super::{Beginning, Motional, Stated, number, time, word};
use crate::claim::Reader;

/// Behaviour of volumes along a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tendency {
    /// Contraction: the motion tends to an attractor.
    Negative,
    /// Conservation on average.
    Zero,
    /// Expansion.
    Positive,
}

/// The claim that the mean of the divergence on the level has a sign, with a value if one is given.
#[derive(Clone, Debug)]
pub struct MeanDivergence {
    /// Sign of the mean.
    pub tendency: Tendency,
    /// Value of the mean, in the time of the equations.
    pub value: Option<Stated>,
    /// Start of the motion.
    pub beginning: Beginning,
    /// Length of the motion in time.
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
