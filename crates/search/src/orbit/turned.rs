//! The other reduced basis of a space of vectors.

use liouville::number::prime::Modulus;

use super::super::{Halt, SearchError};

/// Reduces independent vectors from the other end, as if their columns were in reverse order: each has
/// a last entry 1, in a column where the others are 0. The vectors are returned with their entries in
/// reverse order.
pub fn turned(
    m: &Modulus,
    mut vectors: Vec<Vec<u64>>,
    halt: &Halt,
) -> Result<Vec<Vec<u64>>, SearchError> {
    let mut done = 0;
    for column in 0..vectors.first().map_or(0, Vec::len) {
        let Some(found) = (done..vectors.len()).find(|row| vectors[*row][column] != 0) else {
            continue;
        };
        halt.check()?;
        vectors.swap(done, found);
        let inverse = m.inverse(vectors[done][column]);
        let own = vectors[done].iter().map(|entry| m.mul(*entry, inverse));
        let own: Vec<u64> = own.collect();
        for other in vectors.iter_mut().filter(|other| other[column] != 0) {
            let factor = other[column];
            for (entry, own) in other.iter_mut().zip(&own) {
                *entry = m.sub(*entry, m.mul(factor, *own));
            }
        }
        vectors[done] = own;
        done += 1;
    }
    vectors.truncate(done);
    vectors.reverse();
    vectors.iter_mut().for_each(|own| own.reverse());
    Ok(vectors)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::echelon::Echelon;
    use crate::streams::SearchStream;

    /// The basis that an elimination of the same rows with their columns in reverse order finds.
    #[test]
    fn the_basis_is_that_of_the_columns_in_reverse_order() {
        let mut rng = SearchStream::Moduli.numbered(1, 0);
        let m = rng.prime(&[], &[]);
        for round in 0..60 {
            let (width, height) = (1 + round % 13, round % 9);
            let entry = |k: usize| if k % 3 == round % 3 { 0 } else { m.integer((k % 5) as u64) };
            let mut rows: Vec<Vec<u64>> = (0..height)
                .map(|row| (0..width).map(|column| entry(row * row + 7 * column + round)).collect())
                .collect();
            if let Some(last) = rows.last_mut().filter(|_| round % 2 == 0) {
                last.iter_mut().for_each(|entry| *entry = rng.element(&m));
            }
            let basis = |rows: &[Vec<u64>]| {
                let mut echelon = Echelon::new(width, m);
                rows.iter().for_each(|row| _ = echelon.push(row.clone()));
                echelon.null_space()
            };
            let own = turned(&m, basis(&rows), &Halt::default()).expect("no limit");
            rows.iter_mut().for_each(|row| row.reverse());
            assert_eq!(own, basis(&rows), "round {round}");
        }
    }
}
