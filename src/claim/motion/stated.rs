//! Numbers stated in a case, with the accuracy implied by their digits.

use std::f64::consts::PI;

use crate::number::rational::Rational;

/// A number with the accuracy implied by its notation.
///
/// `1`, `3/7`, `π/2` are exact; `0.0331941` is correct to one unit in its last place, in quotients as well;
/// `0.035 ± 0.003` has a standard error.
#[derive(Clone, Debug, PartialEq)]
pub struct Stated {
    /// Text as typed.
    pub text: String,
    /// The nearest f64.
    pub value: f64,
    /// One unit in the last place of a decimal; 0 for an exact number.
    pub unit: f64,
    /// Standard error, if one is given.
    pub error: f64,
}

impl Stated {
    /// Reads a number; `None` if the text is not a number.
    pub fn parse(text: &str) -> Option<Self> {
        let text = text.trim().replace("pi", "π").replace('−', "-");
        let (number, error) = match text.split_once('±') {
            Some((number, error)) => {
                let error: f64 = error.trim().parse::<Rational>().ok()?.to_f64().0;
                (number.trim(), Some(error).filter(|error| *error >= 0.0)?)
            }
            None => (text.as_str(), 0.0),
        };
        let (value, unit) = match number.split_once('π') {
            Some((factor, divisor)) => multiple_of_pi(factor.trim(), divisor.trim())?,
            None => (number.parse::<Rational>().ok()?.to_f64().0, unit(number)?),
        };
        Some(Self { value, unit, error, text })
    }
}

/// Computes f π/d, and the unit in the last place of a decimal f times π/d.
fn multiple_of_pi(factor: &str, divisor: &str) -> Option<(f64, f64)> {
    let factor = factor.strip_suffix('*').map_or(factor, str::trim_end);
    let factor = match factor {
        "" => "1",
        "-" => "-1",
        factor => factor,
    };
    let share = match divisor.strip_prefix('/') {
        None if divisor.is_empty() => Rational::from(1),
        None => return None,
        Some(divisor) => divisor.parse::<Rational>().ok()?.recip()?,
    };
    let value = &factor.parse::<Rational>().ok()? * &share;
    Some((value.to_f64().0 * PI, unit(factor)? * share.to_f64().0.abs() * PI))
}

/// Returns one unit in the last place of a decimal, with a point or a negative exponent, and 0 for an integer; of a quotient what the units of both make.
fn unit(number: &str) -> Option<f64> {
    if let Some((above, below)) = number.split_once('/') {
        let value = |text: &str| Some(text.trim().parse::<Rational>().ok()?.to_f64().0.abs());
        let (above, below) =
            ((value(above)?, unit(above.trim())?), (value(below)?, unit(below.trim())?));
        return Some((above.1 + above.0 / below.0 * below.1) / below.0);
    }
    let (digits, exponent) = match number.split_once(['e', 'E']) {
        Some((digits, exponent)) => (digits, exponent.trim().parse().ok()?),
        None => (number, 0),
    };
    let Some((_, decimals)) = digits.split_once('.') else {
        // 628e-2 is 6.28.
        return Some(if exponent < 0 { libm::pow(10.0, f64::from(exponent)) } else { 0.0 });
    };
    let places = i32::try_from(decimals.bytes().filter(u8::is_ascii_digit).count()).ok()?;
    Some(libm::pow(10.0, f64::from(i32::checked_sub(exponent, places)?)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_spelling_tells_the_accuracy() {
        let read = |text| Stated::parse(text).map(|s| (s.value, s.unit, s.error));
        assert_eq!(read("1"), Some((1.0, 0.0, 0.0)), "exact");
        assert_eq!(read("3/4"), Some((0.75, 0.0, 0.0)), "exact");
        assert_eq!(read("π/2"), Some((PI / 2.0, 0.0, 0.0)), "exact");
        assert_eq!(read("-3pi/2"), Some((-1.5 * PI, 0.0, 0.0)), "exact");
        assert_eq!(read("0.50"), Some((0.5, 0.01, 0.0)), "two decimals");
        assert_eq!(read("0.035 ± 0.003"), Some((0.035, 0.001, 0.003)), "with its error");
        assert_eq!(read("2.5e-3"), Some((0.0025, 1e-4, 0.0)), "an exponent moves the place");
        assert_eq!(read("625e-2"), Some((6.25, 0.01, 0.0)), "a decimal without a point");
        assert_eq!(read("3e2"), Some((300.0, 0.0, 0.0)), "an integer");
        assert_eq!(read("1_000.12_5"), Some((1000.125, 1e-3, 0.0)), "digits in groups");
        assert_eq!(read("1.50/3"), Some((0.5, 0.01 / 3.0, 0.0)), "two decimals over a number");
        assert_eq!(read("3/1.5"), Some((2.0, 2.0 * 0.1 / 1.5, 0.0)), "one decimal below");
        assert_eq!(read("2 * pi"), Some((2.0 * PI, 0.0, 0.0)), "exact");
        assert_eq!(read("1.5*pi"), Some((1.5 * PI, 0.1 * PI, 0.0)), "one decimal, times π");
        assert_eq!(read("-0.5π/2"), Some((-0.25 * PI, 0.05 * PI, 0.0)), "one decimal, times π/2");
        let wrong = ["", "x", "1 ± y", "1 ± -2", "ππ", "π2", "π/0", "inf*pi", "nan*pi", "2**pi"];
        for wrong in wrong {
            assert_eq!(read(wrong), None, "{wrong}");
        }
    }
}
