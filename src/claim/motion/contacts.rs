//! What happens at a one-sided constraint, and when.

use super::{Beginning, Motional, Stated, stated, time};
use crate::claim::Reader;

/// Something that happens at the constraint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Touch {
    /// The motion arrives, and stays.
    Arrives,
    /// It is free again.
    Leaves,
}

/// The motion arrives at the constraint and leaves it at these times, and at no others.
#[derive(Clone, Debug)]
pub struct Contacts {
    /// What happens, in order.
    pub events: Vec<(Touch, Stated)>,
    /// Where the motion starts.
    pub beginning: Beginning,
    /// How long it is followed.
    pub time: f64,
}

impl Motional for Contacts {
    const NAME: &'static str = "contacts";
    const COMPANIONS: &'static [&'static str] = &["state", "time"];

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        let texts = from.texts(Self::NAME)?.ok_or_else(|| from.missing(Self::NAME))?;
        let event = |text: &String| match text.split_once(" at ") {
            Some(("arrives", when)) => Ok((Touch::Arrives, stated(from, Self::NAME, when)?)),
            Some(("leaves", when)) => Ok((Touch::Leaves, stated(from, Self::NAME, when)?)),
            _ => {
                let message = format!("`{text}` is nothing that happens at a constraint");
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
        match events.is_empty() {
            true => "stays free".to_string(),
            false => events.join(", "),
        }
    }
}
