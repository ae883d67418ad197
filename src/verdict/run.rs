//! A tape with its sampler, run over blocks of states as balls.

use crate::graph::{Evaluator, Expr, Graph, Tape};
use crate::number::Domain;
use crate::number::ball::{Ball, Balls};

use super::antiderivative_value;
use super::sampler::LANES;

/// The values of some outputs of a graph at one block of states.
pub struct Values {
    blocks: Vec<Balls<LANES>>,
}

impl Values {
    /// Output `index`.
    pub fn output(&self, index: usize) -> &Balls<LANES> {
        &self.blocks[index]
    }

    /// The outputs of a range.
    pub fn range(&self, range: std::ops::Range<usize>) -> Vec<&Balls<LANES>> {
        self.blocks[range].iter().collect()
    }
}

/// Evaluates `outputs` of `graph` at each block of inputs.
pub struct Run {
    tape: Tape,
    antiderivatives: Vec<Balls<LANES>>,
}

impl Run {
    /// Lays out the tape; `inputs` are the parameters and the state, antiderivatives follow them.
    pub fn new(graph: &Graph, outputs: &[Expr], inputs: usize) -> Self {
        let domain = Ball::<LANES>;
        let free = graph.inputs().saturating_sub(inputs);
        let antiderivatives =
            (0..free).map(|number| domain.constant(&antiderivative_value(number))).collect();
        Self { tape: Tape::new(graph, outputs), antiderivatives }
    }

    /// The outputs at one block of parameters and states.
    pub fn at(&self, states: &[Balls<LANES>]) -> Values {
        let mut evaluator = Evaluator::new(&self.tape, Ball::<LANES>);
        let inputs: Vec<_> = states.iter().chain(&self.antiderivatives).cloned().collect();
        evaluator.run(&inputs);
        Values { blocks: evaluator.outputs().cloned().collect() }
    }
}
