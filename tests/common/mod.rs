//! Shared tools of the integration tests: cases from text, exact numbers, enclosures.

#![allow(dead_code, reason = "each test binary uses a part of this")]

pub mod drawn;

use liouville::case::Case;
use liouville::number::rational::Rational;
use liouville::verdict::{Enclosed, PointReport, evaluate};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Pow, Signed, Zero};
use serde_json::Value;

/// Parses a case; the text is shown if it is refused.
pub fn case(text: &str) -> Case {
    Case::parse(text, &[]).unwrap_or_else(|error| panic!("{error} in\n{text}"))
}

/// Evaluates a case at a given state.
pub fn report(case: &Case, state: &[Rational]) -> PointReport {
    evaluate(case, Some(state), 1, 0).expect("a case that can be evaluated")
}

/// Reads an exact number from a fraction or a decimal, independently of the library.
pub fn exact(text: &str) -> BigRational {
    let (above, below) = text.split_once('/').unwrap_or((text, "1"));
    decimal(above) / decimal(below)
}

fn decimal(text: &str) -> BigRational {
    let (mantissa, exponent) = text.split_once('e').unwrap_or((text, "0"));
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits: BigInt = format!("{whole}{fraction}").parse().expect("decimal digits");
    let exponent: i32 = exponent.parse().expect("a whole exponent");
    let ten = BigRational::from_integer(10.into());
    BigRational::from_integer(digits) * ten.pow(exponent - fraction.len() as i32)
}

/// Converts a finite f64 exactly.
pub fn dyadic(value: f64) -> BigRational {
    BigRational::from_float(value).unwrap_or_else(|| panic!("{value} is finite"))
}

/// Converts an exact number to the library's type.
pub fn rational(value: &BigRational) -> Rational {
    format!("{}/{}", value.numer(), value.denom()).parse().expect("a fraction")
}

/// Returns the strings of a JSON list.
pub fn strings(list: &Value) -> Vec<&str> {
    let list = list.as_array().unwrap_or_else(|| panic!("{list} is a list"));
    list.iter().map(text).collect()
}

/// Returns a JSON string.
pub fn text(value: &Value) -> &str {
    value.as_str().unwrap_or_else(|| panic!("{value} is a string"))
}

/// A reference value, printed to 30 significant digits.
pub struct Reference {
    value: BigRational,
    /// Half a unit of the 30th digit; below 1e-50 for values printed as 0.
    slack: BigRational,
}

impl Reference {
    pub fn read(text: &str) -> Self {
        let value = exact(text);
        let ten = BigRational::from_integer(10.into());
        let slack = match value.is_zero() {
            true => ten.pow(-50),
            // d.ddd × 10ᵉ with 30 digits is off by at most ½ 10^(e-29) ≤ 5·10⁻³⁰ |d.ddd × 10ᵉ|
            false => value.abs() * BigRational::from_integer(5.into()) * ten.pow(-30),
        };
        Self { value, slack }
    }

    /// Asserts that the enclosure contains this value and is significant: at least half of the 53
    /// bits are correct.
    pub fn assert_in(&self, enclosure: Enclosed, what: &str) {
        let (mid, radius) = enclosure.unwrap_or_else(|| panic!("{what} is undefined"));
        let distance = (dyadic(mid) - &self.value).abs();
        assert!(
            distance <= dyadic(radius) + &self.slack,
            "{what}: {mid} ± {radius:e} misses the reference {}",
            approximate(&self.value)
        );
        let coarsest = mid.abs().max(1.0) * f64::EPSILON.sqrt();
        assert!(radius <= coarsest, "{what}: {mid} ± {radius:e} is too wide to mean anything");
        if !self.value.is_zero() {
            assert!(mid.abs() > radius, "{what}: {mid} ± {radius:e} does not exclude 0");
        }
    }

    pub fn is_zero(&self) -> bool {
        self.value.is_zero()
    }
}

fn approximate(value: &BigRational) -> f64 {
    num_traits::ToPrimitive::to_f64(value).unwrap_or(f64::NAN)
}

/// Returns the enclosure of a claim's value and residual, by the claim's name.
pub fn claim(report: &PointReport, name: &str) -> (Enclosed, Enclosed) {
    let found = report.claims.iter().find(|(known, _, _)| known == name);
    let (_, value, residual) = found.unwrap_or_else(|| panic!("no claim is called {name}"));
    (value.first().copied().flatten(), residual.first().copied().flatten())
}

/// Writes a claim.
pub fn claim_text(name: &str, kind: &str, formula: &str) -> String {
    format!("[[claim]]\nname = \"{name}\"\n{kind} = \"{formula}\"\n")
}

/// Asserts that two enclosures intersect, and that both are narrow.
pub fn assert_meet(a: Enclosed, b: Enclosed, what: &str) {
    let ((a, ra), (b, rb)) = (a.expect("defined"), b.expect("defined"));
    let gap = (dyadic(a) - dyadic(b)).abs();
    assert!(gap <= dyadic(ra) + dyadic(rb), "{what}: {a} ± {ra:e} and {b} ± {rb:e} do not meet");
    let coarsest = a.abs().max(b.abs()).max(1.0) * f64::EPSILON.sqrt();
    assert!(ra + rb <= coarsest, "{what}: ± {ra:e} and ± {rb:e} are too wide to mean anything");
}

/// Whether 0 is outside the enclosure.
pub fn excludes_zero(enclosure: Enclosed) -> bool {
    enclosure.is_some_and(|(mid, radius)| mid.abs() > radius)
}

/// Number of systems made around an invariant: `LIOUVILLE_DRAWS` times as many as usual.
pub fn plants(usual: usize) -> usize {
    let times = std::env::var("LIOUVILLE_DRAWS").ok();
    usual * times.map_or(1, |text| text.parse::<usize>().expect("LIOUVILLE_DRAWS is a number"))
}
