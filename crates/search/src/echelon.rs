//! Row echelon form modulo a prime, built row by row.

use liouville::number::prime::Modulus;

/// Places of the entries of a vector that are not 0.
pub fn nonzero(vector: &[u64]) -> Vec<usize> {
    (0..vector.len()).filter(|place| vector[*place] != 0).collect()
}

/// Number of bytes that so many entries of sparse rows take, each a value with its column.
pub fn bytes(entries: usize) -> u64 {
    (entries * (size_of::<u64>() + size_of::<u32>())) as u64
}

/// A set of independent rows with distinct pivots.
#[derive(Clone)]
pub struct Echelon {
    modulus: Modulus,
    /// Row by pivot column.
    rows: Vec<Option<SparseRow>>,
    /// Number of entries looked at so far.
    steps: u64,
    /// Number of entries kept.
    entries: usize,
    rank: usize,
}

/// A row with 1 at its pivot and 0 before it; rows stay sparse for long.
#[derive(Clone)]
struct SparseRow {
    /// Columns behind the pivot in which the row is not 0.
    columns: Box<[u32]>,
    /// Entries in these columns.
    values: Box<[u64]>,
    /// Place from which on the columns are all up to the last of the matrix.
    dense: usize,
}

impl SparseRow {
    /// Makes a row of a matrix with so many columns.
    fn new(columns: Vec<u32>, values: Vec<u64>, width: usize) -> Self {
        let in_place = |(behind, column): &(usize, &u32)| **column as usize + behind + 1 == width;
        let tail = columns.iter().rev().enumerate().take_while(in_place).count();
        let dense = columns.len() - tail;
        Self { columns: columns.into(), values: values.into(), dense }
    }

    /// Adds a multiple to sums of products, one for each column.
    fn add_to(&self, wide: &mut [u128], factor: u64) {
        let product = |value: &u64| u128::from(factor).wrapping_mul(u128::from(*value));
        let (values, tail) = self.values.split_at(self.dense);
        for (column, value) in self.columns.iter().zip(values) {
            let sum = &mut wide[*column as usize];
            *sum = sum.wrapping_add(product(value));
        }
        let start = wide.len() - tail.len();
        for (sum, value) in wide[start..].iter_mut().zip(tail) {
            *sum = sum.wrapping_add(product(value));
        }
    }

    /// Iterates over the columns and values behind the pivot.
    fn entries(&self) -> impl Iterator<Item = (usize, u64)> {
        self.columns.iter().zip(&self.values).map(|(column, value)| (*column as usize, *value))
    }
}

impl Echelon {
    /// Makes an echelon form without rows.
    pub fn new(columns: usize, modulus: Modulus) -> Self {
        Self { modulus, rows: vec![None; columns], steps: 0, entries: 0, rank: 0 }
    }

    /// Adds a row; returns `false` if it depends on those before it.
    pub fn push(&mut self, row: Vec<u64>) -> bool {
        self.pivot(row).is_some()
    }

    /// Adds a row; returns the column of its pivot, with its entry there before it is scaled; `None` if
    /// it depends on those before it.
    ///
    /// Entries are sums of products that are reduced when they are needed, or when a further product
    /// might not fit: that takes one multiplication a product instead of three.
    pub fn pivot(&mut self, row: Vec<u64>) -> Option<(usize, u64)> {
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
            let Some(pivot) = &self.rows[column] else {
                self.steps += 1;
                self.rows[column] = Some(self.scaled(&wide, column, entry));
                return Some((column, entry));
            };
            self.steps += pivot.columns.len() as u64 + 1;
            if pending == most {
                let behind = wide[column..].iter_mut().filter(|entry| **entry != 0);
                behind.for_each(|entry| *entry = m.widened(m.reduced(*entry)));
                pending = 0;
            }
            pending += 1;
            pivot.add_to(&mut wide, m.sub(0, entry));
        }
        None
    }

    /// Makes a row with 1 at its pivot, where its entry is `entry`.
    fn scaled(&mut self, wide: &[u128], pivot: usize, entry: u64) -> SparseRow {
        let m = self.modulus;
        let inverse = m.inverse(entry);
        let most = wide[pivot + 1..].iter().filter(|sum| **sum != 0).count();
        let (mut columns, mut values) = (Vec::with_capacity(most), Vec::with_capacity(most));
        for (column, sum) in wide.iter().enumerate().skip(pivot + 1) {
            let value = if *sum == 0 { 0 } else { m.mul(m.reduced(*sum), inverse) };
            if value != 0 {
                columns.push(column as u32);
                values.push(value);
            }
        }
        self.entries += columns.len() + 1;
        self.rank += 1;
        SparseRow::new(columns, values, wide.len())
    }

    /// Number of entries that were looked at while rows were added: the work of the elimination,
    /// the same on every machine.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Number of independent rows.
    pub fn rank(&self) -> usize {
        self.rank
    }

    /// Number of bytes that the rows take.
    pub fn bytes(&self) -> u64 {
        bytes(self.entries)
    }

    /// Iterates over the independent rows, reduced by those before them.
    pub fn rows(&self) -> impl Iterator<Item = Vec<u64>> {
        let dense = |(pivot, row): (usize, &Option<SparseRow>)| {
            let mut dense = vec![0; self.rows.len()];
            dense[pivot] = self.modulus.one();
            row.as_ref()?.entries().for_each(|(column, value)| dense[column] = value);
            Some(dense)
        };
        self.rows.iter().enumerate().filter_map(dense)
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
                let own = row.entries().take_while(|(other, _)| *other <= free);
                let used = own.filter(|(other, _)| vector[*other] != 0);
                let sum = used.fold(0, |sum, (other, a)| m.add(sum, m.mul(a, vector[other])));
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
