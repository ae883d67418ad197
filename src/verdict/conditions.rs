//! Conditions that claims presuppose.

use super::cell_rank::{CellRank, RankQuestion};
use super::claim_state::{ClaimState, are_zero, undecide};
use super::cofactors::Cofactor;
use super::conclude::OPEN_CONSTANT;
use super::evidence::{Independence, Verdict};
use super::field::{Answer, PrimeFieldStates, Query};
use super::judging::Judging;
use super::ladder::Open;
use super::preimages::SecondState;
use super::recorded::RecordedClaim;
use super::restriction::flaw;
use super::sampler::{Sampler, extent};
use crate::claim::{Assumption, Condition, Need};
use crate::graph::{Expr, Fault, Graph, record};
use crate::mechanics::calculus::DualPoint;
use crate::mechanics::{Phase, combinations};
use crate::proof::{Extent, GroupOutcome, Prover, is_nowhere_zero, reduced_value, sign};
use crate::scalar::Scalar;

/// A condition that is not met, or not known to be.
pub(super) struct Unmet {
    /// Message.
    pub words: String,
    /// Whether it is known to fail.
    pub is_known: bool,
}

impl Unmet {
    fn known(words: String) -> Self {
        Self { words, is_known: true }
    }

    fn open(words: String) -> Self {
        Self { words, is_known: false }
    }
}

/// Largest numbers of operations and of inputs of a value that is read as a quotient in lowest terms.
const MOST_REDUCED: [usize; 2] = [96, 8];

impl Judging<'_> {
    /// Leaves claims undecided if an essential condition is not known to hold, and adds remarks to
    /// others.
    pub(super) fn settle_conditions(
        &self,
        sampler: &Sampler,
        holding: &mut Open<'_, '_>,
    ) -> Result<(), Fault> {
        for (item, status) in holding.iter_mut() {
            for condition in &item.conditions {
                let is_open = |value: &Expr| self.has_open_constant(*value);
                if condition.is_essential && condition.need.values().iter().any(is_open) {
                    if !self.holds_of_all_values(item)? {
                        undecide(status, OPEN_CONSTANT.to_string());
                    }
                    continue;
                }
                let asks_one_to_one = matches!(condition.need, Need::OneToOne { .. });
                if asks_one_to_one && self.is_one_to_one(sampler, SecondState::InRanges)? {
                    continue;
                }
                let failure = match (&condition.need, sampler.is_numerical()) {
                    (Need::NotZero { .. } | Need::Positive { .. }, true) => {
                        Some(Unmet::open(condition.otherwise.clone()))
                    }
                    (_, true) if !condition.is_essential => None,
                    _ => self.failure(sampler, item, condition)?,
                };
                let Some(failure) = failure else {
                    if asks_one_to_one {
                        let remark = format!("{}, which is not proved", condition.otherwise);
                        status.evidence.add_remark(remark);
                        if let Some(own) = Assumption::that(&condition.need) {
                            status.evidence.assume(own);
                        }
                    }
                    continue;
                };
                if condition.is_essential {
                    if !self.holds_of_all_values(item)? {
                        undecide(status, failure.words);
                    }
                    continue;
                }
                status.evidence.add_remark(failure.words);
                // What jumps is no constant, and no function of the energy.
                let marks = [Independence::Constant, Independence::General].map(Some);
                if matches!(condition.need, Need::Continuous { .. })
                    && marks.contains(&status.evidence.independence)
                {
                    status.evidence.independence = None;
                }
                let (flaw, assumption) = match failure.is_known {
                    true => (flaw(&condition.need), None),
                    false => (None, Assumption::that(&condition.need)),
                };
                if let Some(own) = flaw {
                    status.evidence.add_flaw(own);
                }
                if let Some(own) = assumption {
                    status.evidence.assume(own);
                }
            }
        }
        Ok(())
    }

    /// Leaves claims undecided whose residual vanishes on states of which none is known, where an essential
    /// condition is not known to hold there. A part of the level without such states says nothing otherwise.
    pub(super) fn settle_conditions_unseen(
        &self,
        sampler: &Sampler,
        (item, status): (&RecordedClaim<'_>, &mut ClaimState),
    ) -> Result<(), Fault> {
        for condition in item.conditions.iter().filter(|condition| condition.is_essential) {
            if let Some(failure) = self.failure(sampler, item, condition)?
                && !self.holds_of_all_values(item)?
            {
                undecide(status, failure.words);
                status.is_unseen = false;
                break;
            }
        }
        Ok(())
    }

    /// Leaves densities of maps undecided that fail state by state, where two states have one image:
    /// the measure of a set is that of all states whose images lie in it, and 1 is a density for
    /// x − 1/x though |det DΦ| > 1 everywhere.
    pub(super) fn settle_images(
        &self,
        sampler: &Sampler,
        open: &mut Open<'_, '_>,
    ) -> Result<(), Fault> {
        let moved = |condition: &Condition| match condition.need {
            Need::OneToOne { moved } => Some(moved),
            _ => None,
        };
        for (item, status) in open.iter_mut() {
            let Some(moved) = item.conditions.iter().find_map(moved) else { continue };
            if status.settled != Some(Verdict::Refuted) {
                continue;
            }
            // The image of all states has the measure 0, and they have more.
            let query = Query {
                outputs: vec![moved],
                requirement: item.requirement.clone(),
                ..Query::default()
            };
            let is_null = |answers: &[Answer]| matches!(answers, [Answer::Zero(_)]);
            if !sampler.is_thin() && is_null(&PrimeFieldStates::new(self, sampler).test(&[query])?)
            {
                let remark = "the images of all states with ρ ≠ 0 have the measure 0";
                status.evidence.add_remark(remark.to_string());
                continue;
            }
            if self.is_one_to_one(sampler, SecondState::Anywhere)? {
                continue;
            }
            let both = self.second_preimage(sampler, item, SecondState::Anywhere)?;
            status.evidence.witness = None;
            let reason = match both {
                Some(both) => format!(
                    "Φ takes {both} to one state: |ρ(Φ(x)) det DΦ(x)| = |ρ(x)| fails, but the measure may \
                     still be invariant, as the measures of several preimages add up"
                ),
                None => "|ρ(Φ(x)) det DΦ(x)| = |ρ(x)| fails, which refutes the density if Φ takes no two \
                         states to one, inside or outside of the declared ranges; that is not proved"
                    .to_string(),
            };
            undecide(status, reason);
        }
        Ok(())
    }

    /// Returns what a condition lacks that fails, or is not known to hold although the claim may need it.
    pub(super) fn failure(
        &self,
        sampler: &Sampler,
        item: &RecordedClaim<'_>,
        condition: &Condition,
    ) -> Result<Option<Unmet>, Fault> {
        let otherwise = &condition.otherwise;
        match &condition.need {
            Need::Rank { rows, rank, fixed } => {
                // No field draws states that are found numerically.
                let ranks = match sampler.is_numerical() {
                    true => None,
                    false => PrimeFieldStates::new(self, sampler).ranks(rows, &[rows.len()])?,
                };
                let found = ranks.and_then(|ranks| ranks.first().copied());
                let known = match found {
                    Some(found) if found < *rank => {
                        let (found, all) =
                            (found.saturating_sub(*fixed), rank.saturating_sub(*fixed));
                        let reason = format!("{otherwise}: {found} of {all} dimensions are left");
                        return Ok(Some(Unmet::known(reason)));
                    }
                    Some(_) => {
                        let of = |question| {
                            self.rank_on_cells(sampler, (rows, *rank), &item.requirement, question)
                        };
                        match of(RankQuestion::Drops)? {
                            CellRank::Unknown => {
                                if condition.is_essential && self.holds_of_all_values(item)? {
                                    return Ok(None);
                                }
                                of(RankQuestion::Known)?
                            }
                            known => known,
                        }
                    }
                    None => CellRank::Unknown,
                };
                Ok(match known {
                    CellRank::Full => None,
                    CellRank::Drops => {
                        Some(Unmet::known(format!("on a part of the states {otherwise}")))
                    }
                    CellRank::Unknown if condition.is_essential => {
                        Some(Unmet::open(format!("it is not known whether {otherwise}")))
                    }
                    CellRank::Unknown => Some(Unmet::open(format!(
                        "it is not excluded that on a part of the states {otherwise}"
                    ))),
                })
            }
            Need::NotZero { value } => {
                let is_met =
                    self.holds_at_all_states(sampler, *value, &|graph, extents, value| {
                        is_nowhere_zero(graph, extents, &[], &[value])
                    })?;
                Ok((!is_met).then(|| Unmet::open(otherwise.clone())))
            }
            Need::Positive { value } => {
                let is_met =
                    self.holds_at_all_states(sampler, *value, &|graph, extents, value| {
                        let known = sign(graph, extents, &[], &[], value);
                        known.is_some_and(|known| known.is_positive)
                            && is_nowhere_zero(graph, extents, &[], &[value])
                    })?;
                Ok((!is_met).then(|| Unmet::open(otherwise.clone())))
            }
            Need::Nonzero { values } => {
                let is_vacuous = self.are_zero_everywhere(sampler, values)?;
                Ok(is_vacuous.then(|| Unmet::known(otherwise.clone())))
            }
            Need::Zeros { function } => {
                let Some(filling) = self.filling(sampler)? else { return Ok(None) };
                let has_none =
                    self.holds_at_all_states(&filling.sampler, *function, &|graph, _, value| {
                        is_nowhere_zero(graph, &filling.extents, &[], &[value])
                    })?;
                Ok(has_none.then(|| Unmet::known(otherwise.clone())))
            }
            Need::OneToOne { .. } => {
                let both = self.second_preimage(sampler, item, SecondState::InRanges)?;
                Ok(both
                    .map(|both| Unmet::known(format!("Φ takes {both} to one state: {otherwise}"))))
            }
            Need::Continuous { values } => {
                let place = self.jump(sampler, values)?;
                Ok(place.map(|place| Unmet::known(format!("near {place} {otherwise}"))))
            }
            Need::Finite { value, field } => {
                let place = self.pole(sampler, *value, field)?;
                Ok(place.map(|place| Unmet::known(format!("near {place} {otherwise}"))))
            }
            Need::ValueOnZeros { function, components, factor, inverse } => {
                let cofactor = Cofactor { factor: *factor, inverse: *inverse };
                let zeros = (*function, &components[..]);
                let is_met = self.has_value_on_zeros(sampler, item, zeros, &cofactor)?;
                Ok((!is_met).then(|| Unmet::open(otherwise.clone())))
            }
        }
    }

    /// Whether a test of a value by enclosures holds at all states, for each choice of listed values.
    fn holds_at_all_states(
        &self,
        sampler: &Sampler,
        value: Expr,
        test: &dyn Fn(&Graph, &[Extent], Expr) -> bool,
    ) -> Result<bool, Fault> {
        let Some(combinations) = combinations(sampler.recipes()) else { return Ok(false) };
        let extents = sampler.extents();
        for fixed in combinations {
            let (graph, groups) = sampler.compose(self.graph, &[vec![value]], &fixed)?;
            // A quotient in lowest terms is the same value wherever the other exists.
            let holds = |value: Expr| {
                let size = [graph.operations(&[value]), graph.inputs_of(value).len()];
                let is_small = size.iter().zip(MOST_REDUCED).all(|(own, most)| *own <= most);
                let reduced = || is_small.then(|| reduced_value(&graph, value)).flatten();
                test(&graph, &extents, value)
                    || reduced().is_some_and(|(graph, value)| test(&graph, &extents, value))
            };
            if !groups.concat().into_iter().all(holds) {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Whether values are known to be 0 at all states.
    fn are_zero_everywhere(&self, sampler: &Sampler, values: &[Expr]) -> Result<bool, Fault> {
        if are_zero(self.graph, values) {
            return Ok(true);
        }
        if values
            .iter()
            .any(|value| self.graph.constant_value(*value).is_some_and(|v| !v.is_zero()))
        {
            return Ok(false);
        }
        let answers = PrimeFieldStates::new(self, sampler).test(&[Query::of(values.to_vec())])?;
        Ok(matches!(answers.first(), Some(Answer::Zero(_))))
    }

    /// Whether a claim about new variables is proved for all their values, related or not.
    fn holds_of_all_values(&self, item: &RecordedClaim<'_>) -> Result<bool, Fault> {
        let model = &self.case.model;
        let Some(variables) = model.variables.as_deref() else { return Ok(false) };
        let draws = model.parameter_draws();
        let Some(combinations) = combinations(&draws) else { return Ok(false) };
        let extents: Vec<Extent> = draws.iter().map(extent).collect();
        let prover = Prover { sources: &[], extents: &extents, seed: self.options.seed };
        for fixed in combinations {
            let inputs = draws.len() + variables.model.dimension();
            let (graph, residual) = record(inputs, |inputs| {
                let mut inputs = inputs.to_vec();
                for (input, value) in inputs.iter_mut().zip(&fixed) {
                    if let Some(value) = value {
                        *input = Expr::rational(value);
                    }
                }
                let (parameters, values) = model.make_parameters(&inputs);
                let there = Phase::with_parameters_of(&variables.model, model, &parameters, values);
                item.claim.kind.residual_of_values(variables, &DualPoint::new(there))
            })?;
            let Some(group) = residual else { return Ok(false) };
            if !prover.prove(&graph, &[group])?.iter().all(GroupOutcome::is_zero) {
                return Ok(false);
            }
        }
        Ok(true)
    }
}
