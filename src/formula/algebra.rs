//! Vector and matrix algebra of ℝ³ over any [`Scalar`].
//!
//! Written out by hand because a recorded scalar cannot be compared: no pivoting, no test for zero,
//! none of nalgebra's inverse, determinant or blocked products.

use nalgebra::{Matrix3, Vector3};

use crate::scalar::Scalar;

/// Dot product `(a,b)`.
pub(super) fn dot<T: Scalar>(a: &Vector3<T>, b: &Vector3<T>) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Cross product `a × b`.
pub(super) fn cross<T: Scalar>(a: &Vector3<T>, b: &Vector3<T>) -> Vector3<T> {
    Vector3::new(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
}

/// Outer product `a ⊗ b`, the matrix with entries `a[i] b[j]`.
pub(super) fn outer<T: Scalar>(a: &Vector3<T>, b: &Vector3<T>) -> Matrix3<T> {
    Matrix3::from_fn(|i, j| a[i] * b[j])
}

/// Product `A v`.
pub(super) fn apply<T: Scalar>(a: &Matrix3<T>, v: &Vector3<T>) -> Vector3<T> {
    Vector3::from_fn(|i, _| a[(i, 0)] * v[0] + a[(i, 1)] * v[1] + a[(i, 2)] * v[2])
}

/// Product `A B`.
pub(super) fn compose<T: Scalar>(a: &Matrix3<T>, b: &Matrix3<T>) -> Matrix3<T> {
    Matrix3::from_fn(|i, j| a[(i, 0)] * b[(0, j)] + a[(i, 1)] * b[(1, j)] + a[(i, 2)] * b[(2, j)])
}

/// Transpose `Aᵀ`.
pub(super) fn transpose<T: Scalar>(a: &Matrix3<T>) -> Matrix3<T> {
    Matrix3::from_fn(|i, j| a[(j, i)])
}

/// Identity matrix.
pub(super) fn identity<T: Scalar>() -> Matrix3<T> {
    diagonal(&Vector3::new(T::one(), T::one(), T::one()))
}

/// Diagonal matrix with the diagonal `v`.
pub(super) fn diagonal<T: Scalar>(v: &Vector3<T>) -> Matrix3<T> {
    Matrix3::from_fn(|i, j| if i == j { v[i] } else { T::zero() })
}

/// Trace.
pub(super) fn trace<T: Scalar>(a: &Matrix3<T>) -> T {
    a[(0, 0)] + a[(1, 1)] + a[(2, 2)]
}

/// Determinant, expanded along the first row.
pub(super) fn determinant<T: Scalar>(a: &Matrix3<T>) -> T {
    let cofactors = adjugate(a);
    a[(0, 0)] * cofactors[(0, 0)] + a[(0, 1)] * cofactors[(1, 0)] + a[(0, 2)] * cofactors[(2, 0)]
}

/// Adjugate, with `adj(A) A = det(A) E`.
pub(crate) fn adjugate<T: Scalar>(a: &Matrix3<T>) -> Matrix3<T> {
    Matrix3::from_fn(|i, j| {
        // cyclic indices give the cofactor its sign
        let (r, s, p, q) = ((j + 1) % 3, (j + 2) % 3, (i + 1) % 3, (i + 2) % 3);
        a[(r, p)] * a[(s, q)] - a[(r, q)] * a[(s, p)]
    })
}

/// Inverse `A⁻¹`, as adjugate over determinant.
pub(super) fn inverse<T: Scalar>(a: &Matrix3<T>) -> Matrix3<T> {
    let cofactors = adjugate(a);
    let determinant = determinant(a);
    Matrix3::from_fn(|i, j| cofactors[(i, j)] / determinant)
}

/// Solution `A⁻¹ b` of a linear system, by Cramer's rule.
pub(super) fn solve<T: Scalar>(a: &Matrix3<T>, b: &Vector3<T>) -> Vector3<T> {
    let numerators = apply(&adjugate(a), b);
    let determinant = determinant(a);
    Vector3::from_fn(|i, _| numerators[i] / determinant)
}

/// Power `A^n` for `n ≥ 1`, by repeated squaring.
pub(super) fn power<T: Scalar>(a: &Matrix3<T>, n: u32) -> Matrix3<T> {
    // from the bit below the leading one down, so that there is no product with the identity
    (0..n.ilog2()).rev().fold(*a, |result, bit| {
        let square = compose(&result, &result);
        if n >> bit & 1 == 1 { compose(&square, a) } else { square }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample() -> Matrix3<f64> {
        Matrix3::new(2.0, -1.0, 0.5, 0.25, 3.0, 1.0, -0.75, 1.5, 4.0)
    }

    #[test]
    fn agrees_with_nalgebra_on_numbers() {
        let (a, u, v) = (sample(), Vector3::new(1.0, 2.0, 3.0), Vector3::new(-2.0, 0.5, 1.0));
        assert_eq!(cross(&u, &v), u.cross(&v), "cross product");
        assert_eq!(dot(&u, &v), u.dot(&v), "dot product");
        assert_eq!(outer(&u, &v), u * v.transpose(), "outer product");
        assert!((apply(&a, &u) - a * u).norm() < 1e-14, "matrix times vector");
        assert!((compose(&a, &transpose(&a)) - a * a.transpose()).norm() < 1e-13, "product");
        assert_eq!(trace(&a), a.trace(), "trace");
    }

    #[test]
    fn inverse_determinant_and_solution_fit_together() {
        let (a, b) = (sample(), Vector3::new(1.0, -2.0, 0.5));
        let unit = identity::<f64>();
        assert!((determinant(&a) - a.determinant()).abs() < 1e-12, "determinant");
        assert!((compose(&inverse(&a), &a) - unit).norm() < 1e-14, "inverse");
        assert!((adjugate(&a) * a - unit * determinant(&a)).norm() < 1e-12, "adjugate");
        assert!((a * solve(&a, &b) - b).norm() < 1e-14, "solution");
    }

    #[test]
    fn powers_multiply() {
        let a = sample();
        for n in 1..8 {
            let expected = (1..n).fold(a, |product, _| product * a);
            let error = (power(&a, n) - expected).norm() / expected.norm();
            assert!(error < 1e-13, "the power {n} is {n} factors");
        }
    }
}
