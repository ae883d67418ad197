//! Equations of rubber rolling for given numerical data of the body and its support; without λ they
//! are those of a body that may spin.
//!
//! All vectors are in the body frame: γ is the normal from the support towards the body, r the
//! vector from the mass centre to the point of contact, k the signed curvature of the support (0
//! for the plane), Γ = E - k ∂r/∂γ:
//!
//! ```text
//! Ĩω' = K + λγ,   K = (Ĩω + S)×ω - m r×(ω×r') + M_P,   Ĩ = I + m r²E - m r⊗r
//! γ'  = Γ⁻¹(γ×ω), r' = (∂r/∂γ)γ',   M_P = γ×Γ⁻ᵀ∂U/∂γ
//! λ   = -[(K,Ĩ⁻¹γ) + k(ω,r')] / (γ,Ĩ⁻¹γ)                 so that (ω,γ)' = 0
//! ```
//!
//! Borisov, Mamaev, Bizyaev, Rus. J. Nonlin. Dyn. 9 (2013) 141-202: (1.4), (1.6), (1.7) on the
//! plane, (1.12), (1.13) on the sphere. The tensor in the gyroscopic term is Ĩ; with the central I
//! instead, γ², (ω,γ) and the energy would still be conserved, and every measure lost.

use nalgebra::{Matrix3, Vector3};

use super::across::AcrossNormal;
use super::linear::{adjugate, determinant_with};
use crate::scalar::Scalar;

/// Data of a body on its support in one state.
pub struct Pose<T> {
    /// Angular velocity ω.
    pub omega: Vector3<T>,
    /// Normal γ.
    pub gamma: Vector3<T>,
    /// Mass m.
    pub mass: T,
    /// Curvature k of the support, absent on the plane.
    pub curvature: Option<T>,
    /// Contact vector r.
    pub r: Vector3<T>,
    /// Derivative ∂r/∂γ.
    pub slope: Matrix3<T>,
    /// Operator Γ across γ; absent on the plane, where it is the identity.
    pub gamma_across: Option<AcrossNormal<T>>,
    /// Inertia tensor Ĩ at the point of contact.
    pub inertia: Matrix3<T>,
}

/// Intermediate results of the equations of motion.
pub struct RollingTerms<T> {
    /// Data of the body in this state.
    pub pose: Pose<T>,
    /// Rate γ'.
    pub normal_rate: Vector3<T>,
    /// Rate r'.
    pub contact_rate: Vector3<T>,
}

impl<T: Scalar> RollingTerms<T> {
    /// Computes γ' and r' for given data.
    pub fn of(pose: Pose<T>) -> Self {
        let free_rate = pose.gamma.cross(&pose.omega);
        let normal_rate = match &pose.gamma_across {
            None => free_rate,
            Some(big_gamma) => big_gamma.solve(&free_rate),
        };
        let contact_rate = pose.slope * normal_rate;
        Self { pose, normal_rate, contact_rate }
    }

    /// Computes K, with the angular momentum S of a rotor and with moments of forces.
    pub fn torque(
        &self,
        gyrostat: Option<Vector3<T>>,
        moments: impl Iterator<Item = Vector3<T>>,
    ) -> Vector3<T> {
        let Pose { omega, mass, r, inertia, .. } = &self.pose;
        let mut momentum = inertia * omega;
        if let Some(gyrostat) = gyrostat {
            momentum += gyrostat;
        }
        let slide = omega.cross(&self.contact_rate);
        let mut torque = momentum.cross(omega) - r.cross(&slide) * *mass;
        for moment in moments {
            torque += moment;
        }
        torque
    }

    /// Computes ω' and λ from K.
    pub fn acceleration(&self, torque: Vector3<T>) -> (Vector3<T>, T) {
        let Pose { omega, gamma, curvature, inertia, .. } = &self.pose;
        let adjugate = adjugate(inertia);
        let determinant = determinant_with(inertia, &adjugate);
        let along = adjugate * gamma;
        let mut defect = torque.dot(&along);
        if let Some(k) = curvature {
            defect += determinant * *k * omega.dot(&self.contact_rate);
        }
        let multiplier = -(defect / gamma.dot(&along));
        let total = torque + gamma * multiplier;
        ((adjugate * total).map(|x| x / determinant), multiplier)
    }

    /// Computes M_P = γ × Γ⁻ᵀ ∂U/∂γ from the slope ∂U/∂γ.
    pub fn moment_of_potential(&self, slope: &Vector3<T>) -> Vector3<T> {
        let force = match &self.pose.gamma_across {
            None => *slope,
            Some(big_gamma) => big_gamma.solve_transposed(slope),
        };
        self.pose.gamma.cross(&force)
    }

    /// Kinetic energy ½(ω,Ĩω).
    pub fn kinetic_energy(&self) -> T {
        let Pose { omega, inertia, .. } = &self.pose;
        omega.dot(&(inertia * omega)) / T::from(2.0)
    }
}
