//! Krawczyk's operator with an approximate inverse in f64, every rounding counted.

use super::band;
use super::enclosure::{Enclosure, raised, rounding};
use super::shooting::Columns;

/// Approximate inverse of a square matrix, row by row.
pub struct Inverse {
    size: usize,
    entries: Vec<f64>,
}

impl Inverse {
    /// Inverts the midpoints of a matrix; `order` puts its columns near the diagonal.
    pub fn new(columns: &Columns, order: &[usize]) -> Option<Self> {
        let size = columns.len();
        let mid = |column: &usize| columns[*column].iter().map(|(row, x)| (*row, x.mid)).collect();
        let found = band::inverse(&order.iter().map(mid).collect::<Vec<_>>())?;
        let mut entries = vec![0.0; size * size];
        for (place, unknown) in order.iter().enumerate() {
            entries[unknown * size..][..size].copy_from_slice(&found[place * size..][..size]);
        }
        Some(Self { size, entries })
    }

    /// Row of the inverse.
    pub fn row(&self, index: usize) -> &[f64] {
        &self.entries[index * self.size..][..self.size]
    }

    /// Approximate product with a vector.
    pub fn times(&self, vector: &[Enclosure]) -> Vec<f64> {
        let row = |row: &[f64]| row.iter().zip(vector).map(|(c, x)| c * x.mid).sum();
        self.entries.chunks(self.size).map(row).collect()
    }

    /// Bounds the magnitudes of the product with a vector.
    pub fn bounds(&self, vector: &[Enclosure]) -> Vec<f64> {
        let bound = |row: &[f64]| {
            let (mut mid, mut size, mut rad) = (0.0, 0.0, 0.0);
            for (c, x) in row.iter().zip(vector) {
                mid += c * x.mid;
                size += (c * x.mid).abs();
                rad += c.abs() * x.rad;
            }
            let size = raised(size, self.size);
            raised(mid.abs() + raised(rad, self.size) + rounding(size, self.size), 4)
        };
        self.entries.chunks(self.size).map(bound).collect()
    }

    /// Bounds Σ_j |1 - C A|_ij r_j for each row i, and the largest Σ_j |1 - C A|_ij.
    pub fn defects(&self, columns: &Columns, radii: &[f64]) -> (Vec<f64>, f64) {
        let mut largest = 0.0;
        let mut moved = Vec::with_capacity(self.size);
        for (index, row) in self.entries.chunks(self.size).enumerate() {
            let (mut total, mut norm) = (0.0, 0.0);
            for (other, (column, radius)) in columns.iter().zip(radii).enumerate() {
                let unit = if index == other { 1.0 } else { 0.0 };
                let (mut mid, mut size, mut rad) = (unit, unit, 0.0);
                for (place, x) in column {
                    let c = row[*place];
                    mid -= c * x.mid;
                    size += (c * x.mid).abs();
                    rad += c.abs() * x.rad;
                }
                let terms = column.len() + 1;
                let size = raised(size, terms);
                let entry = raised(mid.abs() + raised(rad, terms) + rounding(size, terms), 4);
                norm += entry;
                total += entry * radius;
            }
            moved.push(raised(total, self.size));
            // A maximum would pass over NaN.
            let norm = raised(norm, self.size);
            largest = if norm <= largest { largest } else { norm };
        }
        (moved, largest)
    }
}

/// Whether every matrix inside a square one of enclosures is regular, by an approximate inverse.
pub fn is_regular(rows: &[Vec<Enclosure>]) -> bool {
    let size = rows.len();
    if rows.iter().any(|row| row.len() != size) {
        return false;
    }
    let column = |column: usize| (0..size).map(|row| (row, rows[row][column])).collect();
    let columns: Columns = (0..size).map(column).collect();
    let order: Vec<usize> = (0..size).collect();
    let found = Inverse::new(&columns, &order);
    found.is_some_and(|inverse| inverse.defects(&columns, &vec![1.0; size]).1 < 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn matrix(entries: [[f64; 2]; 2], rad: f64) -> Vec<Vec<Enclosure>> {
        entries.map(|row| row.map(|x| Enclosure::about(x, rad)).to_vec()).to_vec()
    }

    #[test]
    fn regular_only_where_all_are() {
        assert!(is_regular(&matrix([[2.0, 1.0], [1.0, 3.0]], 0.1)), "far from singular");
        assert!(!is_regular(&matrix([[2.0, 1.0], [1.0, 3.0]], 1.5)), "some inside are singular");
        assert!(!is_regular(&matrix([[1.0, 1.0], [1.0, 1.0]], 0.0)), "singular");
        assert!(!is_regular(&matrix([[2.0, 1.0], [1.0, 3.0]], f64::NAN)), "unknown entries");
    }
}
