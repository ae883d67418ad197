//! Polynomials in the parameters without common factors, and their square roots.
//!
//! √D of a pair g ± √D h is often a fraction of the parameters: √(B³g³/(Bg(c² + B²)²)) is Bg/(c² + B²).

use std::collections::BTreeMap;

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

use liouville::order::StableOrder;

use super::super::ansatz::coefficients::Polynomial;

/// Largest number of terms of a square root.
const MOST_TERMS: usize = 40;

/// A polynomial by its exponents.
type Sparse = BTreeMap<Vec<u32>, BigInt>;

/// A fraction D as (n/d) (α/β)² p/q, with whole numbers n and d.
pub struct SquareFraction {
    /// n and d.
    pub numbers: [BigInt; 2],
    /// α and β.
    pub roots: [Polynomial; 2],
    /// p and q, which are 1 or no squares.
    pub rest: [Polynomial; 2],
}

/// Divides numerator and denominator by what they are seen to have in common.
pub fn reduced(above: &Polynomial, below: &Polynomial) -> [Polynomial; 2] {
    let both = without_common(vec![above.clone(), below.clone()], &[]);
    let [above, below] = [sparse(&both[0]), sparse(&both[1])];
    let one = |own: &Sparse| -> Sparse {
        let zero = own.keys().next().map_or_else(Vec::new, |key| vec![0; key.len()]);
        [(zero, BigInt::one())].into_iter().collect()
    };
    let quotients = match (divided(&above, &below), divided(&below, &above)) {
        (Some(whole), _) => [whole, one(&above)],
        (None, Some(whole)) => [one(&below), whole],
        (None, None) => [above, below],
    };
    quotients.map(|own| sorted(&own))
}

/// Takes squares out of a reduced fraction; `None` of 0.
pub fn square_fraction(above: &Polynomial, below: &Polynomial) -> Option<SquareFraction> {
    let part = |own: &Polynomial| -> Option<(BigInt, Polynomial, Polynomial)> {
        let own = sparse(own);
        let content = content(&own)?;
        let zero = vec![0; own.keys().next()?.len()];
        let one: Sparse = [(zero, BigInt::one())].into_iter().collect();
        let primitive: Sparse = own.into_iter().map(|(a, value)| (a, value / &content)).collect();
        let (root, rest) = root(&primitive).map_or((one.clone(), primitive), |root| (root, one));
        Some((content, sorted(&root), sorted(&rest)))
    };
    let ((n, upper, p), (d, lower, q)) = (part(above)?, part(below)?);
    Some(SquareFraction { numbers: [n, d], roots: [upper, lower], rest: [p, q] })
}

/// Whether a polynomial is the number 1.
pub fn is_one(own: &Polynomial) -> bool {
    matches!(&own[..], [(key, value)] if value.is_one() && key.iter().all(|a| *a == 0))
}

/// Product of two polynomials.
pub fn times(a: &Polynomial, b: &Polynomial) -> Polynomial {
    sorted(&product(&sparse(a), &sparse(b)))
}

/// Multiple of a polynomial.
pub fn multiple(a: &Polynomial, number: &BigInt) -> Polynomial {
    a.iter().map(|(exponents, own)| (exponents.clone(), own * number)).collect()
}

/// Divides polynomials by factors that all of them have: numbers, variables, one of the polynomials, and those
/// in `further`.
pub fn without_common(all: Vec<Polynomial>, further: &[Polynomial]) -> Vec<Polynomial> {
    let mut all: Vec<Sparse> = all.iter().map(sparse).collect();
    let terms = || all.iter().flatten();
    let number = terms().fold(BigInt::zero(), |gcd, (_, value)| gcd.gcd(value));
    let Some(width) = terms().next().map(|(key, _)| key.len()) else {
        return all.iter().map(sorted).collect();
    };
    let powers: Vec<u32> =
        (0..width).map(|k| terms().map(|(key, _)| key[k]).min().unwrap_or(0)).collect();
    let first: Sparse = [(powers, number)].into_iter().collect();
    all = all.iter().map(|own| divided(own, &first).unwrap_or_else(|| own.clone())).collect();
    let mut candidates: Vec<Sparse> = all.iter().map(bare).collect();
    candidates.extend(further.iter().map(|own| bare(&sparse(own))));
    candidates.retain(|own| own.len() > 1);
    candidates.order_by_key(BTreeMap::len);
    for candidate in candidates {
        while let Some(made) =
            all.iter().map(|own| divided(own, &candidate)).collect::<Option<Vec<_>>>()
        {
            all = made;
        }
    }
    all.iter().map(sorted).collect()
}

fn sparse(own: &Polynomial) -> Sparse {
    own.iter().filter(|(_, value)| !value.is_zero()).cloned().collect()
}

/// Terms of low degree first.
fn sorted(own: &Sparse) -> Polynomial {
    let mut terms: Polynomial =
        own.iter().rev().map(|(a, value)| (a.clone(), value.clone())).collect();
    terms.order_by_key(|(exponents, _)| exponents.iter().sum::<u32>());
    terms
}

/// Common divisor of the coefficients with the sign of the last; `None` of 0.
fn content(own: &Sparse) -> Option<BigInt> {
    let gcd = own.values().fold(BigInt::zero(), |gcd, value| gcd.gcd(value));
    let (_, last) = own.last_key_value()?;
    Some(if last.is_negative() { -gcd } else { gcd })
}

/// A polynomial without factors that are numbers or variables.
fn bare(own: &Sparse) -> Sparse {
    let Some(content) = content(own) else { return Sparse::new() };
    let width = own.keys().next().map_or(0, Vec::len);
    let least: Vec<u32> =
        (0..width).map(|k| own.keys().map(|key| key[k]).min().unwrap_or(0)).collect();
    let less = |key: &Vec<u32>| key.iter().zip(&least).map(|(a, b)| a - b).collect();
    own.iter().map(|(key, value)| (less(key), value / &content)).collect()
}

fn product(a: &Sparse, b: &Sparse) -> Sparse {
    let mut made = Sparse::new();
    for ((first, x), (second, y)) in
        a.iter().flat_map(|own| b.iter().map(move |other| (own, other)))
    {
        let key = first.iter().zip(second).map(|(a, b)| a + b).collect();
        *made.entry(key).or_default() += x * y;
    }
    made.retain(|_, value| !value.is_zero());
    made
}

/// The quotient of the first terms of two polynomials; `None` if it is no such term.
fn first_quotient(a: &Sparse, b: &Sparse) -> Option<Sparse> {
    let ((upper, x), (lower, y)) = (a.last_key_value()?, b.last_key_value()?);
    let key: Option<Vec<u32>> = upper.iter().zip(lower).map(|(a, b)| a.checked_sub(*b)).collect();
    let (quotient, rest) = x.div_rem(y);
    rest.is_zero().then(|| Some([(key?, quotient)].into_iter().collect()))?
}

fn minus(a: &mut Sparse, b: &Sparse) {
    for (key, value) in b {
        *a.entry(key.clone()).or_default() -= value;
    }
    a.retain(|_, value| !value.is_zero());
}

/// The quotient of two polynomials; `None` if the division leaves a rest.
fn divided(a: &Sparse, b: &Sparse) -> Option<Sparse> {
    let (mut rest, mut made) = (a.clone(), Sparse::new());
    while !rest.is_empty() {
        let term = first_quotient(&rest, b)?;
        minus(&mut rest, &product(&term, b));
        made.extend(term);
    }
    Some(made)
}

/// The square root of a polynomial, its first term positive.
fn root(own: &Sparse) -> Option<Sparse> {
    let (key, value) = own.last_key_value()?;
    let half: Option<Vec<u32>> = key.iter().map(|a| a.is_even().then_some(a / 2)).collect();
    let first = value.is_positive().then(|| value.sqrt())?;
    if &(&first * &first) != value {
        return None;
    }
    let mut made: Sparse = [(half?, first)].into_iter().collect();
    let mut rest = own.clone();
    minus(&mut rest, &product(&made, &made));
    while !rest.is_empty() {
        let (place, value) = made.last_key_value()?;
        let twice: Sparse = [(place.clone(), value * 2)].into_iter().collect();
        let term = first_quotient(&rest, &twice)?;
        if made.len() == MOST_TERMS || made.first_key_value()?.0 <= term.first_key_value()?.0 {
            return None;
        }
        let cross: Sparse = made.iter().map(|(key, value)| (key.clone(), value * 2)).collect();
        minus(&mut rest, &product(&cross, &term));
        minus(&mut rest, &product(&term, &term));
        made.extend(term);
    }
    Some(made)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(terms: &[(&[u32], i64)]) -> Polynomial {
        sorted(&terms.iter().map(|(key, value)| (key.to_vec(), BigInt::from(*value))).collect())
    }

    #[test]
    fn fractions_lose_common_factors_and_give_roots() {
        // x³y/(4 x y (x² + y)²)
        let sum = of(&[(&[2, 0], 1), (&[0, 1], 1)]);
        let below = times(&times(&sum, &sum), &of(&[(&[1, 1], 4)]));
        let [above, below] = reduced(&of(&[(&[3, 1], -1)]), &below);
        let found = square_fraction(&above, &below).expect("a square up to a number");
        assert_eq!(found.numbers, [BigInt::from(-1), BigInt::from(4)]);
        assert_eq!(found.roots, [of(&[(&[1, 0], 1)]), sum.clone()]);
        assert!(found.rest.iter().all(is_one));
        let one = of(&[(&[0, 0], 1)]);
        let rest = |own: &Polynomial| square_fraction(own, &one).expect("not 0").rest;
        assert_eq!(rest(&sum), [sum.clone(), one.clone()], "x² + y is no square");
        let odd = of(&[(&[2, 0], 1), (&[1, 1], 2), (&[0, 2], 1), (&[0, 0], 1)]);
        assert_eq!(rest(&odd), [odd.clone(), one.clone()], "(x + y)² + 1 is no square");
        let all =
            vec![times(&sum, &of(&[(&[1, 0], 6)])), multiple(&times(&sum, &odd), &BigInt::from(4))];
        let all = without_common(all, std::slice::from_ref(&sum));
        assert_eq!(all, [of(&[(&[1, 0], 3)]), multiple(&odd, &BigInt::from(2))]);
    }
}
