//! Additive constants of integrals.

use liouville::number::rational::Rational;
use liouville::proof::Polynomial;

use super::fraction::Fraction;
use super::reader::Reader;

/// Values of a variable at which an integral may be a constant.
const VALUES: [i64; 3] = [-1, 1, 0];

/// The differences of a fraction and constants, with these: without constant terms, or with a factor v − c for
/// a variable v.
pub fn shifts(reader: &Reader<'_>, own: &Fraction) -> Vec<(Fraction, Fraction)> {
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
    constants.retain(|own| !own.above.is_zero());
    let shifted = |constant: Fraction| Some((own.plus(&constant, true)?, constant));
    constants.into_iter().filter_map(shifted).filter(|(own, _)| !own.above.is_zero()).collect()
}

/// A polynomial where a variable has a value.
fn at_value(own: &Polynomial, token: u32, value: i64) -> Polynomial {
    own.by_powers(token).into_iter().fold(Polynomial::default(), |sum, (power, part)| {
        let factor = (0..power).fold(Rational::from(1), |all, _| &all * &Rational::from(value));
        sum.plus(&part.scaled(&factor))
    })
}
