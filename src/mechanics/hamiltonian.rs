//! Hamilton's equations x' = P ∂H/∂x with bracket P and function H from the case file.

use super::calculus::MANY;
use super::configuration::Configuration;
use super::dynamics::Dynamics;
use super::elimination::dot;
use super::model::Variable;
use super::phase::Phase;
use super::quantity::Quantity;
use super::variables::{BracketBlock, symmetric_part, tensor};
use crate::formula::{Formula, Value};
use crate::scalar::Scalar;

/// A Hamiltonian system: a function and a bracket of the state variables.
#[derive(Clone, Debug)]
pub struct HamiltonianSystem {
    /// Hamiltonian H.
    pub function: Formula,
    /// Blocks of P, by pairs of state variables.
    pub blocks: Vec<Vec<Option<BracketBlock>>>,
    /// Index of the state variable that is time, with rate 1.
    pub clock: Option<usize>,
}

impl HamiltonianSystem {
    /// Evaluates H.
    fn energy_at<T: Scalar>(&self, at: &Configuration<'_, T>) -> T {
        at.scalar(&self.function)
    }

    /// Computes the partial derivatives of H with respect to the state's components.
    fn gradient<T: Scalar>(&self, at: &Configuration<'_, T>) -> Vec<T> {
        let dimension = at.model.dimension();
        if dimension >= MANY
            && let Some(rows) = T::gradients_of(&[self.energy_at(at)], &at.components())
        {
            let mut gradient = vec![T::zero(); dimension];
            rows.iter().flatten().for_each(|(place, slope)| gradient[*place] = *slope);
            return gradient;
        }
        let slope = |index: usize| {
            let mut direction = vec![T::zero(); dimension];
            direction[index] = T::one();
            self.energy_at(&at.lift_state(&direction)).eps
        };
        (0..dimension).map(slope).collect()
    }

    /// Returns the tensor P, by rows.
    pub fn tensor<T: Scalar>(&self, phase: &Phase<'_, T>) -> Vec<Vec<T>> {
        tensor(&phase.model().state, &self.blocks, phase)
    }

    /// Computes P + Pᵀ, which vanishes where P is a bracket.
    pub fn symmetric_part<T: Scalar>(&self, phase: &Phase<'_, T>) -> Vec<T> {
        symmetric_part(&phase.model().state, &self.tensor(phase))
    }
}

impl Dynamics for HamiltonianSystem {
    /// Returns H and the given blocks.
    fn functions(&self) -> Vec<&Formula> {
        let blocks = self.blocks.iter().flatten().flatten().filter_map(BracketBlock::typed);
        [&self.function].into_iter().chain(blocks).collect()
    }

    /// Returns the rates of all components of the state.
    fn field<T: Scalar>(&self, phase: &Phase<'_, T>) -> Vec<T> {
        let state = &phase.model().state;
        let gradient = self.gradient(&phase.configuration);
        let rows = tensor(state, &self.blocks, phase);
        let mut rates: Vec<T> = rows.iter().map(|row| dot(row, &gradient)).collect();
        if let Some(clock) = self.clock {
            let before: usize = state[..clock].iter().map(Variable::len).sum();
            rates[before] = T::one();
        }
        rates
    }

    fn energy<T: Scalar>(&self, phase: &Phase<'_, T>) -> Option<T> {
        Some(self.energy_at(&phase.configuration))
    }

    fn quantity<T: Scalar>(&self, _: Quantity, phase: &Phase<'_, T>) -> Value<T> {
        Value::Scalar(self.energy_at(&phase.configuration))
    }
}
