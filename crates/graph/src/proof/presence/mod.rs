//! Existence of values without which a claim has no meaning.
//!
//! A value written with roots, logarithms, powers and divisions exists where their arguments are as
//! these operations need them. What is needed is asked of each argument alone, so that no product
//! with 0 and no symbol in the place of a function hides it. docs/soundness.md, "What R needs
//! elsewhere".

use std::collections::{BTreeMap, BTreeSet};

use crate::graph::{Expr, Fault, Graph, Step, literally, record};
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};

use super::cells::Leaf;
use super::trial::TrialResult;
use super::{Group, GroupOutcome, Prover, QuestionData, buckets::buckets, is_nowhere_zero, sign};

/// Largest number of terms and factors looked at for a sum of squares.
const MOST_PARTS: usize = 256;

/// Whether a value is a sum of products in which each factor that is not known to be nowhere negative
/// occurs an even number of times.
fn is_sum_of_squares(graph: &Graph, place: usize, is_known: &dyn Fn(usize) -> bool) -> bool {
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

/// Largest number of known arguments with which one is compared.
const MOST_OTHERS: usize = 16;

/// Requirements of operations on one argument.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Needs {
    /// It vanishes on no open set.
    nonzero: bool,
    /// It is negative on no open set.
    not_negative: bool,
}

impl Needs {
    fn add(&mut self, other: Self) {
        self.nonzero |= other.nonzero;
        self.not_negative |= other.not_negative;
    }

    fn include(&self, other: Self) -> bool {
        (self.nonzero || !other.nonzero) && (self.not_negative || !other.not_negative)
    }

    /// Returns the argument of a step that may have no value, and what it needs.
    fn of(step: Step<'_>) -> Option<(usize, Self)> {
        let needs = |nonzero, not_negative| Self { nonzero, not_negative };
        match step {
            Step::Unary(UnaryFunction::Recip, a) => Some((a, needs(true, false))),
            Step::Unary(UnaryFunction::Sqrt, a) => Some((a, needs(false, true))),
            Step::Unary(UnaryFunction::Ln, a) | Step::Binary(BinaryOperation::Pow, a, _) => {
                Some((a, needs(true, true)))
            }
            Step::Power(a, exponent) => {
                let own = needs(exponent.is_negative(), exponent.to_integer().is_none());
                (own != Self::default()).then_some((a, own))
            }
            _ => None,
        }
    }
}

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
        let mut needs: BTreeMap<usize, Needs> = BTreeMap::new();
        let mut known: BTreeMap<usize, Needs> = BTreeMap::new();
        for (place, step) in graph.steps().enumerate() {
            let Some((argument, own)) = Needs::of(step) else { continue };
            if given[place] {
                known.entry(argument).or_default().add(own);
            } else if asked[place] {
                needs.entry(argument).or_default().add(own);
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
            let enough = known.iter().filter(|(_, own)| own.include(needs));
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
                let values = graph.replay(&reached, inputs, |_, _, _| None);
                let kept = literally(|| graph.replay(&conditions, inputs, |_, _, _| None));
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
            let value = graph.replay(&reached, inputs, |_, _, _| None)[graph.place(value)]?;
            let kept = literally(|| graph.replay(&conditions, inputs, |_, _, _| None));
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
        Ok(is_sum_of_squares(&made, made.place(value), &is_known)
            || self.prove(&made, &[group])?.iter().all(GroupOutcome::is_zero))
    }

    /// Whether a value is proved to vanish on no open set where the required values exist.
    fn is_almost_nonzero(
        &self,
        question: &QuestionData<'_>,
        group: &Group,
        value: Expr,
    ) -> Result<bool, Fault> {
        let graph = question.graph;
        if is_nowhere_zero(graph, self.extents, &group.facts, &[value])
            || self.is_almost_nowhere_zero(graph, value)?
        {
            return Ok(true);
        }
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

#[cfg(test)]
mod tests;
