//! Entries of a bracket as formulas, and the case in which it is judged.

use std::cmp::Ordering;

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{Signed, Zero};

use super::super::SearchError;
use super::super::terms::{combined, is_one, whole};
use super::monomials::power_product;
use super::poisson::BracketSearch;
use liouville::case::Case;
use liouville::formula::{Formula, FormulaError, FormulaResult, Type};

impl BracketSearch<'_> {
    /// Entries P_ij, i < j, by rows; the last multiple divides all, unless it is 0.
    pub(super) fn entries(&self, multiples: &[BigInt]) -> Result<Vec<Formula>, FormulaError> {
        let (field, own) = match multiples.split_last() {
            Some((field, own)) => (field.clone(), own),
            None => (BigInt::ZERO, multiples),
        };
        let below = if field.is_zero() { BigInt::from(-1) } else { field };
        let mut entries = Vec::new();
        let dimension = self.family.names.len();
        for pair in (0..dimension).flat_map(|i| (i + 1..dimension).map(move |j| (i, j))) {
            let used = || self.family.unknowns.iter().zip(own).filter(|(one, _)| one.pair == pair);
            let terms: Result<Vec<Formula>, FormulaError> = used()
                .filter(|(_, a)| !a.is_zero())
                .map(|(one, _)| {
                    let power = power_product(&self.family.names, &one.exponents)?;
                    self.family.weights[one.weight].on(&power)
                })
                .collect();
            // Σ c P + f v = 0: P is −c/f.
            let common = used().fold(below.clone(), |gcd, (_, a)| gcd.gcd(a));
            let sign = if below.is_negative() { common } else { -common };
            let values: Vec<BigInt> =
                used().filter(|(_, a)| !a.is_zero()).map(|(_, a)| a / &sign).collect();
            let above = combined(&values, &terms?)?;
            let divisor = (&below / &sign).abs();
            entries.push(match (above, divisor == 1.into()) {
                (None, _) => Formula::number(0),
                (Some(above), true) => above,
                (Some(above), false) => (above.bracketed() / &whole(&divisor))?,
            });
        }
        Ok(entries)
    }

    /// Entry P_ij of the bracket with some entries above its diagonal; 0 where none is given.
    pub(super) fn entry(&self, entries: &[Formula], i: usize, j: usize) -> Formula {
        let (low, high, count) = (i.min(j), i.max(j), self.family.names.len());
        // Earlier rows come first: row k has count − 1 − k entries.
        let place = (0..low).map(|k| count - 1 - k).sum::<usize>() + high.saturating_sub(low + 1);
        let own = entries.get(place).cloned().unwrap_or_else(|| Formula::number(0));
        match i.cmp(&j) {
            Ordering::Less => own,
            Ordering::Equal => Formula::number(0),
            Ordering::Greater => -own.bracketed(),
        }
    }

    /// Writes the nonzero entries, such as `{x,y} = x*y`.
    pub(super) fn shown(&self, entries: &[Formula]) -> String {
        let names = &self.family.names;
        let pairs = (0..names.len()).flat_map(|i| (i + 1..names.len()).map(move |j| (i, j)));
        let nonzero = pairs.zip(entries).filter(|(_, entry)| !is_zero(entry));
        let one = |((i, j), entry): ((usize, usize), &Formula)| {
            format!("{{{},{}}} = {entry}", names[i], names[j])
        };
        nonzero.map(one).collect::<Vec<_>>().join(", ")
    }

    /// Adds a bracket in the state variables to the case; without entries, the bracket 0.
    pub(super) fn with_bracket(&self, entries: &[Formula]) -> Result<Case, SearchError> {
        let state = &self.case.model.state;
        let entry = |i: usize, j: usize| self.entry(entries, i, j);
        let mut named = Vec::new();
        for variable in self.case.model.state_variables() {
            named.push((variable.to_string(), variable));
        }
        let asked = self.case.with_variables(&named)?;
        let starts: Vec<usize> = state
            .iter()
            .scan(0, |start, variable| {
                let own = *start;
                *start += variable.len();
                Some(own)
            })
            .collect();
        let mut blocks = Vec::new();
        for (first, (a, i)) in state.iter().zip(&starts).enumerate() {
            for (second, (b, j)) in state.iter().zip(&starts).enumerate().skip(first) {
                let block = match (a.kind, b.kind) {
                    (Type::Scalar, Type::Scalar) if first == second => continue,
                    (Type::Scalar, Type::Scalar) => entry(*i, *j),
                    (Type::Scalar, across) => {
                        row((0..across.size()).map(|k| entry(*i, j + k)).collect())?
                    }
                    (down, Type::Scalar) => {
                        row((0..down.size()).map(|k| entry(i + k, *j)).collect())?
                    }
                    // hat(u) has −u₃, u₂, −u₁ above its diagonal.
                    (Type::VECTOR, _) if first == second => {
                        let axis = vec![entry(i + 2, i + 1), entry(*i, i + 2), entry(i + 1, *i)];
                        Formula::call("hat", &[&row(axis)?])?
                    }
                    (down, across) => {
                        let all: Vec<Formula> = (0..down.size())
                            .flat_map(|k| (0..across.size()).map(move |l| (i + k, j + l)))
                            .map(|(i, j)| entry(i, j))
                            .collect();
                        Type::Matrix(down.size(), across.size()).filled(&all)?
                    }
                };
                blocks.push(((first, second), asked.in_variables(&block)?));
            }
        }
        Ok(asked.with_bracket(&blocks)?)
    }
}

/// Whether a formula is the number 0.
fn is_zero(formula: &Formula) -> bool {
    formula.constant().is_some_and(|value| value.is_zero())
}

fn row(parts: Vec<Formula>) -> FormulaResult {
    Type::Vector(parts.len()).filled(&parts)
}

/// A factor of the entries: 1, a component of a parameter, or the inverse of one.
#[derive(Clone, Debug)]
pub(super) enum Weight {
    /// Factor above the line.
    Above(Formula),
    /// Factor below the line.
    Below(Formula),
}

impl Weight {
    /// The weight as a formula.
    pub(super) fn formula(&self) -> FormulaResult {
        match self {
            Weight::Above(own) => Ok(own.clone()),
            Weight::Below(own) => Formula::number(1) / own,
        }
    }

    /// The product of the weight and a monomial.
    pub(super) fn on(&self, power: &Formula) -> FormulaResult {
        match self {
            Weight::Above(own) if is_one(own) => Ok(power.clone()),
            Weight::Above(own) if is_one(power) => Ok(own.clone()),
            Weight::Above(own) => own * power,
            Weight::Below(own) => power / own,
        }
    }
}
