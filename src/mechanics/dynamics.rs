//! Interface of the kinds of systems: the equations of motion and facts about them.
//!
//! A new kind implements [`Dynamics`] in a file of its own and becomes a variant of
//! [`System`](super::System); the compiler asks for the rest.

use super::chart::Chart;
use super::configuration::Configuration;
use super::phase::Phase;
use super::quantity::Quantity;
use super::rigid::RigidBody;
use super::rubber::Potential;
use super::system::System;
use crate::formula::{Formula, Value};
use crate::scalar::Scalar;

/// A kind of mechanical system.
pub(super) trait Dynamics {
    /// Returns the formulas of the equations of motion that may depend on the state.
    fn functions(&self) -> Vec<&Formula> {
        self.body().map_or_else(Vec::new, RigidBody::functions)
    }

    /// Returns the formulas of the constants in the equations of motion.
    fn constants(&self) -> Vec<&Formula> {
        self.body().map_or_else(Vec::new, RigidBody::constants)
    }

    /// Returns those of the formulas whose physical dimensions are checked: all but lists of
    /// parameters.
    fn dimensional(&self) -> Vec<&Formula> {
        self.body().map_or_else(|| self.functions(), RigidBody::dimensional)
    }

    /// Returns the chart of the level set that the system has by itself.
    fn chart(&self) -> Chart {
        Chart::Free
    }

    /// The time derivatives of the state's components, in order; of a map their images.
    fn field<T: Scalar>(&self, phase: &Phase<'_, T>) -> Vec<T>;

    /// Energy, for systems that have one.
    fn energy<T: Scalar>(&self, phase: &Phase<'_, T>) -> Option<T> {
        self.body().map(|body| body.energy(phase))
    }

    /// Whether the system has an energy.
    fn has_energy(&self) -> bool {
        true
    }

    /// Whether the rates of velocities may be more than quadratic forms of the velocities.
    fn energy_is_inhomogeneous(&self) -> bool {
        self.body().is_none_or(RigidBody::is_loaded)
    }

    /// Returns the same system without potential and gyrostat, where the free motion is known.
    fn without_forces(&self) -> Option<System> {
        None
    }

    /// Returns the body that rolls, if the system is one with a surface of any shape.
    fn body(&self) -> Option<&RigidBody> {
        None
    }

    /// Returns the same for changes.
    fn body_mut(&mut self) -> Option<&mut RigidBody> {
        None
    }

    /// Whether a body or a ball has a potential.
    fn has_potential(&self) -> bool {
        self.body().is_some_and(|body| body.potential.is_some())
    }

    /// Returns the formula of this potential; `None` if it is arbitrary.
    fn potential_formula(&self) -> Option<&Formula> {
        self.body().and_then(|body| body.potential.as_ref()).and_then(Potential::formula)
    }

    /// Returns the angular momentum of a rotor.
    fn gyrostat(&self) -> Option<&Formula> {
        self.body().and_then(|body| body.gyrostat.as_ref())
    }

    /// Whether time scales as for bodies: ω as 1/t, shapes and masses not at all.
    fn has_time_weights(&self) -> bool {
        self.body().is_some()
    }

    /// Whether the support is curved, with the curvature k.
    fn is_curved(&self) -> bool {
        self.body().is_some_and(|body| body.curvature.is_some())
    }

    /// Whether a surface, a profile or a potential is arbitrary.
    fn has_arbitrary_function(&self) -> bool {
        self.body().is_some_and(RigidBody::has_arbitrary_function)
    }

    /// Closed formulas for values that occur in claims, where some are known.
    fn shortcuts<T: Scalar>(&self, _: &Phase<'_, T>) -> Vec<T> {
        Vec::new()
    }

    /// Divergence div v by a closed formula, where there is one.
    fn divergence<T: Scalar>(&self, _: &Phase<'_, T>) -> Option<T> {
        None
    }

    /// Whether a criterion for densities of the configuration alone exists.
    fn has_criterion(&self) -> bool {
        false
    }

    /// Computes the criterion: scalars that vanish everywhere exactly when a density of the
    /// configuration alone exists. Empty if none is known.
    fn criterion<T: Scalar>(&self, _: &Phase<'_, T>) -> Vec<T> {
        Vec::new()
    }

    /// Returns the covector whose rotation is the criterion, or its last part.
    fn criterion_covector<T: Scalar>(&self, _: &Phase<'_, T>) -> Option<Vec<T>> {
        None
    }

    /// Returns the square of the scale of the criterion.
    fn criterion_scale<T: Scalar>(&self, _: &Phase<'_, T>) -> T {
        T::undefined()
    }

    /// Computes the density ρ₀ relative to which the covector of the criterion is taken.
    fn reference_density<T: Scalar>(&self, _: &Configuration<'_, T>) -> Option<T> {
        None
    }

    /// Computes what the rates of a body or a ball are divided by; nothing for other systems.
    fn divisors<T: Scalar>(&self, _: &Phase<'_, T>) -> Vec<T> {
        Vec::new()
    }

    /// Computes χ with div v = (χ,ω) on the level.
    fn chi<T: Scalar>(&self, _: &Phase<'_, T>) -> Option<[T; 3]> {
        None
    }

    /// Whether the criterion excludes every density that is analytic near ω = 0: the motion is free.
    fn is_free(&self) -> bool {
        self.has_criterion() && !self.energy_is_inhomogeneous()
    }

    /// Whether a rest of the body excludes every density near it if the first part of the criterion
    /// is not 0 there.
    fn rest_excludes_densities(&self) -> bool {
        false
    }

    /// Computes K with Ĩω' = K of a body that may spin, if no moment acts on it besides those of a
    /// potential and a rotor; K is orthogonal to γ where ω is parallel to γ.
    fn turning_moment<T: Scalar>(&self, _: &Phase<'_, T>) -> Option<[T; 3]> {
        None
    }

    /// Whether the level functions are integrals in all of phase space by construction.
    fn conserves_level(&self) -> bool {
        self.body().is_some_and(RigidBody::is_homogeneous)
    }

    /// Evaluates a quantity named in a formula.
    fn quantity<T: Scalar>(&self, _: Quantity, _: &Phase<'_, T>) -> Value<T> {
        Value::Scalar(T::undefined())
    }

    /// Evaluates a quantity that does not depend on velocities and needs no derivative.
    fn configuration_quantity<T: Scalar>(
        &self,
        quantity: Quantity,
        at: &Configuration<'_, T>,
    ) -> Value<T> {
        let of_body = self.body().map(|body| body.configuration_quantity(quantity, at));
        of_body.unwrap_or_else(|| Value::Scalar(T::undefined()))
    }
}

/// Rates of the state variables, or images under a map, as formulas.
impl Dynamics for Vec<Formula> {
    fn functions(&self) -> Vec<&Formula> {
        self.iter().collect()
    }

    fn field<T: Scalar>(&self, phase: &Phase<'_, T>) -> Vec<T> {
        self.iter().flat_map(|rate| phase.evaluate(rate).components()).collect()
    }

    fn has_energy(&self) -> bool {
        false
    }
}
