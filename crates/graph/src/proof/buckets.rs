//! Groups that are proved together, and what is found for each of them on all cells.

use std::sync::Arc;

use crate::graph::{Expr, Graph, Step};
use crate::number::{BinaryOperation, UnaryFunction};

use super::Group;
use super::bounds::InputDistribution;
use super::cells::{Cell, Leaf};
use super::explore::Explored;
use super::fact::SignFact;
use super::outcome::{GroupOutcome, InputRegion, InputRegions};
use super::rewrite::conditions;
use super::trial::{self, Certificate, TrialResult};

/// Groups that are proved together.
pub struct Bucket {
    /// Places of the non-rational steps that they need, and of sums whose signs are facts.
    pub special: Vec<usize>,
    /// Values that exist wherever the claim is to hold.
    pub required: Vec<Expr>,
    /// Facts about values there.
    pub facts: Vec<(Expr, SignFact)>,
    /// Indices of the groups.
    pub members: Vec<usize>,
}

/// Sorts groups by the non-rational steps that they need and by the facts; in the order of the
/// first member of each.
pub fn buckets(graph: &Graph, groups: &[Group], sources: &[InputDistribution]) -> Vec<Bucket> {
    let is_special = |step: Step<'_>| match step {
        Step::Constant(_) => false,
        Step::Input(input) => sources.get(input) == Some(&InputDistribution::Sign),
        Step::Unary(function, _) => !matches!(function, UnaryFunction::Neg | UnaryFunction::Recip),
        Step::Binary(operation, ..) => operation == BinaryOperation::Pow,
        Step::Power(_, exponent) => exponent.to_integer().is_none(),
    };
    let special: Vec<usize> =
        (0..graph.len()).filter(|place| is_special(graph.step(*place))).collect();
    let mut buckets: Vec<Bucket> = Vec::new();
    for (index, group) in groups.iter().enumerate() {
        let own: Vec<usize> = match special.is_empty() {
            true => Vec::new(),
            false => {
                let reached = graph.reached(group.outputs.iter().copied());
                special.iter().copied().filter(|place| reached[*place]).collect()
            }
        };
        let is_same = |bucket: &&mut Bucket| {
            let first = &groups[bucket.members[0]];
            let is_known = || (&first.required, &first.facts) == (&group.required, &group.facts);
            bucket.special == own && (own.is_empty() || is_known())
        };
        match buckets.iter_mut().find(is_same) {
            Some(bucket) => bucket.members.push(index),
            None => {
                let facts = match own.is_empty() {
                    true => Vec::new(),
                    false => {
                        let reached = graph.reached(group.required.iter().copied());
                        let written = conditions(graph, &reached).into_iter();
                        let written = written.map(|(place, fact)| (graph.at(place), fact));
                        let given = group.facts.iter().map(|value| (*value, SignFact::NotNegative));
                        written.chain(given).collect()
                    }
                };
                let required = group.required.clone();
                buckets.push(Bucket { special: own, required, facts, members: vec![index] });
            }
        }
    }
    buckets
}

/// Combines the findings on all cells for each group; the flag tells whether the group is undefined
/// on some cell.
pub fn combined(explored: Explored, bucket: &Bucket) -> Vec<(GroupOutcome, bool)> {
    let count = bucket.members.len();
    let Explored { leaves, certificate } = explored;
    let of_group = |index: usize| {
        let results = || leaves.iter().filter_map(move |leaf| leaf.results[index].as_ref());
        let is_nonzero =
            |result: &Option<TrialResult>| matches!(result, Some(TrialResult::NonZero));
        if leaves.iter().any(|leaf| is_nonzero(&leaf.results[index])) {
            return GroupOutcome::NonZero(InputRegions::default());
        }
        let mut all: Option<Certificate> = None;
        for result in results() {
            match result {
                TrialResult::Zero(certificate) => all = trial::both(all, Some(*certificate)),
                TrialResult::Silent(reason) => return GroupOutcome::Silent(reason.clone()),
                TrialResult::NonZero => {}
            }
        }
        match all {
            Some(all) => GroupOutcome::Zero(certificate.map_or(all, |dropped| all.and(dropped))),
            None => GroupOutcome::Void,
        }
    };
    let mut outcomes: Vec<GroupOutcome> = (0..count).map(of_group).collect();
    // A group that is not zero on the whole needs no parts; others keep those on which they are not
    // zero.
    let is_nonzero = |leaf: &Leaf, index: usize| {
        leaf.cell.is_part() && matches!(leaf.results[index], Some(TrialResult::NonZero))
    };
    let of_group = |index: usize| {
        let numbers = (0..leaves.len()).filter(|number| is_nonzero(&leaves[*number], index));
        numbers.collect::<Vec<usize>>()
    };
    let parts: Vec<Vec<usize>> = (0..count).map(of_group).collect();
    let is_partial: Vec<bool> =
        (0..count).map(|index| leaves.iter().any(|leaf| leaf.results[index].is_none())).collect();
    let shared: Vec<Arc<InputRegion>> =
        leaves.into_iter().map(|leaf| Arc::new(part(leaf.cell))).collect();
    for (outcome, own) in outcomes.iter_mut().zip(parts) {
        if outcome.is_nonzero() && !own.is_empty() {
            let parts = own.into_iter().map(|number| Arc::clone(&shared[number])).collect();
            *outcome = GroupOutcome::NonZero(InputRegions(Some(parts)));
        }
    }
    outcomes.into_iter().zip(is_partial).collect()
}

/// Makes the part of the inputs that a cell is.
pub fn part(cell: Cell) -> InputRegion {
    let positive = cell.signs().map(|place| cell.graph.at(place)).collect();
    InputRegion { positive, signs: cell.fixed, graph: cell.graph }
}
