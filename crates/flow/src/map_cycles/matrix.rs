//! Small matrices of enclosures.

use crate::validated::Enclosure;

/// Rows of a matrix.
pub type Matrix = Vec<Vec<Enclosure>>;

/// Product of two matrices.
pub fn product(a: &[Vec<Enclosure>], b: &[Vec<Enclosure>]) -> Matrix {
    let entry = |row: &[Enclosure], column: usize| {
        row.iter().zip(b).fold(Enclosure::ZERO, |sum, (x, other)| sum + *x * other[column])
    };
    a.iter().map(|row| (0..row.len()).map(|column| entry(row, column)).collect()).collect()
}

/// Determinant, by its first column.
pub fn determinant(a: &[Vec<Enclosure>]) -> Enclosure {
    let without = |left: usize| -> Matrix {
        let rows = a.iter().enumerate().filter(|(row, _)| *row != left);
        rows.map(|(_, row)| row[1..].to_vec()).collect()
    };
    match a.len() {
        0 => Enclosure::exact(1.0),
        _ => a.iter().enumerate().fold(Enclosure::ZERO, |sum, (index, row)| {
            let part = row[0] * determinant(&without(index));
            if index.is_multiple_of(2) { sum + part } else { sum - part }
        }),
    }
}

/// Sum of the diagonal.
pub fn trace(a: &[Vec<Enclosure>]) -> Enclosure {
    a.iter().enumerate().fold(Enclosure::ZERO, |sum, (index, row)| sum + row[index])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn determinants_have_their_signs() {
        let rows = |rows: &[&[f64]]| -> Matrix {
            rows.iter().map(|row| row.iter().map(|x| Enclosure::exact(*x)).collect()).collect()
        };
        let matrix = rows(&[&[0.0, 2.0, 1.0], &[1.0, 0.0, 3.0], &[4.0, 1.0, 0.0]]);
        assert_eq!(determinant(&matrix).mid, 25.0);
        assert_eq!(trace(&product(&matrix, &matrix)).mid, 18.0);
    }
}
