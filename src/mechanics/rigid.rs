//! A rigid body of any shape that rolls on a plane or on a sphere: data and kinematics common to
//! rolling with and without spin.

use nalgebra::{Matrix3, Vector3};

use super::across::AcrossNormal;
use super::body::{Shape, axis, matrix, scalar, vector};
use super::configuration::Configuration;
use super::linear::{across, isotropic, point_mass};
use super::phase::Phase;
use super::rolling::{Pose, RollingTerms};
use super::rubber::{NORMAL, Potential, angular_velocity, normal};
use crate::formula::Formula;
use crate::scalar::Scalar;

/// A rigid body on a plane or a sphere.
#[derive(Clone, Debug)]
pub struct RigidBody {
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

impl RigidBody {
    pub(super) fn motion<'p, T: Scalar>(&self, phase: &'p Phase<'_, T>) -> &'p RollingTerms<T> {
        phase.motion(|| {
            let at = &phase.configuration;
            let (r, slope) = self.shape.contact(at);
            RollingTerms::of(Pose {
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
    pub fn curvature_at<T: Scalar>(&self, at: &Configuration<'_, T>) -> Option<T> {
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

    /// Computes D_T, the determinant of Γ across γ; 1 on the plane.
    pub fn gamma_determinant<T: Scalar>(&self, at: &Configuration<'_, T>) -> T {
        let (_, slope) = self.shape.contact(at);
        self.gamma_across(at, &slope).map_or_else(T::one, |big_gamma| big_gamma.determinant())
    }

    /// Computes the leading minors of the central inertia tensor, and the mass.
    pub fn masses<T: Scalar>(&self, at: &Configuration<'_, T>) -> ([T; 3], T) {
        let inertia = matrix(at.evaluate(&self.inertia));
        let entry = |i, j| inertia[(i, j)];
        let second = entry(0, 0) * entry(1, 1) - entry(0, 1) * entry(1, 0);
        let third = entry(2, 0) * (entry(0, 1) * entry(1, 2) - entry(0, 2) * entry(1, 1))
            - entry(2, 1) * (entry(0, 0) * entry(1, 2) - entry(0, 2) * entry(1, 0))
            + entry(2, 2) * second;
        ([entry(0, 0), second, third], scalar(at.evaluate(&self.mass)))
    }

    pub(super) fn inertia_at<T: Scalar>(
        &self,
        at: &Configuration<'_, T>,
        r: &Vector3<T>,
    ) -> Matrix3<T> {
        let mass = scalar(at.evaluate(&self.mass));
        matrix(at.evaluate(&self.inertia)) + point_mass(mass, r)
    }

    /// Computes K, the right-hand side of Ĩω' = K + λγ.
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

    /// Energy ½(ω,Ĩω) + U.
    pub(super) fn energy<T: Scalar>(&self, phase: &Phase<'_, T>) -> T {
        let kinetic = self.motion(phase).kinetic_energy();
        match &self.potential {
            None => kinetic,
            Some(potential) => kinetic + potential.value(&phase.configuration),
        }
    }

    /// Whether the surface or the potential is an arbitrary function.
    pub(super) fn has_arbitrary_function(&self) -> bool {
        let any = matches!(self.potential, Some(Potential::Arbitrary(_)));
        self.shape.formula().is_none() || any
    }

    /// Whether something acts on the body besides the support: a potential, a moment or a rotor.
    pub fn is_loaded(&self) -> bool {
        self.potential.is_some() || self.gyrostat.is_some() || self.moment.is_some()
    }

    /// Returns the body without potential and rotor; `None` with a further moment, which may be
    /// quadratic in the velocities.
    pub(super) fn unloaded(&self) -> Option<Self> {
        let free = || Self { potential: None, gyrostat: None, ..self.clone() };
        self.moment.is_none().then(free)
    }

    /// Whether γ² is an integral in all of phase space by construction: r is homogeneous of
    /// degree 0.
    pub(super) fn is_homogeneous(&self) -> bool {
        !matches!(self.shape, Shape::Contact(_))
    }

    /// Returns the formulas of the equations of motion.
    pub(super) fn functions(&self) -> Vec<&Formula> {
        self.dimensional().into_iter().chain(&self.moment).collect()
    }

    /// Returns m, I, k, and S.
    pub(super) fn constants(&self) -> Vec<&Formula> {
        [&self.mass, &self.inertia]
            .into_iter()
            .chain(&self.curvature)
            .chain(&self.gyrostat)
            .collect()
    }

    /// Returns the formulas of the surface and of the potential.
    pub(super) fn dimensional(&self) -> Vec<&Formula> {
        let potential = self.potential.as_ref().and_then(Potential::formula);
        self.shape.formula().into_iter().chain(potential).collect()
    }

    /// Computes (γ, rot r) where the file gives r.
    pub(super) fn contact_twist<T: Scalar>(&self, at: &Configuration<'_, T>) -> Option<T> {
        if self.is_homogeneous() {
            return None;
        }
        let (gamma, (_, slope)) = (normal(at), self.shape.contact(at));
        let cyclic = [(0, 1, 2), (1, 2, 0), (2, 0, 1)].into_iter();
        Some(cyclic.map(|(i, j, k)| gamma[i] * (slope[(k, j)] - slope[(j, k)])).sum())
    }

    /// Computes R₁ + R₂ and R₁R₂ for the principal radii of the body at the contact.
    pub fn radii<T: Scalar>(&self, at: &Configuration<'_, T>) -> (T, T) {
        let gamma = normal(at);
        let (_, slope) = self.shape.contact(at);
        let along = gamma.dot(&(slope * gamma)) / gamma.dot(&gamma);
        (along - slope.trace(), across(&slope, &gamma))
    }
}
