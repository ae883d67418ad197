//! Existence of an invariant measure of a rubber body: the divergence as a covector on the sphere.
//!
//! With a = Ĩ⁻¹γ/(γ,Ĩ⁻¹γ), ρ₀ = det Ĩ (γ,Ĩ⁻¹γ) D_T, 1/K = R₁R₂ and s = 1 - k²/K, on |γ| = 1 and
//! modulo γ
//!
//! ```text
//! div v = (χ,ω) on the level,   Γᵀ(γ×χ) = -∇ln ρ₀ + w,   w = (s/D_T) Γᵀa
//! ```
//!
//! so that ρ = Nρ₀ is invariant exactly when d ln N = -(w,dγ), and some N exists on the sphere
//! exactly when (γ, rot w) = 0. On the plane w = a. Neither U nor a gyrostat enters.
//! Borisov, Mamaev, Bizyaev 2013, (2.1)-(2.6) and (2.20), (2.21).

use nalgebra::Vector3;
use num_dual::Dual;

use super::configuration::Configuration;
use super::linear::{across, adjugate};
use super::rubber::{Rubber, normal};
use crate::scalar::Scalar;

impl Rubber {
    /// Computes w = (s/D_T) Γᵀa, whose rotation about γ is the criterion; w = a on the plane.
    pub(super) fn covector<T: Scalar>(&self, at: &Configuration<'_, T>) -> Vector3<T> {
        let unit = self.inertial_normal(at);
        let Some(k) = self.0.curvature_at(at) else { return unit };
        let gamma = normal(at);
        let (_, slope) = self.0.shape.contact(at);
        let Some(big_gamma) = self.0.gamma_across(at, &slope) else { return unit };
        let twist = T::one() - k * k * across(&slope, &gamma);
        let turned = self.0.gamma_matrix(&slope, k).transpose() * unit;
        turned * (twist / big_gamma.determinant())
    }

    /// Computes (γ, rot w), zero on the whole sphere exactly when a density ρ(γ) exists; (2.5),
    /// (2.21).
    pub(super) fn rotation<T: Scalar>(&self, at: &Configuration<'_, T>) -> T {
        let gamma = normal(at);
        let slopes = [0, 1, 2].map(|j| self.covector(&at.lift_normal(j)).map(|x: Dual<T>| x.eps));
        [(0, 1, 2), (1, 2, 0), (2, 0, 1)]
            .into_iter()
            .map(|(i, j, k)| gamma[i] * (slopes[j][k] - slopes[k][j]))
            .sum()
    }

    /// Computes a = Ĩ⁻¹γ/(γ,Ĩ⁻¹γ).
    pub(super) fn inertial_normal<T: Scalar>(&self, at: &Configuration<'_, T>) -> Vector3<T> {
        let gamma = normal(at);
        let (r, _) = self.0.shape.contact(at);
        let along = adjugate(&self.0.inertia_at(at, &r)) * gamma;
        along.map(|x| x / gamma.dot(&along))
    }

    /// Computes the tangential χ with div v = (χ,ω) on the level, for a body (∂r/∂γ symmetric
    /// across γ); γ×χ = Γ⁻ᵀ(w - ∇ln ρ₀) mod γ, where ρ₀ = det Ĩ (γ,Ĩ⁻¹γ) D_T.
    pub(super) fn tangential_chi<T: Scalar>(&self, at: &Configuration<'_, T>) -> Vector3<T> {
        let gamma = normal(at);
        let drift = Vector3::from_fn(|j, _| {
            let volume = self.volume(&at.lift_normal(j));
            volume.eps / volume.re
        });
        let covector = self.covector(at) - drift;
        let turned = match self.0.gamma_across(at, &self.0.shape.contact(at).1) {
            None => covector,
            Some(big_gamma) => big_gamma.solve_transposed(&covector),
        };
        turned.cross(&gamma)
    }

    /// Computes the reference density ρ₀ = det Ĩ (γ,Ĩ⁻¹γ) D_T.
    pub(super) fn volume<T: Scalar>(&self, at: &Configuration<'_, T>) -> T {
        let (r, slope) = self.0.shape.contact(at);
        let volume = self.inertia_along_normal(at, &r);
        match self.0.gamma_across(at, &slope) {
            None => volume,
            Some(big_gamma) => volume * big_gamma.determinant(),
        }
    }

    /// Computes (γ, adj Ĩ γ).
    pub(super) fn inertia_along_normal<T: Scalar>(
        &self,
        at: &Configuration<'_, T>,
        r: &Vector3<T>,
    ) -> T {
        let gamma = normal(at);
        gamma.dot(&(adjugate(&self.0.inertia_at(at, r)) * gamma))
    }
}
