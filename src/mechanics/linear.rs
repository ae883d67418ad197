//! Small linear algebra without pivots or comparisons, for recorded scalars.

use nalgebra::{Matrix3, Vector3};

pub(super) use crate::formula::adjugate;
use crate::scalar::Scalar;

/// Computes the determinant from a known adjugate.
pub fn determinant_with<T: Scalar>(a: &Matrix3<T>, adjugate: &Matrix3<T>) -> T {
    (0..3).map(|k| a[(0, k)] * adjugate[(k, 0)]).sum()
}

/// Isotropic matrix x E.
pub fn isotropic<T: Scalar>(x: T) -> Matrix3<T> {
    Matrix3::from_diagonal_element(x)
}

/// Contribution m((r,r)E - r⊗r) of a point mass at r to an inertia tensor.
pub fn point_mass<T: Scalar>(m: T, r: &Vector3<T>) -> Matrix3<T> {
    (isotropic(r.dot(r)) - r * r.transpose()) * m
}

/// Computes the determinant of A restricted to the plane across γ: (γ, adj(A)γ)/γ².
pub fn across<T: Scalar>(a: &Matrix3<T>, gamma: &Vector3<T>) -> T {
    gamma.dot(&(adjugate(a) * gamma)) / gamma.dot(gamma)
}
