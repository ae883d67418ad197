//! Rubber rolling of a rigid body on a plane or on a sphere: no slipping, no spinning.
//!
//! The values of a case are substituted into the equations of [`rolling`](super::rolling).

use nalgebra::{Matrix3, Vector3};

use super::across::AcrossNormal;
use super::body::{Polynomial, Shape, axis, matrix, scalar, vector};
use super::configuration::Configuration;
use super::linear::{isotropic, point_mass};
use super::phase::Phase;
use super::rolling::{Motion, Pose};
use crate::formula::Formula;
use crate::scalar::Scalar;

/// Index of ω among the state variables.
pub const OMEGA: usize = 0;
/// Index of γ among the state variables.
pub const NORMAL: usize = 1;

/// A body rolling on a plane or sphere.
#[derive(Clone, Debug)]
pub struct Rubber {
    /// Mass m.
    pub mass: Formula,
    /// Central inertia tensor I.
    pub inertia: Formula,
    /// Surface of the body.
    pub shape: Shape,
    /// Signed curvature k of the support; `None` for the plane.
    pub curvature: Option<Formula>,
    /// Constant angular momentum S of a rotor.
    pub gyrostat: Option<Formula>,
    /// Potential U(γ).
    pub potential: Option<Potential>,
    /// Moment of forces that have no potential U(γ).
    pub moment: Option<Formula>,
}

/// A potential U(γ), or U(r) of a ball on a surface.
#[derive(Clone, Debug)]
pub enum Potential {
    /// A potential given by a formula.
    Formula(Formula),
    /// A polynomial with free coefficients, which attains every jet that a residual can contain.
    Arbitrary(Polynomial),
}

/// Returns the normal γ.
pub fn normal<T: Scalar>(at: &Configuration<'_, T>) -> Vector3<T> {
    vector(at.variable(NORMAL))
}

/// Returns the angular velocity ω.
pub fn angular_velocity<T: Scalar>(at: &Configuration<'_, T>) -> Vector3<T> {
    vector(at.variable(OMEGA))
}

impl Rubber {
    /// Returns the rates (ω', γ').
    pub fn field<T: Scalar>(&self, phase: &Phase<'_, T>) -> Vec<T> {
        let (acceleration, _) = self.acceleration(phase);
        let rate = self.motion(phase).normal_rate;
        acceleration.iter().chain(rate.iter()).copied().collect()
    }

    pub(super) fn motion<'p, T: Scalar>(&self, phase: &'p Phase<'_, T>) -> &'p Motion<T> {
        phase.motion(|| {
            let at = &phase.configuration;
            let (r, slope) = self.shape.contact(at);
            Motion::of(Pose {
                omega: angular_velocity(at),
                gamma: normal(at),
                mass: scalar(at.evaluate(&self.mass)),
                curvature: self.curvature_at(at),
                gamma_across: self.gamma_across(at, &slope),
                inertia: self.inertia_at(at, &r),
                r,
                slope,
            })
        })
    }

    /// Returns the curvature k of the support, absent on the plane.
    pub(super) fn curvature_at<T: Scalar>(&self, at: &Configuration<'_, T>) -> Option<T> {
        self.curvature.as_ref().map(|k| scalar(at.evaluate(k)))
    }

    /// Computes Γ = E - k ∂r/∂γ.
    pub(super) fn gamma_matrix<T: Scalar>(&self, slope: &Matrix3<T>, k: T) -> Matrix3<T> {
        isotropic(T::one()) - slope * k
    }

    /// Returns Γ across γ, absent on the plane.
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

    /// Computes K.
    pub(super) fn torque<T: Scalar>(&self, phase: &Phase<'_, T>) -> Vector3<T> {
        let at = &phase.configuration;
        let motion = self.motion(phase);
        let gyrostat = self.gyrostat.as_ref().map(|gyrostat| vector(at.evaluate(gyrostat)));
        let slope = |potential: &Potential| {
            Vector3::from_fn(|i, _| potential.value(&at.lift(NORMAL, axis(i))).eps)
        };
        let of_potential = self.potential.as_ref().map(|u| motion.moment_of_potential(&slope(u)));
        let further = self.moment.as_ref().map(|moment| vector(phase.evaluate(moment)));
        motion.torque(gyrostat, of_potential.into_iter().chain(further))
    }

    /// Computes ω' and λ.
    pub(super) fn acceleration<T: Scalar>(&self, phase: &Phase<'_, T>) -> (Vector3<T>, T) {
        self.motion(phase).acceleration(self.torque(phase))
    }

    /// Energy ½(ω,Ĩω) + U.
    pub fn energy<T: Scalar>(&self, phase: &Phase<'_, T>) -> T {
        let at = &phase.configuration;
        let kinetic = self.motion(phase).kinetic_energy();
        match &self.potential {
            None => kinetic,
            Some(potential) => kinetic + potential.value(at),
        }
    }
}

impl Potential {
    /// Evaluates U at a point of configuration space.
    pub fn value<T: Scalar>(&self, at: &Configuration<'_, T>) -> T {
        match self {
            Potential::Formula(formula) => scalar(at.evaluate(formula)),
            Potential::Arbitrary(polynomial) => polynomial.evaluate(at, normal(at)),
        }
    }
}
