//! A Lagrangian with constraints that are linear in the velocities: nonholonomic and vakonomic
//! motion, in coordinates or quasi-velocities.
//!
//! Velocities w, coordinates q with q' = Σ w_i X_i(q), constraints f_k = (a_k,w) + b_k = 0:
//!
//! ```text
//! P_i' + c^b_ia w_a P_b = X_i(𝓛) + Q_i + Σ μ_k a_ki,   P = ∂𝓛/∂w,   [X_i,X_a] = c^b_ia X_b
//! nonholonomic: 𝓛 = L          vakonomic: 𝓛 = L - Σ λ_k f_k, λ_k' = μ_k
//! ```
//!
//! and f_k' = 0 gives the reactions μ. Where f_k is not linear, a_k = ∂f_k/∂w (Chetaev's rule). In
//! coordinates w = q', X_i = ∂/∂q_i and c = 0. Kozlov, Dynamics of systems with nonintegrable
//! constraints II: (27), (28), (33).

mod equations;
mod masses;
mod momenta;
mod recorded_masses;

pub use self::equations::{EquationTerms, LagrangianEquations};
pub use self::masses::AccelerationSolver;
use self::masses::eliminated;

use super::configuration::Configuration;
use super::dynamics::Dynamics;
use super::model::Variable;
use super::phase::Phase;
use super::quantity::Quantity;
use crate::formula::{Formula, Value};
use crate::scalar::Scalar;

/// A Lagrangian system with constraints.
#[derive(Clone, Debug)]
pub struct Lagrangian {
    /// Kinetic energy T.
    pub kinetic: Formula,
    /// Potential U.
    pub potential: Option<Formula>,
    /// Constraints f_k.
    pub constraints: Vec<Formula>,
    /// Role of each state variable.
    pub roles: Vec<VariableRole>,
    /// Commutators of the fields X_i.
    pub algebra: Algebra,
    /// Generalised forces, by the components of the state that are their velocities.
    pub forces: Vec<(usize, Formula)>,
    /// Whether the motion is vakonomic, with multipliers in the state.
    pub vakonomic: bool,
    /// Method by which the accelerations are solved for.
    pub solver: AccelerationSolver,
}

/// The role of a state variable.
#[derive(Clone, Debug)]
pub enum VariableRole {
    /// A coordinate whose rate is the given state variable.
    Coordinate(usize),
    /// A coordinate with a given rate; the components of its formulas follow one after another.
    Carried(Vec<Formula>),
    /// Time, whose rate is 1.
    Time,
    /// A velocity or quasi-velocity.
    Velocity,
    /// The multiplier of the constraint with this place in their list.
    Multiplier(usize),
}

/// Commutation relations of the fields X_i.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Algebra {
    /// Commuting fields: velocities are the rates of coordinates.
    Commuting,
    /// Rotations: three components from this one on are an angular velocity in the body, P' = P ×
    /// ω.
    Rotations(usize),
    /// General fields, as many as the coordinates; their commutators are computed.
    Frame,
}

/// Terms of the equations of motion at a point.
struct LagrangianTerms<T> {
    /// Components of the state that are velocities.
    velocities: Vec<usize>,
    acceleration: Vec<T>,
    reactions: Vec<T>,
    /// Rates of the coordinates, 0 in the other components.
    drift: Vec<T>,
}

impl Dynamics for Lagrangian {
    fn functions(&self) -> Vec<&Formula> {
        let carried = self.roles.iter().flat_map(|role| match role {
            VariableRole::Carried(rate) => rate.as_slice(),
            _ => &[],
        });
        let forces = self.forces.iter().map(|(_, force)| force);
        self.dimensional().into_iter().chain(forces).chain(carried).collect()
    }

    fn dimensional(&self) -> Vec<&Formula> {
        let energies = [&self.kinetic].into_iter().chain(&self.potential);
        energies.chain(&self.constraints).collect()
    }

    /// Returns the rates of all components of the state.
    fn field<T: Scalar>(&self, phase: &Phase<'_, T>) -> Vec<T> {
        let motion = self.motion(phase);
        let mut field = motion.drift;
        for (component, rate) in motion.velocities.iter().zip(motion.acceleration) {
            field[*component] = rate;
        }
        for (component, rate) in self.multipliers(&phase.model().state).zip(motion.reactions) {
            field[component] = rate;
        }
        field
    }

    fn energy<T: Scalar>(&self, phase: &Phase<'_, T>) -> Option<T> {
        Some(self.energy_at(&phase.configuration))
    }

    fn quantity<T: Scalar>(&self, quantity: Quantity, phase: &Phase<'_, T>) -> Value<T> {
        Value::Scalar(match quantity {
            Quantity::Reaction(index) => self.reaction(phase, index),
            _ => self.energy_at(&phase.configuration),
        })
    }
}

impl Lagrangian {
    /// Returns the reaction μ_k of a constraint.
    fn reaction<T: Scalar>(&self, phase: &Phase<'_, T>, index: usize) -> T {
        self.motion(phase).reactions.get(index).copied().unwrap_or_else(T::undefined)
    }

    /// Energy (w, ∂𝓛/∂w) - 𝓛, which is L₂ - L₀ + Σ λ_k b_k in a vakonomic system.
    fn energy_at<T: Scalar>(&self, at: &Configuration<'_, T>) -> T {
        let state = at.components();
        let mut stretch = vec![T::zero(); state.len()];
        for component in self.velocities(&at.model.state) {
            stretch[component] = state[component];
        }
        let scaled = self.lagrangian(&at.lift_state(&stretch), self.vakonomic);
        scaled.eps - scaled.re
    }

    /// Whether the motion carries some coordinates along with rates of their own.
    pub fn has_carried(&self) -> bool {
        self.roles.iter().any(|role| matches!(role, VariableRole::Carried(_)))
    }

    /// Returns the components of the state that are velocities.
    pub fn velocities(&self, state: &[Variable]) -> Vec<usize> {
        self.components(state, |role| matches!(role, VariableRole::Velocity)).collect()
    }

    /// Lists the components of the state that are multipliers, in the order of the constraints.
    fn multipliers<'a>(&'a self, state: &'a [Variable]) -> impl Iterator<Item = usize> + 'a {
        let of = move |place: usize| {
            let is_own = move |role: &VariableRole| matches!(role, VariableRole::Multiplier(own) if *own == place);
            self.components(state, is_own)
        };
        (0..self.roles.len()).flat_map(of)
    }

    /// Returns the components of the variables with some role.
    fn components<'a>(
        &'a self,
        state: &'a [Variable],
        keep: impl Fn(&VariableRole) -> bool + 'a,
    ) -> impl Iterator<Item = usize> + 'a {
        let mut start = 0;
        let places = state.iter().zip(&self.roles).map(move |(variable, role)| {
            start += variable.len();
            (start - variable.len()..start, role)
        });
        places.filter(move |(_, role)| keep(role)).flat_map(|(place, _)| place)
    }

    /// Evaluates L, or L - Σ λ_k f_k.
    pub fn lagrangian<T: Scalar>(&self, at: &Configuration<'_, T>, with_multipliers: bool) -> T {
        let mut value = at.scalar(&self.kinetic);
        if let Some(potential) = &self.potential {
            value -= at.scalar(potential);
        }
        if with_multipliers {
            let state = at.components();
            for (component, f) in self.multipliers(&at.model.state).zip(&self.constraints) {
                value -= state[component] * at.scalar(f);
            }
        }
        value
    }

    /// Returns the rates of the coordinates as functions of the state, 0 in the other components.
    pub fn drift<T: Scalar>(&self, at: &Configuration<'_, T>) -> Vec<T> {
        let mut rates = Vec::new();
        for (role, variable) in self.roles.iter().zip(&at.model.state) {
            match role {
                VariableRole::Coordinate(velocity) => {
                    rates.extend(at.variable(*velocity).components())
                }
                VariableRole::Carried(rate) => {
                    rates.extend(rate.iter().flat_map(|part| at.evaluate(part).components()));
                }
                VariableRole::Time => rates.push(T::one()),
                VariableRole::Velocity | VariableRole::Multiplier(_) => {
                    rates.extend(vec![T::zero(); variable.len()]);
                }
            }
        }
        rates
    }

    fn motion<T: Scalar>(&self, phase: &Phase<'_, T>) -> LagrangianTerms<T> {
        let equations = self.equations(phase);
        let equations = match self.solver.with_slopes {
            true => equations.with_slopes(),
            false => equations,
        };
        if self.may_be_eliminated(&equations.terms.mass) {
            return equations.solved_by(&eliminated);
        }
        match equations.is_small() {
            true => equations.by_determinant(),
            false => equations.by_blocks(),
        }
    }

    /// Whether the equations of motion are known to have one solution at almost every state at which what they are
    /// divided by is not 0, and at no others.
    pub fn has_known_divisors(&self) -> bool {
        self.solver.is_known
    }

    /// Whether they are known to have one exactly where that is not 0.
    pub fn has_exact_divisors(&self) -> bool {
        self.solver.is_exact
    }
}
