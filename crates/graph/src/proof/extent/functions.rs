//! Enclosures of functions and powers.

use std::f64::consts::{FRAC_PI_2, TAU};

use num_traits::{Signed, ToPrimitive};

use crate::number::UnaryFunction;
use crate::number::rational::Rational;

use super::Extent;

impl Extent {
    /// Applies an increasing function that is defined above `least`, and exact at `at`, if anywhere.
    fn rising(self, least: f64, at: Option<f64>, f: impl Fn(f64) -> f64) -> Self {
        if self.high < least {
            return Self::EMPTY;
        }
        let [low, high] = [self.low.max(least), self.high];
        let wide = Self::twice_outward(f(low), f(high));
        Self {
            low: if Some(low) == at { f(low) } else { wide.low },
            high: if Some(high) == at { f(high) } else { wide.high },
        }
    }

    /// Moves two computed ends outwards by two steps.
    fn twice_outward(low: f64, high: f64) -> Self {
        let once = Self::outward(low, high);
        Self::outward(once.low, once.high)
    }

    /// Computes f(x).
    pub fn unary(self, function: UnaryFunction) -> Self {
        match function {
            UnaryFunction::Neg => self.negated(),
            UnaryFunction::Abs => self.modulus(),
            UnaryFunction::Recip => self.reciprocal(),
            UnaryFunction::Sqrt => self.rising(0.0, None, f64::sqrt).within(true),
            UnaryFunction::Exp => self.rising(f64::NEG_INFINITY, Some(0.0), libm::exp).within(true),
            UnaryFunction::Ln => self.rising(0.0, Some(1.0), libm::log),
            UnaryFunction::Sin => self.wave(libm::sin, 1.0),
            UnaryFunction::Cos => self.wave(libm::cos, 0.0),
            UnaryFunction::Atan => self.rising(f64::NEG_INFINITY, Some(0.0), libm::atan),
        }
    }

    /// Computes sin x or cos x, which is 1 at this quarter of a turn.
    fn wave(self, f: fn(f64) -> f64, crest: f64) -> Self {
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
        let at = |x: f64| match x == 0.0 {
            true => Self { low: f(x), high: f(x) },
            false => Self::twice_outward(f(x), f(x)),
        };
        let (start, end) = (at(low), at(high));
        let mut found = Self { low: start.low.min(end.low), high: start.high.max(end.high) };
        let passes = |quarter: f64| {
            let turns = |x: f64| (x - quarter * FRAC_PI_2) / TAU;
            turns(low - SLACK).ceil() <= turns(high + SLACK).floor()
        };
        if passes(crest) {
            found.high = 1.0;
        }
        if passes(crest + 2.0) {
            found.low = -1.0;
        }
        found.common(Self::SIGN)
    }

    /// Computes x^q.
    pub fn power(self, exponent: &Rational) -> Self {
        /// Largest power that is multiplied out.
        const MOST_POWER: u64 = 64;
        match exponent.to_integer() {
            // Roots and powers of positive numbers are positive.
            None if self.high < 0.0 => Self::EMPTY,
            None => self.within(true).fractional_power(exponent).unwrap_or(Self::POSITIVE),
            Some(n) if n.unsigned_abs() <= MOST_POWER => {
                let power = self.whole_power(n.unsigned_abs());
                if n < 0 { power.reciprocal() } else { power }
            }
            Some(n) if n % 2 == 0 => Self::POSITIVE,
            Some(_) => self.sign().map_or(Self::ALL, |positive| Self::ALL.within(positive)),
        }
    }

    /// Computes x^(a/b) of numbers that are not negative; `None` for large a or b.
    fn fractional_power(self, exponent: &Rational) -> Option<Self> {
        /// Largest a and b.
        const MOST: u64 = 64;
        let (above, below) = exponent.parts();
        let (above, below) = (above.abs().to_u64()?, below.to_u64()?);
        if above > MOST || below > MOST {
            return None;
        }
        let end = |x: f64| Self { low: x, high: x }.whole_power(above).root(below);
        let power = Self { low: end(self.low).low, high: end(self.high).high };
        Some(if exponent.is_negative() { power.reciprocal() } else { power })
    }

    /// Encloses the numbers that are not negative and whose n-th power is such a number.
    fn root(self, n: u64) -> Self {
        /// Shares by which an estimate is moved until its power shows that it is a bound.
        const SHARES: [f64; 3] = [1e-15, 1e-12, 1e-6];
        let bound = |x: f64, side: f64| {
            let near = libm::pow(x, 1.0 / n as f64);
            SHARES.into_iter().map(|share| near * (1.0 + side * share)).find(|end| {
                let power = Self { low: *end, high: *end }.whole_power(n);
                if side > 0.0 { power.low >= x } else { power.high <= x }
            })
        };
        let low = if self.low > 0.0 { bound(self.low, -1.0) } else { None };
        let high = if self.high < f64::INFINITY { bound(self.high, 1.0) } else { None };
        Self { low: low.unwrap_or(0.0), high: high.unwrap_or(f64::INFINITY) }
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
}
