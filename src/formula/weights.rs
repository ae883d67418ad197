//! Weights of symbols in one base dimension, and the equations between them.

use std::collections::BTreeMap;

use super::scope::Symbol;
use crate::number::rational::Rational;

/// Power of the base dimension with which a quantity scales: -1 for a frequency in time.
pub type Weight = Rational;

/// A weight that may depend on weights not yet known: `constant + Σ factor · unknown`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct LinearWeight {
    constant: Rational,
    /// Factors by unknown; none is zero.
    factors: BTreeMap<usize, Rational>,
}

impl LinearWeight {
    pub fn constant(constant: Rational) -> Self {
        Self { constant, factors: BTreeMap::new() }
    }

    pub fn zero() -> Self {
        Self::constant(Rational::from(0))
    }

    /// Returns `self + factor · other`.
    pub fn plus(mut self, other: &LinearWeight, factor: &Rational) -> Self {
        self.constant = &self.constant + &(&other.constant * factor);
        for (unknown, its) in &other.factors {
            let added = its * factor;
            let total = self.factors.get(unknown).map_or(added.clone(), |old| old + &added);
            if total.is_zero() {
                self.factors.remove(unknown);
            } else {
                self.factors.insert(*unknown, total);
            }
        }
        self
    }

    /// Returns `factor · self`.
    pub fn times(&self, factor: &Rational) -> Self {
        Self::zero().plus(self, factor)
    }

    /// Weight, if no unknown is left in it.
    pub fn known(&self) -> Option<&Weight> {
        self.factors.is_empty().then_some(&self.constant)
    }
}

/// Weights of all symbols of a case in one base dimension, known or being inferred.
///
/// Every formula that is checked adds its equations, so that weights inferred from one formula hold
/// in the next.
#[derive(Clone, Debug)]
pub struct WeightSystem {
    dimension: String,
    symbols: BTreeMap<Symbol, usize>,
    unknowns: usize,
    /// Unknowns expressed in unknowns of smaller number.
    solved: BTreeMap<usize, LinearWeight>,
}

impl WeightSystem {
    /// A system for one base dimension, such as `time`, in which no weight is known.
    pub fn new(dimension_name: &str) -> Self {
        Self {
            dimension: dimension_name.to_string(),
            symbols: BTreeMap::new(),
            unknowns: 0,
            solved: BTreeMap::new(),
        }
    }

    /// Declares a weight. Must precede the check of formulas: a weight already inferred stays.
    pub fn set(&mut self, symbol: Symbol, weight: Rational) {
        let symbol = self.symbol(symbol);
        // a contradiction leaves the system as it was
        let _ = self.equate(&symbol, &LinearWeight::constant(weight));
    }

    /// Weight of a symbol, if it is declared or implied by the formulas checked so far.
    pub fn get(&self, symbol: Symbol) -> Option<Weight> {
        let unknown = *self.symbols.get(&symbol)?;
        self.reduced(LinearWeight {
            factors: [(unknown, Rational::from(1))].into(),
            ..LinearWeight::zero()
        })
        .known()
        .cloned()
    }

    /// Name of the base dimension.
    pub fn dimension(&self) -> &str {
        &self.dimension
    }

    /// Weight of a symbol, known or not.
    pub(super) fn symbol(&mut self, symbol: Symbol) -> LinearWeight {
        let next = &mut self.unknowns;
        let unknown = *self.symbols.entry(symbol).or_insert_with(|| {
            *next += 1;
            *next - 1
        });
        self.reduced(variable(unknown))
    }

    /// A new unknown weight.
    pub(super) fn fresh(&mut self) -> LinearWeight {
        self.unknowns += 1;
        variable(self.unknowns - 1)
    }

    /// Substitutes everything known into a weight.
    pub(super) fn reduced(&self, mut form: LinearWeight) -> LinearWeight {
        let mut free = BTreeMap::new();
        // solutions contain smaller unknowns only, so the largest is never met again
        while let Some((unknown, factor)) = form.factors.pop_last() {
            match self.solved.get(&unknown) {
                Some(solution) => form = form.plus(solution, &factor),
                None => {
                    free.insert(unknown, factor);
                }
            }
        }
        LinearWeight { constant: form.constant, factors: free }
    }

    /// Adds the equation `left = right`; `Err` with the difference if it contradicts others.
    pub(super) fn equate(
        &mut self,
        left: &LinearWeight,
        right: &LinearWeight,
    ) -> Result<(), Weight> {
        let minus = Rational::from(-1);
        let mut difference = self.reduced(left.clone().plus(right, &minus));
        let Some((unknown, factor)) = difference.factors.pop_last() else {
            let constant = difference.constant;
            return if constant.is_zero() { Ok(()) } else { Err(constant) };
        };
        if let Some(inverse) = factor.recip() {
            self.solved.insert(unknown, difference.times(&-&inverse));
        }
        Ok(())
    }
}

fn variable(unknown: usize) -> LinearWeight {
    LinearWeight { constant: Rational::from(0), factors: [(unknown, Rational::from(1))].into() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equations_determine_unknowns() {
        let mut system = WeightSystem::new("time");
        let one = Rational::from(1);
        let (x, y) = (system.symbol(Symbol(0)), system.symbol(Symbol(1)));
        let sum = x.clone().plus(&y, &one);
        assert_eq!(system.equate(&sum, &LinearWeight::constant(3.into())), Ok(()), "x + y = 3");
        assert_eq!(system.get(Symbol(0)), None, "not determined yet");
        assert_eq!(system.equate(&x, &y.times(&Rational::from(2))), Ok(()), "x = 2y");
        assert_eq!(system.get(Symbol(0)), Some(Rational::from(2)), "x");
        assert_eq!(system.get(Symbol(1)), Some(Rational::from(1)), "y");
        assert_eq!(system.equate(&x, &y), Err(Rational::from(1)), "x = y contradicts");
    }

    #[test]
    fn declared_weights_are_known_at_once() {
        let mut system = WeightSystem::new("time");
        system.set(Symbol(5), Rational::from(-1));
        assert_eq!(system.symbol(Symbol(5)).known(), Some(&Rational::from(-1)), "declared");
        assert_eq!(system.fresh().known(), None, "a fresh weight is unknown");
        assert_eq!(system.get(Symbol(6)), None, "so is that of a symbol never seen");
    }
}
