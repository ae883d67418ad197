//! Vectors and matrices of any size over any [`Scalar`], in addition to the algebra of ℝ³.
//!
//! No division by a value that may vanish: a recorded scalar has no pivots. Determinants of up to
//! [`MOST_BY_MINORS`] rows are expanded by minors; larger ones come from the characteristic
//! polynomial, whose coefficients are divided only by whole numbers (Faddeev, LeVerrier):
//!
//! ```text
//! M₁ = E,  M_k = A M_(k-1) + c_(k-1) E,  c_k = -tr(A M_k)/k:  det A = (-1)ⁿ cₙ,  adj A = (-1)ⁿ⁻¹ Mₙ
//! ```

use super::value::MatrixEntries;
use crate::number::rational::Rational;
use crate::scalar::Scalar;

/// Limit on the rows of a determinant that is expanded by minors.
const MOST_BY_MINORS: usize = 6;

/// Dot product Σ a_i b_i.
pub(super) fn dot<T: Scalar>(a: &[T], b: &[T]) -> T {
    let products = a.iter().zip(b).map(|(a, b)| *a * *b);
    products.reduce(|sum, product| sum + product).unwrap_or_else(T::zero)
}

/// Product `A v`.
pub(super) fn apply<T: Scalar>(a: &MatrixEntries<T>, v: &[T]) -> Vec<T> {
    a.entries().chunks(a.columns()).map(|row| dot(row, v)).collect()
}

/// Product `A B`.
pub(super) fn compose<T: Scalar>(a: &MatrixEntries<T>, b: &MatrixEntries<T>) -> MatrixEntries<T> {
    MatrixEntries::from_fn((a.rows(), b.columns()), |i, j| {
        let products = (0..a.columns()).map(|k| a[(i, k)] * b[(k, j)]);
        products.reduce(|sum, product| sum + product).unwrap_or_else(T::zero)
    })
}

/// Transpose `Aᵀ`.
pub(super) fn transpose<T: Scalar>(a: &MatrixEntries<T>) -> MatrixEntries<T> {
    MatrixEntries::from_fn((a.columns(), a.rows()), |i, j| a[(j, i)])
}

/// Outer product `a ⊗ b`.
pub(super) fn outer<T: Scalar>(a: &[T], b: &[T]) -> MatrixEntries<T> {
    MatrixEntries::from_fn((a.len(), b.len()), |i, j| a[i] * b[j])
}

/// Identity matrix of `n` rows.
pub(super) fn identity<T: Scalar>(n: usize) -> MatrixEntries<T> {
    MatrixEntries::from_fn((n, n), |i, j| if i == j { T::one() } else { T::zero() })
}

/// Diagonal matrix with the diagonal `v`.
pub(super) fn diagonal<T: Scalar>(v: &[T]) -> MatrixEntries<T> {
    MatrixEntries::from_fn((v.len(), v.len()), |i, j| if i == j { v[i] } else { T::zero() })
}

/// Trace.
pub(super) fn trace<T: Scalar>(a: &MatrixEntries<T>) -> T {
    let diagonal = (0..a.rows()).map(|i| a[(i, i)]);
    diagonal.reduce(|sum, entry| sum + entry).unwrap_or_else(T::zero)
}

/// Power `A^n` for `n ≥ 1`, by repeated squaring.
pub(super) fn power<T: Scalar>(a: &MatrixEntries<T>, n: u32) -> MatrixEntries<T> {
    // from the bit below the leading one down, so that there is no product with the identity
    (0..n.ilog2()).rev().fold(a.clone(), |result, bit| {
        let square = compose(&result, &result);
        if n >> bit & 1 == 1 { compose(&square, a) } else { square }
    })
}

/// Determinant of a square matrix.
pub(super) fn determinant<T: Scalar>(a: &MatrixEntries<T>) -> T {
    let n = a.rows();
    if n > MOST_BY_MINORS {
        return by_characteristic_polynomial(a).0;
    }
    let all: Vec<usize> = (0..n).collect();
    minor(a, &all, &all)
}

/// Adjugate of a square matrix, with `adj(A) A = det(A) E`.
pub(super) fn adjugate<T: Scalar>(a: &MatrixEntries<T>) -> MatrixEntries<T> {
    let n = a.rows();
    if n > MOST_BY_MINORS {
        return by_characteristic_polynomial(a).1;
    }
    let without = |k: usize| (0..n).filter(|i| *i != k).collect::<Vec<usize>>();
    MatrixEntries::from_fn((n, n), |i, j| {
        let cofactor = minor(a, &without(j), &without(i));
        if (i + j).is_multiple_of(2) { cofactor } else { -cofactor }
    })
}

/// Inverse `A⁻¹`, as adjugate over determinant.
pub(super) fn inverse<T: Scalar>(a: &MatrixEntries<T>) -> MatrixEntries<T> {
    let (cofactors, determinant) = (adjugate(a), determinant(a));
    MatrixEntries::from_fn((a.rows(), a.rows()), |i, j| cofactors[(i, j)] / determinant)
}

/// Solution `A⁻¹ b` of a linear system, by Cramer's rule.
pub(super) fn solve<T: Scalar>(a: &MatrixEntries<T>, b: &[T]) -> Vec<T> {
    let determinant = determinant(a);
    apply(&adjugate(a), b).into_iter().map(|numerator| numerator / determinant).collect()
}

/// Minor of some rows and equally many columns, built up row by row from smaller ones.
fn minor<T: Scalar>(a: &MatrixEntries<T>, rows: &[usize], columns: &[usize]) -> T {
    // minors[set]: the determinant of the first rows with this set of columns
    let mut minors = vec![T::one(); 1 << columns.len()];
    for set in 1usize..minors.len() {
        let row = set.count_ones() as usize - 1;
        let inside = (0..columns.len()).filter(|j| set >> j & 1 == 1);
        let terms = inside.enumerate().map(|(place, j)| {
            let term = a[(rows[row], columns[j])] * minors[set & !(1 << j)];
            if (row + place).is_multiple_of(2) { term } else { -term }
        });
        minors[set] = terms.reduce(|sum, term| sum + term).unwrap_or_else(T::one);
    }
    minors[minors.len() - 1]
}

/// Determinant and adjugate, by the characteristic polynomial.
fn by_characteristic_polynomial<T: Scalar>(a: &MatrixEntries<T>) -> (T, MatrixEntries<T>) {
    let n = a.rows();
    let mut cofactors = identity(n);
    let mut coefficient = T::zero();
    for k in 1..=n {
        let product = compose(a, &cofactors);
        coefficient = -trace(&product) * T::rational(&Rational::new(1, k as i64));
        if k < n {
            cofactors = MatrixEntries::from_fn((n, n), |i, j| {
                let entry = product[(i, j)];
                if i == j { entry + coefficient } else { entry }
            });
        }
    }
    if n.is_multiple_of(2) {
        (coefficient, MatrixEntries::from_fn((n, n), |i, j| -cofactors[(i, j)]))
    } else {
        (-coefficient, cofactors)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::DMatrix;

    fn sample(n: usize) -> MatrixEntries<f64> {
        MatrixEntries::from_fn((n, n), |i, j| ((3 * i + 5 * j + i * j * j) % 7) as f64 - 2.5)
    }

    fn dense(a: &MatrixEntries<f64>) -> DMatrix<f64> {
        DMatrix::from_row_slice(a.rows(), a.columns(), a.entries())
    }

    #[test]
    fn matrices_of_any_size_follow_linear_algebra() {
        for n in [1, 2, 4, 5, 6, 7, 9] {
            let a = sample(n);
            let expected = dense(&a).determinant();
            let size = expected.abs().max(1.0);
            assert!((determinant(&a) - expected).abs() < 1e-9 * size, "det of {n} rows");
            let product = dense(&compose(&adjugate(&a), &a));
            let unit = DMatrix::identity(n, n) * expected;
            assert!((product - unit).norm() < 1e-9 * size, "adj of {n} rows");
            let b: Vec<f64> = (0..n).map(|i| 1.0 + i as f64).collect();
            if expected.abs() > 1e-3 {
                let back = apply(&a, &solve(&a, &b));
                assert!(back.iter().zip(&b).all(|(x, y)| (x - y).abs() < 1e-6), "A x = b");
            }
        }
    }

    #[test]
    fn products_of_oblong_matrices() {
        let a = MatrixEntries::from_fn((2, 3), |i, j| (i + 2 * j) as f64);
        let b = transpose(&a);
        assert_eq!(dense(&compose(&a, &b)), dense(&a) * dense(&b), "A Aᵀ");
        assert_eq!(apply(&a, &[1.0, 2.0, 3.0]), [16.0, 22.0], "A v");
        assert_eq!(dense(&outer(&[1.0, 2.0], &[3.0, 4.0, 5.0])).shape(), (2, 3), "a ⊗ b");
        let cube = dense(&sample(4)).pow(3);
        assert!((dense(&power(&sample(4), 3)) - &cube).norm() < 1e-9 * cube.norm(), "A³");
    }

    #[test]
    fn both_ways_to_a_determinant_agree() {
        let a = sample(6);
        let (by_trace, cofactors) = by_characteristic_polynomial(&a);
        assert!((by_trace - determinant(&a)).abs() < 1e-8, "det");
        assert!((dense(&cofactors) - dense(&adjugate(&a))).norm() < 1e-7, "adj");
    }
}
