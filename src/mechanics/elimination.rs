//! Linear algebra over any scalar: projections, determinants, traces, positive systems and others.

use super::blocks::{blocks, part};
use crate::scalar::Scalar;

/// Finds vectors n_i in the span of some gradients with dF_i(n_j) = δ_ij.
#[inline(never)]
pub fn transversals<T: Scalar>(gradients: &[Vec<T>]) -> Vec<Vec<T>> {
    let count = gradients.len();
    let unit = |i: usize, j: usize| if i == j { T::one() } else { T::zero() };
    let transversal = |i: usize| {
        // n_i = Σ_l (G⁻¹)_il ∇F_l with the Gram matrix G of the gradients
        let weights = solve_positive(gram(gradients), (0..count).map(|j| unit(i, j)).collect());
        let dimension = gradients.first().map_or(0, Vec::len);
        (0..dimension)
            .map(|k| weights.iter().zip(gradients).map(|(w, g)| *w * g[k]).sum())
            .collect()
    };
    (0..count).map(transversal).collect()
}

/// Computes u minus its projection on the span of `others`: zero exactly when u depends on them.
#[inline(never)]
pub fn rejection<T: Scalar>(u: &[T], others: &[Vec<T>]) -> Vec<T> {
    let projections = others.iter().map(|other| dot(u, other)).collect();
    let weights = solve_positive(gram(others), projections);
    let part = |k: usize| -> T { weights.iter().zip(others).map(|(w, g)| *w * g[k]).sum() };
    u.iter().enumerate().map(|(k, x)| if others.is_empty() { *x } else { *x - part(k) }).collect()
}

/// Computes the inner product Σ a_i b_i.
#[inline(never)]
pub fn dot<T: Scalar>(a: &[T], b: &[T]) -> T {
    a.iter().zip(b).map(|(a, b)| *a * *b).sum()
}

/// Largest size of a determinant computed by minors, of which there are 2ⁿ; larger ones are the
/// last coefficient of the characteristic polynomial.
const MOST_BY_MINORS: usize = 10;

/// Computes the Gram determinant of some vectors: zero exactly when they are dependent.
///
/// Expanded by minors of the first rows, since a pivot may vanish where the vectors are dependent.
#[inline(never)]
pub fn gram_determinant<T: Scalar>(vectors: &[Vec<T>]) -> T {
    let n = vectors.len();
    if vectors.first().is_some_and(|vector| vector.len() < n) {
        return T::zero();
    }
    determinant(&gram(vectors))
}

/// The determinant of a square matrix, without pivots.
#[inline(never)]
pub fn determinant<T: Scalar>(matrix: &[Vec<T>]) -> T {
    let n = matrix.len();
    if n > MOST_BY_MINORS {
        let last = characteristic_polynomial(matrix).pop().unwrap_or_else(T::one);
        return if n.is_multiple_of(2) { last } else { -last };
    }
    // minors[columns]: the determinant of the first rows with these columns
    let mut minors = vec![T::zero(); 1 << n];
    minors[0] = T::one();
    for columns in 1usize..1 << n {
        let row = columns.count_ones() as usize - 1;
        let mut sum = T::zero();
        let inside = (0..n).filter(|j| columns >> j & 1 == 1);
        for (place, j) in inside.enumerate() {
            let term = matrix[row][j] * minors[columns & !(1 << j)];
            sum = if (row + place).is_multiple_of(2) { sum + term } else { sum - term };
        }
        minors[columns] = sum;
    }
    minors[(1 << n) - 1]
}

/// Computes the coefficients of λ^(n-1), …, 1 in det(λE - A), A given by its columns, by the method
/// of Faddeev and LeVerrier.
#[inline(never)]
pub fn characteristic_polynomial<T: Scalar>(columns: &[Vec<T>]) -> Vec<T> {
    let n = columns.len();
    let mut coefficients = Vec::new();
    // power is A^k + c_1 A^(k-1) + … + c_k E, by columns
    let unit = |i: usize, j: usize| if i == j { T::one() } else { T::zero() };
    let mut power: Vec<Vec<T>> = (0..n).map(|j| (0..n).map(|i| unit(i, j)).collect()).collect();
    for k in 1..=n {
        let next: Vec<Vec<T>> = power
            .iter()
            .map(|column| (0..n).map(|i| (0..n).map(|l| columns[l][i] * column[l]).sum()).collect())
            .collect();
        let trace: T = (0..n).map(|i| next[i][i]).sum();
        let coefficient = -(trace / T::from(k as f64));
        coefficients.push(coefficient);
        power = next;
        for (i, column) in power.iter_mut().enumerate() {
            column[i] += coefficient;
        }
    }
    coefficients
}

/// Computes tr(B A⁻¹) for matrices given by their columns, by the normal equations of A.
#[inline(never)]
pub fn trace_of_quotient<T: Scalar>(a: &[Vec<T>], b: &[Vec<T>]) -> T {
    let solved = |j: usize| {
        let side = a.iter().map(|column| dot(column, &b[j])).collect();
        solve_positive(gram(a), side)[j]
    };
    (0..a.len()).map(solved).sum()
}

/// Computes the inner products of some vectors.
#[inline(never)]
pub fn gram<T: Scalar>(vectors: &[Vec<T>]) -> Vec<Vec<T>> {
    vectors.iter().map(|a| vectors.iter().map(|b| dot(a, b)).collect()).collect()
}

/// Solves A x = b for a positive definite A, by elimination without pivots.
#[inline(never)]
pub fn solve_positive<T: Scalar>(mut a: Vec<Vec<T>>, mut b: Vec<T>) -> Vec<T> {
    for k in 0..b.len() {
        let (above, below) = a.split_at_mut(k + 1);
        let (pivot_row, pivot_value) = (&above[k], b[k]);
        pivot_row[k].note_divisor();
        let present: Vec<usize> = (k..b.len()).filter(|j| !pivot_row[*j].is_absent()).collect();
        // A value that is defined nowhere makes all that it touches undefined, zeros too.
        let vanishes = |x: T| (x * T::zero()).is_absent();
        let is_plain = vanishes(pivot_row[k].recip())
            && vanishes(pivot_value)
            && present.iter().all(|j| vanishes(pivot_row[*j]));
        for (row, value) in below.iter_mut().zip(&mut b[k + 1..]) {
            if is_plain && row[k].is_absent() {
                continue;
            }
            let factor = row[k] / pivot_row[k];
            match vanishes(factor) {
                true => present.iter().for_each(|j| row[*j] -= factor * pivot_row[*j]),
                false => {
                    for (entry, pivot) in row.iter_mut().zip(pivot_row).skip(k) {
                        *entry -= factor * *pivot;
                    }
                }
            }
            *value -= factor * pivot_value;
        }
    }
    let mut are_plain = true;
    for k in (0..b.len()).rev() {
        let known: T = match are_plain {
            true => {
                let terms = a[k][k + 1..].iter().zip(&b[k + 1..]);
                terms.filter(|(entry, _)| !entry.is_absent()).map(|(a, b)| *a * *b).sum()
            }
            false => dot(&a[k][k + 1..], &b[k + 1..]),
        };
        b[k] = (b[k] - known) / a[k][k];
        are_plain = are_plain && (b[k] * T::zero()).is_absent();
    }
    b
}

/// Largest size of an inverse computed by minors; larger ones come from the characteristic
/// polynomial.
const MOST_COFACTORS: usize = 6;

/// Solves A x = b for several b and any A, without pivots: x = adj(A) b / det A for each block of A has a value
/// exactly where det A ≠ 0, also where a leading minor of A is 0.
#[inline(never)]
pub fn solve_by_minors<T: Scalar>(a: &[Vec<T>], sides: &[Vec<T>]) -> Vec<Vec<T>> {
    let mut solved: Vec<Vec<T>> = sides.to_vec();
    for block in blocks(a) {
        let own: Vec<Vec<T>> =
            sides.iter().map(|side| block.iter().map(|i| side[*i]).collect()).collect();
        for (whole, values) in solved.iter_mut().zip(block_solved(&part(a, &block), &own)) {
            block.iter().zip(values).for_each(|(i, value)| whole[*i] = value);
        }
    }
    solved
}

/// The same for a matrix of one block.
fn block_solved<T: Scalar>(a: &[Vec<T>], sides: &[Vec<T>]) -> Vec<Vec<T>> {
    let n = a.len();
    if n > MOST_COFACTORS {
        return sides.iter().map(|b| solved_by_powers(a, b)).collect();
    }
    let whole = determinant(a);
    whole.note_divisor();
    let inverse = whole.recip();
    let without = |row: usize, column: usize| {
        let rows = (0..n).filter(|i| *i != row);
        let minor: Vec<Vec<T>> =
            rows.map(|i| (0..n).filter(|j| *j != column).map(|j| a[i][j]).collect()).collect();
        let minor = determinant(&minor);
        if (row + column).is_multiple_of(2) { minor } else { -minor }
    };
    let adjugate: Vec<Vec<T>> = (0..n).map(|i| (0..n).map(|j| without(j, i)).collect()).collect();
    let solved = |b: &Vec<T>| adjugate.iter().map(|row| dot(row, b) * inverse).collect();
    sides.iter().map(solved).collect()
}

/// Solves A x = b by Cramer's rule, x_i = det A_i / det A, with a value exactly where det A ≠ 0. For few rows.
#[inline(never)]
pub fn solve_by_cramer<T: Scalar>(a: &[Vec<T>], b: &[T]) -> Vec<T> {
    let whole = determinant(a);
    whole.note_divisor();
    let inverse = whole.recip();
    let with_side = |column: usize| -> Vec<Vec<T>> {
        let row = |(row, side): (&Vec<T>, &T)| {
            let mut row = row.clone();
            row[column] = *side;
            row
        };
        a.iter().zip(b).map(row).collect()
    };
    (0..a.len()).map(|column| determinant(&with_side(column)) * inverse).collect()
}

/// The same by Cayley and Hamilton's theorem: Aⁿ + c₁Aⁿ⁻¹ + … + c_n E = 0.
fn solved_by_powers<T: Scalar>(a: &[Vec<T>], b: &[T]) -> Vec<T> {
    // The transpose has the same polynomial, so that rows may serve as columns.
    let mut coefficients = characteristic_polynomial(a);
    let last = coefficients.pop().unwrap_or_else(T::one);
    let mut sum = b.to_vec();
    for coefficient in coefficients {
        let next = a.iter().map(|row| dot(row, &sum));
        sum = next.zip(b).map(|(x, b)| x + coefficient * *b).collect();
    }
    last.note_divisor();
    let inverse = -last.recip();
    sum.into_iter().map(|x| x * inverse).collect()
}

/// Part of the largest entry below which a pivot counts as 0.
const NEGLIGIBLE: f64 = 1e-9;

/// Whether a symmetric matrix has eigenvalues of both signs, as far as rounding shows; `false` where
/// an entry is no number.
pub fn is_indefinite(matrix: &[Vec<f64>]) -> bool {
    let mut rest = matrix.to_vec();
    let largest = |rest: &[Vec<f64>]| {
        rest.iter().flatten().fold(0.0, |most: f64, entry| most.max(entry.abs()))
    };
    let least = largest(matrix) * NEGLIGIBLE;
    if !matrix.iter().flatten().all(|entry| entry.is_finite()) {
        return false;
    }
    let (mut has_positive, mut has_negative) = (false, false);
    while !rest.is_empty() {
        let Some(pivot) =
            (0..rest.len()).max_by(|i, j| rest[*i][*i].abs().total_cmp(&rest[*j][*j].abs()))
        else {
            break;
        };
        let row = rest.remove(pivot);
        let value = row[pivot];
        if value.abs() <= least {
            // 2 a x y with a diagonal of zeros takes both signs.
            return (has_positive && has_negative) || largest(&rest).max(largest(&[row])) > least;
        }
        has_positive |= value > 0.0;
        has_negative |= value < 0.0;
        for own in &mut rest {
            let factor = own[pivot] / value;
            own.iter_mut().zip(&row).for_each(|(entry, pivot)| *entry -= factor * pivot);
            own.remove(pivot);
        }
    }
    has_positive && has_negative
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[inline(never)]
    fn minors_solve_where_leading_minors_vanish() {
        let exchange = vec![vec![0.0, 1.0], vec![1.0, 0.0]];
        assert_eq!(solve_by_minors(&exchange, &[vec![2.0, 3.0]]), [[3.0, 2.0]]);
        // Leading minors 0, 0, … up to the determinant, by minors and by powers.
        for n in 1..10usize {
            let entry = |i: usize, j: usize| if i + j + 1 == n { 2.0 } else { 0.0 };
            let matrix: Vec<Vec<f64>> =
                (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect();
            let side: Vec<f64> = (1..=n).map(|k| k as f64).collect();
            let solution = solve_by_minors(&matrix, std::slice::from_ref(&side)).remove(0);
            for (row, expected) in matrix.iter().zip(&side) {
                assert!((dot(row, &solution) - expected).abs() < 1e-12, "{n} rows");
            }
        }
        for n in 1..8usize {
            let entry =
                |i: usize, j: usize| f64::from(((3 * i + 5 * j) % 7) as u8) + f64::from(i == j);
            let matrix: Vec<Vec<f64>> =
                (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect();
            let side: Vec<f64> = (1..=n).map(|k| k as f64).collect();
            let solution = solve_by_cramer(&matrix, &side);
            for (row, expected) in matrix.iter().zip(&side) {
                assert!((dot(row, &solution) - expected).abs() < 1e-9, "{n} rows");
            }
        }
        let skewed: Vec<Vec<f64>> = (0..8)
            .map(|i| (0..8).map(|j| f64::from((i * 5 + j * 3) % 7) + f64::from(i == j)).collect())
            .collect();
        let side = vec![1.0; 8];
        let solution = solve_by_minors(&skewed, std::slice::from_ref(&side)).remove(0);
        assert!(skewed.iter().all(|row| (dot(row, &solution) - 1.0).abs() < 1e-8));
        let singular = vec![vec![1.0, 2.0], vec![2.0, 4.0]];
        assert!(!solve_by_minors(&singular, &[vec![1.0, 1.0]])[0][0].is_finite());
    }

    #[test]
    fn indefinite_matrices_are_told() {
        let matrix = |rows: &[&[f64]]| rows.iter().map(|row| row.to_vec()).collect::<Vec<_>>();
        for own in [
            matrix(&[&[0.0, 1.0], &[1.0, 0.0]]),
            matrix(&[&[1.0, 1.0], &[1.0, 0.0]]),
            matrix(&[&[1.0, 1.0, 1.0], &[1.0, 1.0, -1.0], &[1.0, -1.0, 1.0]]),
            matrix(&[&[1.0, 0.0], &[0.0, -1e-3]]),
        ] {
            assert!(is_indefinite(&own), "{own:?}");
        }
        for own in [
            matrix(&[&[4.0, 1.0], &[1.0, 3.0]]),
            matrix(&[&[-4.0, 1.0], &[1.0, -3.0]]),
            matrix(&[&[1.0, 1.0], &[1.0, 1.0]]),
            matrix(&[&[0.0, 0.0], &[0.0, 2.0]]),
            matrix(&[&[f64::NAN, 1.0], &[1.0, 0.0]]),
            matrix(&[]),
        ] {
            assert!(!is_indefinite(&own), "{own:?}");
        }
    }

    #[test]
    #[inline(never)]
    fn elimination_solves() {
        let matrix = vec![vec![4.0, 1.0, 0.5], vec![1.0, 3.0, -1.0], vec![0.5, -1.0, 5.0]];
        let solution = solve_positive(matrix.clone(), vec![1.0, 2.0, 3.0]);
        for (row, expected) in matrix.iter().zip([1.0, 2.0, 3.0]) {
            assert!((dot(row, &solution) - expected).abs() < 1e-14, "A x = b");
        }
    }

    #[test]
    #[inline(never)]
    fn determinants_traces_and_characteristic_polynomials() {
        // A = [[2,1,0],[0,3,1],[1,0,1]] by columns: det A = 7, tr A = 6, second invariant 11.
        let a = vec![vec![2.0, 0.0, 1.0], vec![1.0, 3.0, 0.0], vec![0.0, 1.0, 1.0]];
        assert_eq!(gram_determinant(&a), 49.0, "det(AᵀA) = (det A)²");
        let dependent = vec![a[0].clone(), a[1].clone(), vec![3.0, 3.0, 1.0]];
        assert_eq!(gram_determinant(&dependent), 0.0, "the third is the sum of the others");
        assert_eq!(characteristic_polynomial(&a), [-6.0, 11.0, -7.0]);
        let axes = |n: usize| -> Vec<Vec<f64>> {
            let axis = |i: usize| (0..n).map(|j| if i == j { 2.0 } else { 0.0 }).collect();
            (0..n).map(axis).collect()
        };
        assert_eq!(gram_determinant(&axes(11)), 4f64.powi(11), "beyond minors");
        assert_eq!(gram_determinant(&[vec![1.0], vec![2.0]]), 0.0, "more vectors than dimensions");
        // B = A C with C = diag(1,2,4): tr(B A⁻¹) = tr C.
        let b: Vec<Vec<f64>> = [1.0, 2.0, 4.0]
            .iter()
            .zip(&a)
            .map(|(c, column)| column.iter().map(|x| c * x).collect())
            .collect();
        assert!((trace_of_quotient(&a, &b) - 7.0).abs() < 1e-12);
    }

    #[test]
    #[inline(never)]
    fn rejection_is_zero_in_the_span_only() {
        let plane = [vec![1.0, 2.0, 0.0], vec![0.0, 1.0, 1.0]];
        let inside = rejection(&[2.0, 5.0, 1.0], &plane);
        assert!(dot(&inside, &inside) < 1e-24, "2a + b is in it");
        let outside = rejection(&[0.0, 0.0, 1.0], &plane);
        assert!(dot(&outside, &outside) > 0.1, "e₃ is not");
        assert!(plane.iter().all(|g| dot(g, &outside).abs() < 1e-14), "and what is left is across");
        assert_eq!(rejection(&[3.0, 4.0], &[]), [3.0, 4.0], "nothing spans nothing");
    }
}
