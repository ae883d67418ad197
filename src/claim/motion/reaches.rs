//! Values of a function at a time of a motion, proved by enclosures.

use super::{Beginning, Motional, required_number, time};
use crate::claim::Reader;
use crate::formula::{Formula, Type};

/// The claim that a function lies between bounds at a time of a motion.
#[derive(Clone, Debug)]
pub struct Reaches {
    /// Function of the state.
    pub function: Formula,
    /// Lower bound, exclusive.
    pub above: Option<Formula>,
    /// Upper bound, exclusive.
    pub below: Option<Formula>,
    /// Start of the motion.
    pub beginning: Beginning,
    /// Time at which the function is evaluated.
    pub time: f64,
    /// The time as written.
    pub time_text: String,
}

impl Motional for Reaches {
    const NAME: &'static str = "reaches";
    const COMPANIONS: &'static [&'static str] = &["above", "below", "state", "time"];

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        let function = from.required(Self::NAME, Some(Type::Scalar))?;
        let [above, below] = ["above", "below"].map(|key| from.formula(key, Some(Type::Scalar)));
        let (above, below) = (above?, below?);
        if above.is_none() && below.is_none() {
            let message = "nothing is said of its value".to_string();
            return Err(from.complaint(Self::NAME, message, "add above = \"…\" or below = \"…\""));
        }
        let all = [Some(&function), above.as_ref(), below.as_ref()];
        if all.iter().flatten().any(|formula| from.model().has_antiderivative(formula)) {
            let message = "the constant of an ∫ is open".to_string();
            return Err(from.complaint(Self::NAME, message, "write the antiderivative out"));
        }
        let beginning = Beginning::read(from)?;
        if matches!(beginning, Beginning::Section(_)) {
            let message = "an enclosed motion begins at a state".to_string();
            return Err(from.complaint(Self::NAME, message, "write state = { … }"));
        }
        let time_text = required_number(from, "time")?.text;
        Ok(Self { function, above, below, beginning, time: time(from)?, time_text })
    }

    fn beginning(&self) -> &Beginning {
        &self.beginning
    }

    fn text(&self) -> String {
        let trimmed = |formula: &Formula| formula.text().trim().to_string();
        let above = self.above.as_ref().map(|bound| format!("{} < ", trimmed(bound)));
        let below = self.below.as_ref().map(|bound| format!(" < {}", trimmed(bound)));
        let (above, below) = (above.unwrap_or_default(), below.unwrap_or_default());
        let (time, start) = (&self.time_text, self.beginning.text());
        format!("{above}{}{below} at t = {time} from {start}", trimmed(&self.function))
    }
}
