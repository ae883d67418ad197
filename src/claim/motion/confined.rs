//! Motions whose crossings stay in a part of the section.

use super::{Beginning, Motional, Stated, count, stated};
use crate::claim::Reader;

/// A coordinate of the section.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// l
    L,
    /// L/G
    Z,
}

/// After some crossings, all those that follow lie between two bounds.
#[derive(Clone, Debug)]
pub struct Confined {
    /// As it is typed.
    text: String,
    /// Which coordinate.
    pub axis: Axis,
    /// The bounds.
    pub between: [Stated; 2],
    /// Where the motion starts.
    pub beginning: Beginning,
    /// How many crossings are looked at, and how many are left out before them.
    pub crossings: usize,
    /// See there.
    pub skip: usize,
}

impl Motional for Confined {
    const NAME: &'static str = "confined";
    const COMPANIONS: &'static [&'static str] = &["start", "crossings", "skip"];

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        let text = from.text(Self::NAME)?.ok_or_else(|| from.missing(Self::NAME))?;
        let parts: Vec<&str> = text.split('<').map(str::trim).collect();
        let (low, axis, high) = match parts[..] {
            [low, "l", high] => (low, Axis::L, high),
            [low, "L/G", high] => (low, Axis::Z, high),
            _ => {
                let message = format!("`{text}` is no part of the section");
                return Err(from.complaint(Self::NAME, message, "write \"0.4 < l < 2.9\""));
            }
        };
        let between = [stated(from, Self::NAME, low)?, stated(from, Self::NAME, high)?];
        let beginning = Beginning::on_section(from)?;
        let crossings = count(from, "crossings")?.ok_or_else(|| from.missing("crossings"))?;
        let skip = count(from, "skip")?.unwrap_or(0);
        Ok(Self { text, axis, between, beginning, crossings, skip })
    }

    fn beginning(&self) -> &Beginning {
        &self.beginning
    }

    fn text(&self) -> String {
        format!("stays in {} from {}", self.text, self.beginning.text())
    }
}
