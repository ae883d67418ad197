//! Additive constants of integrals.

use liouville::number::rational::Rational;
use liouville::proof::{MOST_POLYNOMIAL_WORK, Polynomial};

use super::fraction::Fraction;
use super::reader::Reader;

/// Values of a variable at which an integral may be a constant.
const VALUES: [i64; 3] = [-1, 1, 0];

/// The differences of a fraction and constants, with these: without constant terms, with a factor v − c for a
/// variable v, or with one of some divisors.
pub fn shifts(
    reader: &Reader<'_>,
    own: &Fraction,
    divisors: &[Polynomial],
) -> Vec<(Fraction, Fraction)> {
    let is_constant =
        |own: &Polynomial| own.variables().iter().all(|token| reader.tokens.is_constant(*token));
    let mut constants: Vec<Fraction> = Vec::new();
    if own.is_polynomial() {
        let mut sum = Polynomial::default();
        for (value, exponents) in own.above.terms() {
            let term = Polynomial::of_term(value, exponents.iter().copied());
            if is_constant(&term) {
                sum = sum.plus(&term);
            }
        }
        constants.push(Fraction { above: sum, below: own.below.clone() });
    } else {
        let variables = own.below.variables().into_iter().chain(own.above.variables());
        let mut moving: Vec<u32> =
            variables.filter(|token| !reader.tokens.is_constant(*token)).collect();
        moving.sort_unstable();
        moving.dedup();
        for token in moving {
            for value in VALUES {
                let at = |own: &Polynomial| at_value(own, token, value);
                let (above, below) = (at(&own.above), at(&own.below));
                if below.is_zero() {
                    continue;
                }
                let Some(there) = (Fraction { above, below }).reduced() else { continue };
                if is_constant(&there.above) && is_constant(&there.below) {
                    constants.push(there);
                }
            }
        }
    }
    for divisor in divisors.iter().filter(|_| !own.is_polynomial()) {
        constants.extend(
            on_zeros(own, divisor).filter(|own| is_constant(&own.above) && is_constant(&own.below)),
        );
    }
    constants.retain(|own| !own.above.is_zero());
    let shifted = |constant: Fraction| Some((own.plus(&constant, true)?, constant));
    constants.into_iter().filter_map(shifted).filter(|(own, _)| !own.above.is_zero()).collect()
}

/// The fraction where a polynomial, linear in some variable, is 0.
fn on_zeros(own: &Fraction, divisor: &Polynomial) -> Option<Fraction> {
    let (token, rest) = divisor.variables().into_iter().find_map(|token| {
        let parts: Vec<(u32, Polynomial)> = divisor.by_powers(token).into_iter().collect();
        let factor = parts.iter().find(|(power, _)| *power == 1)?.1.number()?;
        let is_linear = parts.iter().all(|(power, _)| *power <= 1);
        let rest = parts.iter().find(|(power, _)| *power == 0).map(|(_, own)| own.clone());
        let scale = (-&factor).recip()?;
        is_linear.then(|| (token, rest.unwrap_or_default().scaled(&scale)))
    })?;
    let at = |own: &Polynomial| {
        let mut sum = Polynomial::default();
        for (power, mut part) in own.by_powers(token) {
            for _ in 0..power {
                part = part.times(&rest, &mut { MOST_POLYNOMIAL_WORK })?;
            }
            sum = sum.plus(&part);
        }
        Some(sum)
    };
    let (above, below) = (at(&own.above)?, at(&own.below)?);
    if below.is_zero() { None } else { Fraction { above, below }.reduced() }
}

/// A polynomial where a variable has a value.
fn at_value(own: &Polynomial, token: u32, value: i64) -> Polynomial {
    own.by_powers(token).into_iter().fold(Polynomial::default(), |sum, (power, part)| {
        let factor = (0..power).fold(Rational::from(1), |all, _| &all * &Rational::from(value));
        sum.plus(&part.scaled(&factor))
    })
}
