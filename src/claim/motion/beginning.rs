//! Initial states of the motions in claims.

use super::{Stated, point};
use crate::claim::Reader;
use crate::claim::components::Components;
use crate::claim::point::read_point;

/// The start of a motion.
#[derive(Clone, Debug)]
pub enum Beginning {
    /// State over (l, L/G) on the section of the case, at its energy.
    Section([Stated; 2]),
    /// State given by its variables.
    State(Components),
}

impl Beginning {
    /// Reads `start = [l, L/G]` or `state = { … }`.
    pub fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        match (point(from, "start")?, read_point(from, "state")?) {
            (Some(at), None) => Ok(Beginning::Section(at)),
            (None, Some(state)) => Ok(Beginning::State(state)),
            (None, None) => Err(from.missing("start")),
            (Some(_), Some(_)) => {
                let message = "a motion has one start, and two are given".to_string();
                Err(from.complaint("state", message, "remove `start` or `state`"))
            }
        }
    }

    /// Reads `start = [l, L/G]`.
    pub fn on_section<R: Reader>(from: &R) -> Result<Self, R::Error> {
        point(from, "start")?.map(Beginning::Section).ok_or_else(|| from.missing("start"))
    }

    /// Returns the name of the start in reports.
    pub fn text(&self) -> String {
        match self {
            Beginning::Section([l, z]) => format!("({}, {})", l.text, z.text),
            Beginning::State(point) => point.text.clone(),
        }
    }
}
