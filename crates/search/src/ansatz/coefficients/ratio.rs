//! Ratios of some columns of a vector to others.

use std::collections::BTreeMap;

use num_bigint::BigInt;
use num_traits::Zero;

use super::{Polynomial, PrimitiveVector};
use liouville::formula::{Formula, FormulaError, FormulaResult};
use liouville::number::rational::Rational;

impl PrimitiveVector {
    /// Finds the constant c for which the columns `above` are c times the columns `below`, by the keys
    /// of their functions; 0 without `above`, `None` where there is none.
    pub fn ratio<K: Ord>(
        &self,
        above: &[usize],
        below: &[usize],
        key: &dyn Fn(&usize) -> K,
    ) -> Result<Option<Formula>, FormulaError> {
        if above.is_empty() {
            return Ok(Some(Formula::number(0)));
        }
        let by_key = |own: &[usize]| -> BTreeMap<K, &Polynomial> {
            own.iter().map(|column| (key(column), &self.polynomials[*column])).collect()
        };
        let (above, below) = (by_key(above), by_key(below));
        let is_same = above.len() == below.len() && above.keys().eq(below.keys());
        let mut pairs = above.values().zip(below.values());
        let Some((first, under)) = pairs.next().filter(|_| is_same) else { return Ok(None) };
        if !pairs.all(|(own, other)| product(own, under) == product(other, first)) {
            return Ok(None);
        }
        // A common numerical factor, or a fraction of two polynomials.
        if let (Some((_, a)), Some((_, b))) = (first.first(), under.first()) {
            let scaled = |own: &Polynomial, by: &BigInt| -> Polynomial {
                own.iter().map(|(powers, value)| (powers.clone(), value * by)).collect()
            };
            if scaled(first, b) == scaled(under, a) {
                return Ok(Some(Formula::number(Rational::from_parts(a.clone(), b.clone()))));
            }
        }
        let formula = |own: &Polynomial| -> FormulaResult {
            let alone = Self { names: self.names.clone(), polynomials: vec![own.clone()] };
            alone.formula(0)
        };
        Ok(Some((formula(first)?.bracketed() / &formula(under)?.bracketed())?))
    }
}

/// Product of two polynomials, without terms that are 0.
fn product(a: &Polynomial, b: &Polynomial) -> BTreeMap<Vec<u32>, BigInt> {
    let mut terms: BTreeMap<Vec<u32>, BigInt> = BTreeMap::new();
    for (first, x) in a {
        for (second, y) in b {
            let powers = first.iter().zip(second).map(|(p, q)| p + q).collect();
            *terms.entry(powers).or_default() += x * y;
        }
    }
    terms.retain(|_, value| !value.is_zero());
    terms
}
