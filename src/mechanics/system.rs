//! The kinds of mechanical systems, and what each answers by its own file.

use super::ball::BallOnSurface;
use super::chart::Chart;
use super::configuration::Configuration;
use super::dynamics::Dynamics;
use super::flat_base::FlatBase;
use super::hamiltonian::HamiltonianSystem;
use super::lagrangian::Lagrangian;
use super::phase::Phase;
use super::quantity::Quantity;
use super::rigid::RigidBody;
use super::rubber::Rubber;
use super::spinning::Spinning;
use crate::formula::{Formula, Value};
use crate::scalar::Scalar;

/// The equations of motion of a case.
#[derive(Clone, Debug)]
pub enum System {
    /// A body rolling without slipping or spinning on a plane or a sphere.
    Rubber(Box<Rubber>),
    /// A body rolling without slipping on a plane or a sphere, free to spin.
    Spinning(Box<Spinning>),
    /// A body with a flat part on a sphere.
    FlatBase(Box<FlatBase>),
    /// A homogeneous ball on a surface.
    Ball(Box<BallOnSurface>),
    /// A Lagrangian with constraints that are linear in the velocities.
    Lagrangian(Box<Lagrangian>),
    /// Hamilton's equations with a bracket given by the case.
    Hamiltonian(Box<HamiltonianSystem>),
    /// A vector field of the user: the rate of each state variable.
    Field(Vec<Formula>),
    /// A map of the user's own: the image of each state variable.
    Map(Vec<Formula>),
}

/// Evaluates an expression for the one system that there is.
macro_rules! for_each_kind {
    ($system:expr, $one:ident => $value:expr) => {
        match $system {
            System::Rubber($one) => $value,
            System::Spinning($one) => $value,
            System::FlatBase($one) => $value,
            System::Ball($one) => $value,
            System::Lagrangian($one) => $value,
            System::Hamiltonian($one) => $value,
            System::Field($one) | System::Map($one) => $value,
        }
    };
}

impl System {
    /// Returns the formulas of the equations of motion that may depend on the state.
    pub fn functions(&self) -> Vec<&Formula> {
        for_each_kind!(self, one => one.functions())
    }

    /// Returns the formulas of the constants in the equations of motion.
    pub fn constants(&self) -> Vec<&Formula> {
        for_each_kind!(self, one => one.constants())
    }

    /// Returns those of the formulas whose physical dimensions are checked: all but lists of
    /// parameters.
    pub fn dimensional(&self) -> Vec<&Formula> {
        for_each_kind!(self, one => one.dimensional())
    }

    /// Returns the body that rolls, with or without spin, if the system is one with a surface of
    /// any shape.
    pub fn body(&self) -> Option<&RigidBody> {
        for_each_kind!(self, one => one.body())
    }

    /// Returns the same for changes.
    pub fn body_mut(&mut self) -> Option<&mut RigidBody> {
        for_each_kind!(self, one => one.body_mut())
    }

    /// Whether a body or a ball has a potential.
    pub fn has_potential(&self) -> bool {
        for_each_kind!(self, one => one.has_potential())
    }

    /// Returns the formula of this potential; `None` if it is arbitrary.
    pub fn potential_formula(&self) -> Option<&Formula> {
        for_each_kind!(self, one => one.potential_formula())
    }

    /// Returns the angular momentum of a rotor.
    pub fn gyrostat(&self) -> Option<&Formula> {
        for_each_kind!(self, one => one.gyrostat())
    }

    /// Returns the chart of the level set that the system has by itself.
    pub fn chart(&self) -> Chart {
        for_each_kind!(self, one => one.chart())
    }

    /// Whether time scales as for bodies: ω as 1/t, shapes and masses not at all.
    pub fn has_time_weights(&self) -> bool {
        for_each_kind!(self, one => one.has_time_weights())
    }

    /// Whether the support is curved, with the curvature k.
    pub fn is_curved(&self) -> bool {
        for_each_kind!(self, one => one.is_curved())
    }

    /// Whether a surface, a profile or a potential is arbitrary.
    pub fn has_arbitrary_function(&self) -> bool {
        for_each_kind!(self, one => one.has_arbitrary_function())
    }

    /// The time derivatives of the state's components, in order; of a map their images.
    #[inline(never)]
    pub fn field<T: Scalar>(&self, phase: &Phase<'_, T>) -> Vec<T> {
        for_each_kind!(self, one => one.field(phase))
    }

    /// Energy: ½(ω,Ĩω) + U of a body, that of a Lagrangian, or H; `None` for a vector field.
    #[inline(never)]
    pub fn energy<T: Scalar>(&self, phase: &Phase<'_, T>) -> Option<T> {
        for_each_kind!(self, one => one.energy(phase))
    }

    /// Closed formulas for values that occur in claims, where some are known.
    #[inline(never)]
    pub fn shortcuts<T: Scalar>(&self, phase: &Phase<'_, T>) -> Vec<T> {
        for_each_kind!(self, one => one.shortcuts(phase))
    }

    /// Divergence div v by a closed formula of the system, where there is one.
    #[inline(never)]
    pub fn divergence<T: Scalar>(&self, phase: &Phase<'_, T>) -> Option<T> {
        if !phase.model().extension.is_empty() {
            return None;
        }
        for_each_kind!(self, one => one.divergence(phase))
    }

    /// Whether a criterion for densities of the configuration alone exists.
    pub fn has_criterion(&self) -> bool {
        for_each_kind!(self, one => one.has_criterion())
    }

    /// Whether the system has an energy.
    pub fn has_energy(&self) -> bool {
        for_each_kind!(self, one => one.has_energy())
    }

    /// Whether the system is a map, whose field is the image of the state.
    pub fn is_map(&self) -> bool {
        matches!(self, System::Map(_))
    }

    /// Whether the system is a field of formulas of the state: given, or of Hamilton's equations.
    pub fn is_field(&self) -> bool {
        matches!(self, System::Field(_) | System::Hamiltonian(_))
    }

    /// Whether formulas alone make the rates or the images: the system is a field or a map, without an
    /// inertia that has to be inverted.
    pub fn is_given_by_formulas(&self) -> bool {
        self.is_field() || self.is_map()
    }

    /// Whether the file gives the rates, or the images, as formulas; otherwise they are derived from energies.
    pub fn has_given_rates(&self) -> bool {
        matches!(self, System::Field(_) | System::Map(_))
    }

    /// Whether the rates of velocities are more than quadratic forms of the velocities, because of
    /// a potential, a gyrostat or a rotation.
    pub fn energy_is_inhomogeneous(&self) -> bool {
        for_each_kind!(self, one => one.energy_is_inhomogeneous())
    }

    /// Returns the same body without potential and gyrostat; `None` where the free motion is not
    /// known (a further moment may be quadratic in the velocities).
    pub fn without_forces(&self) -> Option<System> {
        for_each_kind!(self, one => one.without_forces())
    }

    /// Computes the criterion: scalars that are zero everywhere exactly when a density of the
    /// configuration alone exists. One for a rubber body and a flat base, C₁ and C₂ for a spinning
    /// body, none for other systems.
    #[inline(never)]
    pub fn criterion<T: Scalar>(&self, phase: &Phase<'_, T>) -> Vec<T> {
        for_each_kind!(self, one => one.criterion(phase))
    }

    /// Returns the covector whose rotation is the last part of the criterion: w(γ) of a body, ξ(r)
    /// of a flat base.
    #[inline(never)]
    pub fn criterion_covector<T: Scalar>(&self, phase: &Phase<'_, T>) -> Option<Vec<T>> {
        for_each_kind!(self, one => one.criterion_covector(phase))
    }

    /// Returns the square of the scale of the criterion.
    #[inline(never)]
    pub fn criterion_scale<T: Scalar>(&self, phase: &Phase<'_, T>) -> T {
        for_each_kind!(self, one => one.criterion_scale(phase))
    }

    /// Computes ρ₀ of a body: where the criterion vanishes, ρ = Nρ₀ is a density with
    /// d ln N = -(w,dγ).
    #[inline(never)]
    pub fn reference_density<T: Scalar>(&self, at: &Configuration<'_, T>) -> Option<T> {
        for_each_kind!(self, one => one.reference_density(at))
    }

    /// Computes what the rates of a body or a ball are divided by; nothing for other systems.
    pub fn divisors<T: Scalar>(&self, phase: &Phase<'_, T>) -> Vec<T> {
        for_each_kind!(self, one => one.divisors(phase))
    }

    /// Computes (γ, rot r), which vanishes on |γ| = 1 exactly when ∂r/∂γ is symmetric across γ
    /// there, as it is for the surface of a body; `None` where r is the gradient of a support
    /// function.
    #[inline(never)]
    pub fn contact_twist<T: Scalar>(&self, at: &Configuration<'_, T>) -> Option<T> {
        self.body().and_then(|body| body.contact_twist(at))
    }

    /// Returns the moment of forces given besides or instead of a potential.
    pub fn moment(&self) -> Option<&Formula> {
        self.body().and_then(|body| body.moment.as_ref())
    }

    /// Whether the level functions are integrals in all of phase space by construction.
    ///
    /// True for a body whose r is homogeneous of degree 0: then Γγ = γ and γ' is across γ.
    pub fn conserves_level(&self) -> bool {
        for_each_kind!(self, one => one.conserves_level())
    }

    /// Computes χ with div v = (χ,ω) on the level; that of a rubber body is tangential.
    #[inline(never)]
    pub fn chi<T: Scalar>(&self, phase: &Phase<'_, T>) -> Option<[T; 3]> {
        for_each_kind!(self, one => one.chi(phase))
    }

    /// Whether ω' is homogeneous and quadratic in ω. Then the criterion excludes every density that
    /// is analytic near ω = 0; with a potential, a moment or a gyrostat only densities of the
    /// configuration alone.
    pub fn is_free(&self) -> bool {
        for_each_kind!(self, one => one.is_free())
    }

    /// Whether the first part of the criterion, where it is not 0 at a rest of the body, excludes
    /// every density near it, with a potential and a gyrostat too.
    pub fn rest_excludes_densities(&self) -> bool {
        for_each_kind!(self, one => one.rest_excludes_densities())
    }

    /// Computes K with Ĩω' = K of a body that may spin, if no moment acts on it besides those of a
    /// potential and a rotor; K is orthogonal to γ where ω is parallel to γ.
    #[inline(never)]
    pub fn turning_moment<T: Scalar>(&self, phase: &Phase<'_, T>) -> Option<[T; 3]> {
        for_each_kind!(self, one => one.turning_moment(phase))
    }

    #[inline(never)]
    pub(super) fn quantity<T: Scalar>(&self, quantity: Quantity, phase: &Phase<'_, T>) -> Value<T> {
        for_each_kind!(self, one => one.quantity(quantity, phase))
    }

    #[inline(never)]
    pub(super) fn configuration_quantity<T: Scalar>(
        &self,
        quantity: Quantity,
        at: &Configuration<'_, T>,
    ) -> Value<T> {
        for_each_kind!(self, one => one.configuration_quantity(quantity, at))
    }
}
