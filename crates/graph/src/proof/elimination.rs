//! Linear algebra modulo a prime.

use crate::number::prime::Modulus;

/// Reduces a matrix to reduced row echelon form modulo p; returns the pivot columns and their rows.
pub fn reduce(mut rows: Vec<Vec<u64>>, columns: usize, m: &Modulus) -> (Vec<usize>, Vec<Vec<u64>>) {
    let mut pivots = Vec::new();
    for column in 0..columns {
        let done = pivots.len();
        let Some(found) = (done..rows.len()).find(|row| rows[*row][column] != 0) else { continue };
        rows.swap(done, found);
        let inverse = m.inverse(rows[done][column]);
        rows[done].iter_mut().for_each(|entry| *entry = m.mul(*entry, inverse));
        let pivot = rows[done].clone();
        for row in (0..rows.len()).filter(|row| *row != done) {
            let factor = rows[row][column];
            if factor != 0 {
                for (entry, pivot) in rows[row].iter_mut().zip(&pivot) {
                    *entry = m.sub(*entry, m.mul(factor, *pivot));
                }
            }
        }
        pivots.push(column);
    }
    rows.truncate(pivots.len());
    (pivots, rows)
}

#[cfg(test)]
mod tests {
    use super::super::rng::ProofRng;
    use super::*;

    #[test]
    fn elimination_names_the_basis() {
        let m = ProofRng::new(3, 0).prime(&[], &[]);
        let n = |x: u64| m.integer(x);
        let rows = vec![vec![n(1), n(2), n(5)], vec![n(2), n(4), n(11)], vec![n(3), n(6), n(16)]];
        let (pivots, rows) = reduce(rows, 3, &m);
        assert_eq!(pivots, [0, 2], "the second column is twice the first");
        assert_eq!(rows[0][1], n(2), "twice");
    }
}
