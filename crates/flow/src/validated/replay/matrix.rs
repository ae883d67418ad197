//! Matrices of balls, with approximate inverses about which nothing is assumed.

use super::number::{ReplayNumber, Wide};
use crate::validated::enclosure::Enclosure;
use crate::validated::krawczyk::Inverse;
use rayon::prelude::*;

/// Matrix by columns, each a list of rows and entries.
pub type Columns = Vec<Vec<(usize, Wide)>>;

/// Approximate inverse of the midpoints; `order` puts the columns near the diagonal.
pub fn inverse(columns: &Columns, order: &[usize]) -> Option<Inverse> {
    let rounded = |column: &Vec<(usize, Wide)>| {
        column.iter().map(|(row, x)| (*row, Enclosure::exact(x.mid()))).collect()
    };
    Inverse::new(&columns.iter().map(rounded).collect(), order)
}

/// Bounds |C b| for a vector, row by row.
pub fn products(inverse: &Inverse, vector: &[Wide]) -> Vec<Wide> {
    let row = |index: usize| {
        let terms = inverse.row(index).iter().zip(vector);
        let sum = terms.fold(Wide::zero(), |sum, (c, x)| sum.plus(&Wide::exact(*c).times(x)));
        sum.magnitude()
    };
    (0..vector.len()).into_par_iter().map(row).collect()
}

/// Bounds Σ_j |1 - C A|_ij r_j, and Σ_j |1 - C A|_ij, for each row i.
pub fn defects(inverse: &Inverse, columns: &Columns, radii: &[f64]) -> Vec<(Wide, Wide)> {
    let row = |index: usize| {
        let weights: Vec<Wide> = inverse.row(index).iter().map(|c| Wide::exact(*c)).collect();
        let (mut moved, mut norm) = (Wide::zero(), Wide::zero());
        for (other, (column, radius)) in columns.iter().zip(radii).enumerate() {
            let unit = Wide::exact(if index == other { 1.0 } else { 0.0 });
            let entry =
                column.iter().fold(unit, |sum, (place, x)| sum.minus(&weights[*place].times(x)));
            let size = entry.magnitude();
            moved = moved.add(&size.mul(&Wide::exact(*radius)));
            norm = norm.add(&size);
        }
        (moved, norm)
    };
    (0..columns.len()).into_par_iter().map(row).collect()
}

/// Bounds ‖1 - C A‖ in the norm of row sums.
pub fn norm(inverse: &Inverse, columns: &Columns) -> Wide {
    let all = defects(inverse, columns, &vec![0.0; columns.len()]);
    all.iter().fold(Wide::zero(), |largest, (_, norm)| largest.larger(norm))
}

/// Whether every matrix inside a square one, given by its rows, is regular.
pub fn is_regular(rows: &[Vec<Wide>]) -> bool {
    let size = rows.len();
    if rows.iter().any(|row| row.len() != size) {
        return false;
    }
    let column = |column: usize| (0..size).map(|row| (row, rows[row][column].clone())).collect();
    let columns: Columns = (0..size).map(column).collect();
    let found = inverse(&columns, &(0..size).collect::<Vec<_>>());
    found.is_some_and(|inverse| norm(&inverse, &columns).is_below(&Wide::exact(1.0)))
}

/// Encloses Σ a x for f64 a.
pub fn combined(weights: &[f64], values: &[Wide]) -> Wide {
    let terms = weights.iter().zip(values);
    terms.fold(Wide::zero(), |sum, (weight, x)| sum.plus(&Wide::exact(*weight).times(x)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn matrix(entries: [[f64; 2]; 2], rad: f64) -> Vec<Vec<Wide>> {
        entries.map(|row| row.map(|x| Wide::about(x, rad)).to_vec()).to_vec()
    }

    #[test]
    fn regular_only_where_all_are() {
        assert!(is_regular(&matrix([[2.0, 1.0], [1.0, 3.0]], 0.1)), "far from singular");
        assert!(!is_regular(&matrix([[2.0, 1.0], [1.0, 3.0]], 1.5)), "some inside are singular");
        assert!(!is_regular(&matrix([[1.0, 1.0], [1.0, 1.0]], 0.0)), "singular");
        assert!(!is_regular(&matrix([[2.0, 1.0], [1.0, 3.0]], f64::NAN)), "unknown entries");
    }
}
