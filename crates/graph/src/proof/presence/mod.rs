//! Existence of values without which a claim has no meaning.
//!
//! A value written with roots, logarithms, powers and divisions exists where their arguments are as
//! these operations need them. What is needed is asked of each argument alone, so that no product
//! with 0 and no symbol in the place of a function hides it. docs/soundness.md, "What R needs
//! elsewhere".

use std::collections::BTreeMap;

use crate::graph::{Expr, Fault, Graph, Need, literally, record};
use crate::number::UnaryFunction;

use super::cells::Leaf;
use super::domain::MOST_PIECES;
use super::evident::is_never_negative;
use super::trial::TrialResult;
use super::{
    Group, GroupOutcome, Prover, QuestionData, buckets::buckets, is_seen_nowhere_zero, sign,
};

/// Number of pieces of the ranges in which a value is first seen not to vanish.
const FEW_PIECES: usize = 64;
/// Largest number of known arguments with which one is compared.
const MOST_OTHERS: usize = 16;

impl Prover<'_> {
    /// Whether all operations in the values that a group presupposes are proved to have a value
    /// almost everywhere where the required values exist.
    pub(super) fn are_present(
        &self,
        question: &QuestionData<'_>,
        group: &Group,
    ) -> Result<bool, Fault> {
        let graph = question.graph;
        if group.presence.iter().any(|value| graph.is_nowhere_defined(*value)) {
            return Ok(false);
        }
        let given = graph.reached(group.required.iter().copied());
        let asked = graph.reached(group.presence.iter().copied());
        let own: Vec<bool> = asked.iter().zip(&given).map(|(own, given)| *own && !given).collect();
        let mut needs: BTreeMap<usize, Need> = BTreeMap::new();
        let mut known: BTreeMap<usize, Need> = BTreeMap::new();
        for (all, of) in [(&mut needs, &own), (&mut known, &given)] {
            for (argument, need) in graph.needs(of) {
                let all = all.entry(argument).or_default();
                *all = all.and(need);
            }
        }
        for (argument, needs) in needs {
            let value = graph.at(argument);
            let is_present = (!needs.not_negative
                || self.is_never_negative(graph, group, value)?)
                && (!needs.nonzero || self.is_almost_nonzero(question, group, value)?);
            if is_present {
                continue;
            }
            let enough = known.iter().filter(|(_, own)| own.includes(needs));
            let others: Vec<Expr> = enough.map(|(other, _)| graph.at(*other)).collect();
            if !self.is_one_of(graph, group, value, &others)? {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Whether a value is proved to be the same as one of some others.
    fn is_one_of(
        &self,
        graph: &Graph,
        group: &Group,
        value: Expr,
        others: &[Expr],
    ) -> Result<bool, Fault> {
        let Group { required, facts, .. } = group;
        for other in others.iter().take(MOST_OTHERS) {
            let (made, found) = record(graph.inputs(), |inputs| {
                let reached = graph.reached([value, *other]);
                let conditions = graph.reached([&required[..], facts].concat());
                let values = graph.repeated(&reached, inputs);
                let kept = literally(|| graph.repeated(&conditions, inputs));
                let all = |some: &[Expr]| {
                    some.iter().map(|own| kept[graph.place(*own)]).collect::<Option<Vec<Expr>>>()
                };
                let (value, other) = (values[graph.place(value)]?, values[graph.place(*other)]?);
                let (required, facts) = (all(required)?, all(facts)?);
                Some(Group { outputs: vec![value - other], required, facts, presence: Vec::new() })
            })?;
            let Some(group) = found else { continue };
            if self.prove(&made, &[group])?.iter().all(GroupOutcome::is_zero) {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Whether a value is proved to be nowhere negative where the required values exist.
    fn is_never_negative(&self, graph: &Graph, group: &Group, value: Expr) -> Result<bool, Fault> {
        let Group { required, facts, .. } = group;
        let (made, found) = record(graph.inputs(), |inputs| {
            let reached = graph.reached([value]);
            let conditions = graph.reached([&required[..], facts].concat());
            let value = graph.repeated(&reached, inputs)[graph.place(value)]?;
            let kept = literally(|| graph.repeated(&conditions, inputs));
            let all = |some: &[Expr]| {
                some.iter().map(|own| kept[graph.place(*own)]).collect::<Option<Vec<Expr>>>()
            };
            let outputs = vec![value.apply(UnaryFunction::Abs) - value];
            let (required, facts) = (all(required)?, all(facts)?);
            Some((value, Group { outputs, required, facts, presence: Vec::new() }))
        })?;
        let Some((value, group)) = found else { return Ok(false) };
        let is_known = |place: usize| {
            let Group { required, facts, .. } = &group;
            let known = sign(&made, self.extents, required, facts, made.at(place));
            known.is_some_and(|known| known.is_positive)
        };
        Ok(is_never_negative(&made, made.place(value), &is_known)
            || self.prove(&made, &[group])?.iter().all(GroupOutcome::is_zero))
    }

    /// Whether a value is proved to vanish on no open set where the required values exist.
    fn is_almost_nonzero(
        &self,
        question: &QuestionData<'_>,
        group: &Group,
        value: Expr,
    ) -> Result<bool, Fault> {
        // Many pieces of the ranges take the longest.
        let is_seen = |pieces: usize| {
            is_seen_nowhere_zero(question.graph, self.extents, &group.facts, &[value], pieces)
        };
        Ok(is_seen(FEW_PIECES)
            || self.is_almost_nowhere_zero(question.graph, value)?
            || self.is_nonzero_on_cells(question, group, value)?
            || is_seen(MOST_PIECES))
    }

    /// Whether a value is proved not to be identically zero on the cells where the required values exist.
    fn is_nonzero_on_cells(
        &self,
        question: &QuestionData<'_>,
        group: &Group,
        value: Expr,
    ) -> Result<bool, Fault> {
        let graph = question.graph;
        let alone = Group { outputs: vec![value], presence: Vec::new(), ..group.clone() };
        let wide = Group { outputs: [&[value], &group.required[..]].concat(), ..alone.clone() };
        let Some(bucket) = buckets(graph, &[wide], &question.sources).pop() else {
            return Ok(false);
        };
        if bucket.special.is_empty() {
            let found = self.prove_plain(question, &[&alone.outputs]);
            return Ok(found.iter().all(|(outcome, _)| outcome.is_nonzero()));
        }
        let leaves = self.explore(question, &[&alone.outputs], &bucket)?.leaves;
        let is_nonzero =
            |leaf: &Leaf| matches!(leaf.results.first(), Some(Some(TrialResult::NonZero)));
        Ok(leaves.iter().all(is_nonzero))
    }
}
