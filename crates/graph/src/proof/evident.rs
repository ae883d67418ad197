//! Sums that are never negative by the ranges, as facts.
//!
//! A root of a square becomes the modulus of a polynomial that is multiplied out, whose sign bounds
//! may not show: x² + k² − 2ky + y². Written as x² + (k − y)² elsewhere in a claim its sign is
//! plain, and values that are equal share their signs.

use crate::graph::{Expr, Graph, Step};
use crate::number::{BinaryOperation, UnaryFunction};

use super::buckets::Bucket;
use super::classes::Classes;
use super::domain::Region;
use super::extent::Extent;
use super::fact::SignFact;

/// Largest number of such facts.
const MOST_FACTS: usize = 16;

/// The bucket with the signs of sums in some values, or in the radicands of roots, added to its facts;
/// `None` if there are none.
pub fn with_evident_signs(
    graph: &Graph,
    values: &[Expr],
    extents: &[Extent],
    bucket: &Bucket,
) -> Option<Bucket> {
    let reached = graph.reached(values.iter().copied());
    let mut is_rational = vec![false; graph.len()];
    let mut sums = Vec::new();
    for (place, step) in graph.steps().enumerate().filter(|(place, _)| reached[*place]) {
        is_rational[place] = bucket.special.binary_search(&place).is_err()
            && step.arguments().all(|argument| is_rational[argument]);
        if is_rational[place] && matches!(step, Step::Binary(BinaryOperation::Add, ..)) {
            sums.push(place);
        }
    }
    let classes = &Classes::default();
    let region = Region { graph, inputs: extents, facts: &[], classes };
    let known = region.at_sight(&sums);
    let is_positive = |place: &usize| known[*place] && region.sign(*place) == Some(true);
    // The largest sums come last.
    let found = sums.iter().rev().copied().filter(is_positive).take(MOST_FACTS);
    let found: Vec<_> = found.map(|place| (graph.at(place), SignFact::NotNegative)).collect();
    let is_new = |fact: &(Expr, SignFact)| !bucket.facts.contains(fact);
    let found: Vec<_> = found.into_iter().filter(is_new).collect();
    if found.is_empty() {
        return None;
    }
    // Among the values of a cell they are compared with others.
    let own = found.iter().map(|(value, _)| graph.place(*value));
    let mut special: Vec<usize> = bucket.special.iter().copied().chain(own).collect();
    special.sort_unstable();
    special.dedup();
    let (required, members) = (bucket.required.clone(), bucket.members.clone());
    Some(Bucket { special, required, facts: [&bucket.facts[..], &found].concat(), members })
}

/// Whether some steps are roots or moduli, for which signs of sums may matter.
pub fn has_roots(graph: &Graph, special: &[usize]) -> bool {
    special.iter().any(|place| match graph.step(*place) {
        Step::Unary(function, _) => matches!(function, UnaryFunction::Sqrt | UnaryFunction::Abs),
        Step::Power(..) => true,
        _ => false,
    })
}
