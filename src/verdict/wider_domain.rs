//! Extends the domain on which a proved or confirmed claim holds.
//!
//! A claim that was only confirmed at its own place, such as a level that cannot be solved, is proved
//! if the same residual is zero in all of space, and no roots limit where it has a value.
//!
//! For a proved claim, only places where the residual is a constant 0, or zero in prime fields, are
//! added. Enclosures add places for confirmed claims, and never contradict that a claim holds in
//! one place only.

use std::ops::Range;

use super::claim_state::{BlockResult, ClaimState};
use super::evidence::{Method, Proof, Verdict};
use super::field::{Answer, PrimeFieldStates, Query};
use super::judge::{JudgeError, Trust};
use super::judging::Judging;
use super::recorded::{RecordedClaim, Wider};
use super::run::Doubles;
use super::sampler::{Sampler, TAPE_LANES};
use crate::claim::LevelSubset;
use crate::graph::{Expr, Step};
use crate::number::UnaryFunction;
use crate::number::ball::Ball;

impl Judging<'_> {
    /// Finds the wider places in which claims hold as well.
    pub fn extend_domain(
        &self,
        recorded: &[RecordedClaim<'_>],
        statuses: &mut [ClaimState],
    ) -> Result<(), JudgeError> {
        let model = &self.case.model;
        let mut places: Vec<&LevelSubset> = Vec::new();
        for place in recorded.iter().flat_map(|item| item.wider.iter().map(|wider| &wider.place)) {
            if !places.contains(&place) {
                places.push(place);
            }
        }
        for place in places {
            let mut outputs = self.rates_at(place);
            let rates = 0..outputs.len();
            let mut extend = |some: &[Expr]| {
                let start = outputs.len();
                outputs.extend_from_slice(some);
                start..outputs.len()
            };
            let mut asked = Vec::new();
            let common = extend(&self.common.required_at(&place.kept));
            for (item, status) in recorded.iter().zip(statuses.iter_mut()) {
                let wider = item.wider.iter().find(|wider| wider.place == *place);
                let covered = status.evidence.holds.iter().any(|name| name == "everywhere");
                if let (Some(wider), true, false) = (wider, status.holds(), covered) {
                    let residual = extend(&wider.residual);
                    let scale = extend(item.context.scale.as_slice());
                    let (defects, own) = (extend(&wider.defects), extend(&item.requirement));
                    let implies_own = self.is_continued(place, item, wider);
                    asked.push((item.claim, status, residual, scale, defects, own, implies_own));
                }
            }
            if asked.is_empty() {
                continue;
            }
            let sampler = Sampler::new(self.case, place, self.options.seed)?;
            if self.missed_part(&sampler)?.is_some() {
                continue;
            }
            let values = self.run(&outputs).at(&Ball::<TAPE_LANES>, &sampler.balls(0));
            let all = values.existing(std::slice::from_ref(&common));
            if BlockResult::at::<Doubles>(&values.range(rates), None, &all).excludes_zero() {
                continue;
            }
            let mut open = Vec::new();
            for (claim, status, residual, scale, defects, own, implies_own) in asked {
                let scale = values.range(scale).first().copied();
                let existing = values.existing(&[common.clone(), own.clone()]);
                let result = |range: Range<usize>, scale| {
                    BlockResult::at::<Doubles>(&values.range(range), scale, &existing)
                };
                let sound = defects.is_empty() || result(defects.clone(), None).is_zero();
                let result = result(residual.clone(), scale);
                // Where nothing has a value nothing holds.
                if sound && result.has_value() && !result.excludes_zero() {
                    let group = [&outputs[residual], &outputs[defects]].concat();
                    let query = Query {
                        outputs: group,
                        requirement: outputs[own].to_vec(),
                        ..Query::default()
                    };
                    open.push((claim, status, query, result.is_zero(), implies_own));
                }
            }
            let queries: Vec<Query> = open.iter().map(|(_, _, query, ..)| query.clone()).collect();
            let answers = match self.options.trust {
                Trust::Float => vec![None; queries.len()],
                _ => PrimeFieldStates::new(self, &sampler)
                    .test(&queries)?
                    .into_iter()
                    .map(Some)
                    .collect(),
            };
            for ((claim, status, query, is_zero, implies_own), answer) in
                open.into_iter().zip(answers)
            {
                let holds = match answer {
                    Some(Answer::Zero(certificate)) => {
                        if implies_own && status.settled == Some(Verdict::Confirmed) {
                            prove(status, Proof::from(certificate), place.name(model));
                        }
                        true
                    }
                    Some(Answer::NonZero(_) | Answer::Partial) => false,
                    Some(Answer::Silent(_) | Answer::Void) | None => {
                        let constant = |expr: &Expr| self.graph.constant_value(*expr);
                        let folded =
                            query.outputs.iter().all(|x| constant(x).is_some_and(|x| x.is_zero()));
                        let confirmed = status.settled == Some(Verdict::Confirmed);
                        if is_zero && claim.only_there && !folded {
                            let place = place.name(model);
                            let reason = format!("it is not known whether it also holds {place}");
                            status.evidence.reason = Some(reason);
                        }
                        folded || (is_zero && confirmed && !claim.only_there)
                    }
                };
                if holds {
                    status.evidence.holds.push(place.name(model));
                }
            }
        }
        for (item, status) in recorded.iter().zip(statuses) {
            if status.holds() && status.evidence.holds.is_empty() {
                status.evidence.holds.push(item.claim.place.name(model));
            }
        }
        Ok(())
    }

    /// Whether a residual that is zero in the wider place is zero at the claim's own place, too.
    ///
    /// So it is if the wider place is all of space, the residual is the same, and all that counts
    /// has a value on an open set, where it is continuous. √(z x²) has one for z < 0 on the slice
    /// x = 0 alone, which no state of space comes near.
    fn is_continued(&self, place: &LevelSubset, item: &RecordedClaim<'_>, wider: &Wider) -> bool {
        let is_space = place.kept.iter().all(|kept| !kept);
        let required = self.common.required_at(&item.claim.place.kept);
        let values = [&wider.residual[..], &wider.defects, &item.requirement, &required].concat();
        let reached = self.graph.reached(values);
        let is_root = |step: Step<'_>| match step {
            Step::Unary(UnaryFunction::Sqrt, _) => true,
            Step::Power(_, exponent) => exponent.to_integer().is_none(),
            _ => false,
        };
        is_space
            && wider.residual == item.residual
            && !item.claim.kind.is_negated()
            && !self.graph.steps().zip(reached).any(|(step, reached)| reached && is_root(step))
    }
}

/// Settles a confirmed claim as proved, by a proof at a place that contains its own.
fn prove(status: &mut ClaimState, proof: Proof, place: String) {
    status.rung(Method::PrimeField, format!("{place}: {proof}"));
    status.evidence.method = Method::PrimeField;
    status.evidence.proof = Some(proof);
    status.evidence.silence = None;
    status.settled = Some(Verdict::Proved);
}
