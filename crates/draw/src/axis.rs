//! Axes of plots: name, range, and ticks at round numbers.

use std::f64::consts::PI;

use crate::text::{Text, plain};

/// Approximate number of steps between ticks.
const STEPS: f64 = 5.0;

/// Axis of a plot.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Name of the axis.
    pub name: Text,
    pub(crate) from: f64,
    pub(crate) to: f64,
    pub(crate) ticks: Vec<(f64, String)>,
}

impl Axis {
    /// Axis with these ticks.
    pub fn with_ticks(name: Text, [from, to]: [f64; 2], ticks: Vec<(f64, String)>) -> Self {
        Self { name, from, to, ticks }
    }

    /// Axis of an angle over a whole turn.
    pub fn turn(name: Text) -> Self {
        let words = ["0", "π/2", "π", "3π/2", "2π"].into_iter().enumerate();
        let ticks = words.map(|(k, word)| (k as f64 * PI / 2.0, word.to_string())).collect();
        Self { name, from: 0.0, to: 2.0 * PI, ticks }
    }

    /// Axis over some values, with a margin; over -1 to 1 where there are none.
    pub fn over(name: Text, values: impl Iterator<Item = f64>) -> Self {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for value in values.filter(|value| value.is_finite()) {
            (low, high) = (low.min(value), high.max(value));
        }
        if low > high {
            return Self::new(name, -1.0, 1.0);
        }
        let size = low.abs().max(high.abs());
        let margin = match high - low > 1e-9 * size {
            true => 0.03 * (high - low),
            false if size > 0.0 => 1e-3 * size,
            false => 1.0,
        };
        Self::new(name, low - margin, high + margin)
    }

    /// Axis with ticks at round numbers; very large and very small ones are shown divided by a power
    /// of ten, which the name tells.
    pub fn new(name: Text, from: f64, to: f64) -> Self {
        let largest = from.abs().max(to.abs());
        let decade = if largest > 0.0 { libm::floor(libm::log10(largest)) as i32 } else { 0 };
        let power = if (-3..5).contains(&decade) { 0 } else { decade };
        let unit = libm::pow(10.0, f64::from(power));
        let rough = (to - from).abs() / unit / STEPS;
        let size = libm::pow(10.0, libm::floor(libm::log10(rough)));
        let step = [1.0, 2.0, 5.0, 10.0].map(|k| k * size);
        let step = step.into_iter().find(|step| *step >= 0.999 * rough).unwrap_or(rough);
        let (low, high) = (from.min(to) / unit / step, from.max(to) / unit / step);
        let (first, last) = (libm::ceil(low - 1e-9) as i64, libm::floor(high + 1e-9) as i64);
        let digits = (-libm::floor(libm::log10(step) + 1e-9)).clamp(0.0, 12.0) as usize;
        // A range of a few units in the last place has no round numbers in it.
        let last = last.min(first.saturating_add(20));
        let tick = |k: i64| {
            let value = k as f64 * step;
            let word = if k == 0 { "0".to_string() } else { format!("{value:.digits$}") };
            (value * unit, word.replace('-', "−"))
        };
        let name = match power {
            0 => name,
            _ => name.then(plain(&format!(" / {}", power_of_ten(i64::from(power))))),
        };
        Self { name, from, to, ticks: (first..=last).map(tick).collect() }
    }

    /// Widens the range to a length around its middle; the ticks are made anew.
    pub(crate) fn widened(&self, name: Text, length: f64) -> Self {
        let middle = (self.from + self.to) / 2.0;
        Self::new(name, middle - length / 2.0, middle + length / 2.0)
    }

    /// Lower end of the range.
    pub fn from(&self) -> f64 {
        self.from
    }

    /// Length of the range.
    pub(crate) fn length(&self) -> f64 {
        (self.to - self.from).abs()
    }

    /// Position of a value between the ends, from 0 to 1.
    pub fn share(&self, value: f64) -> f64 {
        (value - self.from) / (self.to - self.from)
    }
}

/// A power of ten in letters: 10⁻¹⁶.
pub fn power_of_ten(exponent: i64) -> String {
    let superscript = |digit: char| match digit {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        _ => digit.to_digit(10).and_then(|d| char::from_u32('⁰' as u32 + d)).unwrap_or(digit),
    };
    format!("10{}", exponent.to_string().chars().map(superscript).collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_cover_their_values() {
        for values in [
            vec![],
            vec![2.0],
            vec![0.0, 0.0],
            vec![1.0, f64::NAN, 3.0],
            vec![5e12, 5e12],
            vec![1e-9, 3e-9],
        ] {
            let axis = Axis::over(plain("x"), values.iter().copied());
            let known = values.iter().filter(|x| x.is_finite());
            assert!(known.clone().all(|x| (0.0..=1.0).contains(&axis.share(*x))), "{values:?}");
            assert!(!axis.ticks.is_empty(), "{values:?}");
        }
    }

    #[test]
    fn ticks_are_round_numbers_within_the_ends() {
        let words = |from, to| -> Vec<String> {
            Axis::new(plain("x"), from, to).ticks.into_iter().map(|(_, word)| word).collect()
        };
        assert_eq!(words(-1.0, 1.0), ["−1.0", "−0.5", "0", "0.5", "1.0"]);
        assert_eq!(words(0.0, 14.0), ["0", "5", "10"]);
        assert_eq!(words(9.7, 9.9), ["9.70", "9.75", "9.80", "9.85", "9.90"]);
        assert_eq!(words(0.0, 1000.0), ["0", "200", "400", "600", "800", "1000"]);
        assert_eq!(words(0.0, 2e-7), ["0", "0.5", "1.0", "1.5", "2.0"]);
        assert_eq!(Axis::new(plain("x"), 0.0, 2e-7).name.letters(), "x / 10⁻⁷");
    }
}
