//! Even powers of sines as those of cosines, and the other way round.

use liouville::number::rational::Rational;
use liouville::proof::{MOST_POLYNOMIAL_WORK, Polynomial};

use super::fraction::Fraction;
use super::reader::Reader;

/// The fraction with sin² u replaced by 1 − cos² u for all u whose sine and cosine occur, and with cosines so
/// replaced.
pub fn turned(reader: &Reader<'_>, own: &Fraction) -> Vec<Fraction> {
    let mut tokens = own.above.variables();
    tokens.extend(own.below.variables());
    tokens.sort_unstable();
    tokens.dedup();
    let partner = |name: &str, other: &str, token: u32| {
        let argument = reader.tokens.text(token).strip_prefix(name)?;
        let is_partner =
            |own: &&u32| reader.tokens.text(**own).strip_prefix(other) == Some(argument);
        Some((token, *tokens.iter().find(is_partner)?))
    };
    let replaced = |name: &str, other: &str| {
        let pairs: Vec<(u32, u32)> =
            tokens.iter().filter_map(|token| partner(name, other, *token)).collect();
        let part = |own: &Polynomial| {
            pairs.iter().try_fold(own.clone(), |own, (token, other)| without(&own, *token, *other))
        };
        let is_there = !pairs.is_empty();
        is_there
            .then(|| Fraction { above: part(&own.above)?, below: part(&own.below)? }.reduced())?
    };
    [("sin(", "cos("), ("cos(", "sin(")].iter().filter_map(|(a, b)| replaced(a, b)).collect()
}

/// A polynomial with x² replaced by 1 − y².
fn without(own: &Polynomial, x: u32, y: u32) -> Option<Polynomial> {
    let work = &mut { MOST_POLYNOMIAL_WORK };
    let variable = Polynomial::variable(y);
    let one = Polynomial::constant(&Rational::from(1));
    let minus = variable.times(&variable, work)?.scaled(&Rational::from(-1));
    let square = one.plus(&minus);
    let mut sum = Polynomial::default();
    for (power, mut part) in own.by_powers(x) {
        for _ in 0..power / 2 {
            part = part.times(&square, work)?;
        }
        if power % 2 == 1 {
            part = part.times(&Polynomial::variable(x), work)?;
        }
        sum = sum.plus(&part);
    }
    Some(sum)
}
