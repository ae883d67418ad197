//! Exact rational numbers: the values of decimals and fractions in a case file.
//!
//! `0.1` is 1/10 and stays so until a number domain asks for its own image of it.

use std::cmp::Ordering;
use std::fmt;
use std::str::FromStr;

use num_bigint::{BigInt, Sign};
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{Pow, Signed, ToPrimitive};

/// Largest power of ten in a literal; beyond it no f64 could hold the value.
const MAX_EXPONENT: i64 = 1000;
/// Length of the longest literal that is read; exact arithmetic on longer ones costs more than any
/// case needs.
const MAX_DIGITS: usize = 4000;

/// An exact rational number of any size.
///
/// Numbers of the size people type are kept in machine words: thousands of them are drawn, folded
/// and enclosed before the first state is reached.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Rational(Form);

/// In lowest terms with a positive denominator; `Small` whenever both parts fit.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
enum Form {
    Small(i64, i64),
    Big(Box<BigRational>),
}

/// The reason why a text is not a number.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RationalError {
    /// Not of the form `12`, `-0.5`, `1e-3` or `3/7`.
    #[error("`{0}` is not a number: write 12, -0.5, 1e-3 or 3/7")]
    Malformed(String),
    /// A zero denominator, as in `1/0`.
    #[error("`{0}` divides by zero")]
    ZeroDenominator(String),
    /// An exponent past ±1000 or more than 4000 digits.
    #[error(
        "this number is too long: at most {MAX_DIGITS} digits and exponents within ±{MAX_EXPONENT}"
    )]
    TooLong,
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
            return Self(Form::Small(n / common, d / common));
        }
        let common = n.gcd(&d) * d.signum();
        match (i64::try_from(n / common), i64::try_from(d / common)) {
            (Ok(n), Ok(d)) => Self(Form::Small(n, d)),
            _ => Self(Form::Big(Box::new(BigRational::new(n.into(), d.into())))),
        }
    }

    /// Makes the fraction of two integers of any size; the denominator must not be zero.
    pub fn from_parts(numerator: BigInt, denominator: BigInt) -> Self {
        assert!(denominator.sign() != Sign::NoSign, "a fraction needs a non-zero denominator");
        Self::from_big(BigRational::new(numerator, denominator))
    }

    fn from_big(value: BigRational) -> Self {
        match (value.numer().to_i64(), value.denom().to_i64()) {
            (Some(n), Some(d)) => Self(Form::Small(n, d)),
            _ => Self(Form::Big(Box::new(value))),
        }
    }

    fn to_big(&self) -> BigRational {
        match &self.0 {
            Form::Small(n, d) => BigRational::new_raw((*n).into(), (*d).into()),
            Form::Big(value) => (**value).clone(),
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
                0.. => Form::Small(signed << power, 1),
                _ => Form::Small(signed, 1 << -power),
            }));
        }
        BigRational::from_float(value).map(Self::from_big)
    }

    /// Returns the nearest f64, and whether it is exact.
    pub fn to_f64(&self) -> (f64, bool) {
        const EXACT: u64 = 1 << f64::MANTISSA_DIGITS;
        match &self.0 {
            // Both parts are f64s, and division rounds correctly: exact only for powers of two.
            Form::Small(n, d) if n.unsigned_abs() <= EXACT && d.unsigned_abs() <= EXACT => {
                ((*n as f64) / (*d as f64), d.count_ones() == 1)
            }
            _ => {
                let value = self.to_big();
                let nearest = value.to_f64().unwrap_or(f64::NAN);
                let exact = BigRational::from_float(nearest).is_some_and(|back| back == value);
                (nearest, exact)
            }
        }
    }

    /// Returns the number as a machine integer, if it is one.
    pub fn to_integer(&self) -> Option<i64> {
        match self.0 {
            Form::Small(n, 1) => Some(n),
            _ => None,
        }
    }

    /// Returns numerator and denominator where both fit a machine word.
    pub fn small_parts(&self) -> Option<(i64, i64)> {
        match self.0 {
            Form::Small(n, d) => Some((n, d)),
            Form::Big(_) => None,
        }
    }

    /// Returns numerator and denominator in lowest terms, the denominator positive.
    pub fn parts(&self) -> (BigInt, BigInt) {
        self.to_big().into()
    }

    /// Number of bits needed to write numerator and denominator.
    pub fn bits(&self) -> u64 {
        let bits = |x: i64| u64::from(64 - x.unsigned_abs().leading_zeros());
        match &self.0 {
            Form::Small(n, d) => bits(*n) + bits(*d),
            Form::Big(value) => value.numer().bits() + value.denom().bits(),
        }
    }

    /// Whether the number is 0.
    pub fn is_zero(&self) -> bool {
        matches!(self.0, Form::Small(0, _))
    }

    /// Whether the number is 1.
    pub fn is_one(&self) -> bool {
        matches!(self.0, Form::Small(1, 1))
    }

    /// Whether the number is below 0.
    pub fn is_negative(&self) -> bool {
        match &self.0 {
            Form::Small(n, _) => *n < 0,
            Form::Big(value) => value.is_negative(),
        }
    }

    /// Returns the absolute value.
    pub fn abs(&self) -> Self {
        if self.is_negative() { -self } else { self.clone() }
    }

    /// Computes `1/x`, or `None` for 0.
    pub fn recip(&self) -> Option<Self> {
        match &self.0 {
            Form::Small(0, _) => None,
            Form::Small(n, d) => Some(Self::reduced(i128::from(*d), i128::from(*n))),
            Form::Big(value) => Some(Self::from_big(value.recip())),
        }
    }

    /// Computes `x^n`, or `None` for 0 to a negative power.
    pub fn powi(&self, exponent: i32) -> Option<Self> {
        (exponent >= 0 || !self.is_zero())
            .then(|| Self::from_big(Pow::pow(&self.to_big(), exponent)))
    }
}

macro_rules! operators {
    ($($trait:ident $method:ident $checked:expr;)*) => {$(
        impl std::ops::$trait for &Rational {
            type Output = Rational;
            fn $method(self, other: &Rational) -> Rational {
                if let (Form::Small(a, b), Form::Small(c, d)) = (&self.0, &other.0) {
                    let [a, b, c, d] = [*a, *b, *c, *d].map(i128::from);
                    // Products of 64-bit parts fit 127 bits; only a sum of two may overflow.
                    if let Some((n, d)) = $checked(a, b, c, d) {
                        return Rational::reduced(n, d);
                    }
                }
                Rational::from_big(std::ops::$trait::$method(self.to_big(), other.to_big()))
            }
        }
    )*};
}

operators! {
    Add add |a: i128, b: i128, c: i128, d: i128| {
        (a * d).checked_add(c * b).map(|n| (n, b * d))
    };
    Sub sub |a: i128, b: i128, c: i128, d: i128| {
        (a * d).checked_sub(c * b).map(|n| (n, b * d))
    };
    Mul mul |a: i128, b: i128, c: i128, d: i128| Some((a * c, b * d));
}

impl std::ops::Neg for &Rational {
    type Output = Rational;
    fn neg(self) -> Rational {
        match &self.0 {
            Form::Small(n, d) => Rational::reduced(-i128::from(*n), i128::from(*d)),
            Form::Big(value) => Rational::from_big(-&**value),
        }
    }
}

impl Ord for Rational {
    fn cmp(&self, other: &Self) -> Ordering {
        match (&self.0, &other.0) {
            (Form::Small(a, b), Form::Small(c, d)) => {
                (i128::from(*a) * i128::from(*d)).cmp(&(i128::from(*c) * i128::from(*b)))
            }
            _ => self.to_big().cmp(&other.to_big()),
        }
    }
}

impl PartialOrd for Rational {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl From<i64> for Rational {
    fn from(value: i64) -> Self {
        Self(Form::Small(value, 1))
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
    Ok(Rational::from_big(BigRational::from_integer(integer * sign) * scale))
}

/// Largest number of decimal places in a printed terminating decimal.
const MAX_PLACES: u32 = 6;

impl fmt::Display for Rational {
    /// Prints a terminating decimal of up to six places as a decimal, anything else as a fraction.
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (n, d) = match &self.0 {
            Form::Small(n, d) => (i128::from(*n), *d),
            Form::Big(value) if value.is_integer() => return write!(out, "{}", value.numer()),
            Form::Big(value) => return write!(out, "{}/{}", value.numer(), value.denom()),
        };
        // n/d = (n 10^k/d)/10^k is a decimal of k places when d divides 10^k.
        match (0..=MAX_PLACES).find(|places| 10i64.pow(*places) % d == 0) {
            None => write!(out, "{n}/{d}"),
            Some(0) => write!(out, "{n}"),
            Some(places) => {
                let scale = i128::from(10i64.pow(places));
                let digits = (n.abs() * (scale / i128::from(d))) as u128;
                let (whole, fraction) = (digits / scale as u128, digits % scale as u128);
                let sign = if n < 0 { "-" } else { "" };
                write!(out, "{sign}{whole}.{fraction:0>width$}", width = places as usize)
            }
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
    fn numbers_of_f64_are_what_their_bits_say() {
        let mut bits = 1u64;
        let random = std::iter::repeat_with(|| {
            bits = bits.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            f64::from_bits(bits)
        });
        let near_one = (0..4000).map(|k| (f64::from(k) - 2000.0) / f64::from(k % 64 + 1));
        let ends = [0.0, -0.0, 5e-324, f64::MIN_POSITIVE, f64::MAX, 2f64.powi(63), 2f64.powi(-62)];
        let beyond = [2f64.powi(62), -(2f64.powi(63)), 2f64.powi(-63), 3.0 * 2f64.powi(-62)];
        for value in random.take(4000).chain(near_one).chain(ends).chain(beyond) {
            let slow = BigRational::from_float(value).map(Rational::from_big);
            assert_eq!(Rational::from_f64(value), slow, "{value:e}");
        }
        assert_eq!(Rational::from_f64(f64::INFINITY), None, "no number");
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
    fn small_and_large_parts_agree() {
        let large = read("9223372036854775807");
        let sum = &large + &large;
        assert_eq!(sum.to_string(), "18446744073709551614", "overflow moves to big integers");
        assert_eq!(&sum - &large, large, "and comes back");
        assert_eq!(read("-9223372036854775808").abs().to_string(), "9223372036854775808");
        let tiny = read("1e-30");
        assert_eq!(&(&tiny * &read("1e30")), &Rational::from(1), "products reduce");
        assert!(tiny > Rational::from(0) && tiny < Rational::new(1, i64::MAX), "order is exact");
        assert_eq!(Rational::new(-6, -4), Rational::new(3, 2), "lowest terms, positive below");
    }

    #[test]
    fn rounding_to_f64_knows_when_it_is_exact() {
        assert_eq!(read("0.5").to_f64(), (0.5, true));
        assert_eq!(read("0.1").to_f64(), (0.1, false));
        let odd = (1u64 << 53) + 1;
        assert_eq!(read(&odd.to_string()).to_f64(), ((odd - 1) as f64, false), "ties to even");
    }
}
