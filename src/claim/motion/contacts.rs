//! Events at a one-sided constraint, and their times.

use super::{Beginning, Motional, Stated, stated, time};
use crate::claim::{Reader, ValueShape};

/// An event at the constraint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Touch {
    /// Arrival of the motion, which then stays.
    Arrives,
    /// Departure of the motion.
    Leaves,
}

/// The claim that the motion arrives at the constraint and leaves it at these times, and at no
/// others.
#[derive(Clone, Debug)]
pub struct Contacts {
    /// Events with their times, in order.
    pub events: Vec<(Touch, Stated)>,
    /// Start of the motion.
    pub beginning: Beginning,
    /// Length of the motion in time.
    pub time: f64,
}

impl Motional for Contacts {
    const NAME: &'static str = "contacts";
    const COMPANIONS: &'static [&'static str] = &["state", "time"];
    const SHAPES: &'static [(&'static str, ValueShape)] =
        &[(Self::NAME, ValueShape::List), ("state", ValueShape::ListOrTable)];

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        let texts = from.texts(Self::NAME)?.ok_or_else(|| from.missing(Self::NAME))?;
        let event = |text: &String| match text.split_once(" at ") {
            Some(("arrives", when)) => Ok((Touch::Arrives, stated(from, Self::NAME, when)?)),
            Some(("leaves", when)) => Ok((Touch::Leaves, stated(from, Self::NAME, when)?)),
            _ => {
                let message = format!("`{text}` is not an event at a constraint");
                let remedy = "write \"arrives at 2.928\" or \"leaves at 3.815\"";
                Err(from.complaint(Self::NAME, message, remedy))
            }
        };
        let events = texts.iter().map(event).collect::<Result<_, _>>()?;
        Ok(Self { events, beginning: Beginning::read(from)?, time: time(from)? })
    }

    fn beginning(&self) -> &Beginning {
        &self.beginning
    }

    fn text(&self) -> String {
        let name = |touch: &Touch| match touch {
            Touch::Arrives => "arrives",
            Touch::Leaves => "leaves",
        };
        let events: Vec<String> = self
            .events
            .iter()
            .map(|(touch, when)| format!("{} at {}", name(touch), when.text))
            .collect();
        let events = if events.is_empty() {
            "no arrival, no leaving".to_string()
        } else {
            events.join(", ")
        };
        format!("{events}, under [one-sided]")
    }
}
