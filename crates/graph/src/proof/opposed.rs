//! Cells on which three facts contradict each other.
//!
//! X > 0, Y ≥ 0 and Z ≥ 0 have no common input if X + Y + Z vanishes identically. Intervals do not see
//! it: x > y > z > x is an order of three numbers that no box excludes.

use crate::graph::{Expr, Fault};

use super::cells::Cell;
use super::explore::Explorer;
use super::fact::SignFact;
use super::lower::Algebraic;
use super::next::Next;
use super::tower::Tower;
use super::trial::{Roots, Trial, TrialResult};

/// Largest number of facts of which all triples are tried.
const MOST_FACTS: usize = 12;

impl Explorer<'_> {
    /// The answer for a cell three of whose facts are about values that add up to zero.
    pub fn opposed(
        &self,
        cell: &Cell,
        algebraic: &Algebraic<'_>,
        tower: &Tower,
        known: &[(usize, SignFact)],
    ) -> Result<Option<Next>, Fault> {
        let of_value = |(place, fact): &(usize, SignFact)| {
            let value = algebraic.values.get(*place).copied().flatten()?;
            tower.is_clean(algebraic, value).then_some((value, *fact))
        };
        // The signs chosen last and the radicands of the roots that are left come last.
        let facts = known.iter().rev().filter_map(of_value).take(MOST_FACTS);
        let facts: Vec<(Expr, SignFact)> = facts.collect();
        if facts.len() < 3 || cell.signs().next().is_none() {
            return Ok(None);
        }
        let triples = triples(facts.len())
            .filter(|triple| triple.iter().any(|index| facts[*index].1 == SignFact::Positive));
        let made = algebraic.with(|_, at| {
            let sum =
                |[i, j, k]: [usize; 3]| Some(at(facts[i].0)? + at(facts[j].0)? + at(facts[k].0)?);
            triples.map(sum).collect()
        })?;
        let Some((extended, sums)) = made else { return Ok(None) };
        let groups: Vec<&[Expr]> = sums.iter().map(std::slice::from_ref).collect();
        let roots = Roots { nested: tower.nested, fixed: &[] };
        let found = Trial::new(&extended, self.digest).test(&groups, roots);
        Ok(found.into_iter().find_map(|result| match result {
            TrialResult::Zero(own) => Some(Next::Empty(Some(own))),
            _ => None,
        }))
    }
}

/// Lists all triples of different indices below a number.
fn triples(count: usize) -> impl Iterator<Item = [usize; 3]> {
    let pairs = (0..count).flat_map(move |i| (i + 1..count).map(move |j| (i, j)));
    pairs.flat_map(move |(i, j)| (j + 1..count).map(move |k| [i, j, k]))
}
