//! Sums that are never negative, by their form or by the ranges, and the facts that they are: rule S10 of
//! docs/soundness.md.
//!
//! A root of a square becomes the modulus of a polynomial that is multiplied out, whose sign bounds
//! may not show: x² + k² − 2ky + y². Written as x² + (k − y)² elsewhere in a claim its sign is
//! plain, and values that are equal share their signs.

use std::collections::BTreeSet;

use crate::graph::{Expr, Graph, Step};
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};

use super::buckets::Bucket;
use super::classes::Classes;
use super::domain::Region;
use super::extent::Extent;
use super::fact::SignFact;

/// Largest number of such facts.
const MOST_FACTS: usize = 16;

/// Largest number of terms and factors looked at for a sum of squares.
const MOST_PARTS: usize = 256;

/// Whether a value is a sum of products in which each factor that is not known to be nowhere negative
/// occurs an even number of times.
pub fn is_never_negative(graph: &Graph, place: usize, is_known: &dyn Fn(usize) -> bool) -> bool {
    let (mut terms, mut looked) = (vec![(place, true)], 0);
    while let Some((term, mut is_positive)) = terms.pop() {
        match graph.step(term) {
            Step::Binary(BinaryOperation::Add, a, b) => {
                terms.extend([(a, is_positive), (b, is_positive)]);
                continue;
            }
            Step::Binary(BinaryOperation::Sub, a, b) => {
                terms.extend([(a, is_positive), (b, !is_positive)]);
                continue;
            }
            _ => {}
        }
        let is_known_term = is_positive && is_known(term);
        let (mut factors, mut odd): (Vec<usize>, BTreeSet<usize>) = (vec![term], BTreeSet::new());
        while let Some(factor) = factors.pop() {
            looked += 1;
            if looked > MOST_PARTS {
                return false;
            }
            match graph.step(factor) {
                Step::Binary(BinaryOperation::Mul, a, b) => factors.extend([a, b]),
                Step::Unary(UnaryFunction::Recip, a) => factors.push(a),
                Step::Unary(UnaryFunction::Neg, a) => {
                    is_positive = !is_positive;
                    factors.push(a);
                }
                Step::Constant(value) => is_positive ^= value.is_negative(),
                Step::Power(a, exponent) if exponent.to_integer().is_some() => {
                    let half = exponent * &Rational::new(1, 2);
                    if half.to_integer().is_none() {
                        factors.push(a);
                    }
                }
                _ => {
                    if !odd.remove(&factor) {
                        odd.insert(factor);
                    }
                }
            }
        }
        if !(is_known_term || is_positive && odd.into_iter().all(is_known)) {
            return false;
        }
    }
    true
}

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
    let is_positive = |place: &usize| known[*place].is_some() && region.sign(*place) == Some(true);
    let is_known = |place: usize| known[place] == Some(true);
    let is_square =
        |place: &usize| known[*place].is_none() && is_never_negative(graph, *place, &is_known);
    // The largest sums come last.
    let largest = || sums.iter().rev().copied();
    let found = largest().filter(is_positive).chain(largest().filter(is_square)).take(MOST_FACTS);
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
