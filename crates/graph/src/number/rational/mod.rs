//! Exact rational numbers: the values of decimals and fractions in a case file.
//!
//! `0.1` is 1/10 and stays so until a number domain asks for its own image of it.

mod divisor;
mod operators;
mod text;

#[cfg(test)]
mod tests;

pub use divisor::common_divisor;
pub use text::RationalError;

use num_bigint::{BigInt, Sign};
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{Pow, Signed, ToPrimitive};

/// An exact rational number of any size.
///
/// Numbers of the size people type are kept in machine words: thousands of them are drawn, folded
/// and enclosed before the first state is reached.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Rational(Repr);

/// In lowest terms with a positive denominator; `Small` whenever both parts fit.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
enum Repr {
    Small(i64, i64),
    Big(Box<BigRational>),
}

impl Rational {
    /// Makes the fraction `numerator / denominator`; the denominator must not be zero.
    pub fn new(numerator: i64, denominator: i64) -> Self {
        assert!(denominator != 0, "a fraction needs a non-zero denominator");
        Self::reduced(i128::from(numerator), i128::from(denominator))
    }

    /// Reduces `n/d` to lowest terms, d ≠ 0.
    fn reduced(n: i128, d: i128) -> Self {
        // 128-bit division is a function call; most numbers do not need it.
        if let (Ok(n), Ok(d)) = (i64::try_from(n), i64::try_from(d))
            && n > i64::MIN
            && d > i64::MIN
        {
            let common = n.gcd(&d) * d.signum();
            return Self(Repr::Small(n / common, d / common));
        }
        let common = n.gcd(&d) * d.signum();
        match (i64::try_from(n / common), i64::try_from(d / common)) {
            (Ok(n), Ok(d)) => Self(Repr::Small(n, d)),
            _ => {
                let [n, d] = [n, d].map(|part| BigInt::from(part / common));
                Self(Repr::Big(Box::new(BigRational::new_raw(n, d))))
            }
        }
    }

    /// Makes the fraction of two integers of any size; the denominator must not be zero.
    pub fn from_parts(numerator: BigInt, denominator: BigInt) -> Self {
        assert!(denominator.sign() != Sign::NoSign, "a fraction needs a non-zero denominator");
        let common = common_divisor(&numerator, &denominator);
        let common = if denominator.is_negative() { -common } else { common };
        Self::from_big(BigRational::new_raw(numerator / &common, denominator / common))
    }

    /// Takes a fraction in lowest terms.
    fn from_big(value: BigRational) -> Self {
        match (value.numer().to_i64(), value.denom().to_i64()) {
            (Some(n), Some(d)) => Self(Repr::Small(n, d)),
            _ => Self(Repr::Big(Box::new(value))),
        }
    }

    fn to_big(&self) -> BigRational {
        match &self.0 {
            Repr::Small(n, d) => BigRational::new_raw((*n).into(), (*d).into()),
            Repr::Big(value) => (**value).clone(),
        }
    }

    /// Returns the exact value of a finite f64 (a dyadic rational); `None` for NaN and infinities.
    pub fn from_f64(value: f64) -> Option<Self> {
        const FRACTION: u32 = f64::MANTISSA_DIGITS - 1;
        let exponent = (value.to_bits() >> FRACTION & 0x7ff) as i32;
        let mantissa = (value.to_bits() & ((1 << FRACTION) - 1) | 1 << FRACTION) as i64;
        // value = ±mantissa 2^power, with an odd mantissa; 0, subnormal and infinite apart.
        let power = exponent - 1075 + mantissa.trailing_zeros() as i32;
        if (1..0x7ff).contains(&exponent) && (-62..=10).contains(&power) {
            let odd = mantissa >> mantissa.trailing_zeros();
            let signed = if value < 0.0 { -odd } else { odd };
            return Some(Self(match power {
                0.. => Repr::Small(signed << power, 1),
                _ => Repr::Small(signed, 1 << -power),
            }));
        }
        dyadic(value).map(Self::from_big)
    }

    /// Returns the nearest f64, and whether it is exact.
    pub fn to_f64(&self) -> (f64, bool) {
        const EXACT: u64 = 1 << f64::MANTISSA_DIGITS;
        match &self.0 {
            // Both parts are f64s, and division rounds correctly: exact only for powers of two.
            Repr::Small(n, d) if n.unsigned_abs() <= EXACT && d.unsigned_abs() <= EXACT => {
                ((*n as f64) / (*d as f64), d.count_ones() == 1)
            }
            _ => {
                let value = self.to_big();
                let nearest = value.to_f64().unwrap_or(f64::NAN);
                // Both are in lowest terms.
                let is_same = |back: BigRational| {
                    (back.numer(), back.denom()) == (value.numer(), value.denom())
                };
                let exact = dyadic(nearest).is_some_and(is_same);
                (nearest, exact)
            }
        }
    }

    /// Returns the number as a machine integer, if it is one.
    pub fn to_integer(&self) -> Option<i64> {
        match self.0 {
            Repr::Small(n, 1) => Some(n),
            _ => None,
        }
    }

    /// Returns numerator and denominator where both fit a machine word.
    pub fn small_parts(&self) -> Option<(i64, i64)> {
        match self.0 {
            Repr::Small(n, d) => Some((n, d)),
            Repr::Big(_) => None,
        }
    }

    /// Returns numerator and denominator in lowest terms, the denominator positive.
    pub fn parts(&self) -> (BigInt, BigInt) {
        self.to_big().into()
    }

    /// Number of bits needed to write numerator and denominator.
    pub fn bits(&self) -> u64 {
        self.part_bits().iter().sum()
    }

    /// Numbers of bits needed to write the numerator, and the denominator.
    pub fn part_bits(&self) -> [u64; 2] {
        let bits = |x: i64| u64::from(64 - x.unsigned_abs().leading_zeros());
        match &self.0 {
            Repr::Small(n, d) => [bits(*n), bits(*d)],
            Repr::Big(value) => [value.numer().bits(), value.denom().bits()],
        }
    }

    /// Whether the number is 0.
    pub fn is_zero(&self) -> bool {
        matches!(self.0, Repr::Small(0, _))
    }

    /// Whether the number is 1.
    pub fn is_one(&self) -> bool {
        matches!(self.0, Repr::Small(1, 1))
    }

    /// Whether the number is below 0.
    pub fn is_negative(&self) -> bool {
        match &self.0 {
            Repr::Small(n, _) => *n < 0,
            Repr::Big(value) => value.is_negative(),
        }
    }

    /// Returns the absolute value.
    pub fn abs(&self) -> Self {
        if self.is_negative() { -self } else { self.clone() }
    }

    /// Computes `1/x`, or `None` for 0.
    pub fn recip(&self) -> Option<Self> {
        match &self.0 {
            Repr::Small(0, _) => None,
            Repr::Small(n, d) => Some(Self::reduced(i128::from(*d), i128::from(*n))),
            Repr::Big(value) => Some(Self::from_big(value.recip())),
        }
    }

    /// Computes `x^n`, or `None` for 0 to a negative power.
    pub fn powi(&self, exponent: i32) -> Option<Self> {
        (exponent >= 0 || !self.is_zero())
            .then(|| Self::from_big(Pow::pow(&self.to_big(), exponent)))
    }
}

/// Returns the value of a finite f64 in lowest terms, which needs no common divisor.
fn dyadic(value: f64) -> Option<BigRational> {
    const FRACTION: u32 = f64::MANTISSA_DIGITS - 1;
    let bits = value.to_bits();
    let (exponent, fraction) = ((bits >> FRACTION & 0x7ff) as i32, bits & ((1 << FRACTION) - 1));
    let (mantissa, power) = match exponent {
        0x7ff => return None,
        0 if fraction == 0 => return Some(BigRational::from_integer(BigInt::ZERO)),
        0 => (fraction, -1074),
        _ => (fraction | 1 << FRACTION, exponent - 1075),
    };
    let twos = mantissa.trailing_zeros();
    let odd = (mantissa >> twos) as i64;
    let (odd, power) = (BigInt::from(if value < 0.0 { -odd } else { odd }), power + twos as i32);
    Some(match power {
        0.. => BigRational::from_integer(odd << power),
        _ => BigRational::new_raw(odd, BigInt::from(1) << -power),
    })
}

impl From<i64> for Rational {
    fn from(value: i64) -> Self {
        Self(Repr::Small(value, 1))
    }
}
