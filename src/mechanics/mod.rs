//! Mechanical systems, each written once over any [`crate::scalar::Scalar`].

mod across;
mod ball;
mod body;
pub mod calculus;
mod chart;
mod configuration;
mod draws;
mod flat_base;
mod hamiltonian;
pub mod iterate;
mod lagrangian;
mod linear;
mod memo;
mod model;
mod phase;
mod quantity;
mod recipe;
mod rolling;
mod rubber;
mod rubber_measure;
mod rubber_names;
mod shortcuts;
mod variables;
mod vocabulary;

pub use ball::{BallOnSurface, Surface};
pub use body::{Polynomial, Shape};
pub use chart::{Chart, GivenChart};
pub use configuration::Configuration;
pub use draws::Draws;
pub use flat_base::FlatBase;
pub use hamiltonian::Hamiltonian;
pub use lagrangian::{Algebra, Lagrangian, Role};
pub use model::{
    LevelEquation, LevelFunction, Model, Origin, Parameter, RootEquation, Variable, components,
};
pub use phase::Phase;
pub use quantity::{
    Features, Quantity, of_ball, of_flat_base, of_hamiltonian, of_lagrangian, of_rubber,
};
pub use recipe::{Draw, Line, Range, Recipe};
pub use rubber::{NORMAL, OMEGA, Potential, Rubber};
pub use variables::{Block, Variables};
pub use vocabulary::{Entry, Meaning, Reach, Vocabulary};

pub use across::AcrossNormal;
pub use body::contact_of;
pub use chart::rolling_point;
pub use linear::point_mass;
pub use rolling::{Motion, Pose};

use crate::formula::{Formula, Value};
use crate::scalar::Scalar;

/// The equations of motion of a case.
#[derive(Clone, Debug)]
pub enum System {
    /// A body rolling without slipping or spinning on a plane or a sphere.
    Rubber(Box<Rubber>),
    /// A body with a flat part on a sphere.
    FlatBase(Box<FlatBase>),
    /// A homogeneous ball on a surface.
    Ball(Box<BallOnSurface>),
    /// A Lagrangian with constraints that are linear in the velocities.
    Lagrangian(Box<Lagrangian>),
    /// Hamilton's equations with a bracket given by the case.
    Hamiltonian(Box<Hamiltonian>),
    /// A vector field of the user: the rate of each state variable.
    Field(Vec<Formula>),
    /// A map of the user's own: the image of each state variable.
    Map(Vec<Formula>),
}

impl System {
    /// Returns the formulas of the equations of motion that may depend on the state.
    pub fn functions(&self) -> Vec<&Formula> {
        fn typed(potential: &Option<Potential>) -> Option<&Formula> {
            match potential {
                Some(Potential::Formula(formula)) => Some(formula),
                _ => None,
            }
        }
        match self {
            System::Rubber(body) => {
                let parts = [body.shape.formula(), typed(&body.potential), body.moment.as_ref()];
                parts.into_iter().flatten().collect()
            }
            System::FlatBase(_) => Vec::new(),
            System::Ball(ball) => {
                let surface = match &ball.surface {
                    Surface::Level(formula) => Some(formula),
                    Surface::Support(shape) => shape.formula(),
                };
                surface.into_iter().chain(typed(&ball.potential)).collect()
            }
            System::Lagrangian(lagrangian) => {
                let carried = lagrangian.roles.iter().flat_map(|role| match role {
                    Role::Carried(rate) => rate.as_slice(),
                    _ => &[],
                });
                let energies = [&lagrangian.kinetic].into_iter().chain(&lagrangian.potential);
                let forces = lagrangian.forces.iter().map(|(_, force)| force);
                energies.chain(&lagrangian.constraints).chain(forces).chain(carried).collect()
            }
            System::Hamiltonian(hamiltonian) => hamiltonian.functions().collect(),
            System::Field(rates) | System::Map(rates) => rates.iter().collect(),
        }
    }

    /// Whether a surface, a profile or a potential is arbitrary.
    pub fn has_arbitrary_function(&self) -> bool {
        let is_open = |shape: &Shape| shape.formula().is_none();
        let is_any =
            |potential: &Option<Potential>| matches!(potential, Some(Potential::Arbitrary(_)));
        match self {
            System::Rubber(body) => is_open(&body.shape) || is_any(&body.potential),
            System::Ball(ball) => {
                let surface = matches!(&ball.surface, Surface::Support(shape) if is_open(shape));
                surface || is_any(&ball.potential)
            }
            System::FlatBase(_)
            | System::Lagrangian(_)
            | System::Hamiltonian(_)
            | System::Field(_)
            | System::Map(_) => false,
        }
    }

    /// The time derivatives of the state's components, in order; of a map their images.
    pub fn field<T: Scalar>(&self, phase: &Phase<'_, T>) -> Vec<T> {
        match self {
            System::Rubber(body) => body.field(phase),
            System::FlatBase(body) => body.field(phase),
            System::Ball(ball) => ball.field(phase),
            System::Lagrangian(lagrangian) => lagrangian.field(phase),
            System::Hamiltonian(hamiltonian) => hamiltonian.field(phase),
            System::Field(rates) | System::Map(rates) => {
                rates.iter().flat_map(|rate| phase.evaluate(rate).components()).collect()
            }
        }
    }

    /// Energy: ½(ω,Ĩω) + U of a body, that of a Lagrangian, or H; `None` for a vector field.
    pub fn energy<T: Scalar>(&self, phase: &Phase<'_, T>) -> Option<T> {
        match self {
            System::Rubber(body) => Some(body.energy(phase)),
            System::FlatBase(body) => Some(body.energy(phase)),
            System::Ball(ball) => Some(ball.energy(phase)),
            System::Lagrangian(lagrangian) => Some(lagrangian.energy(&phase.configuration)),
            System::Hamiltonian(hamiltonian) => Some(hamiltonian.energy(&phase.configuration)),
            System::Field(_) | System::Map(_) => None,
        }
    }

    /// Closed formulas for values that occur in claims, where some are known.
    pub fn shortcuts<T: Scalar>(&self, phase: &Phase<'_, T>) -> Vec<T> {
        match self {
            System::Rubber(body) => body.shortcuts(phase),
            _ => Vec::new(),
        }
    }

    /// Divergence div v by a closed formula of the system, where there is one.
    pub fn divergence<T: Scalar>(&self, phase: &Phase<'_, T>) -> Option<T> {
        match self {
            System::Rubber(body) if phase.model().extension.is_empty() => body.divergence(phase),
            _ => None,
        }
    }

    /// Whether a criterion for densities of the configuration alone exists.
    pub fn has_criterion(&self) -> bool {
        matches!(self, System::Rubber(_) | System::FlatBase(_))
    }

    /// Whether the system has an energy.
    pub fn has_energy(&self) -> bool {
        !matches!(self, System::Field(_) | System::Map(_))
    }

    /// Whether the system is a map, whose field is the image of the state.
    pub fn is_map(&self) -> bool {
        matches!(self, System::Map(_))
    }

    /// Whether the rates of velocities are more than quadratic forms of the velocities, because of
    /// a potential, a gyrostat or a rotation.
    pub fn energy_is_inhomogeneous(&self) -> bool {
        match self {
            System::Rubber(body) => {
                body.potential.is_some() || body.gyrostat.is_some() || body.moment.is_some()
            }
            System::FlatBase(body) => body.gyrostat.is_some(),
            System::Ball(ball) => ball.potential.is_some() || ball.rotation.is_some(),
            System::Lagrangian(_) | System::Hamiltonian(_) | System::Field(_) | System::Map(_) => {
                true
            }
        }
    }

    /// Returns the same body without potential and gyrostat; `None` where the free motion is not
    /// known (a further moment may be quadratic in the velocities).
    pub fn without_forces(&self) -> Option<System> {
        let mut free = self.clone();
        match &mut free {
            System::Rubber(body) => {
                if body.moment.is_some() {
                    return None;
                }
                (body.potential, body.gyrostat) = (None, None);
            }
            System::FlatBase(body) => body.gyrostat = None,
            System::Ball(ball) => {
                if ball.rotation.is_some() {
                    return None;
                }
                ball.potential = None;
            }
            System::Lagrangian(_) | System::Hamiltonian(_) | System::Field(_) | System::Map(_) => {
                return None;
            }
        }
        Some(free)
    }

    /// Computes the criterion, which is zero everywhere exactly when a density of the configuration
    /// alone exists.
    pub fn criterion<T: Scalar>(&self, phase: &Phase<'_, T>) -> Option<T> {
        match self {
            System::Rubber(body) => Some(body.criterion(&phase.configuration)),
            System::FlatBase(body) => Some(body.criterion(phase)),
            _ => None,
        }
    }

    /// Returns the covector whose rotation is the criterion: w(γ) of a rubber body, ξ(r) of a flat
    /// base.
    pub fn criterion_covector<T: Scalar>(&self, phase: &Phase<'_, T>) -> Option<Vec<T>> {
        match self {
            System::Rubber(body) => {
                Some(body.criterion_covector(&phase.configuration).iter().copied().collect())
            }
            System::FlatBase(body) => Some(body.criterion_covector(phase).to_vec()),
            _ => None,
        }
    }

    /// Returns the square of the scale of the criterion: |a|² for a rubber body, the squares of
    /// both terms for a flat base.
    pub fn criterion_scale<T: Scalar>(&self, phase: &Phase<'_, T>) -> T {
        match self {
            System::Rubber(body) => {
                let unit = body.inertial_normal(&phase.configuration);
                unit.dot(&unit)
            }
            System::FlatBase(body) => {
                let [a, b] = body.criterion_terms(phase);
                a * a + b * b
            }
            _ => T::zero(),
        }
    }

    /// Computes (γ, rot r), which vanishes on |γ| = 1 exactly when ∂r/∂γ is symmetric across γ
    /// there, as it is for the surface of a body; `None` where r is the gradient of a support
    /// function.
    pub fn contact_twist<T: Scalar>(&self, at: &Configuration<'_, T>) -> Option<T> {
        match self {
            System::Rubber(body) if matches!(body.shape, Shape::Contact(_)) => {
                Some(body.contact_twist(at))
            }
            _ => None,
        }
    }

    /// Returns the moment of forces given besides or instead of a potential.
    pub fn moment(&self) -> Option<&Formula> {
        match self {
            System::Rubber(body) => body.moment.as_ref(),
            _ => None,
        }
    }

    /// Whether the level functions are integrals in all of phase space by construction.
    ///
    /// True for a body whose r is homogeneous of degree 0: then Γγ = γ and γ' is across γ.
    pub fn conserves_level(&self) -> bool {
        match self {
            System::Rubber(body) => !matches!(body.shape, Shape::Contact(_)),
            System::FlatBase(_) => true,
            _ => false,
        }
    }

    /// Computes the tangential χ with div v = (χ,ω) on the level.
    pub fn chi<T: Scalar>(&self, phase: &Phase<'_, T>) -> Option<[T; 3]> {
        match self {
            System::Rubber(body) => Some(body.chi(&phase.configuration).into()),
            _ => None,
        }
    }

    /// Whether ω' is homogeneous and quadratic in ω. Then the criterion excludes every density that
    /// is analytic near ω = 0; with a potential, a moment or a gyrostat only densities of the
    /// configuration alone.
    pub fn is_free(&self) -> bool {
        match self {
            System::Rubber(_) => !self.energy_is_inhomogeneous(),
            System::FlatBase(body) => body.gyrostat.is_none(),
            _ => false,
        }
    }

    fn quantity<T: Scalar>(&self, quantity: Quantity, phase: &Phase<'_, T>) -> Value<T> {
        match self {
            System::Rubber(body) => body.quantity(quantity, phase),
            System::FlatBase(body) => body.quantity(quantity, phase),
            System::Ball(ball) => ball.quantity(quantity, phase),
            System::Lagrangian(lagrangian) => Value::Scalar(match quantity {
                Quantity::Reaction(index) => lagrangian.reaction(phase, index),
                _ => lagrangian.energy(&phase.configuration),
            }),
            System::Hamiltonian(hamiltonian) => {
                Value::Scalar(hamiltonian.energy(&phase.configuration))
            }
            System::Field(_) | System::Map(_) => Value::Scalar(T::undefined()),
        }
    }

    fn configuration_quantity<T: Scalar>(
        &self,
        quantity: Quantity,
        at: &Configuration<'_, T>,
    ) -> Value<T> {
        match self {
            System::Rubber(body) => body.configuration_quantity(quantity, at),
            System::Ball(ball) => ball.configuration_quantity(quantity, at),
            _ => Value::Scalar(T::undefined()),
        }
    }
}
