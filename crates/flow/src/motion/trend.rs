//! Trend of the growth of a tangent vector over the blocks of a motion.
//!
//! Growth like t^p has the mean rate p ln(t₁/t₀)/(t₁ - t₀) from t₀ to t₁, which falls in time, and
//! exponential growth has one that does not. Both are fitted to the rates of the blocks.

use crate::motion::lyapunov::{BLOCKS, SKIPPED};

/// Rates of growth, and sizes of the places visited, block by block after the transient.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct GrowthTrend {
    /// Rates of the logarithm of the vector's length.
    rates: [f64; BLOCKS],
    /// Diagonals of the boxes around the states of the blocks.
    spreads: [f64; BLOCKS],
}

impl Default for GrowthTrend {
    fn default() -> Self {
        Self { rates: [f64::NAN; BLOCKS], spreads: [f64::NAN; BLOCKS] }
    }
}

/// Exponent without the growth of a power of the time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FittedExponent {
    /// Exponent.
    pub value: f64,
    /// Estimate of its error.
    pub error: f64,
}

impl GrowthTrend {
    /// Trend of a motion; blocks that are missing have no value.
    pub fn new(rates: &[f64], spreads: &[f64]) -> Self {
        let mut trend = Self::default();
        trend.rates.iter_mut().zip(rates).for_each(|(own, rate)| *own = *rate);
        trend.spreads.iter_mut().zip(spreads).for_each(|(own, spread)| *own = *spread);
        trend
    }

    /// Fits λ + p ln(t₁/t₀)/(t₁ - t₀) to the rates by least squares. Growth that only tends to a power
    /// has another λ in its later half, and the difference is an error too.
    pub fn fitted(&self) -> FittedExponent {
        let [value, error] = self.fit(0);
        let [later, _] = self.fit(BLOCKS / 2);
        FittedExponent { value, error: error.max((value - later).abs()) }
    }

    /// Exponent by the blocks from one on, with its standard error.
    fn fit(&self, first: usize) -> [f64; 2] {
        let width = (1.0 - SKIPPED) / BLOCKS as f64;
        let power = |block: usize| {
            let begin = SKIPPED + width * block as f64;
            libm::log((begin + width) / begin)
        };
        let count = (BLOCKS - first) as f64;
        let rates = &self.rates[first..];
        let power: Vec<f64> = (first..BLOCKS).map(power).collect();
        let mean = |values: &[f64]| values.iter().sum::<f64>() / count;
        let (centre, level) = (mean(&power), mean(rates));
        let pairs = || power.iter().zip(rates).map(|(x, y)| (x - centre, y - level));
        let square: f64 = pairs().map(|(x, _)| x * x).sum();
        let slope = pairs().map(|(x, y)| x * y).sum::<f64>() / square;
        let left: f64 = pairs().map(|(x, y)| (y - slope * x) * (y - slope * x)).sum();
        let share = 1.0 / count + centre * centre / square;
        [level - slope * centre, (left / (count - 2.0) * share).sqrt()]
    }

    /// Whether the motion itself has gone away in the later half at half the rate of its neighbours
    /// or more, block after block: the growth is then that of a place which the motion leaves.
    pub fn is_leaving(&self, block: f64) -> bool {
        let later = &self.spreads[BLOCKS / 2..];
        let grows = later.windows(2).all(|pair| pair[1] > pair[0]);
        let (Some(first), Some(last)) = (later.first(), later.last()) else { return false };
        let rates = &self.rates[BLOCKS / 2 + 1..];
        let growth = rates.iter().sum::<f64>() * block;
        grows && growth > 0.0 && libm::log(last / first) >= growth / 2.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WIDTH: f64 = (1.0 - SKIPPED) / BLOCKS as f64;

    fn of(length: impl Fn(f64) -> f64) -> GrowthTrend {
        let at = |block: usize| SKIPPED + WIDTH * block as f64;
        let rate = |block: usize| libm::log(length(at(block + 1)) / length(at(block))) / WIDTH;
        let rates: Vec<f64> = (0..BLOCKS).map(rate).collect();
        let spreads: Vec<f64> = (0..BLOCKS).map(|block| length(at(block))).collect();
        GrowthTrend::new(&rates, &spreads)
    }

    #[test]
    fn a_power_is_no_exponent() {
        for power in [-1.5, 0.5, 1.0, 3.0] {
            let FittedExponent { value, error } = of(|t| libm::pow(t, power)).fitted();
            assert!(value.abs() < 1e-12 && error < 1e-12, "t^{power}: {value:e} ± {error:e}");
        }
        let both = of(|t| t * t * libm::exp(3.0 * t)).fitted();
        assert!((both.value - 3.0).abs() < 1e-12, "{both:?}");
        assert!(GrowthTrend::default().fitted().value.is_nan(), "no blocks, no value");
    }

    #[test]
    fn a_motion_that_leaves_is_seen_by_its_own_distance() {
        let grows = of(|t| libm::exp(30.0 * t));
        assert!(grows.is_leaving(WIDTH), "as fast as its neighbours");
        let stays = GrowthTrend { spreads: [1.0; BLOCKS], ..grows };
        assert!(!stays.is_leaving(WIDTH), "in one place");
        let slow = std::array::from_fn(|block| 1.0 + 0.1 * block as f64);
        let drifts = GrowthTrend { spreads: slow, ..grows };
        assert!(!drifts.is_leaving(WIDTH), "much slower than its neighbours");
    }
}
