//! Motions whose section crossings stay in a part of the section, all or most of them.

use super::{Beginning, Motional, Stated, count, stated, without_error};
use crate::claim::Reader;
use crate::number::rational::Rational;

/// A coordinate of the section.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SectionCoordinate {
    /// Angle l.
    L,
    /// Ratio L/G.
    Z,
}

/// The claim that, after some crossings, those that follow lie between two bounds, or a share of
/// them does.
#[derive(Clone, Debug)]
pub struct Confined {
    /// Text of the claim as typed.
    text: String,
    /// Coordinate that is bounded.
    pub axis: SectionCoordinate,
    /// Lower and upper bound.
    pub between: [Stated; 2],
    /// Smallest share of the crossings that must lie between the bounds.
    pub share: Rational,
    /// Start of the motion.
    pub beginning: Beginning,
    /// Number of crossings to test.
    pub crossings: usize,
    /// Number of crossings to skip before them.
    pub skip: usize,
}

impl Motional for Confined {
    const NAME: &'static str = "confined";
    const COMPANIONS: &'static [&'static str] = &["start", "crossings", "skip", "share"];

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        let text = from.text(Self::NAME)?.ok_or_else(|| from.missing(Self::NAME))?;
        let parts: Vec<&str> = text.split('<').map(str::trim).collect();
        let (low, axis, high) = match parts[..] {
            [low, "l", high] => (low, SectionCoordinate::L, high),
            [low, "L/G", high] => (low, SectionCoordinate::Z, high),
            _ => {
                let message = format!("`{text}` is not a part of the section");
                return Err(from.complaint(Self::NAME, message, "write \"0.4 < l < 2.9\""));
            }
        };
        let between = [stated(from, Self::NAME, low)?, stated(from, Self::NAME, high)?];
        for bound in &between {
            without_error(from, Self::NAME, bound)?;
        }
        let beginning = Beginning::on_section(from)?;
        let crossings = count(from, "crossings", 1)?.ok_or_else(|| from.missing("crossings"))?;
        let skip = count(from, "skip", 0)?.unwrap_or(0);
        let share = match from.text("share")? {
            None => Rational::from(1),
            Some(text) => {
                let share = text.parse().ok();
                let [zero, one] = [0, 1].map(Rational::from);
                let share = share.filter(|share: &Rational| *share > zero && *share <= one);
                share.ok_or_else(|| {
                    let message = format!("`{text}` is not a share");
                    from.complaint("share", message, "write a number above 0, at most 1")
                })?
            }
        };
        Ok(Self { text, axis, between, share, beginning, crossings, skip })
    }

    fn beginning(&self) -> &Beginning {
        &self.beginning
    }

    fn text(&self) -> String {
        let most = match self.share < Rational::from(1) {
            true => format!(" for {} of the crossings", self.share),
            false => String::new(),
        };
        format!("stays in {}{most} from {}", self.text, self.beginning.text())
    }
}
