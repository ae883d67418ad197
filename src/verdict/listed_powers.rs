//! Powers whose exponents are whole numbers for some listed values.

use std::collections::BTreeSet;

use super::claim_state::ClaimState;
use super::evidence::Verdict;
use super::judge::JudgeError;
use super::judging::Judging;
use super::recorded::RecordedClaim;
use super::sampler::{Sampler, TAPE_LANES};
use crate::claim::{Condition, Need};
use crate::graph::{Evaluator, Expr, Fault, Graph, Step, Tape, record};
use crate::mechanics::{Draw, combinations};
use crate::number::BinaryOperation;
use crate::number::ball::{Ball, Balls};
use crate::number::rational::Rational;
use crate::proof::{Extent, sign};
use crate::scalar::Scalar;

/// Draws of listed numbers in the exponents of powers that have other states as numbers in the file;
/// `None` if there are too many combinations to tell.
pub(super) type SplitDraws = Option<BTreeSet<usize>>;

impl Judging<'_> {
    /// Lists such draws for a claim whose verdict rests on all states that count: one that is not refuted, that says that
    /// something does not vanish, or that asks whether a map is one-to-one.
    pub(super) fn split_draws_of(
        &self,
        item: &RecordedClaim<'_>,
        status: &ClaimState,
    ) -> Result<SplitDraws, JudgeError> {
        let asks_images = |own: &Condition| matches!(own.need, Need::OneToOne { .. });
        let is_about_all = status.settled != Some(Verdict::Refuted)
            || item.claim.kind.is_negated()
            || item.conditions.iter().any(asks_images);
        let mut split = BTreeSet::new();
        if !is_about_all {
            return Ok(Some(split));
        }
        let residual = [&item.residual[..], &item.context.quadrature_defects].concat();
        let whole = self.sampler_at(&item.claim.place)?;
        let pieces = self.pieces(&whole)?;
        let samplers: Vec<&Sampler> = match &pieces {
            Some(pieces) => pieces.iter().flatten().collect(),
            None => vec![&whole],
        };
        for sampler in samplers {
            match self.split_draws(sampler, &whole, (item, &residual))? {
                Some(more) => split.extend(more),
                None => return Ok(None),
            }
        }
        Ok(Some(split))
    }

    /// Whether the equations of motion have values at a drawn state for some listed exponents, each as a number in the
    /// file: x² has one for x < 0, and x^a, for any a near 2, none.
    pub(super) fn has_field_for_some_exponents(&self, sampler: &Sampler) -> Result<bool, Fault> {
        let is_listed = !sampler.is_numerical() && self.case.model.has_listed_exponents();
        let choices = is_listed.then(|| combinations(sampler.recipes())).flatten();
        for fixed in choices.into_iter().flatten() {
            let field = std::slice::from_ref(&self.common.field);
            let (graph, values) = sampler.compose(self.graph, field, &fixed)?;
            let tape = Tape::new(&graph, &values.concat());
            let mut evaluator = Evaluator::new(&tape, Ball::<TAPE_LANES>);
            let chosen = sampler.with(&fixed);
            evaluator.run(&chosen.drawn(&Ball::<TAPE_LANES>, TAPE_LANES, 0));
            let found: Vec<&Balls<TAPE_LANES>> = evaluator.outputs().collect();
            if (0..TAPE_LANES).any(|lane| found.iter().all(|own| own.is_defined(lane))) {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Lists the draws in exponents for which a claim may speak of fewer states than with numbers in the
    /// file: ln X belongs to what a claim requires for each power X^a with a parameter a, while the same
    /// whole number in the file takes any base.
    ///
    /// The sampler is that of the whole place, or of a part of it. `residual` is what vanishes if the claim holds.
    pub(super) fn split_draws(
        &self,
        sampler: &Sampler,
        whole: &Sampler,
        (item, residual): (&RecordedClaim<'_>, &[Expr]),
    ) -> Result<SplitDraws, Fault> {
        let mut split = BTreeSet::new();
        if !whole.recipes().iter().any(|own| matches!(own, Draw::OneOf(_))) {
            return Ok(Some(split));
        }
        let common = self.common.required_at(sampler.kept());
        let all = [&item.requirement[..], &common, residual, &self.common.field].concat();
        let own = powers(self.graph, all);
        let made = powers(sampler.graph(), sampler.made().to_vec());
        if own.is_empty() && made.is_empty() {
            return Ok(Some(split));
        }
        let Some(choices) = combinations(sampler.recipes()) else { return Ok(None) };
        let extents = sampler.extents();
        let is_listed = |draw: &usize| matches!(whole.recipes()[*draw], Draw::OneOf(_));
        for fixed in choices {
            let (graph, drawn) = sampler.compose(self.graph, &own, &fixed)?;
            for index in lost_bases(&graph, &drawn, &extents) {
                let inputs = self.graph.inputs_of(own[index][1]).into_iter();
                // On a part of a level listed values are numbers already.
                let values = inputs.filter_map(|input| whole.made().get(input));
                split.extend(values.flat_map(|value| whole.graph().inputs_of(*value)));
            }
            let (graph, values) = with_listed(sampler.graph(), &made, &fixed)?;
            for index in lost_bases(&graph, &values, &extents) {
                split.extend(sampler.graph().inputs_of(made[index][1]));
            }
        }
        split.retain(is_listed);
        Ok(Some(split))
    }
}

/// Lists base and exponent of each power in some values whose exponent is no number.
fn powers(graph: &Graph, values: Vec<Expr>) -> Vec<Vec<Expr>> {
    let reached = graph.reached(values);
    let power = |(place, step): (usize, Step<'_>)| match step {
        Step::Binary(BinaryOperation::Pow, a, b) if reached[place] => {
            Some(vec![graph.at(a), graph.at(b)])
        }
        _ => None,
    };
    graph.steps().enumerate().take(reached.len()).filter_map(power).collect()
}

/// Records values over draws once more, with listed values.
fn with_listed(
    graph: &Graph,
    groups: &[Vec<Expr>],
    fixed: &[Option<Rational>],
) -> Result<(Graph, Vec<Vec<Expr>>), Fault> {
    let (made, values) = record(fixed.len(), |draws| {
        let pairs = draws.iter().zip(fixed);
        let draws: Vec<Expr> =
            pairs.map(|(draw, own)| own.as_ref().map_or(*draw, Expr::rational)).collect();
        let reached = graph.reached(groups.iter().flatten().copied());
        let values = graph.repeated(&reached, &draws);
        let group = |group: &Vec<Expr>| {
            group.iter().map(|value| values[graph.place(*value)]).collect::<Option<Vec<Expr>>>()
        };
        groups.iter().map(group).collect::<Option<Vec<Vec<Expr>>>>()
    })?;
    values.map(|values| (made, values)).ok_or(Fault::ForeignValue)
}

/// Lists the powers with a whole exponent and a base that is not known to be positive.
fn lost_bases(graph: &Graph, powers: &[Vec<Expr>], extents: &[Extent]) -> Vec<usize> {
    let is_lost = |power: &Vec<Expr>| {
        let [base, exponent] = power[..] else { return false };
        let is_whole =
            graph.constant_value(exponent).is_some_and(|value| value.to_integer().is_some());
        let known = || sign(graph, extents, &[base], &[], base);
        is_whole && !known().is_some_and(|known| known.is_positive && !known.may_vanish)
    };
    (0..powers.len()).filter(|index| is_lost(&powers[*index])).collect()
}
