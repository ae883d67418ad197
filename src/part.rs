//! Shares of a job's units.
//!
//! A job numbers its units in one fixed order: states of a [sweep](crate::sweep), cells of a chart
//! row by row, starts of sections and exponents. Every unit has the same bits in any part.
//!
//! ```
//! use liouville::part::Part;
//!
//! let parts: Vec<Part> = Part::all(3).collect();
//! let ranges: Vec<_> = parts.iter().map(|part| part.range(10)).collect();
//! assert_eq!(ranges, [0..3, 3..6, 6..10]);
//! assert_eq!("2/3".parse(), Ok(parts[1]));
//! assert_eq!(parts[1].of(&['a', 'b', 'c', 'd']), ['b']);
//! ```

use std::fmt;
use std::ops::Range;
use std::str::FromStr;

/// Part I of N: the units ⌊(I−1)·U/N⌋ to ⌊I·U/N⌋ − 1 of U.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Part {
    index: u64,
    count: u64,
}

impl Part {
    /// Whole of a job.
    pub const WHOLE: Self = Self { index: 1, count: 1 };
    /// Largest number of parts.
    pub const MOST: u64 = 1_000_000;

    /// Part `index` of `count`, counted from 1; `None` if there is no such part.
    pub fn new(index: u64, count: u64) -> Option<Self> {
        let is_part = (1..=count).contains(&index) && count <= Self::MOST;
        is_part.then_some(Self { index, count })
    }

    /// All parts of this number of them, in order.
    pub fn all(count: u64) -> impl Iterator<Item = Self> {
        (1..=count.min(Self::MOST)).map(move |index| Self { index, count })
    }

    /// Number of the part, from 1.
    pub fn index(self) -> u64 {
        self.index
    }

    /// Number of parts.
    pub fn count(self) -> u64 {
        self.count
    }

    /// Units of the part, of a job of this many units.
    pub fn range(self, units: u64) -> Range<u64> {
        let (units, count) = (u128::from(units), u128::from(self.count));
        // at most `units`, so that it fits again
        let end = |index: u64| (u128::from(index) * units / count) as u64;
        end(self.index - 1)..end(self.index)
    }

    /// Elements of a slice that belong to the part.
    pub fn of<T>(self, units: &[T]) -> &[T] {
        let range = self.range(units.len() as u64);
        units.get(range.start as usize..range.end as usize).unwrap_or_default()
    }
}

impl fmt::Display for Part {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{}/{}", self.index, self.count)
    }
}

/// Mistake in the text of a part.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("write I/N, such as 3/40, with I from 1 to N and N up to {}", Part::MOST)]
pub struct PartMistake;

impl FromStr for Part {
    type Err = PartMistake;

    fn from_str(text: &str) -> Result<Self, PartMistake> {
        let (index, count) = text.split_once('/').ok_or(PartMistake)?;
        let number = |text: &str| text.trim().parse().map_err(|_| PartMistake);
        Self::new(number(index)?, number(count)?).ok_or(PartMistake)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_cover_all_units_once() {
        for units in [0, 1, 7, 40, 1000, u64::MAX] {
            for count in [1, 2, 3, 7, 40, 41] {
                let mut next = 0;
                for part in Part::all(count) {
                    let range = part.range(units);
                    assert_eq!(range.start, next, "{part} of {units}");
                    let even = units / count;
                    let length = range.end - range.start;
                    assert!(length - even <= 1, "{part} of {units} has {length}");
                    next = range.end;
                }
                assert_eq!(next, units);
            }
        }
    }

    #[test]
    fn parts_are_read_as_they_are_printed() {
        assert_eq!("40/40".parse::<Part>().map(|part| part.to_string()), Ok("40/40".to_string()));
        for text in ["0/3", "4/3", "1", "1/0", "a/3", "-1/3", "1/1000001", "1/2/3"] {
            assert_eq!(text.parse::<Part>(), Err(PartMistake), "{text}");
        }
    }
}
