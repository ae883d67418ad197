//! Cells on which the signs of factors contradict each other: rule S9 of docs/soundness.md.
//!
//! Facts are read as products of irreducible polynomials. X > 0 says that none of its factors is 0, and that an even
//! number of those that occur an odd number of times is negative; so does Y ≥ 0 if all factors of Y occur in such an
//! X. Signs of factors are those of sums of squares, or are known by intervals. What is said of the signs is a
//! linear system over the field of two elements.

use std::collections::BTreeMap;

use crate::number::rational::Rational;

use super::cells::Cell;
use super::explore::Explorer;
use super::fact::SignFact;
use super::factors::polynomial;
use super::next::Next;
use super::polynomial::{MOST_WORK, Polynomial};

/// Largest number of facts that are read.
const MOST_FACTS: usize = 12;
/// Largest number of factors.
const MOST_FACTORS: usize = 24;
/// Largest number of terms of a fact.
const MOST_TERMS: usize = 200;

impl Explorer<'_> {
    /// The answer for a cell on which the signs of factors contradict each other.
    pub fn opposed_by_factors(&self, cell: &Cell, known: &[(usize, SignFact)]) -> Option<Next> {
        cell.signs().next()?;
        let mut system = System::default();
        // The signs chosen last come last.
        let read = |(place, fact): &(usize, SignFact)| {
            let own = polynomial(&cell.graph, cell.graph.at(*place))?;
            (!own.is_zero() && own.size() <= MOST_TERMS).then_some((own, *fact))
        };
        let facts: Vec<(Polynomial, SignFact)> =
            known.iter().rev().filter_map(read).take(MOST_FACTS).collect();
        let (strict, others): (Vec<_>, Vec<_>) =
            facts.into_iter().partition(|(_, fact)| *fact == SignFact::Positive);
        for (own, _) in &strict {
            system.factors_of(own);
        }
        for (own, _) in strict.iter().chain(&others) {
            system.take(own);
        }
        // What the form of one value says alone is left to sums of squares, which are printed.
        let is_alone = strict.len() + others.len() == 1;
        if !is_alone && system.is_contradictory() {
            return Some(Next::Empty(None));
        }
        let mut is_seen = !is_alone;
        for index in 0..system.factors.len() {
            let factor = &system.factors[index];
            let definite = definite_sign(factor).filter(|_| !is_alone);
            let sign = definite.or_else(|| self.sign_of_factor(cell, known, factor));
            if let Some(is_positive) = sign {
                system.equations.push((1 << index, !is_positive));
                is_seen = true;
            }
        }
        (is_seen && system.is_contradictory()).then_some(Next::Empty(None))
    }

    /// Sign of a polynomial in values of a cell, by intervals, where 0 counts as either sign.
    fn sign_of_factor(
        &self,
        cell: &Cell,
        known: &[(usize, SignFact)],
        factor: &Polynomial,
    ) -> Option<bool> {
        let places: Vec<usize> = factor.variables().into_iter().map(|own| own as usize).collect();
        cell.sign_of(known, self.prover.extents, &places, |values| {
            factor.value(&|own| values.get(own as usize).copied().flatten())
        })
    }
}

/// Signs of factors that are not 0, as unknowns: 1 for a negative one.
#[derive(Default)]
struct System {
    factors: Vec<Polynomial>,
    /// Sets of factors in bits, and whether an odd number of them is negative.
    equations: Vec<(u64, bool)>,
}

impl System {
    /// Takes up the factors of a polynomial that is not 0.
    fn factors_of(&mut self, own: &Polynomial) {
        for factor in own.factors() {
            if !self.factors.contains(&factor) && self.factors.len() < MOST_FACTORS {
                self.factors.push(factor);
            }
        }
    }

    /// Takes up that a polynomial is positive, if all of its factors are known not to be 0.
    fn take(&mut self, own: &Polynomial) {
        let (mut rest, mut odd) = (own.clone(), BTreeMap::<usize, bool>::new());
        for (index, factor) in self.factors.iter().enumerate() {
            while rest.number().is_none()
                && let Some(quotient) = rest.over(factor, &mut { MOST_WORK })
            {
                rest = quotient;
                *odd.entry(index).or_default() ^= true;
            }
        }
        let Some(number) = rest.number().filter(|number| !number.is_zero()) else { return };
        let set = odd.into_iter().filter(|(_, is_odd)| *is_odd).fold(0, |set, (k, _)| set | 1 << k);
        self.equations.push((set, number.is_negative()));
    }

    /// Whether no signs fulfil all equations.
    fn is_contradictory(&self) -> bool {
        let mut rows: Vec<(u64, bool)> = Vec::new();
        for (mut set, mut is_odd) in self.equations.iter().copied() {
            for (own, value) in &rows {
                // The first factor of each row occurs in no later one.
                if set & (1 << own.trailing_zeros()) != 0 {
                    (set, is_odd) = (set ^ own, is_odd ^ value);
                }
            }
            match (set, is_odd) {
                (0, true) => return true,
                (0, false) => {}
                row => rows.push(row),
            }
        }
        false
    }
}

/// Sign of a sum of squares with factors of one sign.
fn definite_sign(own: &Polynomial) -> Option<bool> {
    own.squares()?;
    // The value at a point where it is not 0.
    let value = own.terms().try_fold(Rational::from(0), |sum, (factor, powers)| {
        let product = powers.iter().try_fold(factor.clone(), |product, (variable, power)| {
            let at = Rational::from(i64::from(*variable) + 2);
            Some(&product * &at.powi(i32::try_from(*power).ok()?)?)
        });
        Some(&sum + &product?)
    })?;
    (!value.is_zero()).then(|| !value.is_negative())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn signs_that_contradict_each_other_are_seen() {
        let system = |equations: &[(u64, bool)]| System {
            factors: Vec::new(),
            equations: equations.to_vec(),
        };
        assert!(system(&[(0b11, false), (0b01, true), (0b10, false)]).is_contradictory());
        assert!(!system(&[(0b11, false), (0b01, true), (0b10, true)]).is_contradictory());
        assert!(system(&[(0b110, true), (0b011, true), (0b101, true)]).is_contradictory());
        assert!(!system(&[(0b110, true), (0b011, true), (0b101, false)]).is_contradictory());
        assert!(system(&[(0, true)]).is_contradictory());
        assert!(!system(&[(0, false)]).is_contradictory());
    }
}
