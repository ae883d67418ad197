//! Functions written by hand, run one state at a time: as the compiler makes them for the baseline of
//! the architecture, and natively, for the widest vectors of this processor.

use super::candidate::{Block, Candidate};
use liouville::graph::Kernel;
use liouville::number::arb::Approximation;
use liouville::verdict::TAPE_LANES;

/// Function over a block of states; each state is a list of components.
pub type BlockResidual = fn(&[Vec<f64>], &mut [f64]);

/// A function at one state after the other, as the compiler makes it by default and natively; both
/// give the same bits, for no sums are fused or reordered.
macro_rules! one_by_one {
    ($residual:path) => {
        [
            |states, results| OneAfterOther { states, results, residual: $residual }.run(),
            |states, results| {
                with_widest_vectors(OneAfterOther { states, results, residual: $residual });
            },
        ]
    };
}
pub(super) use one_by_one;

/// A pass over a block of states, to be compiled for several instruction sets.
pub(super) struct OneAfterOther<'p, R> {
    pub states: &'p [Vec<f64>],
    pub results: &'p mut [f64],
    pub residual: R,
}

impl<R: Fn(&[f64]) -> f64> Kernel for OneAfterOther<'_, R> {
    #[inline(always)]
    fn run(self) {
        for (state, result) in self.states.iter().zip(self.results) {
            *result = (self.residual)(state);
        }
    }
}

/// Function run over blocks.
pub struct OneByOne {
    residual: BlockResidual,
    /// Inputs for each block and lane.
    states: Vec<Vec<Vec<f64>>>,
    results: [f64; TAPE_LANES],
}

impl OneByOne {
    /// Prepares a function and the states, lane by lane.
    pub fn new(residual: BlockResidual, states: &[Block]) -> Self {
        let lane = |block: &Block, lane: usize| block.iter().map(|input| input[lane]).collect();
        let states = states
            .iter()
            .map(|block| (0..TAPE_LANES).map(|index| lane(block, index)).collect())
            .collect();
        Self { residual, states, results: [0.0; TAPE_LANES] }
    }
}

impl Candidate for OneByOne {
    fn run(&mut self, block: usize) {
        (self.residual)(&self.states[block], &mut self.results);
    }

    fn value(&self, lane: usize) -> Option<Approximation> {
        Approximation::from_f64(self.results[lane])
    }
}
