//! The operator Γ = E - k ∂r/∂γ on the plane across γ, and its inverse there.
//!
//! For r = -∇h with h of degree 1, ∂r/∂γ is symmetric and (∂r/∂γ)γ = 0, so that Γ preserves γ and
//! the plane across it. With A = E - γ⊗γ/γ² - k ∂r/∂γ, which is Γ on that plane and 0 on γ,
//!
//! ```text
//! D_T = ½((tr A)² - tr A²),   Γ⁻¹u = (tr A u - A u)/D_T      for u across γ
//! ```
//!
//! by the theorem of Cayley and Hamilton in two dimensions. The cofactors of Γ itself give the same
//! result, but lose twice the digits where D_T is small: Γ's eigenvalue 1 along γ dominates them.

use nalgebra::{Matrix3, Vector3};

use super::linear::{across, adjugate, determinant_with, isotropic};
use crate::scalar::Scalar;

/// The operator Γ, prepared for inversion across γ.
pub enum AcrossNormal<T> {
    /// Γ for symmetric ∂r/∂γ: A, tr A and D_T.
    Symmetric {
        /// A
        matrix: Matrix3<T>,
        /// tr A
        trace: T,
        /// D_T
        determinant: T,
    },
    /// Γ for any r(γ): its adjugate, det Γ and D_T.
    General {
        /// The adjugate of Γ.
        adjugate: Matrix3<T>,
        /// det Γ
        determinant: T,
        /// D_T
        across: T,
    },
}

impl<T: Scalar> AcrossNormal<T> {
    /// Makes Γ for ∂r/∂γ symmetric and zero on γ.
    pub fn symmetric(slope: &Matrix3<T>, k: T, gamma: &Vector3<T>) -> Self {
        let projection = isotropic(T::one()) - gamma * gamma.transpose() / gamma.dot(gamma);
        let matrix = projection - slope * k;
        let trace = matrix.trace();
        let square: T = matrix.iter().map(|x| *x * *x).sum();
        let determinant = (trace * trace - square) / T::from(2.0);
        Self::Symmetric { matrix, trace, determinant }
    }

    /// Makes Γ for any ∂r/∂γ.
    pub fn general(slope: &Matrix3<T>, k: T, gamma: &Vector3<T>) -> Self {
        let matrix = isotropic(T::one()) - slope * k;
        let adjugate = adjugate(&matrix);
        let determinant = determinant_with(&matrix, &adjugate);
        Self::General { adjugate, determinant, across: across(&matrix, gamma) }
    }

    /// Returns D_T, the determinant of Γ across γ.
    pub fn determinant(&self) -> T {
        match self {
            Self::Symmetric { determinant, .. } => *determinant,
            Self::General { across, .. } => *across,
        }
    }

    /// Computes Γ⁻¹u for u across γ.
    pub fn solve(&self, u: &Vector3<T>) -> Vector3<T> {
        match self {
            Self::Symmetric { matrix, trace, determinant } => {
                (u * *trace - matrix * u).map(|x| x / *determinant)
            }
            Self::General { adjugate, determinant, .. } => (adjugate * u).map(|x| x / *determinant),
        }
    }

    /// Computes Γ⁻ᵀu up to a multiple of γ, for any u.
    pub fn solve_transposed(&self, u: &Vector3<T>) -> Vector3<T> {
        match self {
            // The part of u along γ does not affect A u.
            Self::Symmetric { .. } => self.solve(u),
            Self::General { adjugate, determinant, .. } => {
                (adjugate.transpose() * u).map(|x| x / *determinant)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_forms_agree_on_a_symmetric_tensor() {
        let gamma: Vector3<f64> = Vector3::new(0.6, -1.1, 0.4);
        let along = gamma / gamma.dot(&gamma).sqrt();
        let side = along.cross(&Vector3::new(0.3, 0.2, 0.9)).normalize();
        let other = along.cross(&side);
        let slope = side * side.transpose() * 1.7
            + other * other.transpose() * 0.4
            + (side * other.transpose() + other * side.transpose()) * 0.2;
        let special = AcrossNormal::symmetric(&slope, -0.8, &gamma);
        let general = AcrossNormal::general(&slope, -0.8, &gamma);
        assert!((special.determinant() - general.determinant()).abs() < 1e-14, "D_T");
        let u = side * 0.3 - other * 1.2;
        assert!((special.solve(&u) - general.solve(&u)).norm() < 1e-14, "Γ⁻¹u");
        let any = u + along * 2.0;
        let apart = special.solve_transposed(&any) - general.solve_transposed(&any);
        assert!(apart.cross(&along).norm() < 1e-14, "Γ⁻ᵀu, but for a multiple of γ");
    }
}
