//! Decimal digits proved by a ball.

use num_bigint::BigInt;
use num_traits::{Signed, ToPrimitive};

use super::Approximation;

/// Smallest decimal exponent of a number written without one.
const SMALLEST_PLAIN: i64 = -5;

impl Approximation {
    /// Rounds the number to `digits` significant digits, provided that all numbers of the interval
    /// round to the same ones.
    pub fn decimal(&self, digits: usize) -> Option<String> {
        let (mantissa, exponent, radius) = self.parts();
        if self.is_zero() {
            return Some("0".to_string());
        }
        if !self.excludes_zero() || digits == 0 || exponent.abs() > 1 << 20 {
            return None;
        }
        // An estimate of the decimal exponent that is right or one too small.
        let bits = mantissa.bits() as i64 + exponent - 1;
        let mut leading = (bits as f64 * std::f64::consts::LOG10_2).floor() as i64;
        loop {
            let places = digits as i64 - 1 - leading;
            let low = rounded(&(mantissa - radius), exponent, places);
            let high = rounded(&(mantissa + radius), exponent, places);
            if low != high {
                return None;
            }
            let written = low.abs().to_string();
            if written.len() > digits {
                leading += 1;
                continue;
            }
            let sign = if low.is_negative() { "-" } else { "" };
            return Some(format!("{sign}{}", placed(&written, leading)));
        }
    }
}

impl Approximation {
    /// Prints the midpoint to about three digits, however large or small.
    pub fn rough(&self) -> String {
        let middle = self.midpoint();
        if let Some(digits) = middle.decimal(3) {
            return digits;
        }
        let (mantissa, exponent, _) = middle.parts();
        let cut = mantissa.bits().saturating_sub(64);
        let head = (mantissa.abs() >> cut).to_f64().unwrap_or(f64::MAX);
        let leading = (exponent + cut as i64) as f64 * std::f64::consts::LOG10_2 + head.log10();
        let sign = if mantissa.is_negative() { "-" } else { "" };
        // Rounding leaves no significant digit of the fraction.
        if leading.abs() * f64::EPSILON * 1000.0 > 1.0 {
            return format!("{sign}10^{leading:.0}");
        }
        let whole = leading.floor();
        format!("{sign}{:.2}e{whole:.0}", 10f64.powf(leading - whole))
    }
}

/// Rounds m·2^e·10^places to the nearest integer.
fn rounded(mantissa: &BigInt, exponent: i64, places: i64) -> BigInt {
    let ten = |power: i64| BigInt::from(10).pow(power.max(0) as u32);
    let two = |power: i64| BigInt::from(1) << power.max(0) as u64;
    let above = mantissa * ten(places) * two(exponent);
    let below = ten(-places) * two(-exponent);
    let doubled: BigInt = (above.abs() * 2 + &below) / (below * 2);
    if above.is_negative() { -doubled } else { doubled }
}

/// Writes digits d₁d₂d₃… as d₁.d₂d₃…·10^leading.
fn placed(digits: &str, leading: i64) -> String {
    let count = digits.len() as i64;
    if leading >= count || leading < SMALLEST_PLAIN {
        let (first, rest) = digits.split_at(1);
        let point = if rest.is_empty() { "" } else { "." };
        return format!("{first}{point}{rest}e{leading}");
    }
    if leading < 0 {
        return format!("0.{}{digits}", "0".repeat((-leading - 1) as usize));
    }
    let (whole, fraction) = digits.split_at(leading as usize + 1);
    if fraction.is_empty() { whole.to_string() } else { format!("{whole}.{fraction}") }
}

#[cfg(test)]
mod tests {
    use super::super::ArbBall;
    use super::*;
    use num_traits::Zero;

    fn shown(text: &str, digits: usize) -> Option<String> {
        ArbBall::new(256).rational(&text.parse().expect("a number")).decimal(digits)
    }

    #[test]
    fn digits_are_rounded_and_placed() {
        assert_eq!(shown("2/3", 5).as_deref(), Some("0.66667"));
        assert_eq!(shown("-1/7", 10).as_deref(), Some("-0.1428571429"));
        assert_eq!(shown("0.00001234", 2).as_deref(), Some("0.000012"));
        assert_eq!(shown("1e-7", 3).as_deref(), Some("1.00e-7"));
        assert_eq!(shown("99999", 3).as_deref(), Some("1.00e5"), "a carry moves the point");
        assert_eq!(shown("12345", 5).as_deref(), Some("12345"));
        assert_eq!(shown("123456", 3).as_deref(), Some("1.23e5"));
        assert_eq!(shown("0", 30).as_deref(), Some("0"));
    }

    #[test]
    fn digits_that_are_not_known_are_not_shown() {
        let third = ArbBall::new(64).rational(&"1/3".parse().expect("a number"));
        assert!(third.decimal(18).is_some(), "64 bits are 19 digits");
        assert_eq!(third.decimal(25), None, "but not 25");
        let zero = third.add(&third.neg(), 64);
        assert_eq!(zero.decimal(1), None, "0 within the radius has no leading digit");
        assert!(!zero.mantissa_is_known(), "and its radius is not 0");
    }

    #[test]
    fn numbers_of_any_size_are_shown() {
        let rough =
            |text: &str| ArbBall::new(256).rational(&text.parse().expect("a number")).rough();
        assert_eq!(rough("-1.25e-400"), "-1.25e-400");
        let (large, half) = (ArbBall::new(64), "1/2".parse().expect("a number"));
        let power = (0..40).fold(large.rational(&half), |x, _| x.mul(&x, 64));
        assert_eq!(power.rough(), "1.24e-330985980542", "2^(-2^40)");
    }

    impl Approximation {
        fn mantissa_is_known(&self) -> bool {
            !self.parts().0.is_zero() || self.parts().2 == 0
        }
    }
}
