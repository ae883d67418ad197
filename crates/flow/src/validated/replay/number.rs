//! Numbers in balls of many bits; an operation without a value gives an unknown number.

use crate::validated::enclosure::{Enclosure, raised};
use liouville::number::arb::{Approximation, ArbBall};
use liouville::number::rational::Rational;
use liouville::number::{BinaryOperation, Domain, UnaryFunction};

/// Bits of a midpoint.
const REPLAY_BITS: u32 = 256;
/// Bits of a bound, for which the size matters alone.
const FEW: u32 = 64;

/// Domain of the numbers.
pub fn domain() -> ArbBall {
    ArbBall::new(REPLAY_BITS)
}

/// Numbers of a replay: balls, or unknown numbers.
pub trait ReplayNumber: Clone + Send + Sync {
    /// Number of an f64.
    fn exact(x: f64) -> Self;
    /// Encloses an exact number.
    fn of(value: &Rational) -> Self;
    /// A number that is not known.
    fn unknown() -> Self;
    /// Encloses x + y.
    fn plus(&self, other: &Self) -> Self;
    /// Encloses x y.
    fn times(&self, other: &Self) -> Self;
    /// Encloses -x.
    fn neg(&self) -> Self;
    /// Encloses 1/x.
    fn recip(&self) -> Self;
    /// Encloses f(x).
    fn apply(&self, function: UnaryFunction) -> Self;
    /// Encloses x^q.
    fn power(&self, exponent: &Rational) -> Self;
    /// Whether the number is exactly 0.
    fn is_zero(&self) -> bool;
    /// Whether the number is known.
    fn is_known(&self) -> bool;
    /// Whether all numbers of the ball are positive.
    fn is_positive(&self) -> bool;
    /// Largest magnitude of the ball, as an exact number or one slightly above.
    fn magnitude(&self) -> Self;
    /// Encloses all numbers whose magnitude is at most that of a bound.
    fn within(bound: &Self) -> Self;
    /// Midpoint, near enough for what is not proved.
    fn mid(&self) -> f64;

    /// The number 0.
    fn zero() -> Self {
        Self::exact(0.0)
    }

    /// Encloses x - y.
    fn minus(&self, other: &Self) -> Self {
        self.plus(&other.neg())
    }

    /// Encloses x + y of two bounds.
    fn add(&self, other: &Self) -> Self {
        self.plus(other)
    }

    /// Encloses x y of two bounds.
    fn mul(&self, other: &Self) -> Self {
        self.times(other)
    }

    /// Whether x < y for all numbers of both balls.
    fn is_below(&self, other: &Self) -> bool {
        other.minus(self).is_positive()
    }

    /// Bounds both of two bounds.
    fn larger(&self, other: &Self) -> Self {
        match (self.is_below(other), other.is_below(self)) {
            (true, _) => other.clone(),
            (_, true) => self.clone(),
            _ => self.magnitude().add(&other.minus(self).magnitude()),
        }
    }
}

/// Ball of 256 bits, or an unknown number.
#[derive(Clone, Debug)]
pub struct Wide(Option<Approximation>);

impl Wide {
    /// Encloses all numbers within `rad` of an f64.
    pub fn about(mid: f64, rad: f64) -> Self {
        Self(Approximation::from_double_double(mid, 0.0, rad).filter(|_| rad >= 0.0))
    }

    /// Block of the domain.
    pub fn block(&self) -> Option<Approximation> {
        self.0.clone()
    }

    /// Number of a block.
    pub fn from_block(block: Option<Approximation>) -> Self {
        Self(block)
    }

    fn binary(&self, operation: BinaryOperation, other: &Self, bits: u32) -> Self {
        let mut out = None;
        ArbBall::new(bits).binary(operation, &self.0, &other.0, &mut out);
        Self(out)
    }

    /// Encloses the numbers of both balls.
    pub fn hull(&self, other: &Self) -> Self {
        // The smaller ball is within |x - y| and its radius of the other midpoint.
        self.plus(&Self::within(&other.minus(self)))
    }

    /// Enclosure in f64.
    pub fn enclosure(&self) -> Enclosure {
        let unknown = (f64::NAN, f64::NAN);
        let (mid, rad) = self.0.as_ref().map_or(unknown, Approximation::enclosure);
        Enclosure { mid, rad }
    }
}

impl ReplayNumber for Wide {
    fn exact(x: f64) -> Self {
        Self(Approximation::from_f64(x))
    }

    fn of(value: &Rational) -> Self {
        Self(domain().constant(value))
    }

    fn unknown() -> Self {
        Self(None)
    }

    fn plus(&self, other: &Self) -> Self {
        self.binary(BinaryOperation::Add, other, REPLAY_BITS)
    }

    fn times(&self, other: &Self) -> Self {
        self.binary(BinaryOperation::Mul, other, REPLAY_BITS)
    }

    fn neg(&self) -> Self {
        self.apply(UnaryFunction::Neg)
    }

    fn recip(&self) -> Self {
        self.apply(UnaryFunction::Recip)
    }

    fn apply(&self, function: UnaryFunction) -> Self {
        let mut out = None;
        domain().unary(function, &self.0, &mut out);
        Self(out)
    }

    fn power(&self, exponent: &Rational) -> Self {
        let mut out = None;
        domain().power(&self.0, exponent, &mut out);
        Self(out)
    }

    fn is_zero(&self) -> bool {
        self.0.as_ref().is_some_and(Approximation::is_zero)
    }

    fn is_known(&self) -> bool {
        self.0.is_some()
    }

    fn is_positive(&self) -> bool {
        self.0.as_ref().is_some_and(Approximation::is_positive)
    }

    fn magnitude(&self) -> Self {
        let Some(value) = &self.0 else { return Self(None) };
        let (mantissa, exponent, radius) = value.parts();
        let size = Approximation::exact(mantissa.magnitude().clone().into(), exponent);
        let radius = Approximation::exact(radius.into(), exponent);
        Self(Some(size.add(&radius, FEW)))
    }

    fn within(bound: &Self) -> Self {
        let Some(size) = bound.magnitude().0 else { return Self(None) };
        let (mid, rad) = size.enclosure();
        Self::about(0.0, raised(mid + rad, 2))
    }

    fn mid(&self) -> f64 {
        self.0.as_ref().map_or(f64::NAN, |value| value.enclosure().0)
    }

    fn minus(&self, other: &Self) -> Self {
        self.binary(BinaryOperation::Sub, other, REPLAY_BITS)
    }

    fn add(&self, other: &Self) -> Self {
        self.binary(BinaryOperation::Add, other, FEW)
    }

    fn mul(&self, other: &Self) -> Self {
        self.binary(BinaryOperation::Mul, other, FEW)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether a number lies in a ball.
    fn holds(ball: &Wide, x: f64) -> bool {
        let x = ball.enclosure().mid - x;
        x.abs() <= ball.enclosure().rad
    }

    #[test]
    fn bounds_and_hulls_contain_what_they_should() {
        let (a, b) = (Wide::about(1.0, 0.25), Wide::about(3.0, 0.5));
        let hull = a.hull(&b);
        assert!(holds(&hull, 0.75) && holds(&hull, 3.5), "{hull:?}");
        let inside = Wide::about(0.0, 4.0).hull(&a);
        assert!(holds(&inside, -4.0) && holds(&inside, 4.0), "{inside:?}");
        let size = Wide::about(-3.0, 0.5).magnitude();
        assert!(size.enclosure().mid >= 3.5, "{size:?}");
        let around = Wide::within(&size);
        assert!(holds(&around, 3.5) && holds(&around, -3.5) && !holds(&around, 3.6), "{around:?}");
        assert!(!Wide::about(1.0, f64::NAN).is_known() && !Wide::about(1.0, -1.0).is_known());
        assert!(!Wide::unknown().is_below(&b) && !b.is_below(&Wide::unknown()));
        assert!(a.is_below(&b) && !b.is_below(&a) && !a.is_below(&a));
    }
}
