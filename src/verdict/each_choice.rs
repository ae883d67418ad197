//! Claims that something does *not* vanish: one choice of listed values for which it vanishes refutes such a claim.

use super::claim_state::{ClaimState, undecide};
use super::evidence::Verdict;
use super::field::TOO_MANY_COMBINATIONS;
use super::judge::JudgeError;
use super::judging::Judging;
use super::ladder::Open;
use super::recorded::RecordedClaim;
use super::sampler::Sampler;
use crate::claim::LevelSubset;
use crate::mechanics::{Draw, combinations};

/// Reason of a claim without a value for any choice.
const NO_CHOICE: &str =
    "there is no choice of the listed values for which all formulas of the claim have a value";

impl Judging<'_> {
    /// Decides such claims separately for each choice of the listed values that they depend on.
    pub(super) fn climb_each(
        &self,
        place: &LevelSubset,
        sampler: &Sampler,
        missed: Option<&str>,
        open: Open<'_, '_>,
    ) -> Result<(), JudgeError> {
        for (item, status) in open {
            let used = self.draws_used(item, sampler);
            let only = |(draw, is_used): (&Draw, &bool)| match draw {
                Draw::OneOf(values) if !is_used => values.first().cloned(),
                _ => None,
            };
            let others: Vec<_> = sampler.recipes().iter().zip(&used).map(only).collect();
            let sampler = sampler.with(&others);
            let Some(choices) = combinations(sampler.recipes()) else {
                undecide(status, TOO_MANY_COMBINATIONS.to_string());
                continue;
            };
            let (mut still, mut void) = (Vec::new(), Vec::new());
            for fixed in &choices {
                if !sampler.is_numerical() && sampler.has_lists() {
                    let (is_void, has_motion) = self.are_void(&sampler, &[item], fixed)?;
                    if !has_motion || is_void.contains(&true) {
                        let kept = if has_motion { &mut void } else { &mut still };
                        kept.push(fixed.clone());
                        continue;
                    }
                }
                let mut one = ClaimState::default();
                let chosen = sampler.with(fixed);
                self.decide(place, &chosen, missed, &mut vec![(item, &mut one)])?;
                self.settle_parts(&chosen, &mut vec![(item, &mut one)])?;
                one.is_on_a_part |= status.is_on_a_part;
                let refuted = one.settled == Some(Verdict::Refuted);
                if !refuted || status.settled.is_none() {
                    *status = one;
                } else {
                    status.is_on_a_part = one.is_on_a_part;
                }
                if !refuted {
                    let listed = chosen.listed(self.case, |draw| used[draw]);
                    if !listed.is_empty() {
                        let reason = status.evidence.reason.get_or_insert_default();
                        let separator = if reason.is_empty() { "" } else { ": " };
                        *reason = format!("for {listed}{separator}{reason}");
                    }
                    break;
                }
            }
            if still.len() + void.len() < choices.len() {
                self.remark_choices(&sampler, (&still, &void), status);
            } else {
                undecide(status, NO_CHOICE.to_string());
            }
        }
        Ok(())
    }

    /// Whether a claim, or which states there are, depends on each draw.
    fn draws_used(&self, item: &RecordedClaim<'_>, sampler: &Sampler) -> Vec<bool> {
        let mut values = self.common.required_at(sampler.kept());
        values.extend(item.residual.iter().chain(&item.requirement).chain(&item.presence));
        let level = self.common.level.iter().zip(sampler.kept());
        values.extend(level.filter(|(_, kept)| **kept).map(|(value, _)| value));
        let parameters = self.case.model.free_components();
        let of_values = values.into_iter().flat_map(|value| self.graph.inputs_of(value));
        let inputs = of_values.chain(parameters..sampler.made().len());
        let made = inputs.filter_map(|input| sampler.made().get(input));
        let mut used = vec![false; sampler.recipes().len()];
        for draw in made.flat_map(|value| sampler.graph().inputs_of(*value)) {
            used[draw] = true;
        }
        used
    }
}
