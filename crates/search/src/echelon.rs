//! Row echelon form modulo a prime, built row by row.

use liouville::number::prime::Modulus;

/// A set of independent rows with distinct pivots.
pub struct Echelon {
    modulus: Modulus,
    /// Row by pivot column, with 1 at its pivot and 0 before it.
    rows: Vec<Option<Vec<u64>>>,
    /// Columns behind the pivot in which the row is not 0, by pivot column; rows stay sparse for
    /// long.
    others: Vec<Box<[u32]>>,
    /// Number of entries looked at so far.
    steps: u64,
    /// Number of rows kept.
    rank: usize,
}

impl Echelon {
    /// Makes an echelon form without rows.
    pub fn new(columns: usize, modulus: Modulus) -> Self {
        Self {
            modulus,
            rows: vec![None; columns],
            others: vec![Box::default(); columns],
            steps: 0,
            rank: 0,
        }
    }

    /// Adds a row; returns `false` if it depends on those before it.
    ///
    /// Entries are sums of products that are reduced when they are needed, or when a further product
    /// might not fit: that takes one multiplication a product instead of three.
    pub fn push(&mut self, mut row: Vec<u64>) -> bool {
        let m = self.modulus;
        let mut wide: Vec<u128> = row.iter().map(|entry| m.widened(*entry)).collect();
        let (mut pending, most) = (0, m.most_products());
        self.steps += row.len() as u64;
        for column in 0..row.len() {
            if wide[column] == 0 {
                continue;
            }
            let entry = m.reduced(wide[column]);
            if entry == 0 {
                continue;
            }
            let others = &self.others[column];
            self.steps += others.len() as u64 + 1;
            match &self.rows[column] {
                Some(pivot) => {
                    if pending == most {
                        let behind = wide[column..].iter_mut().filter(|entry| **entry != 0);
                        behind.for_each(|entry| *entry = m.widened(m.reduced(*entry)));
                        pending = 0;
                    }
                    pending += 1;
                    let factor = u128::from(m.sub(0, entry));
                    for other in others {
                        let other = *other as usize;
                        let product = factor.wrapping_mul(u128::from(pivot[other]));
                        wide[other] = wide[other].wrapping_add(product);
                    }
                }
                None => {
                    let inverse = m.inverse(entry);
                    let mut others = Vec::new();
                    row[..column].fill(0);
                    for (other, (entry, wide)) in row.iter_mut().zip(&wide).enumerate().skip(column)
                    {
                        *entry = m.mul(m.reduced(*wide), inverse);
                        if *entry != 0 && other > column {
                            others.push(other as u32);
                        }
                    }
                    self.others[column] = others.into();
                    self.rows[column] = Some(row);
                    self.rank += 1;
                    return true;
                }
            }
        }
        false
    }

    /// Number of entries that were looked at while rows were added: the work of the elimination,
    /// the same on every machine.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Number of bytes that the rows take.
    pub fn bytes(&self) -> u64 {
        (self.rank * self.rows.len() * (size_of::<u64>() + size_of::<u32>())) as u64
    }

    /// Iterates over the independent rows, reduced by those before them.
    pub fn rows(&self) -> impl Iterator<Item = &Vec<u64>> {
        self.rows.iter().flatten()
    }

    /// Number of columns.
    pub fn columns(&self) -> usize {
        self.rows.len()
    }

    /// Whether some row has its pivot in this column.
    pub fn has_pivot(&self, column: usize) -> bool {
        self.rows[column].is_some()
    }

    /// Lists the columns without pivots.
    pub fn free(&self) -> Vec<usize> {
        (0..self.rows.len()).filter(|column| self.rows[*column].is_none()).collect()
    }

    /// Returns a basis of the null space of all rows: for each free column the vector with 1 there
    /// and 0 at the other free columns.
    pub fn null_space(&self) -> Vec<Vec<u64>> {
        self.free().into_iter().map(|free| self.null_vector(free)).collect()
    }

    /// Returns the vector of the null space with 1 at a free column and 0 at the other free columns.
    pub fn null_vector(&self, free: usize) -> Vec<u64> {
        let m = self.modulus;
        let mut vector = vec![0; self.rows.len()];
        vector[free] = m.one();
        for column in (0..free).rev() {
            if let Some(row) = &self.rows[column] {
                let own = row[column + 1..=free].iter().zip(&vector[column + 1..=free]);
                let used = own.filter(|(a, x)| **a != 0 && **x != 0);
                let sum = used.fold(0, |sum, (a, x)| m.add(sum, m.mul(*a, *x)));
                vector[column] = m.sub(0, sum);
            }
        }
        vector
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn null_vectors_are_annulled() {
        let m = Modulus::new(2_305_843_009_213_693_951);
        let n = |x: u64| m.integer(x);
        let mut echelon = Echelon::new(4, m);
        let rows = [[1, 2, 0, 3], [2, 4, 1, 1], [3, 6, 1, 4]];
        let added: Vec<bool> =
            rows.iter().map(|row| echelon.push(row.iter().map(|x| n(*x)).collect())).collect();
        assert_eq!(added, [true, true, false], "the third row is the sum of the others");
        let vectors = echelon.null_space();
        assert_eq!(vectors.len(), 2);
        for vector in vectors {
            for row in rows {
                let sum = row.iter().zip(&vector).fold(0, |s, (a, b)| m.add(s, m.mul(n(*a), *b)));
                assert_eq!(sum, 0, "row · vector");
            }
        }
    }
}
