//! Extends the domain on which a proved or confirmed claim holds.
//!
//! A claim that was only confirmed at its own place, such as a level that cannot be solved, is proved
//! if the same residual is zero in all of space, and no roots limit where it has a value; and so is one that is
//! undecided there, if all that counts has a value at every state.
//!
//! For a proved claim, only places where the residual is a constant 0, or zero in prime fields, are
//! added. Enclosures add places for confirmed claims, and never contradict that a claim holds in
//! one place only.

use std::ops::Range;

use super::cell_rank::{CellRank, RankQuestion};
use super::claim_state::{BlockResult, ClaimState};
use super::conjugates::is_one_function;
use super::evidence::{Method, Proof, Verdict};
use super::field::{Answer, PrimeFieldStates, Query};
use super::judge::{JudgeError, Trust};
use super::judging::Judging;
use super::preimages::SecondState;
use super::recorded::{RecordedClaim, Wider};
use super::run::{Doubles, Values};
use super::sampler::{Sampler, TAPE_LANES};
use crate::claim::{Condition, LevelSubset, Need, PlaceName};
use crate::graph::{Expr, Fault};
use crate::number::ball::Ball;

/// A claim that holds at its own place, with the positions of its outputs for a wider one.
struct Candidate<'f, 'r> {
    item: &'f RecordedClaim<'r>,
    status: &'f mut ClaimState,
    residual: Range<usize>,
    scale: Range<usize>,
    defects: Range<usize>,
    requirement: Range<usize>,
    /// Whether a proof at the wider place is one at its own.
    implies_own: bool,
}

/// A candidate that enclosures do not exclude.
struct Asked<'f, 'r> {
    item: &'f RecordedClaim<'r>,
    status: &'f mut ClaimState,
    query: Query,
    /// Whether 0 lies in the enclosures at all states.
    is_zero: bool,
    implies_own: bool,
}

impl Judging<'_> {
    /// Finds the wider places in which claims hold as well.
    pub fn extend_domain(
        &self,
        recorded: &[RecordedClaim<'_>],
        statuses: &mut [ClaimState],
    ) -> Result<(), JudgeError> {
        let mut places: Vec<&LevelSubset> = Vec::new();
        for place in recorded.iter().flat_map(|item| item.wider.iter().map(|wider| &wider.place)) {
            if !places.contains(&place) {
                places.push(place);
            }
        }
        for place in places {
            self.extend_to(place, recorded, statuses)?;
        }
        for (item, status) in recorded.iter().zip(statuses) {
            if status.holds() && status.evidence.holds.is_empty() {
                status.evidence.holds.push(item.claim.place.name(&self.case.model));
            }
        }
        Ok(())
    }

    /// Finds the claims that hold at a wider place.
    fn extend_to(
        &self,
        place: &LevelSubset,
        recorded: &[RecordedClaim<'_>],
        statuses: &mut [ClaimState],
    ) -> Result<(), JudgeError> {
        let mut outputs = self.rates_at(place);
        let rates = 0..outputs.len();
        let mut extend = |some: &[Expr]| {
            let start = outputs.len();
            outputs.extend_from_slice(some);
            start..outputs.len()
        };
        let common = extend(&self.common.required_at(&place.kept));
        let mut candidates = Vec::new();
        for (item, status) in recorded.iter().zip(statuses.iter_mut()) {
            let wider = item.wider.iter().find(|wider| wider.place == *place);
            let covered = status.evidence.holds.contains(&PlaceName::Everywhere);
            let is_asked = |wider: &Wider| {
                status.holds()
                    || (status.settled == Some(Verdict::Undecided) && self.is_total(item, wider))
            };
            if let (Some(wider), false) = (wider.filter(|wider| is_asked(wider)), covered) {
                candidates.push(Candidate {
                    item,
                    status,
                    residual: extend(&wider.residual),
                    scale: extend(item.context.scale.as_slice()),
                    defects: extend(&wider.defects),
                    requirement: extend(&item.requirement),
                    implies_own: self.is_continued(place, item, wider),
                });
            }
        }
        if candidates.is_empty() {
            return Ok(());
        }
        let sampler = self.sampler_at(place)?;
        if self.missed_part(&sampler)?.is_some() || !self.flat_equations(&sampler)?.is_empty() {
            return Ok(());
        }
        let is_kept = self.options.trust == Trust::Float || self.is_kept(place, &sampler)?;
        if !is_kept {
            // Where states are found numerically nothing is proved of what is confirmed.
            let is_open = |own: &Candidate<'_, '_>| own.status.settled == Some(Verdict::Confirmed);
            candidates.retain(|own| sampler.is_numerical() && is_open(own));
        }
        // A map may be one-to-one on a level alone.
        let asks = |own: &Candidate<'_, '_>| {
            own.item
                .conditions
                .iter()
                .any(|condition| matches!(condition.need, Need::OneToOne { .. }))
        };
        if candidates.iter().any(asks) && !self.is_one_to_one(&sampler, SecondState::InRanges)? {
            candidates.retain(|own| !asks(own));
        }
        let mut kept = Vec::new();
        for own in candidates {
            if self.meets_conditions(&sampler, &own)? {
                kept.push(own);
            }
        }
        let candidates = kept;
        let values = self.run(&outputs).at(&Ball::<TAPE_LANES>, &sampler.balls(0));
        let all = values.existing(std::slice::from_ref(&common));
        if BlockResult::at::<Doubles>(&values.range(rates), None, &all).excludes_zero() {
            return Ok(());
        }
        let asked: Vec<Asked<'_, '_>> = candidates
            .into_iter()
            .filter_map(|candidate| candidate.weighed(&outputs, &values, &common))
            .collect();
        let queries: Vec<Query> = asked.iter().map(|asked| asked.query.clone()).collect();
        let answers = match self.options.trust {
            Trust::Float => vec![None; queries.len()],
            _ => {
                let found = PrimeFieldStates::new(self, &sampler).test(&queries)?;
                found.into_iter().map(Some).collect()
            }
        };
        for (asked, answer) in asked.into_iter().zip(answers) {
            // A whole exponent from a list counts for negative bases, too, if it is a number in the file.
            if matches!(answer, Some(Answer::Zero(_))) {
                let split =
                    self.split_draws(&sampler, &sampler, (asked.item, &asked.query.outputs))?;
                if split.is_none_or(|draws| !draws.is_empty()) {
                    continue;
                }
            }
            self.conclude_at(place, asked, answer);
        }
        Ok(())
    }

    /// Whether what a claim presupposes is known at a wider place as far as at its own: z − 2 + |z − 2| is not 0
    /// on z = 3, and is for z < 2.
    fn meets_conditions(&self, sampler: &Sampler, own: &Candidate<'_, '_>) -> Result<bool, Fault> {
        // What is not 0 at states of the level is 0 on no open set if it is one analytic function.
        let is_asked = |condition: &&Condition| match &condition.need {
            Need::NotZero { .. } | Need::Zeros { .. } => true,
            Need::Continuous { .. } => true,
            need @ (Need::Rank { .. } | Need::Nonzero { .. }) => {
                !is_one_function(self.graph, &need.values(), &[])
            }
            _ => false,
        };
        for condition in own.item.conditions.iter().filter(is_asked) {
            // A rank without which a claim says less is asked no further than for a cell on which it drops.
            if let (Need::Rank { rows, rank, .. }, false) =
                (&condition.need, condition.is_essential)
            {
                let remark = own.status.evidence.remark.as_deref();
                let is_known = remark.is_some_and(|own| own.contains(&condition.otherwise));
                let question = (&rows[..], *rank);
                let asked = RankQuestion::Drops;
                if !is_known
                    && self.rank_on_cells(sampler, question, &own.item.requirement, asked)?
                        == CellRank::Drops
                {
                    return Ok(false);
                }
                continue;
            }
            if let Some(failure) = self.failure(sampler, own.item, condition)? {
                let remark = own.status.evidence.remark.as_deref();
                if condition.is_essential || !remark.is_some_and(|own| own.contains(&failure.words))
                {
                    return Ok(false);
                }
            }
        }
        Ok(true)
    }

    /// Adds a wider place to those where a claim holds, if it does.
    fn conclude_at(&self, place: &LevelSubset, asked: Asked<'_, '_>, answer: Option<Answer>) {
        let Asked { item, status, query, is_zero, implies_own } = asked;
        let name = place.name(&self.case.model);
        let confirmed = status.settled == Some(Verdict::Confirmed);
        let is_open = status.settled == Some(Verdict::Undecided);
        let holds = match answer {
            Some(Answer::Zero(certificate)) => {
                if implies_own && (confirmed || is_open) {
                    prove(status, Proof::from(certificate), &name);
                }
                implies_own || !is_open
            }
            _ if is_open => false,
            Some(Answer::NonZero(_) | Answer::Partial) => false,
            Some(Answer::Silent(_) | Answer::Void) | None => {
                let is_folded = |expr: &Expr| {
                    self.graph.constant_value(*expr).is_some_and(|value| value.is_zero())
                };
                let folded = query.outputs.iter().all(is_folded);
                let only_there = item.claim.only_there;
                if is_zero && only_there && !folded {
                    let reason = format!("it is not known whether it also holds {name}");
                    status.evidence.reason = Some(reason);
                }
                folded || (is_zero && confirmed && !only_there)
            }
        };
        if holds {
            status.evidence.holds.push(name);
        }
    }

    /// Whether all that counts has a value at every state, for parameters for which it has one at any, and
    /// nothing else is required.
    fn is_total(&self, item: &RecordedClaim<'_>, wider: &Wider) -> bool {
        let required = self.common.required_at(&item.claim.place.kept);
        let lists = [&wider.residual, &wider.defects, &item.requirement, &item.presence, &required];
        let reached = self.graph.reached(lists.into_iter().flatten().copied());
        let parameters = self.case.model.free_components();
        let is_of_parameters = |place: usize| {
            let inputs = self.graph.inputs_of(self.graph.at(place));
            inputs.into_iter().all(|input| input < parameters)
        };
        self.graph.needs(&reached).all(|(place, _)| is_of_parameters(place))
            && !item.conditions.iter().any(|condition| condition.is_essential)
    }

    /// Whether a residual that is zero in the wider place is zero at the claim's own place, too.
    ///
    /// So it is if the wider place is all of space, the residual is the same, and all that counts
    /// has a value on an open set, where it is continuous. √(z x²) has one for z < 0 on the slice
    /// x = 0 alone, which no state of space comes near. What the residual needs elsewhere, as ε/(ε + x²) at ε = 0,
    /// may have a value at almost every state of space, and at none of a part of the level, unless the states that
    /// count need it, too: a reversor of mechanics divides by the same masses.
    fn is_continued(&self, place: &LevelSubset, item: &RecordedClaim<'_>, wider: &Wider) -> bool {
        let is_space = place.kept.iter().all(|kept| !kept);
        let required = self.common.required_at(&item.claim.place.kept);
        let values = [&wider.residual[..], &wider.defects, &item.requirement, &required].concat();
        let reached = self.graph.reached(values);
        is_space
            && wider.residual == item.residual
            && !item.claim.kind.is_negated()
            && (self.graph.left_out(&required, &item.presence).is_empty()
                || self.is_total(item, wider))
            && !self.graph.steps_at(&reached).any(|(_, step)| step.is_root())
    }
}

impl<'f, 'r> Candidate<'f, 'r> {
    /// The question for the fields; `None` if enclosures exclude that the claim holds.
    fn weighed(
        self,
        outputs: &[Expr],
        values: &Values<Doubles>,
        common: &Range<usize>,
    ) -> Option<Asked<'f, 'r>> {
        let scale = values.range(self.scale).first().copied();
        let existing = values.existing(&[common.clone(), self.requirement.clone()]);
        let result = |range: &Range<usize>, scale| {
            BlockResult::at::<Doubles>(&values.range(range.clone()), scale, &existing)
        };
        let is_sound = self.defects.is_empty() || result(&self.defects, None).is_zero();
        let found = result(&self.residual, scale);
        // Where nothing has a value nothing holds.
        let is_open = is_sound && found.has_value() && !found.excludes_zero();
        is_open.then(|| Asked {
            item: self.item,
            status: self.status,
            query: Query {
                outputs: [&outputs[self.residual], &outputs[self.defects]].concat(),
                requirement: outputs[self.requirement].to_vec(),
                presence: self.item.presence.clone(),
            },
            is_zero: found.is_zero(),
            implies_own: self.implies_own,
        })
    }
}

/// Settles a confirmed claim as proved, by a proof at a place that contains its own.
fn prove(status: &mut ClaimState, proof: Proof, place: &PlaceName) {
    status.rung(Method::PrimeField, format!("{place}: {proof}"));
    status.evidence.method = Method::PrimeField;
    status.evidence.proof = Some(proof);
    (status.evidence.silence, status.evidence.reason) = (None, None);
    status.settled = Some(Verdict::Proved);
}
