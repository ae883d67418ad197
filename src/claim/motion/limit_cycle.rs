//! Motions that tend to a periodic motion.

use super::{Beginning, Motional, Stated, count, point};
use crate::claim::{Reader, ValueShape};

/// The claim that the crossings tend to a cycle of the section map.
#[derive(Clone, Debug)]
pub struct LimitCycle {
    /// Number of points of the cycle.
    pub period: usize,
    /// One point of the cycle.
    pub point: Option<[Stated; 2]>,
    /// Start of the motion.
    pub beginning: Beginning,
    /// Number of crossings to follow.
    pub crossings: usize,
}

impl Motional for LimitCycle {
    const NAME: &'static str = "limit-cycle";
    const COMPANIONS: &'static [&'static str] = &["start", "crossings", "point"];
    const SHAPES: &'static [(&'static str, ValueShape)] =
        &[("start", ValueShape::List), ("point", ValueShape::List)];

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        let period = count(from, Self::NAME, 1)?.ok_or_else(|| from.missing(Self::NAME))?;
        let crossings = count(from, "crossings", 1)?.ok_or_else(|| from.missing("crossings"))?;
        if crossings < 8 * period {
            let message = format!("{crossings} crossings do not show a cycle of period {period}");
            return Err(from.complaint("crossings", message, "follow the motion for longer"));
        }
        let (point, beginning) = (point(from, "point")?, Beginning::on_section(from)?);
        Ok(Self { period, point, beginning, crossings })
    }

    fn beginning(&self) -> &Beginning {
        &self.beginning
    }

    fn text(&self) -> String {
        format!("tends to a cycle of period {} from {}", self.period, self.beginning.text())
    }
}
