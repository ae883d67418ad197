//! Axes of pictures: name, range, and ticks.

use std::f64::consts::PI;

/// Approximate number of steps between ticks.
const STEPS: f64 = 5.0;

/// An axis of a picture.
#[derive(Clone, Debug)]
pub struct Scale {
    /// Name of the axis.
    pub name: String,
    from: f64,
    to: f64,
    ticks: Vec<(f64, String)>,
}

impl Scale {
    /// Axis of l over a whole turn.
    pub fn longitude() -> Self {
        let names = ["0", "π/2", "π", "3π/2", "2π"].into_iter().enumerate();
        let ticks = names.map(|(k, name)| (k as f64 * PI / 2.0, name.to_string())).collect();
        Self { name: "l".to_string(), from: 0.0, to: 2.0 * PI, ticks }
    }

    /// Axis of L/G from pole to pole.
    pub fn height() -> Self {
        Self::new("L/G", -1.0, 1.0)
    }

    /// Axis over some values, with a margin; over -1 to 1 where there are none.
    pub fn over(name: &str, values: impl Iterator<Item = f64>) -> Self {
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

    /// Axis with ticks at round numbers.
    pub fn new(name: &str, from: f64, to: f64) -> Self {
        let rough = (to - from).abs() / STEPS;
        let power = libm::pow(10.0, libm::floor(libm::log10(rough)));
        let step = [1.0, 2.0, 5.0, 10.0].map(|k| k * power);
        let step = step.into_iter().find(|step| *step >= 0.999 * rough).unwrap_or(rough);
        let (low, high) = (from.min(to) / step, from.max(to) / step);
        let first = libm::ceil(low - 1e-9) as i64;
        let last = libm::floor(high + 1e-9) as i64;
        let digits = (-libm::floor(libm::log10(step) + 1e-9)).max(0.0) as usize;
        let tick = |k: i64| {
            let value = k as f64 * step;
            let text = format!("{value:.digits$}");
            (value, if k == 0 { "0".to_string() } else { text })
        };
        Self { name: name.to_string(), from, to, ticks: (first..=last).map(tick).collect() }
    }

    /// Position of a value between the ends, from 0 to 1.
    pub fn share(&self, value: f64) -> f64 {
        (value - self.from) / (self.to - self.from)
    }

    /// Ticks with their labels.
    pub fn ticks(&self) -> &[(f64, String)] {
        &self.ticks
    }

    /// Position of the axis name: between the last two ticks.
    pub fn name_at(&self) -> f64 {
        match &self.ticks[..] {
            [.., (a, _), (b, _)] => (a + b) / 2.0,
            _ => (self.from + self.to) / 2.0,
        }
    }

    /// Number of letters of the widest label of the axis.
    pub fn widest(&self) -> usize {
        let words = self.ticks.iter().map(|(_, word)| word).chain([&self.name]);
        words.map(|word| word.chars().count()).max().unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_cover_their_values() {
        for values in
            [vec![], vec![2.0], vec![0.0, 0.0], vec![1.0, f64::NAN, 3.0], vec![5e12, 5e12]]
        {
            let scale = Scale::over("x", values.iter().copied());
            let known = values.iter().filter(|x| x.is_finite());
            assert!(known.clone().all(|x| (0.0..=1.0).contains(&scale.share(*x))), "{values:?}");
            assert!(!scale.ticks.is_empty(), "{values:?}");
        }
    }

    #[test]
    fn ticks_are_round_numbers_within_the_ends() {
        let words = |from, to| -> Vec<String> {
            Scale::new("x", from, to).ticks.into_iter().map(|(_, word)| word).collect()
        };
        assert_eq!(words(-1.0, 1.0), ["-1.0", "-0.5", "0", "0.5", "1.0"]);
        assert_eq!(words(0.0, 14.0), ["0", "5", "10"]);
        assert_eq!(words(9.7, 9.9), ["9.70", "9.75", "9.80", "9.85", "9.90"]);
        assert_eq!(words(0.0, 1000.0), ["0", "200", "400", "600", "800", "1000"]);
    }
}
