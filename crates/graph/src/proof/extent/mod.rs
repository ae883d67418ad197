//! Intervals that contain all values of a quantity over some real inputs.
//!
//! An [`Extent`] is a closed interval with f64 or infinite ends. Every operation returns one that
//! contains all results: ends are computed in f64 and moved outwards by one step (for elementary
//! functions of `libm`, whose error is below one unit in the last place, by two). A product of a
//! value with itself is a square. Where no input gives a result the extent is *empty*.

mod functions;
mod rounding;

#[cfg(test)]
mod tests;

use crate::number::UnaryFunction;
use crate::number::rational::Rational;

use rounding::{down, has_exact_error, product, sum, up};

/// A closed interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    low: f64,
    high: f64,
}

impl Extent {
    /// All real numbers.
    pub const ALL: Self = Self { low: f64::NEG_INFINITY, high: f64::INFINITY };
    /// All non-negative numbers.
    pub const POSITIVE: Self = Self { low: 0.0, high: f64::INFINITY };
    /// The number 0.
    pub const ZERO: Self = Self { low: 0.0, high: 0.0 };
    /// The interval from -1 to 1.
    pub const SIGN: Self = Self { low: -1.0, high: 1.0 };
    /// The empty interval.
    pub const EMPTY: Self = Self { low: f64::INFINITY, high: f64::NEG_INFINITY };

    /// Makes the interval from `low` to `high`.
    pub fn between(low: &Rational, high: &Rational) -> Self {
        Self { low: Self::at(low).low, high: Self::at(high).high }
    }

    /// Makes the interval of one number.
    pub fn at(value: &Rational) -> Self {
        match value.to_f64() {
            (nearest, true) => Self { low: nearest, high: nearest },
            (nearest, false) => Self::outward(nearest, nearest),
        }
    }

    /// Moves two computed ends outwards by one step; all numbers if one end is NaN.
    fn outward(low: f64, high: f64) -> Self {
        if low.is_nan() || high.is_nan() {
            return Self::ALL;
        }
        Self { low: low.next_down(), high: high.next_up() }
    }

    /// Returns the ends, if they are finite.
    pub fn ends(self) -> Option<[f64; 2]> {
        (self.low.is_finite() && self.high.is_finite()).then_some([self.low, self.high])
    }

    /// Whether the interval is empty.
    #[inline(always)]
    pub fn is_empty(self) -> bool {
        self.low > self.high
    }

    /// Returns the intersection of two intervals.
    #[inline(always)]
    pub fn common(self, other: Self) -> Self {
        let both = Self { low: self.low.max(other.low), high: self.high.min(other.high) };
        if both.is_empty() { Self::EMPTY } else { both }
    }

    /// Whether 0 is outside the interval.
    #[inline(always)]
    pub fn excludes_zero(self) -> bool {
        self.low > 0.0 || self.high < 0.0
    }

    /// Whether the interval contains a positive number.
    #[inline(always)]
    pub fn reaches_above_zero(self) -> bool {
        self.high > 0.0
    }

    /// Returns both halves, which share the middle; `None` if the interval cannot be cut.
    pub fn halves(self) -> Option<(Self, Self)> {
        let middle = self.middle()?;
        Some((Self { high: middle, ..self }, Self { low: middle, ..self }))
    }

    /// Returns a number inside the interval.
    pub fn middle(self) -> Option<f64> {
        let Self { low, high } = self;
        let middle = match (low.is_finite(), high.is_finite()) {
            (true, true) => low + (high - low) / 2.0,
            (true, false) => 2.0 * low.max(0.0) + 1.0,
            (false, true) => 2.0 * high.min(0.0) - 1.0,
            (false, false) => 0.0,
        };
        (low < middle && middle < high).then_some(middle)
    }

    /// Returns the hull of two intervals.
    pub fn hull(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// Returns the hull of the interval and its opposite.
    pub fn hull_with_opposite(self) -> Self {
        let size = self.high.max(-self.low);
        if self.is_empty() { self } else { Self { low: -size, high: size } }
    }

    /// Returns a number of the interval, off the middle where there is an interior: false formulas
    /// often hold in the middle of symmetric ranges.
    pub fn inside(self) -> Option<f64> {
        const SHARE: f64 = 0.381_966;
        let Self { low, high } = self;
        let inside = match (low.is_finite(), high.is_finite()) {
            (true, true) => low + SHARE * (high - low),
            (true, false) => 2.0 * low.max(0.0) + SHARE,
            (false, true) => 2.0 * high.min(0.0) - SHARE,
            (false, false) => SHARE,
        };
        let single = (low == high && low.is_finite()).then_some(low);
        single.or_else(|| (low < inside && inside < high).then_some(inside))
    }

    /// Encloses the square roots, of either sign, of all numbers that have one.
    pub fn roots(self) -> Self {
        let root = self.unary(UnaryFunction::Sqrt);
        if root.is_empty() { root } else { Self { low: -root.high, high: root.high } }
    }

    /// Returns the common sign of all numbers, if they have one; 0 counts as either sign.
    #[inline(always)]
    pub fn sign(self) -> Option<bool> {
        match (self.low >= 0.0, self.high <= 0.0) {
            (true, _) => Some(true),
            (_, true) => Some(false),
            _ => None,
        }
    }

    /// Computes -x.
    #[inline(always)]
    pub fn negated(self) -> Self {
        Self { low: -self.high, high: -self.low }
    }

    /// Computes |x|.
    #[inline(always)]
    pub fn modulus(self) -> Self {
        match self.sign() {
            Some(true) => self,
            Some(false) => self.negated(),
            None => Self { low: 0.0, high: self.high.max(-self.low) },
        }
    }

    /// Computes x + y.
    #[inline(always)]
    pub fn plus(self, other: Self) -> Self {
        let (low, high) = (sum(self.low, other.low), sum(self.high, other.high));
        if low.0.is_nan() || high.0.is_nan() {
            return Self::ALL;
        }
        Self { low: down(low), high: up(high) }
    }

    /// Computes x y.
    #[inline(always)]
    pub fn times(self, other: Self) -> Self {
        if self == Self::ALL || other == Self::ALL {
            let is_zero = self == Self::ZERO || other == Self::ZERO;
            return if is_zero { Self::ZERO } else { Self::ALL };
        }
        let wide = self.between_corners(other).unwrap_or_else(|| self.between_any_corners(other));
        match (self.sign(), other.sign()) {
            (Some(a), Some(b)) => wide.within(a == b),
            _ => wide,
        }
    }

    /// Returns the hull of the products of all ends; `None` if some product is 0, infinite or so small
    /// that its rounding error may underflow.
    #[inline(always)]
    fn between_corners(self, other: Self) -> Option<Self> {
        let (first, second) = ([self.low, self.low, self.high, self.high], [other.low, other.high]);
        let (mut rounded, mut missing) = ([0.0; 4], [0.0; 4]);
        let mut is_exact = true;
        for corner in 0..4 {
            let (a, b) = (first[corner], second[corner & 1]);
            rounded[corner] = a * b;
            missing[corner] = a.mul_add(b, -rounded[corner]);
            is_exact &= has_exact_error(rounded[corner]);
        }
        if !is_exact {
            return None;
        }
        // Rounding is monotone: an end comes from a corner whose rounded product is extreme.
        let [least, most] = [
            rounded[0].min(rounded[1]).min(rounded[2].min(rounded[3])),
            rounded[0].max(rounded[1]).max(rounded[2].max(rounded[3])),
        ];
        let (mut is_above, mut is_below) = (false, false);
        for corner in 0..4 {
            is_above |= rounded[corner] == least && missing[corner] < 0.0;
            is_below |= rounded[corner] == most && missing[corner] > 0.0;
        }
        let low = if is_above { least.next_down() } else { least };
        Some(Self { low, high: if is_below { most.next_up() } else { most } })
    }

    /// Returns the hull of the products of all ends, whatever they are.
    #[cold]
    #[inline(never)]
    fn between_any_corners(self, other: Self) -> Self {
        let corners = [
            (self.low, other.low),
            (self.low, other.high),
            (self.high, other.low),
            (self.high, other.high),
        ];
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for (a, b) in corners {
            let exact = product(a, b);
            (low, high) = (low.min(down(exact)), high.max(up(exact)));
        }
        Self { low, high }
    }

    /// Returns the part of the interval with this sign.
    #[inline(always)]
    pub fn within(self, positive: bool) -> Self {
        match positive {
            _ if self.is_empty() => self,
            true => Self { low: self.low.max(0.0), ..self },
            false => Self { high: self.high.min(0.0), ..self },
        }
    }

    /// Computes x².
    #[inline(always)]
    pub fn square(self) -> Self {
        let Self { low, high } = self.modulus();
        if self.is_empty() {
            return self;
        }
        Self { low: down(product(low, low)), high: up(product(high, high)) }.within(true)
    }

    /// Computes 1/x.
    pub fn reciprocal(self) -> Self {
        match self.sign() {
            _ if self == (Self { low: 0.0, high: 0.0 }) => Self::EMPTY,
            None => Self::ALL,
            Some(true) => {
                // 1/0 is not an end: an argument with a reciprocal is not 0.
                let high = if self.low == 0.0 { f64::INFINITY } else { 1.0 / self.low };
                Self::outward(1.0 / self.high, high).within(true)
            }
            Some(false) => self.negated().reciprocal().negated(),
        }
    }

    /// Estimates the gain from cutting the interval.
    pub fn spread(self) -> f64 {
        let least = if self.excludes_zero() { self.low.abs().min(self.high.abs()) } else { 0.0 };
        match (self.high - self.low, least) {
            (width, 0.0) if width > 0.0 => f64::MAX.min(1e9 * width),
            (width, least) => width / least,
        }
    }
}
