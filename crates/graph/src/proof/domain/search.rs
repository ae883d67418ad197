//! Questions about boxes of inputs: a point where values are positive, a common zero, a sign.

use std::collections::VecDeque;

use crate::graph::{Expr, Graph};
use crate::proof::classes::Classes;
use crate::proof::extent::Extent;
use crate::proof::fact::SignFact;
use crate::proof::rewrite::conditions;

use super::{KnownSign, Region};

/// Largest number of parts of the box used to show that a value does not vanish.
pub const MOST_PIECES: usize = 1 << 12;
/// Largest number of parts of a box that are searched for a point.
const MOST_BOXES: usize = 1 << 12;

/// Searches for a point inside the extents of some inputs at which some values are positive,
/// whatever the others do; `None` if none is found.
pub fn point(graph: &Graph, inputs: &[Extent], positive: &[Expr]) -> Option<Vec<f64>> {
    let positive: Vec<usize> = positive.iter().map(|value| graph.place(*value)).collect();
    let facts: Vec<(usize, SignFact)> =
        positive.iter().map(|place| (*place, SignFact::Positive)).collect();
    let classes = Classes::default();
    let region = Region { graph, inputs, facts: &facts, classes: &classes };
    let mut reach = region.reached(&[]);
    let positive: Vec<usize> = positive.iter().map(|place| reach.number(*place)).collect();
    let mut open = VecDeque::from([(region.whole(), 0)]);
    for _ in 0..MOST_BOXES {
        let (part, depth) = open.pop_front()?;
        if reach.bounds(&part).is_none() {
            continue;
        }
        let bounds = reach.bounds_of_inputs(&part);
        if positive.iter().all(|number| bounds[*number].excludes_zero()) {
            return part.iter().map(|extent| extent.inside()).collect();
        }
        open.extend(region.cut(&reach, part, depth).into_iter().flatten());
    }
    None
}

/// Whether some values are known to have no common zero inside the extents of the inputs where
/// others are not negative.
pub fn is_nowhere_zero(
    graph: &Graph,
    inputs: &[Extent],
    not_negative: &[Expr],
    values: &[Expr],
) -> bool {
    is_seen_nowhere_zero(graph, inputs, not_negative, values, MOST_PIECES)
}

/// The same, as far as it is seen by this number of pieces of the extents.
pub fn is_seen_nowhere_zero(
    graph: &Graph,
    inputs: &[Extent],
    not_negative: &[Expr],
    values: &[Expr],
    pieces: usize,
) -> bool {
    let classes = Classes::default();
    let fact = |value: &Expr| (graph.place(*value), SignFact::NotNegative);
    let facts: Vec<(usize, SignFact)> = not_negative.iter().map(fact).collect();
    let region = Region { graph, inputs, facts: &facts, classes: &classes };
    let places: Vec<usize> = values.iter().map(|value| graph.place(*value)).collect();
    let mut reach = region.reached(&places);
    let numbers: Vec<usize> = places.iter().map(|place| reach.number(*place)).collect();
    // What follows from the zeros may contradict a fact at sight: q − p = 0 and |q − p|² = 1.
    reach.suppose_zero(&numbers);
    let used = reach.inputs().to_vec();
    let mut open = vec![region.whole()];
    for _ in 0..pieces {
        let Some(mut part) = open.pop() else { return true };
        let Some(bounds) = reach.bounds(&part) else { continue };
        let vanishes =
            |number: &usize| !bounds[*number].excludes_zero() && !bounds[*number].is_empty();
        if !numbers.iter().all(vanishes) {
            continue;
        }
        // Start from the part of the inputs that the facts allow, the largest piece first.
        for (number, input) in &used {
            part[*input] = part[*input].common(bounds[*number]);
        }
        let spread = |(_, input): &&(usize, usize)| part[*input].spread();
        let widest = used.iter().max_by(|a, b| spread(a).total_cmp(&spread(b)));
        let Some((input, (low, high))) =
            widest.and_then(|(_, input)| Some((*input, part[*input].halves()?)))
        else {
            return false;
        };
        let mut upper = part.clone();
        (part[input], upper[input]) = (low, high);
        open.extend([upper, part]);
    }
    open.is_empty()
}

/// Whether it is seen that some values do not exist, one or another, at any inputs inside their extents:
/// an argument of a root, a logarithm or a power has the wrong sign.
pub fn is_missing(graph: &Graph, inputs: &[Extent], required: &[Expr]) -> bool {
    let facts = conditions(graph, &graph.reached(required.iter().copied()));
    let classes = Classes::default();
    let region = Region { graph, inputs, facts: &facts, classes: &classes };
    !facts.is_empty() && region.is_empty_at_sight()
}

/// Narrows the extents of inputs to what contains all those at which some values are not negative;
/// `None` if there are none.
pub fn narrowed(graph: &Graph, inputs: &[Extent], not_negative: &[Expr]) -> Option<Vec<Extent>> {
    let classes = Classes::default();
    let fact = |value: &Expr| (graph.place(*value), SignFact::NotNegative);
    let facts: Vec<(usize, SignFact)> = not_negative.iter().map(fact).collect();
    let region = Region { graph, inputs, facts: &facts, classes: &classes };
    let (mut reach, whole) = (region.reached(&[]), region.whole());
    let inputs = reach.inputs().to_vec();
    let bounds = reach.bounds(&whole)?;
    let mut narrow = whole.clone();
    for (number, input) in inputs {
        narrow[input] = whole[input].common(bounds[number]);
    }
    Some(narrow)
}

/// Finds the sign of a value at all inputs inside their extents at which some values exist and others
/// are not negative, where 0 counts as either sign; `None` if unknown.
pub fn sign(
    graph: &Graph,
    inputs: &[Extent],
    required: &[Expr],
    not_negative: &[Expr],
    value: Expr,
) -> Option<KnownSign> {
    let mut facts = conditions(graph, &graph.reached(required.iter().copied()));
    facts.extend(not_negative.iter().map(|value| (graph.place(*value), SignFact::NotNegative)));
    let classes = Classes::default();
    Region { graph, inputs, facts: &facts, classes: &classes }.known_sign(graph.place(value))
}
