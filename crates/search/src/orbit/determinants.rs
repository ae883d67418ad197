//! Determinants modulo a prime.

use liouville::number::prime::Modulus;

use super::super::{Halt, SearchError};

/// Computes the determinants of n + 1 rows of length n, once without the last and once without the one before.
pub fn determinants(
    m: &Modulus,
    rows: &[Vec<u64>],
    halt: &Halt,
) -> Result<(u64, u64), SearchError> {
    let size = rows.len() - 1;
    let mut elimination = Elimination::new(m, size);
    for row in &rows[..size - 1] {
        halt.check()?;
        if !elimination.push(row) {
            return Ok((0, 0));
        }
    }
    Ok((elimination.last(&rows[size - 1]), elimination.last(&rows[size])))
}

/// An elimination row by row, in which each entry is one sum of products.
struct Elimination<'m> {
    m: &'m Modulus,
    /// Columns of the rows in the order of their pivots.
    order: Vec<usize>,
    /// Entries of the reduced rows by column: down to the pivot of a column.
    columns: Vec<Vec<u64>>,
    /// −1 over the pivots.
    inverses: Vec<u64>,
    /// Multiples of the rows that are added to the present one.
    multiples: Vec<u64>,
    /// Product of the pivots, with the sign of the order.
    product: u64,
}

impl<'m> Elimination<'m> {
    fn new(m: &'m Modulus, size: usize) -> Self {
        Self {
            m,
            order: (0..size).collect(),
            columns: vec![Vec::with_capacity(size); size],
            inverses: Vec::with_capacity(size),
            multiples: Vec::with_capacity(size),
            product: m.one(),
        }
    }

    /// Finds the multiples of the reduced rows that leave no entries at their pivots.
    fn reduce(&mut self, row: &[u64]) {
        self.multiples.clear();
        for (k, inverse) in self.inverses.iter().enumerate() {
            let sum = self.m.dot(&self.multiples, &self.columns[k][..k]);
            let entry = self.m.add(row[self.order[k]], sum);
            self.multiples.push(self.m.mul(entry, *inverse));
        }
    }

    /// Entry of the reduced row at a place of the order.
    fn entry(&self, row: &[u64], place: usize) -> u64 {
        self.m.add(row[self.order[place]], self.m.dot(&self.multiples, &self.columns[place]))
    }

    /// Adds a row; `false` if it depends on those before it.
    fn push(&mut self, row: &[u64]) -> bool {
        self.reduce(row);
        let (m, done) = (self.m, self.inverses.len());
        for place in done..self.order.len() {
            let entry = self.entry(row, place);
            self.columns[place].push(entry);
        }
        let found = (done..self.order.len()).find(|place| self.columns[*place][done] != 0);
        let Some(found) = found else { return false };
        if found != done {
            self.columns.swap(found, done);
            self.order.swap(found, done);
            self.product = m.sub(0, self.product);
        }
        let pivot = self.columns[done][done];
        self.product = m.mul(self.product, pivot);
        self.inverses.push(m.sub(0, m.inverse(pivot)));
        true
    }

    /// The determinant with a last row.
    fn last(&mut self, row: &[u64]) -> u64 {
        self.reduce(row);
        self.m.mul(self.product, self.entry(row, self.order.len() - 1))
    }
}

#[cfg(test)]
mod tests {
    use liouville::proof::ProofRng;

    use super::*;

    /// Determinant by the first row.
    fn expanded(m: &Modulus, rows: &[Vec<u64>]) -> u64 {
        let Some((first, rest)) = rows.split_first() else { return m.one() };
        let mut sum = 0;
        for (k, entry) in first.iter().enumerate() {
            let without = |row: &Vec<u64>| [&row[..k], &row[k + 1..]].concat();
            let minor = expanded(m, &rest.iter().map(without).collect::<Vec<_>>());
            let term = m.mul(*entry, minor);
            sum = if k % 2 == 0 { m.add(sum, term) } else { m.sub(sum, term) };
        }
        sum
    }

    #[test]
    fn determinants_are_those_of_their_expansion() {
        let m = Modulus::new(2_305_843_009_213_693_951);
        let mut rng = ProofRng::new(5, 0);
        let mut zeros = 0;
        for round in 0..200 {
            let size = 1 + round % 5;
            // Many zeros, so that pivots are at other places and some rows depend on others.
            let mut entry = |_| m.integer(rng.below(3));
            let rows: Vec<Vec<u64>> =
                (0..=size).map(|_| (0..size).map(&mut entry).collect()).collect();
            let others = [&rows[..size - 1], &rows[size..]].concat();
            let expected = (expanded(&m, &rows[..size]), expanded(&m, &others));
            let found = determinants(&m, &rows, &Halt::default()).expect("no halt");
            assert_eq!(found, expected, "{rows:?}");
            zeros += usize::from(expected.0 == 0);
        }
        assert!((20..180).contains(&zeros), "{zeros} of 200 are 0");
    }
}
