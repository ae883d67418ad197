//! Classes of exponents that a polynomial field does not mix.
//!
//! A field whose rate of x_i contains x^m takes x^a to multiples of x^(a + m − e_i). With the shifts
//! m − e_i of all its terms, an integral is a sum of integrals in each of which any two exponents
//! differ by a sum of differences of shifts: scalings, sign changes and the reversal of time split
//! the monomials into these classes.

/// A lattice of whole vectors.
#[derive(Clone, Debug, Default)]
pub struct ExponentLattice {
    /// Rows in echelon form, each with the place of its first entry, which is positive.
    rows: Vec<(usize, Vec<i64>)>,
}

impl ExponentLattice {
    /// Adds a vector; `None` if the entries become too large.
    pub fn push(&mut self, mut own: Vec<i64>) -> Option<()> {
        for place in 0..own.len() {
            if own[place] == 0 {
                continue;
            }
            let next = self.rows.partition_point(|(pivot, _)| *pivot < place);
            match self.rows.get_mut(next).filter(|(pivot, _)| *pivot == place) {
                Some((_, row)) => {
                    while own[place] != 0 {
                        let quotient = row[place].div_euclid(own[place]);
                        subtract(row, quotient, &own)?;
                        std::mem::swap(row, &mut own);
                    }
                    positive(row, place);
                }
                None => {
                    positive(&mut own, place);
                    self.rows.insert(next, (place, own));
                    return Some(());
                }
            }
        }
        Some(())
    }

    /// The representative of a class of vectors; `None` if its entries are too large.
    pub fn class(&self, mut own: Vec<i64>) -> Option<Vec<i64>> {
        for (place, row) in &self.rows {
            let quotient = own[*place].div_euclid(row[*place]);
            // Few entries of a monomial in many variables are not 0.
            if quotient != 0 {
                subtract(&mut own, quotient, row)?;
            }
        }
        Some(own)
    }
}

fn subtract(from: &mut [i64], times: i64, other: &[i64]) -> Option<()> {
    for (entry, own) in from.iter_mut().zip(other) {
        *entry = entry.checked_sub(times.checked_mul(*own)?)?;
    }
    Some(())
}

fn positive(row: &mut [i64], place: usize) {
    if row[place] < 0 {
        row.iter_mut().for_each(|entry| *entry = -*entry);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vectors_of_a_class_have_one_representative() {
        let mut lattice = ExponentLattice::default();
        let rows = [[2, 0, 1], [0, 3, 0], [4, 3, 2], [6, 0, 1]];
        rows.iter().for_each(|row| lattice.push(row.to_vec()).expect("small"));
        let class = |own: [i64; 3]| lattice.class(own.to_vec()).expect("small");
        assert_eq!(class([0, 0, 0]), class([4, 0, 0]), "2·(2, 0, 1) − … has no third entry");
        assert_eq!(class([1, 5, 7]), class([-1, -1, 6]));
        assert_ne!(class([1, 0, 0]), class([0, 0, 0]));
        assert_ne!(class([0, 1, 0]), class([0, 2, 0]));
    }
}
