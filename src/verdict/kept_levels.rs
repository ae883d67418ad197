//! Whether motions are proved to stay on a level: rule L9 of docs/soundness-levels.md.
//!
//! That the rates of its equations are 0 at the states drawn is no proof: a modulus may make them so at almost all.

use super::claim_state::{ClaimState, undecide};
use super::evidence::Verdict;
use super::existence::signed_extents;
use super::field::{Answer, PrimeFieldStates, Query, Where};
use super::judge::{JudgeError, Trust};
use super::judging::Judging;
use super::ladder::LADDER_BITS;
use super::recorded::RecordedClaim;
use super::sampler::Sampler;
use crate::claim::{LevelSubset, OfMotions, PlaceName};
use crate::graph::{Expr, Fault};
use crate::number::Enclosing;
use crate::number::mixed::{Mixed, Number};
use crate::number::rational::Rational;

const NOT_KEPT: &str = "it is not proved that the motion stays on the level";

impl Judging<'_> {
    /// Notes whether the motion is proved to stay on the equations of a place, on each part of its states.
    pub(super) fn note_kept(&self, place: &LevelSubset, is_proved: bool) {
        let mut known = self.kept.borrow_mut();
        let own = known.entry(place.kept.clone()).or_insert(true);
        *own &= is_proved;
    }

    /// Whether states of a place are proved to lie on its equations, and motions from them to stay there.
    pub(super) fn is_kept(&self, place: &LevelSubset, sampler: &Sampler) -> Result<bool, Fault> {
        if self.is_kept_everywhere(&place.kept) {
            return Ok(true);
        }
        if sampler.is_numerical() {
            return self.is_kept_by_combination(&place.kept);
        }
        let query = self.level_query(place, sampler)?;
        let answers = PrimeFieldStates::new(self, sampler).test(&[query])?;
        Ok(matches!(answers.first(), Some(Answer::Zero(_))))
    }

    /// Leaves proofs about motions on a level undecided, if it is not proved that they stay there; what holds in all
    /// of space needs no level.
    pub(super) fn leave_unkept_levels(
        &self,
        recorded: &[RecordedClaim<'_>],
        statuses: &mut [ClaimState],
    ) -> Result<(), JudgeError> {
        for (item, status) in recorded.iter().zip(statuses) {
            let kept = &item.claim.place.kept;
            let rests_on_level = status.settled == Some(Verdict::Proved)
                && !status.is_combination
                && kept.iter().any(|kept| *kept)
                && item.claim.kind.of_motions() != OfMotions::Nothing
                && !status.evidence.holds.contains(&PlaceName::Everywhere);
            if !rests_on_level || self.is_kept_everywhere(kept) {
                continue;
            }
            let known = self.kept.borrow().get(kept).copied();
            let is_kept = match known {
                Some(true) => true,
                None if self.options.trust == Trust::Float => false,
                _ => self.is_kept_by_combination(kept)?,
            };
            if !is_kept {
                status.evidence.proof = None;
                status.evidence.holds.clear();
                undecide(status, NOT_KEPT.to_string());
            }
        }
        Ok(())
    }

    /// Returns the error that names an equation that is violated, or that the motion leaves, on a part of the states
    /// of which one is found.
    pub(super) fn name_the_error_on_parts(
        &self,
        place: &LevelSubset,
        sampler: &Sampler,
    ) -> Result<(), JudgeError> {
        let kept: Vec<usize> = (0..place.kept.len()).filter(|index| place.kept[*index]).collect();
        let field = PrimeFieldStates::new(self, sampler);
        for (values, is_rate) in [(&self.common.level, false), (&self.common.level_rates, true)] {
            if is_rate && self.is_at_rest(sampler)? {
                break;
            }
            let queries: Vec<Query> =
                kept.iter().map(|index| Query::of(vec![values[*index]])).collect();
            for (index, answer) in kept.iter().zip(field.test(&queries)?) {
                let Answer::NonZero(found) = answer else { continue };
                let Some(size) = self.magnitude_on_parts(sampler, &found, values[*index]) else {
                    continue;
                };
                let equation = self.case.model.level[*index].text.clone();
                return Err(match is_rate {
                    true => JudgeError::NotInvariant { equation, rate: size },
                    false => self.off_level(equation, size),
                });
            }
        }
        Ok(())
    }

    /// Prints a value at a state of a part on which it is not identically zero.
    fn magnitude_on_parts(
        &self,
        sampler: &Sampler,
        found: &[Where],
        value: Expr,
    ) -> Option<String> {
        let required = self.common.required_at(sampler.kept());
        let run = self.run(&[&[value][..], &required].concat());
        let at = |chosen: &Sampler, numbers: &[Rational]| {
            LADDER_BITS.into_iter().find_map(|bits| {
                let domain = Mixed::new(bits);
                let state = chosen.made_from(&domain, numbers);
                let is_known = |value: &Number| matches!(value, Number::Exact(_) | Number::Ball(_));
                if !state.iter().all(is_known) {
                    return None;
                }
                let values = run.at(&domain, &state);
                if !values.existing(std::slice::from_ref(&(1..required.len() + 1)))[0] {
                    return None;
                }
                let own = values.output(0);
                let (mid, _) = Mixed::enclosure(own, 0).filter(|_| Mixed::excludes_zero(own, 0))?;
                Some(format!("{mid:.3e}"))
            })
        };
        for own in found {
            let chosen = sampler.with(&own.fixed);
            for part in own.parts.proper().into_iter().flatten() {
                for extents in signed_extents(&chosen, &part.signs) {
                    let Some(point) = part.point(&extents) else { continue };
                    let number = |(draw, x): (&crate::mechanics::Draw, &f64)| {
                        draw.only().or_else(|| Rational::from_f64(*x))
                    };
                    let numbers: Option<Vec<Rational>> =
                        chosen.recipes().iter().zip(&point).map(number).collect();
                    if let Some(size) = numbers.and_then(|numbers| at(&chosen, &numbers)) {
                        return Some(size);
                    }
                }
            }
        }
        None
    }
}
