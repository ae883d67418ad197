//! A tape of residuals, run over blocks of states in any number domain.

use crate::graph::{Evaluator, Expr, Graph, Tape};
use crate::number::Domain;
use crate::number::ball::Ball;

use super::antiderivative_value;
use super::sampler::LANES;

/// Balls over f64, the first domain of the ladder.
pub type Doubles = Ball<LANES>;

/// The values of some outputs of a graph at one block of states.
pub struct Values<D: Domain> {
    blocks: Vec<D::Block>,
}

impl<D: Domain> Values<D> {
    /// Output `index`.
    pub fn output(&self, index: usize) -> &D::Block {
        &self.blocks[index]
    }

    /// The outputs of a range.
    pub fn range(&self, range: std::ops::Range<usize>) -> Vec<&D::Block> {
        self.blocks[range].iter().collect()
    }
}

/// Evaluates `outputs` of `graph` at each block of inputs.
pub struct Run {
    tape: Tape,
    antiderivatives: usize,
}

impl Run {
    /// Lays out the tape; `inputs` are the parameters and the state, antiderivatives follow them.
    pub fn new(graph: &Graph, outputs: &[Expr], inputs: usize) -> Self {
        let antiderivatives = graph.inputs().saturating_sub(inputs);
        Self { tape: Tape::new(graph, outputs), antiderivatives }
    }

    /// The outputs at one block of parameters and states.
    pub fn at<D: Domain + Clone>(&self, domain: &D, states: &[D::Block]) -> Values<D> {
        let mut evaluator = Evaluator::new(&self.tape, domain.clone());
        let free = (0..self.antiderivatives).map(|k| domain.constant(&antiderivative_value(k)));
        let inputs: Vec<D::Block> = states.iter().cloned().chain(free).collect();
        evaluator.run(&inputs);
        Values { blocks: evaluator.outputs().cloned().collect() }
    }
}
