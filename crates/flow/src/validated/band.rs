//! Approximate inverses of matrices whose entries lie near the diagonal, except a last column.
//!
//! Nothing that is proved rests on their accuracy.

use liouville::order::StableOrder;

/// Inverts a square matrix given by its columns, each a list of rows and entries: Gaussian
/// elimination with the largest pivot, inside the band. Row by row; `None` where a pivot is 0 or
/// not finite.
pub fn inverse(columns: &[Vec<(usize, f64)>]) -> Option<Vec<f64>> {
    let size = columns.len();
    let border = size.checked_sub(1)?;
    let mut first = vec![border; size];
    let mut last = vec![0; size];
    for (column, entries) in columns[..border].iter().enumerate() {
        for (row, _) in entries {
            first[*row] = first[*row].min(column);
            last[*row] = last[*row].max(column);
        }
    }
    let mut order: Vec<usize> = (0..size).collect();
    order.order_by_key(|row| first[*row]);
    let mut place = vec![0; size];
    order.iter().enumerate().for_each(|(index, row)| place[*row] = index);
    let mut matrix = vec![0.0; size * size];
    for (column, entries) in columns.iter().enumerate() {
        for (row, value) in entries {
            matrix[place[*row] * size + column] = *value;
        }
    }
    // Each row of the right side has the unit vector of its equation.
    let mut side = vec![0.0; size * size];
    order.iter().enumerate().for_each(|(index, row)| side[index * size + row] = 1.0);
    let mut reach: Vec<usize> = order.iter().map(|row| last[*row]).collect();
    let firsts: Vec<usize> = order.iter().map(|row| first[*row]).collect();
    for column in 0..size {
        let end = firsts.partition_point(|first| *first <= column);
        let magnitude = |row: &usize| matrix[row * size + column].abs();
        let pivot = (column..end).max_by(|a, b| magnitude(a).total_cmp(&magnitude(b)))?;
        if pivot != column {
            for k in 0..size {
                matrix.swap(pivot * size + k, column * size + k);
                side.swap(pivot * size + k, column * size + k);
            }
            reach.swap(pivot, column);
        }
        let by = matrix[column * size + column].recip();
        if !by.is_finite() {
            return None;
        }
        for row in column + 1..end {
            let factor = matrix[row * size + column] * by;
            if factor == 0.0 {
                continue;
            }
            reach[row] = reach[row].max(reach[column]);
            let (above, below) = matrix.split_at_mut(row * size);
            let band = column..reach[column].max(column) + 1;
            let (own, other) = (&mut below[..size], &above[column * size..][..size]);
            subtract(&mut own[band.clone()], factor, &other[band.clone()]);
            if !band.contains(&border) {
                own[border] -= factor * other[border];
            }
            let (above, below) = side.split_at_mut(row * size);
            subtract(&mut below[..size], factor, &above[column * size..][..size]);
        }
    }
    for row in (0..size).rev() {
        let (above, below) = side.split_at_mut((row + 1) * size);
        let own = &mut above[row * size..];
        let inside = row + 1..(reach[row] + 1).max(row + 1).min(border);
        for column in inside.chain((row < border).then_some(border)) {
            let factor = matrix[row * size + column];
            if factor != 0.0 {
                subtract(own, factor, &below[(column - row - 1) * size..][..size]);
            }
        }
        let by = matrix[row * size + row].recip();
        own.iter_mut().for_each(|x| *x *= by);
    }
    side.iter().all(|x| x.is_finite()).then_some(side)
}

fn subtract(own: &mut [f64], factor: f64, other: &[f64]) {
    own.iter_mut().zip(other).for_each(|(x, y)| *x -= factor * y);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bordered_band_is_inverted() {
        let size = 40;
        let entry = |row: usize, column: usize| -> f64 {
            let near = row.abs_diff(column) <= 3 || column == size - 1;
            let value = ((row * 37 + column * 101) % 17) as f64 - 8.0;
            if near { value } else { 0.0 }
        };
        let columns: Vec<Vec<(usize, f64)>> = (0..size)
            .map(|column| {
                let entries = (0..size).map(|row| (row, entry(row, column)));
                entries.filter(|(_, value)| *value != 0.0).collect()
            })
            .collect();
        let found = inverse(&columns).expect("regular");
        for row in 0..size {
            for column in 0..size {
                let product: f64 =
                    (0..size).map(|k| found[row * size + k] * entry(k, column)).sum();
                let unit = if row == column { 1.0 } else { 0.0 };
                assert!((product - unit).abs() < 1e-9, "({row}, {column}): {product}");
            }
        }
    }

    #[test]
    fn a_singular_matrix_has_no_inverse() {
        let columns = vec![vec![(0, 1.0), (1, 2.0)], vec![(0, 2.0), (1, 4.0)]];
        assert_eq!(inverse(&columns), None, "two proportional columns");
    }
}
