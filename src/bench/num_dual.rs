//! num-dual at f64, one state at a time: by the definitions that the tape records, or by hand.

use super::candidate::{Block, Candidate};
use crate::case::{Case, Claim};
use crate::mechanics::Phase;
use crate::mechanics::calculus::Jet;
use crate::number::precise::Approximation;
use crate::verdict::LANES;

/// A function of one state, run over blocks.
pub struct OneByOne<F> {
    residual: F,
    /// For each block, for each lane, the inputs.
    states: Vec<Vec<Vec<f64>>>,
    results: [f64; LANES],
}

impl<F: Fn(&[f64]) -> f64> OneByOne<F> {
    /// The function and the states, lane by lane.
    pub fn new(residual: F, states: &[Block]) -> Self {
        let lane = |block: &Block, lane: usize| block.iter().map(|input| input[lane]).collect();
        let states = states
            .iter()
            .map(|block| (0..LANES).map(|index| lane(block, index)).collect())
            .collect();
        Self { residual, states, results: [0.0; LANES] }
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

/// The residual of a claim by its own definition, over num-dual's numbers at f64.
pub fn by_definition<'c>(case: &'c Case, claim: &'c Claim) -> impl Fn(&[f64]) -> f64 + 'c {
    let free = case.model.free_components();
    let end = free + case.model.dimension();
    move |inputs| {
        let jet = Jet::new(Phase::new(&case.model, &inputs[..free], &inputs[free..end]));
        let residual = claim.kind.residual(&jet, &claim.place.kept);
        residual.first().copied().unwrap_or(f64::NAN)
    }
}
