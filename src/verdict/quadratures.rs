//! Antiderivatives of the equations of motion and of the new variables: whether each integrand is a function of its
//! variable alone.

use super::claim_state::{BlockResult, ClaimState, are_zero, undecide};
use super::field::{Answer, PrimeFieldStates, Query};
use super::judge::JudgeError;
use super::judging::Judging;
use super::recorded::RecordedClaim;
use super::run::Doubles;
use super::sampler::TAPE_LANES;
use crate::claim::{LevelSubset, OfMotions};
use crate::number::ball::Ball;

impl Judging<'_> {
    /// Checks that each ∫ of the equations of motion and of the new variables is a function of its variable in all of
    /// phase space, where derivatives are taken; returns a warning where that is unknown.
    pub(super) fn check_quadratures(&self) -> Result<Option<String>, JudgeError> {
        let quadratures = self.common.quadratures.iter();
        let open: Vec<_> = quadratures.filter(|(_, all)| !are_zero(self.graph, all)).collect();
        if open.is_empty() {
            return Ok(None);
        }
        let everywhere = LevelSubset::everywhere(&self.case.model);
        let sampler = self.sampler_at(&everywhere)?;
        let queries: Vec<Query> =
            open.iter().map(|(_, defects)| Query::of(defects.clone())).collect();
        let answers = PrimeFieldStates::new(self, &sampler).test(&queries)?;
        let mut warning = None;
        for ((text, defects), answer) in open.into_iter().zip(answers) {
            let values = self.run(defects).at(&Ball::<TAPE_LANES>, &sampler.balls(0));
            let all = [true; TAPE_LANES];
            let seen = BlockResult::at::<Doubles>(&values.range(0..defects.len()), None, &all);
            if matches!(answer, Answer::Zero(_)) {
                continue;
            }
            if answer.is_nonzero() || seen.excludes_zero() {
                return Err(JudgeError::Quadrature(text.clone()));
            }
            // Nothing is known of a part of the states that may be empty.
            warning = Some(format!(
                "it is not proved that each integrand in `{text}` is a function of its variable alone, so that \
                 nothing is proved of the motion"
            ));
        }
        *self.open_quadrature.borrow_mut() = warning.clone();
        Ok(warning)
    }

    /// Leaves proofs undecided that rest on an integrand of which it is not proved that it is a function of its
    /// variable alone.
    pub(super) fn leave_open_quadratures(
        &self,
        recorded: &[RecordedClaim<'_>],
        statuses: &mut [ClaimState],
    ) {
        let open = self.open_quadrature.borrow();
        let Some(reason) = open.as_ref() else { return };
        let model = &self.case.model;
        for (item, status) in recorded.iter().zip(statuses) {
            let kind = &item.claim.kind;
            let names_rates = || kind.formulas().into_iter().any(|own| model.has_quantities(own));
            let rests_on_motion = kind.of_motions() != OfMotions::Nothing || names_rates();
            let values = [&item.residual[..], &item.requirement].concat();
            let has_constant = values.into_iter().any(|value| self.has_open_constant(value));
            if status.settled.is_some() && (rests_on_motion || has_constant) {
                (status.evidence.proof, status.evidence.witness) = (None, None);
                status.evidence.holds.clear();
                undecide(status, reason.clone());
            }
        }
    }
}
