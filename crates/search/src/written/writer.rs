//! Fractions as texts: a product of factors, or a sum over a product.

use liouville::number::rational::Rational;
use liouville::order::StableOrder;
use liouville::proof::{MOST_POLYNOMIAL_WORK, Polynomial};
use num_bigint::BigInt;
use num_integer::Integer;

use super::super::orbit::parsed::{joined, terms as terms_of};
use super::circular;
use super::fraction::Fraction;
use super::hyperbolic;
use super::products::{assembled, assembled_number, is_sum};
use super::reader::Reader;
use super::square_sums;
use super::squares;

/// Treatment of constant factors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Constants {
    /// They are written.
    Kept,
    /// They are left out.
    Left,
    /// They are left out, except for a minus sign.
    Sign,
}

/// A text, and the constant that it has to be multiplied by.
#[derive(Clone, Debug)]
pub struct Written {
    pub text: String,
    pub constant: Fraction,
    pub constant_text: String,
}

/// A factor of a numerator or denominator.
#[derive(Clone)]
struct Factor {
    polynomial: Polynomial,
    power: u32,
}

/// The shortest text of a fraction.
pub fn written(reader: &mut Reader<'_>, own: &Fraction, constants: Constants) -> Option<Written> {
    if constants == Constants::Kept
        && let Some((number, text)) = reader.named.multiple_of_energy(own)
    {
        let sign = if number.is_negative() { "−" } else { "" };
        let own = assembled(&number.abs(), &[vec![(text, 1)], Vec::new()]);
        let (text, constant_text) = (format!("{sign}{own}"), "1".to_string());
        return Some(Written { text, constant: Fraction::one(), constant_text });
    }
    let turned: Vec<Fraction> =
        hyperbolic::turned(reader, own).into_iter().chain(circular::turned(reader, own)).collect();
    let all = std::iter::once(own).chain(&turned);
    let mut made: Vec<Written> = Vec::new();
    for own in all {
        for is_sum in [false, true] {
            made.extend(product(reader, own, constants, is_sum));
        }
        made.extend(with_square(reader, own, constants));
        made.extend(sum_of_terms(reader, own, constants));
    }
    made.into_iter().min_by_key(|own| own.text.chars().count())
}

/// Writes a polynomial term by term, each with its number.
fn sum_of_terms(reader: &Reader<'_>, own: &Fraction, constants: Constants) -> Option<Written> {
    let scale = own.below.number()?.recip()?;
    let is_wanted = constants == Constants::Kept && !own.above.is_zero();
    let (constant, constant_text) = (Fraction::one(), "1".to_string());
    is_wanted.then(|| Written {
        text: with_sums_first(plain_terms(reader, &own.above.scaled(&scale))),
        constant,
        constant_text,
    })
}

/// Writes a fraction as the square of a sum and what is left.
fn with_square(reader: &mut Reader<'_>, own: &Fraction, constants: Constants) -> Option<Written> {
    let (number, whole) = content(own)?;
    let one = Rational::from(1);
    if constants == Constants::Sign || constants == Constants::Kept && number != one {
        return None;
    }
    let opposite = Fraction::number(&-&one).times(&whole)?;
    let of_both = [(number.clone(), whole), (-&number, opposite)];
    let signs = if constants == Constants::Left { 2 } else { 1 };
    let mut made: Vec<Written> = Vec::new();
    for (number, own) in &of_both[..signs] {
        let Some((sum, rest)) = square_sums::largest(own) else { continue };
        let [sum, rest] = [sum, rest].map(|own| written(reader, &own, Constants::Kept));
        let (sum, rest) = (sum?.text, rest?.text);
        let text = match rest.as_str() {
            "0" => format!("({sum})²"),
            rest => joined(std::iter::once((false, format!("({sum})²"))).chain(
                terms_of(rest).into_iter().map(|(is_negative, own)| (is_negative, own.to_string())),
            )),
        };
        let constant = Fraction::number(number);
        made.push(Written { text, constant, constant_text: assembled_number(number) });
    }
    made.into_iter().min_by_key(|own| own.text.chars().count())
}

/// Writes numerator and denominator as products; `is_sum` leaves the numerator as a sum.
fn product(
    reader: &mut Reader<'_>,
    own: &Fraction,
    constants: Constants,
    is_sum: bool,
) -> Option<Written> {
    if own.above.is_zero() {
        let constant = Fraction::one();
        return Some(Written { text: "0".to_string(), constant, constant_text: "1".to_string() });
    }
    let (above, below) = (divided(&own.above)?, divided(&own.below)?);
    let mut number = &above.0 * &below.0.recip()?;
    let (mut above, below) = (above.1, below.1);
    let is_constant = |reader: &Reader<'_>, own: &Factor| {
        own.polynomial.variables().iter().all(|token| reader.tokens.is_constant(*token))
    };
    let mut left = [Vec::new(), Vec::new()];
    let mut kept = [Vec::new(), Vec::new()];
    if is_sum {
        let (constant, rest): (Vec<Factor>, Vec<Factor>) =
            above.into_iter().partition(|own| is_constant(reader, own));
        let mut sum = Polynomial::constant(&Rational::from(1));
        for own in &rest {
            for _ in 0..own.power {
                sum = sum.times(&own.polynomial, &mut { MOST_POLYNOMIAL_WORK })?;
            }
        }
        above = constant;
        above.push(Factor { polynomial: sum, power: 1 });
    }
    for (place, own) in [above, below].into_iter().enumerate() {
        for factor in own {
            match constants != Constants::Kept && is_constant(reader, &factor) {
                true => left[place].push(factor),
                false => kept[place].push(factor),
            }
        }
    }
    let mut is_negative = false;
    let mut parts = [Vec::new(), Vec::new()];
    for (own, texts) in kept.iter().zip(&mut parts) {
        for factor in own {
            let (turned, scale, text) = factor_text(reader, &factor.polynomial)?;
            is_negative ^= turned && factor.power % 2 == 1;
            let is_below = std::ptr::eq(own, &kept[1]);
            for _ in 0..factor.power {
                number = if is_below { &number * &scale.recip()? } else { &number * &scale };
            }
            texts.push((text, factor.power));
        }
    }
    if number.is_negative() {
        (is_negative, number) = (!is_negative, -&number);
    }
    let mut constant = Fraction::one();
    let mut constant_text = "1".to_string();
    if constants != Constants::Kept {
        let sign = Rational::from(if is_negative && constants == Constants::Left { -1 } else { 1 });
        let value = &number * &sign;
        let mut texts = [Vec::new(), Vec::new()];
        constant = Fraction::number(&value);
        for (place, own) in left.iter().enumerate() {
            for factor in own {
                let whole = Fraction::whole(factor.polynomial.clone());
                for _ in 0..factor.power {
                    constant =
                        if place == 0 { constant.times(&whole)? } else { constant.over(&whole)? };
                }
                let text = plain(reader, &factor.polynomial);
                texts[place].push((text, factor.power));
            }
        }
        constant_text = assembled(&value, &texts);
        number = Rational::from(1);
        is_negative &= constants == Constants::Sign;
    }
    let mut is_alone = false;
    if is_negative {
        let is_single = parts[1].is_empty() && parts[0].len() == 1 && number == Rational::from(1);
        if let Some(turned) = turned(&mut parts[0], is_single) {
            (is_negative, is_alone) = (false, turned);
        } else if turned(&mut parts[1], false).is_some() {
            is_negative = false;
        }
    }
    let text = match is_alone {
        true => parts[0].iter().map(|(text, _)| text.as_str()).collect(),
        false => assembled(&number, &parts),
    };
    let text = if is_negative { negative(&text, parts[0].len() + parts[1].len()) } else { text };
    Some(Written { text, constant, constant_text })
}

/// Takes the negative of a factor that is a sum, where that begins with a plus; of a factor that is all in any
/// case. Returns whether it is all.
fn turned(factors: &mut [(String, u32)], is_single: bool) -> Option<bool> {
    for (text, power) in factors.iter_mut() {
        if *power % 2 == 0 || !is_sum(text) {
            continue;
        }
        let own = terms_of(text).into_iter().map(|(sign, own)| (!sign, own.to_string()));
        let opposite = with_sums_first(own.collect());
        if is_single || !opposite.starts_with('−') {
            *text = opposite;
            return Some(is_single);
        }
    }
    None
}

fn negative(text: &str, factors: usize) -> String {
    match factors <= 1 && is_sum(text) {
        true => format!("−({text})"),
        false => format!("−{text}"),
    }
}

/// A number, and the fraction of polynomials with whole coefficients by which it is multiplied.
pub fn content(own: &Fraction) -> Option<(Rational, Fraction)> {
    let (above, below) = (whole(&own.above), whole(&own.below));
    let work = &mut { MOST_POLYNOMIAL_WORK };
    let number =
        |own: &Polynomial, whole: &Polynomial, work: &mut usize| own.over(whole, work)?.number();
    let upper = number(&own.above, &above, work)?;
    let lower = number(&own.below, &below, work)?;
    Some((&upper * &lower.recip()?, Fraction { above, below }))
}

/// Divides a polynomial into factors of whole coefficients and a number.
fn divided(own: &Polynomial) -> Option<(Rational, Vec<Factor>)> {
    let work = &mut { MOST_POLYNOMIAL_WORK };
    let mut rest = own.clone();
    let mut all = Vec::new();
    for factor in own.factors() {
        let polynomial = whole(&factor);
        let mut power = 0;
        while let Some(quotient) = rest.over(&polynomial, work) {
            (rest, power) = (quotient, power + 1);
        }
        if power > 0 {
            all.push(Factor { polynomial, power });
        }
    }
    // Variables come before sums, in the order of the file.
    all.order_by_key(|own| (own.polynomial.size(), own.polynomial.variables()));
    match rest.number() {
        Some(number) => Some((number, all)),
        None => {
            let polynomial = whole(&rest);
            let number = rest.over(&polynomial, work)?.number()?;
            all.push(Factor { polynomial, power: 1 });
            Some((number, all))
        }
    }
}

/// The multiple with whole coefficients without common divisor.
fn whole(own: &Polynomial) -> Polynomial {
    let parts = || own.terms().map(|(value, _)| value.parts());
    let below = parts().fold(BigInt::from(1), |lcm, (_, below)| lcm.lcm(&below));
    let above = parts().fold(BigInt::ZERO, |gcd, (above, own)| gcd.gcd(&(above * (&below / own))));
    match above == BigInt::ZERO {
        true => own.clone(),
        false => own.scaled(&Rational::from_parts(below, above)),
    }
}

/// A factor's text with whether it is that of the negative, and a number that it has to be multiplied by.
fn factor_text(reader: &mut Reader<'_>, own: &Polynomial) -> Option<(bool, Rational, String)> {
    let one = Rational::from(1);
    let (turned, text) = positive(terms(reader, own)?);
    if let Some((scale, named)) = reader.named.of_polynomial(own)
        && named.chars().count() <= text.chars().count()
    {
        return Some((scale.is_negative(), scale.abs(), named));
    }
    if let Some(squares) = squares::sum(own, &|token| reader.tokens.text(token).to_string())
        && squares.chars().count() < text.chars().count()
    {
        return Some((false, one, squares));
    }
    Some((turned, one, text))
}

/// A sum, or its negative where most terms are negative, with a positive term first; and whether it is the negative.
fn positive(terms: Vec<(bool, String)>) -> (bool, String) {
    let negative = terms.iter().filter(|(is_negative, _)| *is_negative).count();
    let turned = 2 * negative > terms.len();
    let own = terms.into_iter().map(|(is_negative, text)| (is_negative != turned, text));
    (turned, with_sums_first(own.collect()))
}

fn with_sums_first(mut terms: Vec<(bool, String)>) -> String {
    terms.order_by_key(|(is_negative, _)| *is_negative);
    joined(terms)
}

/// Terms of a polynomial, one for each product of powers of the variables that are not constant.
fn terms(reader: &mut Reader<'_>, own: &Polynomial) -> Option<Vec<(bool, String)>> {
    let mut moving: Vec<u32> = own.variables();
    moving.retain(|token| !reader.tokens.is_constant(*token));
    let mut groups: Vec<(Vec<u32>, Polynomial)> = own.collected(&moving).into_iter().collect();
    groups.order_by_key(|(powers, _)| {
        let falling: Vec<i64> = powers.iter().map(|power| -i64::from(*power)).collect();
        (powers.iter().sum::<u32>(), falling)
    });
    let mut all = Vec::new();
    for (powers, coefficient) in groups {
        let mut monomial = Vec::new();
        for (token, power) in moving.iter().zip(&powers).filter(|(_, power)| **power > 0) {
            monomial.push((reader.tokens.text(*token).to_string(), *power));
        }
        if monomial.is_empty() && coefficient.size() > 1 {
            for (value, exponents) in coefficient.terms() {
                all.push(term(reader, value, exponents));
            }
            continue;
        }
        if let Some((value, exponents)) = coefficient.as_term() {
            let (is_negative, number) = (value.is_negative(), value.abs());
            let mut factors = named_powers(reader, exponents);
            factors.extend(monomial);
            all.push((is_negative, assembled(&number, &[factors, Vec::new()])));
            continue;
        }
        let (mut number, factors) = divided(&coefficient)?;
        let mut texts = Vec::new();
        for factor in factors {
            let (turned, text) = positive(plain_terms(reader, &factor.polynomial));
            if turned && factor.power % 2 == 1 {
                number = -&number;
            }
            texts.push((text, factor.power));
        }
        texts.extend(monomial);
        all.push((number.is_negative(), assembled(&number.abs(), &[texts, Vec::new()])));
    }
    Some(all)
}

fn named_powers(reader: &Reader<'_>, exponents: &[(u32, u32)]) -> Vec<(String, u32)> {
    let named = |(token, power): &(u32, u32)| (reader.tokens.text(*token).to_string(), *power);
    exponents.iter().map(named).collect()
}

fn term(reader: &Reader<'_>, value: &Rational, exponents: &[(u32, u32)]) -> (bool, String) {
    let factors = named_powers(reader, exponents);
    (value.is_negative(), assembled(&value.abs(), &[factors, Vec::new()]))
}

/// Terms of a polynomial, one by one.
fn plain_terms(reader: &Reader<'_>, own: &Polynomial) -> Vec<(bool, String)> {
    let mut all: Vec<_> = own.terms().collect();
    all.order_by_key(|(_, exponents)| exponents.iter().map(|(_, power)| *power).sum::<u32>());
    all.into_iter().map(|(value, exponents)| term(reader, value, exponents)).collect()
}

fn plain(reader: &Reader<'_>, own: &Polynomial) -> String {
    joined(plain_terms(reader, own))
}
