//! Exact rational numbers: what a decimal or a fraction in a case file means.
//!
//! `0.1` is 1/10 and stays so until a number domain asks for its own image of it.

use std::fmt;
use std::str::FromStr;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Pow, Signed, ToPrimitive, Zero};

/// Largest power of ten a literal may carry; beyond it no f64 could hold the value.
const MAX_EXPONENT: i64 = 1000;
/// Longest literal that is read; exact arithmetic on longer ones costs more than any case needs.
const MAX_DIGITS: usize = 4000;

/// An exact rational number of any size.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Rational(BigRational);

/// Why a text is not a number.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RationalError {
    /// Not of the form `12`, `-0.5`, `1e-3` or `3/7`.
    #[error("`{0}` is not a number: write 12, -0.5, 1e-3 or 3/7")]
    Malformed(String),
    /// `1/0`.
    #[error("`{0}` divides by zero")]
    ZeroDenominator(String),
    /// An exponent past ±1000 or more than 4000 digits.
    #[error(
        "this number is too long: at most {MAX_DIGITS} digits and exponents within ±{MAX_EXPONENT}"
    )]
    TooLong,
}

impl Rational {
    /// The fraction `numerator / denominator`; the denominator must not be zero.
    pub fn new(numerator: i64, denominator: i64) -> Self {
        assert!(denominator != 0, "a fraction needs a non-zero denominator");
        Self(BigRational::new(numerator.into(), denominator.into()))
    }

    /// The exact value of a finite f64 (a dyadic rational); `None` for NaN and infinities.
    pub fn from_f64(value: f64) -> Option<Self> {
        BigRational::from_float(value).map(Self)
    }

    /// The nearest f64, and whether it is exactly this number.
    pub fn to_f64(&self) -> (f64, bool) {
        let nearest = self.0.to_f64().unwrap_or(f64::NAN);
        let exact = BigRational::from_float(nearest).is_some_and(|back| back == self.0);
        (nearest, exact)
    }

    /// This number as a machine integer, if it is one.
    pub fn to_integer(&self) -> Option<i64> {
        self.0.is_integer().then(|| self.0.to_integer().to_i64()).flatten()
    }

    /// Numerator and denominator in lowest terms, the denominator positive.
    pub fn parts(&self) -> (&BigInt, &BigInt) {
        (self.0.numer(), self.0.denom())
    }

    /// Bits needed to write numerator and denominator.
    pub fn bits(&self) -> u64 {
        self.0.numer().bits() + self.0.denom().bits()
    }

    /// Is this 0?
    pub fn is_zero(&self) -> bool {
        self.0.is_zero()
    }

    /// Is this 1?
    pub fn is_one(&self) -> bool {
        self.0.is_one()
    }

    /// Is this below 0?
    pub fn is_negative(&self) -> bool {
        self.0.is_negative()
    }

    /// The absolute value.
    pub fn abs(&self) -> Self {
        Self(self.0.abs())
    }

    /// `1/x`, or `None` for 0.
    pub fn recip(&self) -> Option<Self> {
        (!self.is_zero()).then(|| Self(self.0.recip()))
    }

    /// `x^n`, or `None` for 0 to a negative power.
    pub fn powi(&self, exponent: i32) -> Option<Self> {
        (exponent >= 0 || !self.is_zero()).then(|| Self(Pow::pow(&self.0, exponent)))
    }
}

macro_rules! operators {
    ($($trait:ident :: $method:ident),*) => {$(
        impl std::ops::$trait for &Rational {
            type Output = Rational;
            fn $method(self, other: &Rational) -> Rational {
                Rational(std::ops::$trait::$method(&self.0, &other.0))
            }
        }
    )*};
}
operators!(Add::add, Sub::sub, Mul::mul);

impl std::ops::Neg for &Rational {
    type Output = Rational;
    fn neg(self) -> Rational {
        Rational(-&self.0)
    }
}

impl From<i64> for Rational {
    fn from(value: i64) -> Self {
        Self(BigRational::from_integer(value.into()))
    }
}

impl FromStr for Rational {
    type Err = RationalError;

    /// Reads `12`, `-0.5`, `1e-3`, `3/7`, with `−` or `-` as the sign and `_` between digits.
    fn from_str(text: &str) -> Result<Self, RationalError> {
        let clean: String = text
            .trim()
            .chars()
            .filter(|c| *c != '_')
            .map(|c| if c == '−' { '-' } else { c })
            .collect();
        if clean.len() > MAX_DIGITS {
            return Err(RationalError::TooLong);
        }
        match clean.split_once('/') {
            None => decimal(&clean, text),
            Some((above, below)) => {
                let below = decimal(below.trim(), text)?;
                let inverse = below
                    .recip()
                    .ok_or_else(|| RationalError::ZeroDenominator(text.to_string()))?;
                Ok(&decimal(above.trim(), text)? * &inverse)
            }
        }
    }
}

fn decimal(clean: &str, text: &str) -> Result<Rational, RationalError> {
    let malformed = || RationalError::Malformed(text.to_string());
    let (mantissa, exponent) = match clean.split_once(['e', 'E']) {
        None => (clean, 0),
        Some((mantissa, exponent)) => (mantissa, exponent.parse::<i64>().map_err(|_| malformed())?),
    };
    if exponent.abs() > MAX_EXPONENT {
        return Err(RationalError::TooLong);
    }
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let (sign, whole) = match whole.strip_prefix(['-', '+']) {
        Some(rest) => (if whole.starts_with('-') { -1 } else { 1 }, rest),
        None => (1, whole),
    };
    let digits = format!("{whole}{fraction}");
    if digits.is_empty() || !digits.bytes().all(|b| b.is_ascii_digit()) {
        return Err(malformed());
    }
    let integer: BigInt = digits.parse().map_err(|_| malformed())?;
    let shift = exponent - fraction.len() as i64;
    let scale = BigRational::from_integer(BigInt::from(10)).pow(shift as i32);
    Ok(Rational(BigRational::from_integer(integer * sign) * scale))
}

impl fmt::Display for Rational {
    /// A terminating decimal of up to six places is written as one, anything else as a fraction.
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let places = (0..=6u32).find(|places| {
            let scale = BigRational::from_integer(BigInt::from(10).pow(*places));
            (&self.0 * scale).is_integer()
        });
        match places {
            Some(0) => write!(out, "{}", self.0.numer()),
            Some(places) => {
                let scaled = (&self.0 * BigRational::from_integer(BigInt::from(10).pow(places)))
                    .to_integer();
                let digits =
                    format!("{:0>width$}", scaled.abs().to_string(), width = places as usize + 1);
                let (whole, fraction) = digits.split_at(digits.len() - places as usize);
                let sign = if scaled.is_negative() { "-" } else { "" };
                write!(out, "{sign}{whole}.{fraction}")
            }
            None => write!(out, "{}/{}", self.0.numer(), self.0.denom()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Rational {
        text.parse().expect("a number")
    }

    #[test]
    fn decimals_are_exact() {
        assert_eq!(read("0.1"), Rational::new(1, 10), "0.1 is 1/10, not the nearest f64");
        assert_eq!(read("-2.50e1"), Rational::from(-25), "exponents shift the point");
        assert_eq!(read("−3/7"), Rational::new(-3, 7), "the typographic minus is a minus");
        assert_eq!(read("1e-3"), Rational::new(1, 1000), "negative exponents divide");
    }

    #[test]
    fn nonsense_is_refused() {
        for text in ["", "-", "1.2.3", "x", "1e", "nan", "inf", "1/", "0x10"] {
            assert!(text.parse::<Rational>().is_err(), "`{text}` is no number");
        }
        assert_eq!("1/0".parse::<Rational>(), Err(RationalError::ZeroDenominator("1/0".into())));
        assert_eq!("1e999999999".parse::<Rational>(), Err(RationalError::TooLong));
    }

    #[test]
    fn printing_reads_back() {
        for text in ["0.125", "-0.05", "3/7", "12", "-1/3", "0.000001", "1/10000000"] {
            let value = read(text);
            assert_eq!(value.to_string(), text, "the shortest exact form");
            assert_eq!(read(&value.to_string()), value, "and it reads back");
        }
    }

    #[test]
    fn rounding_to_f64_knows_when_it_is_exact() {
        assert_eq!(read("0.5").to_f64(), (0.5, true));
        assert_eq!(read("0.1").to_f64(), (0.1, false));
    }
}
