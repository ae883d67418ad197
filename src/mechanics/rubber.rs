//! Rubber rolling of a rigid body on a plane or on a sphere: no slipping, no spinning.
//!
//! Body frame; γ the normal from the support towards the body, r from the mass centre to the point
//! of contact, k the signed curvature of the support (0 for the plane), Γ = E - k ∂r/∂γ:
//!
//! ```text
//! Ĩω' = K + λγ,   K = (Ĩω + S)×ω - m r×(ω×r') + M_P,   Ĩ = I + m r²E - m r⊗r
//! γ'  = Γ⁻¹(γ×ω), r' = (∂r/∂γ)γ',   M_P = γ×Γ⁻ᵀ∂U/∂γ
//! λ   = -[(K,Ĩ⁻¹γ) + k(ω,r')] / (γ,Ĩ⁻¹γ)                 so that (ω,γ)' = 0
//! ```
//!
//! Borisov, Mamaev, Bizyaev, Rus. J. Nonlin. Dyn. 9 (2013) 141-202: (1.4), (1.6), (1.7) on the
//! plane, (1.12), (1.13) on the sphere. The tensor in the gyroscopic term is Ĩ; with the central I
//! in its place γ², (ω,γ) and the energy would still be conserved, and every measure lost.

use nalgebra::{Matrix3, Vector3};

use super::across::AcrossNormal;
use super::body::{Polynomial, Shape, axis, matrix, scalar, vector};
use super::linear::{adjugate, determinant_with, isotropic, point_mass};
use super::phase::{Configuration, Phase};
use crate::formula::Formula;
use crate::scalar::Scalar;

/// The place of ω among the state variables.
pub const OMEGA: usize = 0;
/// The place of γ among the state variables.
pub const NORMAL: usize = 1;

/// A body rolling on a plane or sphere.
#[derive(Clone, Debug)]
pub struct Rubber {
    /// m
    pub mass: Formula,
    /// The central inertia tensor I.
    pub inertia: Formula,
    /// The surface of the body.
    pub shape: Shape,
    /// The signed curvature k of the support; `None` for the plane.
    pub curvature: Option<Formula>,
    /// The constant angular momentum S of a rotor.
    pub gyrostat: Option<Formula>,
    /// U(γ)
    pub potential: Option<Potential>,
    /// A moment of forces that have no U(γ).
    pub moment: Option<Formula>,
}

/// A potential U(γ), or U(r) of a ball on a surface.
#[derive(Clone, Debug)]
pub enum Potential {
    /// As typed.
    Formula(Formula),
    /// A polynomial with free coefficients: reaches every jet a residual can contain.
    Arbitrary(Polynomial),
}

/// What the equations compute on their way.
pub struct Motion<T> {
    pub(super) r: Vector3<T>,
    pub(super) slope: Matrix3<T>,
    /// Γ across γ; absent on the plane, where it is the identity.
    pub(super) gamma_across: Option<AcrossNormal<T>>,
    pub(super) inertia: Matrix3<T>,
    pub(super) normal_rate: Vector3<T>,
    pub(super) contact_rate: Vector3<T>,
}

/// γ
pub fn normal<T: Scalar>(at: &Configuration<'_, T>) -> Vector3<T> {
    vector(at.variable(NORMAL))
}

/// ω
pub fn angular_velocity<T: Scalar>(at: &Configuration<'_, T>) -> Vector3<T> {
    vector(at.variable(OMEGA))
}

impl Rubber {
    /// (ω', γ')
    pub fn field<T: Scalar>(&self, phase: &Phase<'_, T>) -> Vec<T> {
        let (acceleration, _) = self.acceleration(phase);
        let rate = self.motion(phase).normal_rate;
        acceleration.iter().chain(rate.iter()).copied().collect()
    }

    pub(super) fn motion<'p, T: Scalar>(&self, phase: &'p Phase<'_, T>) -> &'p Motion<T> {
        phase.motion(|| {
            let at = &phase.configuration;
            let (omega, gamma) = (angular_velocity(at), normal(at));
            let (r, slope) = self.shape.contact(at);
            let gamma_across = self.gamma_across(at, &slope);
            let free_rate = gamma.cross(&omega);
            let normal_rate = match &gamma_across {
                None => free_rate,
                Some(big_gamma) => big_gamma.solve(&free_rate),
            };
            Motion {
                r,
                slope,
                gamma_across,
                inertia: self.inertia_at(at, &r),
                normal_rate,
                contact_rate: slope * normal_rate,
            }
        })
    }

    /// The curvature k of the support, absent on the plane.
    pub(super) fn curvature_at<T: Scalar>(&self, at: &Configuration<'_, T>) -> Option<T> {
        self.curvature.as_ref().map(|k| scalar(at.evaluate(k)))
    }

    /// Γ = E - k ∂r/∂γ
    pub(super) fn gamma_matrix<T: Scalar>(&self, slope: &Matrix3<T>, k: T) -> Matrix3<T> {
        isotropic(T::one()) - slope * k
    }

    /// Γ across γ, absent on the plane.
    pub(super) fn gamma_across<T: Scalar>(
        &self,
        at: &Configuration<'_, T>,
        slope: &Matrix3<T>,
    ) -> Option<AcrossNormal<T>> {
        let make = match self.shape {
            Shape::Contact(_) => AcrossNormal::general,
            _ => AcrossNormal::symmetric,
        };
        self.curvature_at(at).map(|k| make(slope, k, &normal(at)))
    }

    pub(super) fn inertia_at<T: Scalar>(
        &self,
        at: &Configuration<'_, T>,
        r: &Vector3<T>,
    ) -> Matrix3<T> {
        let mass = scalar(at.evaluate(&self.mass));
        matrix(at.evaluate(&self.inertia)) + point_mass(mass, r)
    }

    /// ω' and λ.
    pub(super) fn acceleration<T: Scalar>(&self, phase: &Phase<'_, T>) -> (Vector3<T>, T) {
        let at = &phase.configuration;
        let (omega, gamma) = (angular_velocity(at), normal(at));
        let motion = self.motion(phase);
        let mass = scalar(at.evaluate(&self.mass));
        let mut momentum = motion.inertia * omega;
        if let Some(gyrostat) = &self.gyrostat {
            momentum += vector(at.evaluate(gyrostat));
        }
        let slide = omega.cross(&motion.contact_rate);
        let mut torque = momentum.cross(&omega) - motion.r.cross(&slide) * mass;
        if let Some(moment) = self.moment_of_potential(phase) {
            torque += moment;
        }
        if let Some(moment) = &self.moment {
            torque += vector(phase.evaluate(moment));
        }
        let adjugate = adjugate(&motion.inertia);
        let determinant = determinant_with(&motion.inertia, &adjugate);
        let along = adjugate * gamma;
        let mut defect = torque.dot(&along);
        if let Some(k) = self.curvature_at(at) {
            defect += determinant * k * omega.dot(&motion.contact_rate);
        }
        let multiplier = -(defect / gamma.dot(&along));
        let total = torque + gamma * multiplier;
        ((adjugate * total).map(|x| x / determinant), multiplier)
    }

    /// M_P = γ × Γ⁻ᵀ ∂U/∂γ
    fn moment_of_potential<T: Scalar>(&self, phase: &Phase<'_, T>) -> Option<Vector3<T>> {
        let potential = self.potential.as_ref()?;
        let at = &phase.configuration;
        let slope = Vector3::from_fn(|i, _| potential.value(&at.lift(NORMAL, axis(i))).eps);
        let force = match &self.motion(phase).gamma_across {
            None => slope,
            Some(big_gamma) => big_gamma.solve_transposed(&slope),
        };
        Some(normal(at).cross(&force))
    }

    /// ½(ω,Ĩω) + U
    pub fn energy<T: Scalar>(&self, phase: &Phase<'_, T>) -> T {
        let at = &phase.configuration;
        let omega = angular_velocity(at);
        let kinetic = omega.dot(&(self.motion(phase).inertia * omega)) / T::from(2.0);
        match &self.potential {
            None => kinetic,
            Some(potential) => kinetic + potential.value(at),
        }
    }
}

impl Potential {
    /// U at a point of configuration space.
    pub fn value<T: Scalar>(&self, at: &Configuration<'_, T>) -> T {
        match self {
            Potential::Formula(formula) => scalar(at.evaluate(formula)),
            Potential::Arbitrary(polynomial) => polynomial.evaluate(at, normal(at)),
        }
    }
}
