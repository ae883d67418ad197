//! Hamilton's equations x' = P ∂H/∂x with bracket P and function H from the case file.

use super::calculus::dot;
use super::configuration::Configuration;
use super::model::Variable;
use super::phase::Phase;
use super::variables::{Block, symmetric_part, tensor};
use crate::formula::Formula;
use crate::scalar::Scalar;

/// A Hamiltonian system: a function and a bracket of the state variables.
#[derive(Clone, Debug)]
pub struct Hamiltonian {
    /// Hamiltonian H.
    pub function: Formula,
    /// Blocks of P, by pairs of state variables.
    pub blocks: Vec<Vec<Option<Block>>>,
    /// Index of the state variable that is time, with rate 1.
    pub clock: Option<usize>,
}

impl Hamiltonian {
    /// Returns the rates of all components of the state.
    pub fn field<T: Scalar>(&self, phase: &Phase<'_, T>) -> Vec<T> {
        let state = &phase.model().state;
        let gradient: Vec<T> = (0..phase.model().dimension())
            .map(|index| {
                let mut direction = vec![T::zero(); phase.model().dimension()];
                direction[index] = T::one();
                self.energy(&phase.configuration.lift_state(&direction)).eps
            })
            .collect();
        let rows = tensor(state, &self.blocks, phase);
        let mut rates: Vec<T> = rows.iter().map(|row| dot(row, &gradient)).collect();
        if let Some(clock) = self.clock {
            let before: usize = state[..clock].iter().map(Variable::len).sum();
            rates[before] = T::one();
        }
        rates
    }

    /// Evaluates H.
    pub fn energy<T: Scalar>(&self, at: &Configuration<'_, T>) -> T {
        at.scalar(&self.function)
    }

    /// Computes P + Pᵀ, which vanishes where P is a bracket.
    pub fn symmetric_part<T: Scalar>(&self, phase: &Phase<'_, T>) -> Vec<T> {
        let state = &phase.model().state;
        symmetric_part(state, &tensor(state, &self.blocks, phase))
    }

    /// Iterates over H and the given blocks.
    pub fn functions(&self) -> impl Iterator<Item = &Formula> {
        let blocks = self.blocks.iter().flatten().flatten().filter_map(Block::typed);
        [&self.function].into_iter().chain(blocks)
    }
}
