//! Values that are proved to be 0 at all states and for all parameters.

use crate::graph::{Expr, Graph};
use crate::proof::{Extent, Group, GroupOutcome, InputDistribution, Prover};

/// Seed of the proofs.
const SEED: u64 = 1;

/// Whether a value is proved to be 0 for all inputs, also where terms cancel.
pub fn vanishes(graph: &Graph, value: Expr) -> bool {
    if let Some(value) = graph.constant_value(value) {
        return value.is_zero();
    }
    let inputs = graph.inputs();
    let (sources, extents) = (vec![InputDistribution::Uniform; inputs], vec![Extent::ALL; inputs]);
    let prover = Prover { sources: &sources, extents: &extents, seed: SEED };
    let found = prover.prove(graph, &[Group::of(vec![value])]);
    found.is_ok_and(|found| found.iter().all(GroupOutcome::is_zero))
}
