//! Squares of sums of monomials in a fraction, such as (x*v − y*u)² in x²*v² − 2*x*y*u*v + y²*u² + y²/x².

use std::collections::BTreeMap;

use liouville::number::rational::Rational;

use super::fraction::Fraction;

/// Largest number of terms of a fraction that is looked at.
const MOST_TERMS: usize = 40;
/// Largest number of squares among these.
const MOST_SQUARES: usize = 12;

/// Exponents of variables, without those that are 0.
type Exponents = BTreeMap<u32, i64>;

/// A term c*m² of a fraction, as √c and m.
struct Root {
    number: Rational,
    exponents: Exponents,
}

/// A sum of two or more monomials whose square the fraction contains, and the rest; the longest such sum.
pub fn largest(own: &Fraction) -> Option<(Fraction, Fraction)> {
    let terms = terms(own)?;
    let roots: Vec<Root> =
        terms.iter().filter_map(|(exponents, value)| root(exponents, value)).collect();
    if !(2..=MOST_SQUARES).contains(&roots.len()) {
        return None;
    }
    // The sign with which two monomials stand in the sum, if their product is there.
    let sign = |a: &Root, b: &Root| {
        let value = terms.get(&product(&a.exponents, &b.exponents))?;
        let double = &(&a.number * &b.number) * &Rational::from(2);
        match value {
            value if *value == double => Some(false),
            value if *value == -&double => Some(true),
            _ => None,
        }
    };
    let mut best: Vec<(usize, bool)> = Vec::new();
    for first in 0..roots.len() {
        for second in first + 1..roots.len() {
            let Some(is_negative) = sign(&roots[first], &roots[second]) else { continue };
            let mut own = vec![(first, false), (second, is_negative)];
            for third in second + 1..roots.len() {
                let Some(is_negative) = sign(&roots[first], &roots[third]) else { continue };
                let fits = |(k, other): &(usize, bool)| {
                    sign(&roots[*k], &roots[third]) == Some(is_negative != *other)
                };
                if own.iter().all(fits) {
                    own.push((third, is_negative));
                }
            }
            if own.len() > best.len() {
                best = own;
            }
        }
    }
    let mut sum: Option<Fraction> = None;
    for (place, is_negative) in best {
        let monomial = monomial(&roots[place])?;
        sum = Some(match sum {
            None => monomial,
            Some(sum) => sum.plus(&monomial, is_negative)?,
        });
    }
    let sum = sum?;
    let rest = own.plus(&sum.power(2)?, true)?;
    Some((sum, rest))
}

/// Terms of a fraction over a monomial.
fn terms(own: &Fraction) -> Option<BTreeMap<Exponents, Rational>> {
    let (below, divisors) = own.below.as_term()?;
    if own.above.size() > MOST_TERMS {
        return None;
    }
    let mut all = BTreeMap::new();
    for (value, powers) in own.above.terms() {
        let mut exponents: Exponents =
            powers.iter().map(|(token, power)| (*token, i64::from(*power))).collect();
        for (token, power) in divisors {
            *exponents.entry(*token).or_default() -= i64::from(*power);
        }
        exponents.retain(|_, power| *power != 0);
        all.insert(exponents, value * &below.recip()?);
    }
    Some(all)
}

fn root(exponents: &Exponents, value: &Rational) -> Option<Root> {
    if value.is_negative() || exponents.is_empty() || exponents.values().any(|own| own % 2 != 0) {
        return None;
    }
    let (above, below) = value.parts();
    let [above, below] = [above, below].map(|own| {
        let root = own.sqrt();
        (&root * &root == own).then_some(root)
    });
    let number = Rational::from_parts(above?, below?);
    Some(Root { number, exponents: exponents.iter().map(|(k, own)| (*k, own / 2)).collect() })
}

fn product(a: &Exponents, b: &Exponents) -> Exponents {
    let mut all = a.clone();
    for (token, power) in b {
        *all.entry(*token).or_default() += power;
    }
    all.retain(|_, power| *power != 0);
    all
}

fn monomial(own: &Root) -> Option<Fraction> {
    let mut product = Fraction::number(&own.number);
    for (token, power) in &own.exponents {
        product = product.times(&Fraction::variable(*token).power(*power)?)?;
    }
    Some(product)
}
