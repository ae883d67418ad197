//! Single enclosures: midpoint and radius, with the rules of the ball domain.

use std::ops::{Add, Mul, Neg, Sub};

use liouville::number::ball::{Ball, Balls};
use liouville::number::rational::Rational;
use liouville::number::{BinaryOperation, Domain, UnaryFunction};

/// Real number within `rad` of `mid`; a radius that is not finite encloses nothing known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Enclosure {
    /// Midpoint.
    pub mid: f64,
    /// Radius.
    pub rad: f64,
}

impl Enclosure {
    /// The number 0.
    pub const ZERO: Self = Self { mid: 0.0, rad: 0.0 };

    /// Encloses an f64, which is exact.
    pub fn exact(mid: f64) -> Self {
        Self { mid, rad: 0.0 }
    }

    /// Encloses an exact number.
    pub fn of(value: &Rational) -> Self {
        Self::first(&Ball::<1>.constant(value))
    }

    /// Encloses all numbers within `rad` of an f64.
    pub fn about(mid: f64, rad: f64) -> Self {
        Self { mid, rad }
    }

    /// Lane 0 of a block.
    pub fn first(block: &Balls<1>) -> Self {
        Self { mid: block.mid[0], rad: block.rad[0] }
    }

    /// The enclosure as a block of one lane.
    pub fn block(self) -> Balls<1> {
        Balls::new([self.mid], [self.rad])
    }

    /// Upper bound of the magnitude.
    pub fn magnitude(self) -> f64 {
        raised(self.mid.abs() + self.rad, 1)
    }

    /// Whether the enclosure is finite.
    pub fn is_finite(self) -> bool {
        self.mid.is_finite() && self.rad.is_finite()
    }

    /// Whether all numbers of the enclosure are positive.
    pub fn is_positive(self) -> bool {
        self.is_finite() && self.mid > self.rad
    }

    /// Whether all numbers of the enclosure lie in another.
    pub fn is_within(self, other: Self) -> bool {
        let gap = raised((self.mid - other.mid).abs() + self.rad, 4);
        gap <= other.rad || (self.mid == other.mid && self.rad <= other.rad)
    }

    /// Encloses the union of two enclosures.
    pub fn hull(self, other: Self) -> Self {
        if !self.is_finite() || !other.is_finite() {
            return Self { mid: f64::NAN, rad: f64::NAN };
        }
        let mid = self.mid + (other.mid - self.mid) / 2.0;
        let reach =
            |x: Self| (mid - x.mid).abs() + x.rad + f64::EPSILON * (mid.abs() + x.mid.abs());
        Self { mid, rad: raised(reach(self).max(reach(other)), 4) }
    }

    /// Encloses the exponentials.
    pub fn exp(self) -> Self {
        let mut out = Balls::new([0.0], [0.0]);
        Ball::<1>.unary(UnaryFunction::Exp, &self.block(), &mut out);
        Self::first(&out)
    }

    /// Encloses the reciprocals; not finite where 0 is among the numbers.
    pub fn recip(self) -> Self {
        let mut out = Balls::new([0.0], [0.0]);
        Ball::<1>.unary(UnaryFunction::Recip, &self.block(), &mut out);
        Self::first(&out)
    }

    fn combined(self, operation: BinaryOperation, other: Self) -> Self {
        let mut out = Balls::new([0.0], [0.0]);
        Ball::<1>.binary(operation, &self.block(), &other.block(), &mut out);
        Self::first(&out)
    }
}

impl Add for Enclosure {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.combined(BinaryOperation::Add, other)
    }
}

impl Sub for Enclosure {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.combined(BinaryOperation::Sub, other)
    }
}

impl Mul for Enclosure {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        self.combined(BinaryOperation::Mul, other)
    }
}

impl Neg for Enclosure {
    type Output = Self;
    fn neg(self) -> Self {
        Self { mid: -self.mid, ..self }
    }
}

/// Bounds from above a sum of at most `terms` products of non-negative numbers, computed in f64.
///
/// Each of the roundings, at most 2 `terms`, changes the sum by less than half of `EPSILON`, and
/// underflow by less than `MIN_POSITIVE` in all.
#[inline(always)]
pub fn raised(sum: f64, terms: usize) -> f64 {
    sum * (1.0 + (terms as f64 + 8.0) * f64::EPSILON) + f64::MIN_POSITIVE
}

/// Bounds the rounding error of Σ a_k b_k over `terms` terms, computed in f64, where
/// `size` ≥ Σ |a_k b_k|: γ size with γ = n u/(1 - n u).
#[inline(always)]
pub fn rounding(size: f64, terms: usize) -> f64 {
    raised(size * ((terms as f64 + 4.0) * f64::EPSILON / 2.0), 4)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hulls_contain_both() {
        let (a, b) = (Enclosure::about(1.0, 0.25), Enclosure::about(3.0, 0.5));
        let hull = a.hull(b);
        assert!(hull.mid - hull.rad <= 0.75 && hull.mid + hull.rad >= 3.5, "{hull:?}");
        let inside = Enclosure::about(0.0, 4.0).hull(a);
        assert!(inside.mid - inside.rad <= -4.0 && inside.mid + inside.rad >= 4.0, "{inside:?}");
    }

    #[test]
    fn decimals_are_not_their_f64() {
        let tenth = Enclosure::of(&Rational::new(1, 10));
        assert!(tenth.rad > 0.0 && tenth.rad < 1e-16, "{tenth:?}");
        assert_eq!(Enclosure::of(&Rational::new(1, 4)).rad, 0.0, "exact in binary");
    }
}
