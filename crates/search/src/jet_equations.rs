//! Linear equations for the Taylor coefficients of polynomials in the velocities that are integrals,
//! or whose powers are densities.

use rustc_hash::FxHashMap;

use super::budget::Budget;
use super::echelon::Echelon;
use super::expansion::{FieldExpansion, Taylor};
use super::jets::VelocityPolynomials;
use super::reduced::ReducedEchelon;
use super::series::{TruncatedSeries, exponents};
use super::{Halt, SearchError};
use liouville::number::prime::Modulus;
use liouville::order::StableOrder;

/// Exponents of the velocities, and the index of a monomial in the positions.
pub type RowKey = (Vec<u32>, usize);

/// Columns and values of a sparse row.
type Entries = Vec<(usize, u64)>;

/// Linear equations for the Taylor coefficients of the C_a.
pub struct Equations {
    /// Order of the coefficient of each column, from high to low, so that the free columns are of
    /// low order.
    columns: Vec<u32>,
    /// Rows, each with the velocity exponents and the position monomial of its coefficient.
    rows: Vec<(RowKey, Entries)>,
    modulus: Modulus,
}

impl Equations {
    /// Numbers of unknowns and equations.
    pub fn size(&self) -> (usize, usize) {
        (self.columns.len(), self.rows.len())
    }

    /// Iterates over the rows in dense form, with their keys.
    pub fn rows(&self) -> impl Iterator<Item = (&RowKey, Vec<u64>)> {
        self.rows.iter().map(|(key, entries)| {
            let mut row = vec![0; self.columns.len()];
            for (column, value) in entries {
                row[*column] = self.modulus.add(row[*column], *value);
            }
            (key, row)
        })
    }

    /// Brings all equations into echelon form; returns it with the keys of the independent rows.
    pub fn solved(&self, budget: &Budget<'_>) -> Result<(Echelon, Vec<RowKey>), SearchError> {
        let mut echelon = Echelon::new(self.columns.len(), self.modulus);
        let mut keys = Vec::new();
        for (place, (key, row)) in self.rows().enumerate() {
            budget.check(&echelon)?;
            budget.tell(place, self.rows.len());
            if echelon.push(row) {
                keys.push(key.clone());
            }
        }
        Ok((echelon, keys))
    }

    /// Finds the columns with pivots alone.
    ///
    /// Rows of low order come first: with them each coefficient is expressed by the few that are
    /// free up to its order.
    pub fn ranked(&self, budget: &Budget<'_>) -> Result<ReducedEchelon, SearchError> {
        let mut rows: Vec<Entries> = self.rows.iter().map(|(_, row)| self.merged(row)).collect();
        rows.retain(|row| !row.is_empty());
        rows.order_by_key(|row| (std::cmp::Reverse(row[0].0), row.len()));
        let mut reduced = ReducedEchelon::new(self.columns.len(), self.modulus);
        let count = rows.len();
        for (place, row) in rows.into_iter().enumerate() {
            budget.check(&reduced)?;
            budget.tell(place, count);
            reduced.push(&row);
        }
        Ok(reduced)
    }

    /// Adds up the entries of a row with the same column; those that are 0 are left out.
    fn merged(&self, row: &Entries) -> Entries {
        let mut merged: Entries = Vec::with_capacity(row.len());
        for (column, value) in row {
            match merged.last_mut() {
                Some((last, sum)) if last == column => *sum = self.modulus.add(*sum, *value),
                _ => merged.push((*column, *value)),
            }
        }
        merged.retain(|(_, value)| *value != 0);
        merged
    }

    /// Bounds the number of integrals that the equations leave; `None` if they do not show that it is
    /// finite.
    pub fn dimension(&self, echelon: &Echelon) -> Option<usize> {
        self.free_where(|column| !echelon.has_pivot(column))
    }

    /// Bounds the number of integrals that the equations leave, of which pivots alone are known.
    pub fn free_below(&self, reduced: &ReducedEchelon) -> Option<usize> {
        self.free_where(|column| !reduced.has_pivot(column))
    }

    /// Number of free coefficients up to the least order J such that those of order J + 1 are all
    /// determined by others of order J + 1 at most: an integral is fixed by its J-jet then.
    fn free_where(&self, is_free: impl Fn(usize) -> bool) -> Option<usize> {
        let highest = self.columns.iter().max()?;
        let mut free = vec![0; *highest as usize + 1];
        for (column, order) in self.columns.iter().enumerate() {
            free[*order as usize] += usize::from(is_free(column));
        }
        let determined = free.iter().skip(1).position(|count| *count == 0)?;
        Some(free[..=determined].iter().sum())
    }

    /// Sets up the equations for L_vP + α div v P = 0 at a point, where α is the weight, up to an
    /// order within that of the expansion.
    pub fn of(
        expansion: &FieldExpansion,
        taylor: &Taylor<'_>,
        order: u32,
        asked: VelocityPolynomials,
        weight: u64,
        halt: &Halt,
    ) -> Result<Self, SearchError> {
        let (modulus, series) = (taylor.modulus, &taylor.series);
        let VelocityPolynomials { degree, mixed } = asked;
        let velocities = taylor.local.coordinates.velocities;
        let lowest = if mixed { 0 } else { degree };
        let powers: Vec<Vec<u32>> =
            (lowest..=degree).flat_map(|n| exponents(velocities, n)).collect();
        let monomials = &series.monomials()[..series.count_below(order + 1)];
        let degrees: Vec<u32> = monomials.iter().map(|own| own.iter().sum()).collect();
        // Columns from high order to low, so that the free ones are of low order.
        let mut columns: Vec<(usize, usize)> =
            (0..powers.len()).flat_map(|a| (0..monomials.len()).map(move |k| (a, k))).collect();
        columns.order_by_key(|(a, k)| (std::cmp::Reverse(degrees[*k]), *a, *k));
        let all = terms(expansion, series, weight, &modulus);
        let mut blocks = Blocks { place: FxHashMap::default(), rows: Vec::new() };
        let met: Vec<Vec<(usize, u64, &Term)>> = powers
            .iter()
            .map(|power| {
                let met = |term| {
                    let (raised, factor) = term_times(term, power)?;
                    let factor = modulus.integer(u64::from(factor));
                    Some((blocks.of(raised, series.count_below(order)), factor, term))
                };
                all.iter().filter_map(met).collect()
            })
            .collect();
        let lowered: Vec<_> =
            (0..taylor.local.coordinates.positions).map(|k| series.lowered(k)).collect();
        for (column, (a, k)) in columns.iter().enumerate() {
            halt.check()?;
            halt.meter().set(column, columns.len());
            for (block, factor, term) in &met[*a] {
                let (from, factor) = match term.along {
                    None => (*k, *factor),
                    Some(i) => {
                        let Some(from) = lowered[i][*k] else { continue };
                        let exponent = modulus.integer(u64::from(monomials[*k][i]));
                        (from, modulus.mul(*factor, exponent))
                    }
                };
                // Products of a degree below the order; the coefficients are in graded order.
                let end = series.count_below(order - degrees[from]);
                let products = series.products_with(from);
                let rows = &mut blocks.rows[*block].1;
                for (other, value) in term.entries.iter().take_while(|(other, _)| *other < end) {
                    let place = products[*other] as usize;
                    rows[place].push((column, modulus.mul(factor, *value)));
                }
            }
        }
        let columns = columns.into_iter().map(|(_, k)| degrees[k]).collect();
        Ok(Self { columns, rows: blocks.sorted(), modulus })
    }
}

/// A term of the operator P ↦ L_vP + α div v P: a series and a power of the velocities by which P is
/// multiplied, after it was differentiated.
struct Term {
    /// Position with respect to which P is differentiated, if any.
    along: Option<usize>,
    /// Velocity with respect to which P is differentiated, if any.
    across: Option<usize>,
    power: Vec<u32>,
    /// Coefficients other than 0, by increasing place.
    entries: Vec<(usize, u64)>,
}

/// Lists the terms of the operator.
fn terms(
    expansion: &FieldExpansion,
    series: &TruncatedSeries,
    weight: u64,
    m: &Modulus,
) -> Vec<Term> {
    let term = |along, across, power: &[u32], coefficient: &[u64], factor: u64| {
        let present = coefficient.iter().enumerate().filter(|(_, value)| **value != 0);
        let entries = present.map(|(place, value)| (place, m.mul(factor, *value))).collect();
        Term { along, across, power: power.to_vec(), entries }
    };
    let (mut all, one) = (Vec::new(), m.one());
    for (i, rate) in expansion.positions.iter().enumerate() {
        all.extend(rate.iter().map(|(w, series)| term(Some(i), None, w, series, one)));
    }
    for (i, rate) in expansion.velocities.iter().enumerate() {
        all.extend(rate.iter().map(|(w, series)| term(None, Some(i), w, series, one)));
    }
    if weight != 0 {
        let divergence = expansion.divergence(series);
        all.extend(divergence.iter().map(|(w, series)| term(None, None, w, series, weight)));
    }
    all
}

/// Returns the power of the velocities in a term applied to w^a, and its factor; `None` if that is
/// 0.
fn term_times(term: &Term, a: &[u32]) -> Option<(Vec<u32>, u32)> {
    let mut raised: Vec<u32> = a.iter().zip(&term.power).map(|(x, y)| x + y).collect();
    let Some(i) = term.across else { return Some((raised, 1)) };
    if a[i] == 0 {
        return None;
    }
    raised[i] -= 1;
    Some((raised, a[i]))
}

/// Rows by the power of the velocities and the place of the monomial in the positions.
struct Blocks {
    place: FxHashMap<Vec<u32>, usize>,
    rows: Vec<(Vec<u32>, Vec<Entries>)>,
}

impl Blocks {
    /// Returns the index of the block of a power, of which there are `height` rows.
    fn of(&mut self, power: Vec<u32>, height: usize) -> usize {
        *self.place.entry(power).or_insert_with_key(|power| {
            self.rows.push((power.clone(), vec![Vec::new(); height]));
            self.rows.len() - 1
        })
    }

    /// Returns the rows that are not empty, in the order of their keys.
    fn sorted(mut self) -> Vec<(RowKey, Entries)> {
        self.rows.order_by(|(a, _), (b, _)| a.cmp(b));
        let of_block = |(power, rows): (Vec<u32>, Vec<Entries>)| {
            let present = rows.into_iter().enumerate().filter(|(_, row)| !row.is_empty());
            present.map(move |(place, row)| ((power.clone(), place), row))
        };
        self.rows.into_iter().flat_map(of_block).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Effort;
    use crate::streams::SearchStream;

    /// Makes equations from rows with a first entry in a column of their own, followed by others.
    fn equations(modulus: Modulus, columns: usize, rows: Vec<Entries>) -> Equations {
        let rows = rows.into_iter().enumerate().map(|(k, row)| ((vec![0], k), row)).collect();
        Equations { columns: vec![0; columns], rows, modulus }
    }

    /// Checks that both ways of elimination find pivots in the same columns.
    fn agrees(equations: &Equations) -> usize {
        let effort = Effort::default();
        let budget = Budget::of(&effort);
        let ranked = equations.ranked(&budget).expect("within the budget");
        let (solved, keys) = equations.solved(&budget).expect("within the budget");
        let is_free = |column: &usize| !ranked.has_pivot(*column);
        let free: Vec<usize> = (0..ranked.columns()).filter(is_free).collect();
        assert_eq!(free, solved.free(), "the columns without pivots");
        keys.len()
    }

    #[test]
    fn both_ways_find_the_rank() {
        let mut rng = SearchStream::Jets.under(7);
        let m = rng.prime(&[], &[]);
        let (columns, mut ranks) = (24, Vec::new());
        for round in 0..200 {
            let mut below = |bound: usize| (m.to_integer(rng.element(&m)) % bound as u64) as usize;
            let mut rows: Vec<Entries> = Vec::new();
            for _ in 0..4 + round % 40 {
                let row: Entries = match below(3) {
                    // A multiple of a row, or the sum of two, depends on those before it.
                    0 if rows.len() > 1 => {
                        let (a, b) = (below(rows.len()), below(rows.len()));
                        let mut sum = [rows[a].clone(), rows[b].clone()].concat();
                        sum.sort_by_key(|(column, _)| *column);
                        sum
                    }
                    _ => {
                        let mut places: Vec<usize> =
                            (0..1 + below(4)).map(|_| below(columns)).collect();
                        places.sort_unstable();
                        let value =
                            |below: &mut dyn FnMut(usize) -> usize| m.integer(1 + below(3) as u64);
                        places.into_iter().map(|place| (place, value(&mut below))).collect()
                    }
                };
                rows.push(row);
            }
            ranks.push(agrees(&equations(m, columns, rows)));
        }
        assert!(ranks.contains(&columns), "all columns have pivots");
        assert!(ranks.iter().any(|rank| *rank < columns / 2), "few have");
    }

    #[test]
    fn a_last_equation_behind_dependent_ones_counts() {
        let m = SearchStream::Jets.under(3).prime(&[], &[]);
        let one = m.one();
        let mut rows: Vec<Entries> =
            (0..40u64).map(|k| vec![(0, m.integer(k + 1)), (1, m.integer(2 * k + 2))]).collect();
        rows.push(vec![(0, one), (1, one), (2, one)]);
        assert_eq!(agrees(&equations(m, 3, rows.clone())), 2);
        rows.push(vec![(0, one), (0, m.sub(0, one))]);
        assert_eq!(agrees(&equations(m, 3, rows)), 2, "entries that cancel are none");
    }
}
