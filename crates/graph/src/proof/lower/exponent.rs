//! Exponents of roots in parts: a whole power, roots of even index, a root of odd index.

use crate::number::rational::Rational;

/// Largest length of a chain of nested square roots of one radicand.
const LONGEST_CHAIN: u32 = 24;

/// An exponent in the form n + i/2^s + j/m with 0 ≤ i < 2^s and 0 ≤ j < m, m odd.
pub struct ExponentParts {
    /// Integer part n.
    pub whole: i64,
    /// Numerator i.
    pub part: i64,
    /// Exponent s.
    pub length: u32,
    /// Odd denominator m.
    pub odd: i64,
    /// Numerator j.
    pub j: i64,
}

impl ExponentParts {
    /// Takes an exponent apart; `None` if its parts are too large.
    pub fn of(exponent: &Rational) -> Option<Self> {
        let (above, below) = exponent.parts();
        let (above, below) = (i64::try_from(&above).ok()?, i64::try_from(&below).ok()?);
        let length = below.trailing_zeros();
        if length > LONGEST_CHAIN || above.abs() > 1 << 40 {
            return None;
        }
        let (even, odd) = (1i64 << length, below >> length);
        if odd > i64::from(i32::MAX) {
            return None;
        }
        let inverse = num_integer::Integer::extended_gcd(&even, &odd).x.rem_euclid(odd);
        let j = (i128::from(above) * i128::from(inverse)).rem_euclid(i128::from(odd)) as i64;
        let r = (above - j * even) / odd;
        let (whole, part) = (r.div_euclid(even), r.rem_euclid(even));
        Some(Self { whole, part, length, odd, j })
    }
}
