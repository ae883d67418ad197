//! Relations Q(s) t = P(s) between values in a table of points modulo a prime.

use crate::number::prime::Modulus;
use crate::number::rational::Rational;

use super::monomials::{Monomial, product_modulo};
use crate::proof::elimination::reduce;
use crate::proof::reconstruct::reconstruct;

/// Values at random points modulo a prime.
pub struct Table {
    pub modulus: Modulus,
    /// Places of the values, in order.
    pub tracked: Vec<usize>,
    /// The values at each point.
    pub rows: Vec<Vec<u64>>,
}

impl Table {
    /// Returns the values of a place at all points.
    fn column(&self, place: usize) -> Option<Vec<u64>> {
        let index = self.tracked.binary_search(&place).ok()?;
        Some(self.rows.iter().map(|row| row[index]).collect())
    }

    /// Returns the values of all monomials in some places, a row for each point.
    fn monomials(&self, all: &[Monomial], symbols: &[usize]) -> Option<Vec<Vec<u64>>> {
        let columns: Vec<Vec<u64>> =
            symbols.iter().map(|place| self.column(*place)).collect::<Option<_>>()?;
        let row = |point: usize| -> Vec<u64> {
            let values: Vec<u64> = columns.iter().map(|column| column[point]).collect();
            all.iter().map(|monomial| product_modulo(monomial, &values, &self.modulus)).collect()
        };
        Some((0..self.rows.len()).map(row).collect())
    }
}

/// Coefficients of P and Q modulo the prime of a table.
pub struct Relation {
    modulus: Modulus,
    above: Vec<(Monomial, u64)>,
    below: Vec<(Monomial, u64)>,
}

impl Relation {
    /// Returns P and Q with rational coefficients; `None` if these are not small.
    pub fn reconstructed(&self) -> Option<[Vec<(Monomial, Rational)>; 2]> {
        let of = |terms: &[(Monomial, u64)]| -> Option<Vec<(Monomial, Rational)>> {
            let term = |(monomial, value): &(Monomial, u64)| {
                Some((monomial.clone(), reconstruct(*value, &self.modulus)?))
            };
            terms.iter().map(term).collect()
        };
        Some([of(&self.above)?, of(&self.below)?])
    }
}

/// Finds t = P(s).
pub fn combination(
    table: &Table,
    all: &[Monomial],
    symbols: &[usize],
    target: usize,
) -> Option<Relation> {
    let (m, target) = (&table.modulus, table.column(target)?);
    let mut matrix = table.monomials(all, symbols)?;
    matrix.iter_mut().zip(&target).for_each(|(row, value)| row.push(*value));
    let (pivots, rows) = reduce(matrix, all.len() + 1, m);
    // The target is a combination unless it adds to the rank.
    if pivots.last() == Some(&all.len()) {
        return None;
    }
    let term = |(pivot, row): (&usize, &Vec<u64>)| (all[*pivot].clone(), row[all.len()]);
    let above = pivots.iter().zip(&rows).map(term).filter(|(_, value)| *value != 0).collect();
    Some(Relation { modulus: *m, above, below: vec![(Vec::new(), m.one())] })
}

/// Finds Q(s) t = P(s), where Q is not 0 as a function of the points.
pub fn quotient(
    table: &Table,
    all: &[Monomial],
    symbols: &[usize],
    target: usize,
) -> Option<Relation> {
    let (m, target) = (&table.modulus, table.column(target)?);
    let values = table.monomials(all, symbols)?;
    // Without a relation between the monomials left, no Q vanishes.
    let (basis, _) = reduce(values.clone(), all.len(), m);
    let n = basis.len();
    let row = |(row, t): (&Vec<u64>, &u64)| -> Vec<u64> {
        let plain = basis.iter().map(|k| row[*k]);
        plain.chain(basis.iter().map(|k| m.mul(row[*k], *t))).collect()
    };
    let matrix: Vec<Vec<u64>> = values.iter().zip(&target).map(row).collect();
    let (pivots, rows) = reduce(matrix, 2 * n, m);
    let free = (n..2 * n).find(|column| pivots.binary_search(column).is_err())?;
    let [mut above, mut below] = [Vec::new(), vec![(all[basis[free - n]].clone(), m.one())]];
    for (pivot, row) in pivots.iter().zip(&rows) {
        match row[free] {
            0 => {}
            value if *pivot < n => above.push((all[basis[*pivot]].clone(), value)),
            value => below.push((all[basis[*pivot - n]].clone(), m.sub(0, value))),
        }
    }
    Some(Relation { modulus: *m, above, below })
}
