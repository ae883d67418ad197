//! Functions written by hand, run one state at a time.

use super::candidate::{Block, Candidate};
use liouville::number::arb::Approximation;
use liouville::verdict::TAPE_LANES;

/// Function of one state, run over blocks.
pub struct OneByOne<F> {
    residual: F,
    /// Inputs for each block and lane.
    states: Vec<Vec<Vec<f64>>>,
    results: [f64; TAPE_LANES],
}

impl<F: Fn(&[f64]) -> f64> OneByOne<F> {
    /// Prepares a function and the states, lane by lane.
    pub fn new(residual: F, states: &[Block]) -> Self {
        let lane = |block: &Block, lane: usize| block.iter().map(|input| input[lane]).collect();
        let states = states
            .iter()
            .map(|block| (0..TAPE_LANES).map(|index| lane(block, index)).collect())
            .collect();
        Self { residual, states, results: [0.0; TAPE_LANES] }
    }
}

impl<F: Fn(&[f64]) -> f64> Candidate for OneByOne<F> {
    fn run(&mut self, block: usize) {
        for (state, result) in self.states[block].iter().zip(&mut self.results) {
            *result = (self.residual)(state);
        }
    }

    fn value(&self, lane: usize) -> Option<Approximation> {
        Approximation::from_f64(self.results[lane])
    }
}
