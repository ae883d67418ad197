//! Rubber rolling of a rigid body on a plane or on a sphere: no slipping, no spinning.
//!
//! The values of a case are substituted into the equations of [`rolling`](super::rolling).

use nalgebra::Vector3;

use super::body::{SurfacePolynomial, scalar, vector};
use super::chart::Chart;
use super::configuration::Configuration;
use super::dynamics::Dynamics;
use super::phase::Phase;
use super::quantity::Quantity;
use super::rigid::RigidBody;
use super::system::System;
use crate::formula::{Formula, Value};
use crate::scalar::Scalar;

/// Index of ω among the state variables.
pub const OMEGA: usize = 0;
/// Index of γ among the state variables.
pub const NORMAL: usize = 1;

/// A body that rolls without slipping or spinning.
#[derive(Clone, Debug)]
pub struct Rubber(pub RigidBody);

/// A potential U(γ), or U(r) of a ball on a surface.
#[derive(Clone, Debug)]
pub enum Potential {
    /// A potential given by a formula.
    Formula(Formula),
    /// A polynomial with free coefficients, which attains every jet that a residual can contain.
    Arbitrary(SurfacePolynomial),
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
    /// Computes ω' and λ.
    pub(super) fn acceleration<T: Scalar>(&self, phase: &Phase<'_, T>) -> (Vector3<T>, T) {
        self.0.motion(phase).acceleration(self.0.torque(phase))
    }
}

impl Dynamics for Rubber {
    fn chart(&self) -> Chart {
        Chart::Rolling
    }

    /// Returns the rates (ω', γ').
    fn field<T: Scalar>(&self, phase: &Phase<'_, T>) -> Vec<T> {
        let (acceleration, _) = self.acceleration(phase);
        let rate = self.0.motion(phase).normal_rate;
        acceleration.iter().chain(rate.iter()).copied().collect()
    }

    fn without_forces(&self) -> Option<System> {
        self.0.unloaded().map(|body| System::Rubber(Box::new(Self(body))))
    }

    fn body(&self) -> Option<&RigidBody> {
        Some(&self.0)
    }

    fn body_mut(&mut self) -> Option<&mut RigidBody> {
        Some(&mut self.0)
    }

    fn shortcuts<T: Scalar>(&self, phase: &Phase<'_, T>) -> Vec<T> {
        self.known_values(phase)
    }

    fn divergence<T: Scalar>(&self, phase: &Phase<'_, T>) -> Option<T> {
        self.known_divergence(phase)
    }

    fn has_criterion(&self) -> bool {
        true
    }

    fn criterion<T: Scalar>(&self, phase: &Phase<'_, T>) -> Vec<T> {
        vec![self.rotation(&phase.configuration)]
    }

    fn criterion_covector<T: Scalar>(&self, phase: &Phase<'_, T>) -> Option<Vec<T>> {
        Some(self.covector(&phase.configuration).iter().copied().collect())
    }

    fn criterion_scale<T: Scalar>(&self, phase: &Phase<'_, T>) -> T {
        let unit = self.inertial_normal(&phase.configuration);
        unit.dot(&unit)
    }

    /// Returns (γ, adj Ĩ γ) and D_T.
    fn divisors<T: Scalar>(&self, phase: &Phase<'_, T>) -> Vec<T> {
        let at = &phase.configuration;
        let (r, _) = self.0.shape.contact(at);
        vec![self.inertia_along_normal(at, &r), self.0.gamma_determinant(at)]
    }

    fn reference_density<T: Scalar>(&self, at: &Configuration<'_, T>) -> Option<T> {
        Some(self.volume(at))
    }

    fn chi<T: Scalar>(&self, phase: &Phase<'_, T>) -> Option<[T; 3]> {
        Some(self.tangential_chi(&phase.configuration).into())
    }

    fn quantity<T: Scalar>(&self, quantity: Quantity, phase: &Phase<'_, T>) -> Value<T> {
        match quantity {
            Quantity::AngularAcceleration => Value::Vector(self.acceleration(phase).0),
            Quantity::Multiplier => Value::Scalar(self.acceleration(phase).1),
            _ => self.0.quantity(quantity, phase),
        }
    }
}

impl Potential {
    /// Returns the formula, unless the potential is arbitrary.
    pub fn formula(&self) -> Option<&Formula> {
        match self {
            Potential::Formula(formula) => Some(formula),
            Potential::Arbitrary(_) => None,
        }
    }

    /// Evaluates U at a point of configuration space.
    pub fn value<T: Scalar>(&self, at: &Configuration<'_, T>) -> T {
        match self {
            Potential::Formula(formula) => scalar(at.evaluate(formula)),
            Potential::Arbitrary(polynomial) => polynomial.evaluate(at, normal(at)),
        }
    }
}
