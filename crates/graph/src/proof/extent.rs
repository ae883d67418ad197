//! Intervals that contain all values of a quantity over some real inputs.
//!
//! An [`Extent`] is a closed interval with f64 or infinite ends. Every operation returns one that
//! contains all results: ends are computed in f64 and moved outwards by one step (for elementary
//! functions of `libm`, whose error is below one unit in the last place, by two). A product of a
//! value with itself is a square. Where no input gives a result the extent is *empty*.

use std::f64::consts::{FRAC_PI_2, TAU};

use crate::number::Function;
use crate::number::rational::Rational;

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

    /// Whether the interval is empty.
    pub fn is_empty(self) -> bool {
        self.low > self.high
    }

    /// Returns the intersection of two intervals.
    pub fn common(self, other: Self) -> Self {
        let both = Self { low: self.low.max(other.low), high: self.high.min(other.high) };
        if both.is_empty() { Self::EMPTY } else { both }
    }

    /// Whether 0 is outside the interval.
    pub fn excludes_zero(self) -> bool {
        self.low > 0.0 || self.high < 0.0
    }

    /// Whether the interval contains a positive number.
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
        let root = self.unary(Function::Sqrt);
        if root.is_empty() { root } else { Self { low: -root.high, high: root.high } }
    }

    /// Returns the common sign of all numbers, if they have one; 0 counts as either sign.
    pub fn sign(self) -> Option<bool> {
        match (self.low >= 0.0, self.high <= 0.0) {
            (true, _) => Some(true),
            (_, true) => Some(false),
            _ => None,
        }
    }

    /// Computes -x.
    pub fn negated(self) -> Self {
        Self { low: -self.high, high: -self.low }
    }

    /// Computes |x|.
    pub fn modulus(self) -> Self {
        match self.sign() {
            Some(true) => self,
            Some(false) => self.negated(),
            None => Self { low: 0.0, high: self.high.max(-self.low) },
        }
    }

    /// Computes x + y.
    pub fn plus(self, other: Self) -> Self {
        let (low, high) = (sum(self.low, other.low), sum(self.high, other.high));
        if low.0.is_nan() || high.0.is_nan() {
            return Self::ALL;
        }
        Self { low: down(low), high: up(high) }
    }

    /// Computes x y.
    pub fn times(self, other: Self) -> Self {
        let corners = [
            product(self.low, other.low),
            product(self.low, other.high),
            product(self.high, other.low),
            product(self.high, other.high),
        ];
        let low = corners.into_iter().map(down).fold(f64::INFINITY, f64::min);
        let high = corners.into_iter().map(up).fold(f64::NEG_INFINITY, f64::max);
        let wide = Self { low, high };
        match (self.sign(), other.sign()) {
            (Some(a), Some(b)) => wide.within(a == b),
            _ => wide,
        }
    }

    /// Returns the part of the interval with this sign.
    pub fn within(self, positive: bool) -> Self {
        match positive {
            _ if self.is_empty() => self,
            true => Self { low: self.low.max(0.0), ..self },
            false => Self { high: self.high.min(0.0), ..self },
        }
    }

    /// Computes x².
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

    /// Applies an increasing function that is defined above `least`.
    fn rising(self, least: f64, f: impl Fn(f64) -> f64) -> Self {
        if self.high < least {
            return Self::EMPTY;
        }
        let (low, high) = (f(self.low.max(least)), f(self.high));
        let once = Self::outward(low, high);
        Self::outward(once.low, once.high)
    }

    /// Computes f(x).
    pub fn unary(self, function: Function) -> Self {
        match function {
            Function::Neg => self.negated(),
            Function::Abs => self.modulus(),
            Function::Recip => self.reciprocal(),
            Function::Sqrt => self.rising(0.0, f64::sqrt).within(true),
            Function::Exp => self.rising(f64::NEG_INFINITY, libm::exp).within(true),
            Function::Ln => self.rising(0.0, libm::log),
            Function::Sin => self.sine(),
            Function::Cos => self.plus(Self::outward(FRAC_PI_2, FRAC_PI_2)).sine(),
            Function::Atan => self.rising(f64::NEG_INFINITY, libm::atan),
        }
    }

    /// Computes sin x.
    fn sine(self) -> Self {
        /// Largest argument that is reduced to one turn.
        const FAR: f64 = 1e6;
        /// More than the rounding of the turns of an argument below that.
        const SLACK: f64 = 1e-8;
        let Self { low, high } = self;
        if self.is_empty() {
            return self;
        }
        if !(low >= -FAR && high <= FAR) {
            return Self::SIGN;
        }
        let ends = [libm::sin(low), libm::sin(high)];
        let once = Self::outward(ends[0].min(ends[1]), ends[0].max(ends[1]));
        let mut found = Self::outward(once.low, once.high);
        // Whether an odd quarter of a turn lies inside: 1 of 4 for the crest, 3 of 4 for the
        // trough.
        let passes = |quarter: f64| {
            let turns = |x: f64| (x - quarter * FRAC_PI_2) / TAU;
            turns(low - SLACK).ceil() <= turns(high + SLACK).floor()
        };
        if passes(1.0) {
            found.high = 1.0;
        }
        if passes(3.0) {
            found.low = -1.0;
        }
        found.common(Self::SIGN)
    }

    /// Computes x^q.
    pub fn power(self, exponent: &Rational) -> Self {
        /// Largest power that is multiplied out.
        const MOST: u64 = 64;
        match exponent.to_integer() {
            // Roots and powers of positive numbers are positive.
            None if self.high < 0.0 => Self::EMPTY,
            None => Self::POSITIVE,
            Some(n) if n.unsigned_abs() <= MOST => {
                let power = self.whole_power(n.unsigned_abs());
                if n < 0 { power.reciprocal() } else { power }
            }
            Some(n) if n % 2 == 0 => Self::POSITIVE,
            Some(_) => self.sign().map_or(Self::ALL, |positive| Self::ALL.within(positive)),
        }
    }

    /// Computes x^n.
    fn whole_power(self, n: u64) -> Self {
        match n {
            _ if self.is_empty() => self,
            0 => Self { low: 1.0, high: 1.0 },
            n if n % 2 == 0 => self.square().whole_power(n / 2),
            // An odd power increases.
            n => {
                let (low, high) =
                    (Self { high: self.low, ..self }, Self { low: self.high, ..self });
                let end = |x: Self| x.square().whole_power(n / 2).times(x);
                Self { low: end(low).low, high: end(high).high }
            }
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

/// Adds a and b; returns the rounded sum and the sign of the error.
fn sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    if !sum.is_finite() {
        // Beyond all numbers the error is unknown; an infinite end is exact.
        let is_end = a.is_infinite() || b.is_infinite();
        return (sum, if is_end { 0.0 } else { f64::NAN });
    }
    // Knuth's exact error of a sum.
    let part = sum - a;
    (sum, (a - (sum - part)) + (b - part))
}

/// Multiplies a and b; returns the rounded product and the sign of the error. 0 · ∞ is 0, since ∞
/// is not a number of an interval.
fn product(a: f64, b: f64) -> (f64, f64) {
    if a == 0.0 || b == 0.0 {
        return (0.0, 0.0);
    }
    let product = a * b;
    if product.is_infinite() && (a.is_infinite() || b.is_infinite()) {
        return (product, 0.0);
    }
    // The error is exact unless it underflows.
    let is_exact = product.is_finite() && product.abs() > f64::MIN_POSITIVE / f64::EPSILON;
    (product, if is_exact { libm::fma(a, b, -product) } else { f64::NAN })
}

/// Returns the largest f64 known not to exceed the exact value.
fn down((rounded, missing): (f64, f64)) -> f64 {
    if missing >= 0.0 { rounded } else { rounded.next_down() }
}

/// Returns the smallest f64 known not to lie below the exact value.
fn up((rounded, missing): (f64, f64)) -> f64 {
    if missing <= 0.0 { rounded } else { rounded.next_up() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_are_rounded_outwards_and_only_where_they_are_rounded() {
        let between = |low: f64, high: f64| Extent { low, high };
        let two = between(2.0, 2.0);
        assert_eq!(two.plus(between(-2.0, 2.0)), between(0.0, 4.0), "exact ends stay");
        let third = Extent::at(&Rational::new(1, 3));
        assert!(third.low < third.high, "1/3 is no f64");
        let one = third.times(between(3.0, 3.0));
        assert!(one.low <= 1.0 && one.high >= 1.0 && one.low < one.high, "{one:?}");
        let tiny = between(1e-300, 1e-300);
        assert!(tiny.times(tiny).sign() == Some(true) && tiny.square().high > 0.0, "underflow");
        assert_eq!(between(1e300, 1e300).square().high, f64::INFINITY, "overflow");
        assert!(between(1e300, 1e300).square().low < f64::INFINITY, "to both sides");
    }

    #[test]
    fn sines_and_powers_hold_their_values() {
        let modulus = crate::number::prime::Modulus::new((1 << 61) - 1);
        let mut chance = crate::proof::chance::Chance::new(6, 0);
        let mut share = || (chance.element(&modulus) >> 9) as f64 / (1u64 << 52) as f64;
        for round in 0..4000 {
            let low = 40.0 * share() - 20.0;
            let high = low + share() * if round % 2 == 0 { 0.5 } else { 8.0 };
            let extent = Extent { low, high };
            let at = low + share() * (high - low);
            let inside = |extent: Extent, value: f64| {
                extent.low <= value + 1e-12 * value.abs()
                    && value <= extent.high + 1e-12 * value.abs()
            };
            assert!(inside(extent.unary(Function::Sin), at.sin()), "sin {at} in {extent:?}");
            assert!(inside(extent.unary(Function::Cos), at.cos()), "cos {at} in {extent:?}");
            assert!(inside(extent.unary(Function::Atan), at.atan()), "atan {at} in {extent:?}");
            for n in [-3, -2, -1, 0, 1, 2, 3, 5, 8, 13] {
                let power = extent.power(&Rational::from(n));
                assert!(inside(power, at.powi(n as i32)), "{at}^{n} in {extent:?}: {power:?}");
            }
        }
        let narrow = Extent { low: 0.3, high: 1.0 };
        assert!(narrow.unary(Function::Cos).low > 0.54, "cos is positive from 0.3 to 1");
        let odd = Extent { low: -2.0, high: 3.0 }.power(&Rational::from(3));
        assert!(odd.low >= -8.0 - 1e-12 && odd.high <= 27.0 + 1e-12, "{odd:?}");
    }

    #[test]
    fn random_results_lie_inside() {
        use crate::number::exact::square_root;
        let modulus = crate::number::prime::Modulus::new((1 << 61) - 1);
        let mut chance = crate::proof::chance::Chance::new(5, 0);
        let mut number = || {
            let drawn = modulus.to_integer(chance.element(&modulus));
            let (mantissa, exponent) = ((drawn >> 8) as i64 - (1 << 52), (drawn & 63) as i32 - 40);
            libm::scalbn(mantissa as f64, exponent)
        };
        let exact = |x: f64| Rational::from_f64(x).expect("finite");
        for _ in 0..5000 {
            let (x, y) = (number(), number());
            let (a, b) = (Extent { low: x, high: x }, Extent { low: y, high: y });
            let inside = |extent: Extent, value: Rational| {
                exact(extent.low) <= value && value <= exact(extent.high)
            };
            assert!(inside(a.plus(b), &exact(x) + &exact(y)), "{x} + {y}");
            assert!(inside(a.times(b), &exact(x) * &exact(y)), "{x} · {y}");
            assert!(inside(a.square(), &exact(x) * &exact(x)), "{x}²");
            if let Some(inverse) = exact(x).recip() {
                assert!(inside(a.reciprocal(), inverse), "1/{x}");
            }
            let square = &exact(x) * &exact(x);
            let (root, (near, _)) = (square_root(&square), square.to_f64());
            let of = Extent { low: near.next_down(), high: near.next_up() };
            assert!(inside(of.unary(Function::Sqrt), root.expect("a square")), "√{x}²");
        }
    }
}
