//! Values at random points modulo a prime.

use crate::Effort;
use crate::streams::SearchStream;
use liouville::graph::{Evaluator, Expr, Graph, Tape};
use liouville::number::prime::{Modulus, Prime, UNDEFINED};
use liouville::proof::{root_numbers, statement_seed};

/// Number of blocks of points that are tried, as roots exist at some only.
const TRIALS: usize = 64;

/// Evaluates some values at N random points at which all exist, and returns the modulus with them;
/// `None` if no such points are found.
pub fn values_at_random<const N: usize>(
    graph: &Graph,
    values: &[Expr],
    stream: SearchStream,
    effort: &Effort,
) -> Option<(Modulus, Vec<[u64; N]>)> {
    let mut rng = stream.under(statement_seed(effort.options.seed, graph, values));
    let modulus = rng.prime_for(&root_numbers(graph));
    let tape = Tape::new(graph, values);
    let mut evaluator = Evaluator::new(&tape, Prime::new([modulus; N]));
    for _ in 0..TRIALS {
        let inputs: Vec<[u64; N]> =
            (0..graph.inputs()).map(|_| std::array::from_fn(|_| rng.element(&modulus))).collect();
        evaluator.run(&inputs);
        let found: Vec<[u64; N]> = evaluator.outputs().copied().collect();
        if !found.iter().flatten().any(|value| *value == UNDEFINED) {
            return Some((modulus, found));
        }
    }
    None
}
