//! Rational numbers as text: reading of decimals and fractions, and printing.

use std::fmt;
use std::str::FromStr;

use num_bigint::BigInt;
use num_rational::BigRational;

use super::{Rational, Repr};

/// Largest power of ten in a literal; beyond it no f64 could hold the value.
const MAX_EXPONENT: i64 = 1000;
/// Length of the longest literal that is read; exact arithmetic on longer ones costs more than any
/// case needs.
const MAX_DIGITS: usize = 4000;

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

/// Number of digits, and largest power of ten, of decimals that are read in machine words.
const SHORT: usize = 18;

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
    let shift = exponent - fraction.len() as i64;
    if digits.len() <= SHORT && shift.unsigned_abs() <= SHORT as u64 {
        let integer = sign * digits.parse::<i128>().map_err(|_| malformed())?;
        let scale = 10i128.pow(shift.unsigned_abs() as u32);
        return Ok(match shift {
            0.. => Rational::reduced(integer * scale, 1),
            _ => Rational::reduced(integer, scale),
        });
    }
    let integer: BigInt = digits.parse().map_err(|_| malformed())?;
    let scale = BigRational::from_integer(BigInt::from(10)).pow(shift as i32);
    Ok(Rational::from_big(BigRational::from_integer(integer * sign) * scale))
}

/// Largest number of decimal places in a printed terminating decimal.
const MAX_PLACES: u32 = 6;

impl fmt::Display for Rational {
    /// Prints a terminating decimal of up to six places as a decimal, anything else as a fraction.
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (n, d) = match &self.0 {
            Repr::Small(n, d) => (i128::from(*n), *d),
            Repr::Big(value) if value.is_integer() => return write!(out, "{}", value.numer()),
            Repr::Big(value) => return write!(out, "{}/{}", value.numer(), value.denom()),
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
