//! Double-double numbers: an unevaluated sum hi + lo of two f64, some 32 digits.
//!
//! With u = 2⁻⁵³, relative errors are at most
//!
//! ```text
//! x ± y   3u² + 13u³   (Joldes, Muller, Popescu 2017, algorithm 6)
//! x y     5u²          (the same, algorithm 10)
//! 1/x     18u²         q + q r,  q = fl(1/hi), r = 1 - q x
//! √x      8u²          s + r/2s, s = fl(√hi),  r = x - s²
//! ```
//!
//! as long as no product underflows. [`double_double_ball`](super::double_double_ball) adds radii that cover these
//! errors.

use std::ops::{Add, Mul, Neg, Sub};

use super::arb::{Approximation, ArbBall};
use super::rational::Rational;
use super::{BinaryOperation, Domain, UnaryFunction};

/// Precision in bits of elementary functions.
const ELEMENTARY_BITS: u32 = 140;

/// hi + lo, |lo| at most half a unit in the last place of hi; NaN where undefined.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DoubleDouble {
    /// The nearest f64.
    pub hi: f64,
    /// The remainder.
    pub lo: f64,
}

/// Splits a + b = s + e exactly.
#[inline(always)]
pub fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    let c = s - a;
    (s, (a - (s - c)) + (b - c))
}

/// Splits a + b = s + e exactly, for |a| ≥ |b| or a = 0.
#[inline(always)]
fn quick_two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    (s, b - (s - a))
}

/// Splits a b = p + e exactly, where e does not underflow.
#[inline(always)]
pub fn two_product(a: f64, b: f64) -> (f64, f64) {
    let p = a * b;
    (p, a.mul_add(b, -p))
}

impl DoubleDouble {
    /// The undefined value.
    pub const NAN: Self = Self { hi: f64::NAN, lo: f64::NAN };

    /// Converts an f64 exactly.
    #[inline(always)]
    pub fn from_f64(value: f64) -> Self {
        Self { hi: value, lo: 0.0 }
    }

    /// Returns the nearest pair to an exact number.
    pub fn from_rational(value: &Rational) -> Self {
        let (hi, exact) = value.to_f64();
        let lo = match Rational::from_f64(hi) {
            Some(nearest) if !exact => (value - &nearest).to_f64().0,
            _ => 0.0,
        };
        Self { hi, lo }
    }

    /// Returns the exact value; `None` if it is not finite.
    pub fn to_rational(self) -> Option<Rational> {
        Some(&Rational::from_f64(self.hi)? + &Rational::from_f64(self.lo)?)
    }

    /// Whether both parts are finite.
    #[inline(always)]
    pub fn is_finite(self) -> bool {
        self.hi.is_finite() && self.lo.is_finite()
    }

    /// Computes 1/x.
    #[inline(always)]
    pub fn recip(self) -> Self {
        let q = 1.0 / self.hi;
        let (p, e) = two_product(q, self.hi);
        let r = ((1.0 - p) - e) - q * self.lo;
        let (hi, lo) = quick_two_sum(q, r * q);
        Self { hi, lo }
    }

    /// Computes √x; √0 = 0.
    #[inline(always)]
    pub fn sqrt(self) -> Self {
        let s = self.hi.sqrt();
        let (p, e) = two_product(s, s);
        let r = ((self.hi - p) - e) + self.lo;
        let (hi, lo) = quick_two_sum(s, r / (s + s));
        if self.hi == 0.0 { Self::default() } else { Self { hi, lo } }
    }

    /// Computes an elementary function by way of higher precision.
    pub fn apply(self, function: UnaryFunction) -> Self {
        let domain = ArbBall::new(ELEMENTARY_BITS);
        self.elementary(|x| domain.function(function, x))
    }

    /// Computes x^q.
    pub fn power(self, exponent: &Rational) -> Self {
        let domain = ArbBall::new(ELEMENTARY_BITS);
        self.elementary(|x| domain.rational_power(x, exponent))
    }

    /// Computes x^y for x > 0.
    pub fn power_of(self, exponent: Self) -> Self {
        let domain = ArbBall::new(ELEMENTARY_BITS);
        let exponent = Approximation::from_double_double(exponent.hi, exponent.lo, 0.0);
        self.elementary(|x| domain.power_of(x, exponent.as_ref()?))
    }

    fn elementary(self, f: impl Fn(&Approximation) -> Option<Approximation>) -> Self {
        Approximation::from_double_double(self.hi, self.lo, 0.0).and_then(|x| f(&x)).map_or(
            Self::NAN,
            |value| {
                let (hi, lo, _) = value.to_double_double();
                Self { hi, lo }
            },
        )
    }
}

impl Add for DoubleDouble {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        let (s, e) = two_sum(self.hi, other.hi);
        let (t, f) = two_sum(self.lo, other.lo);
        let (s, e) = quick_two_sum(s, e + t);
        let (hi, lo) = quick_two_sum(s, f + e);
        Self { hi, lo }
    }
}

impl Neg for DoubleDouble {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { hi: -self.hi, lo: -self.lo }
    }
}

impl Sub for DoubleDouble {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let (p, e) = two_product(self.hi, other.hi);
        let (hi, lo) = quick_two_sum(p, e + (self.hi * other.lo + self.lo * other.hi));
        Self { hi, lo }
    }
}

/// The double-double domain, one lane, without error bounds.
#[derive(Clone, Copy, Debug, Default)]
pub struct DoubleDoubles;

impl Domain for DoubleDoubles {
    type Block = DoubleDouble;

    fn constant(&self, value: &Rational) -> DoubleDouble {
        DoubleDouble::from_rational(value)
    }

    fn values(&self, values: &[Rational]) -> DoubleDouble {
        values.first().map_or(DoubleDouble::NAN, DoubleDouble::from_rational)
    }

    #[inline(always)]
    fn unary(&self, function: UnaryFunction, x: &DoubleDouble, out: &mut DoubleDouble) {
        *out = match function {
            UnaryFunction::Neg => -*x,
            UnaryFunction::Recip => x.recip(),
            UnaryFunction::Sqrt => x.sqrt(),
            UnaryFunction::Abs if x.hi < 0.0 => -*x,
            UnaryFunction::Abs => *x,
            UnaryFunction::Exp
            | UnaryFunction::Ln
            | UnaryFunction::Sin
            | UnaryFunction::Cos
            | UnaryFunction::Atan => x.apply(function),
        };
    }

    #[inline(always)]
    fn binary(
        &self,
        operation: BinaryOperation,
        x: &DoubleDouble,
        y: &DoubleDouble,
        out: &mut DoubleDouble,
    ) {
        *out = match operation {
            BinaryOperation::Add => *x + *y,
            BinaryOperation::Sub => *x - *y,
            BinaryOperation::Mul => *x * *y,
            BinaryOperation::Pow => x.power_of(*y),
        };
    }

    fn power(&self, x: &DoubleDouble, exponent: &Rational, out: &mut DoubleDouble) {
        *out = x.power(exponent);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the error of x ∘ y against exact arithmetic, relative and in units of u².
    fn error(found: DoubleDouble, exact: &Rational) -> f64 {
        let found = found.to_rational().expect("finite");
        let difference = (&found - exact).abs().to_f64().0;
        difference / exact.to_f64().0.abs() / (f64::EPSILON / 2.0).powi(2)
    }

    #[test]
    fn operations_keep_their_bounds() {
        let third = Rational::new(1, 3);
        for numerator in 1..200 {
            let (x, y) = (Rational::new(numerator, 7), Rational::new(-11, 3 * numerator + 1));
            let (p, q) = (DoubleDouble::from_rational(&x), DoubleDouble::from_rational(&y));
            let (x, y) = (p.to_rational().expect("finite"), q.to_rational().expect("finite"));
            assert!(error(p + q, &(&x + &y)) <= 3.1, "sum");
            assert!(error(p * q, &(&x * &y)) <= 5.0, "product");
            assert!(error(p.recip(), &x.recip().expect("not 0")) <= 18.0, "reciprocal");
            let root = p.sqrt().to_rational().expect("finite");
            let square = DoubleDouble::from_rational(&(&root * &root));
            assert!(error(square, &x) <= 18.0, "square of the root");
        }
        let cube_root = DoubleDouble::from_rational(&third).power(&third);
        let cube = cube_root * cube_root * cube_root;
        assert!(error(cube, &third) <= 30.0, "power");
    }
}
