//! Slopes of the level equations at the states: where they depend on each other, rates that are 0 do not
//! keep the motion on the level.

use super::field::{Answer, PrimeFieldStates, Query};
use super::judge::JudgeError;
use super::judging::Judging;
use super::ladder::{LADDER_BITS, PRECISE_STATES};
use super::sampler::{Sampler, TAPE_LANES};
use crate::graph::Expr;
use crate::mechanics::combinations;
use crate::number::ball::Ball;
use crate::number::mixed::{Mixed, Number};

impl Judging<'_> {
    /// Checks that the slope of each equation of the user, without what it has in common with those before
    /// it, is not 0 on an open set of states, for any listed values.
    ///
    /// # Errors
    ///
    /// One is, or it is not known at any state: as for (x − 1)² = 0, whose rate 2(x − 1)x' is 0 at x = 1
    /// whatever x' is.
    pub(super) fn check_slopes(&self, sampler: &Sampler) -> Result<(), JudgeError> {
        if self.common.dependence.is_empty() {
            return Ok(());
        }
        let choices = combinations(sampler.recipes());
        for fixed in choices.unwrap_or_else(|| vec![vec![None; sampler.recipes().len()]]) {
            self.check_slopes_at(&sampler.with(&fixed))?;
        }
        Ok(())
    }

    fn check_slopes_at(&self, sampler: &Sampler) -> Result<(), JudgeError> {
        let (width, states) = (self.case.model.dimension(), sampler.balls(0));
        let left = self.run(&self.common.dependence.concat()).at(&Ball::<TAPE_LANES>, &states);
        let kept = self.case.model.level.iter().zip(sampler.kept()).enumerate();
        for (index, (equation, _)) in kept.filter(|(_, (_, kept))| **kept) {
            let slope: &[Expr] = &self.common.dependence[index];
            let place = index * width..(index + 1) * width;
            let is_seen = left.existing(std::slice::from_ref(&place));
            let values = left.range(place);
            let is_free = |lane: usize| values.iter().any(|value| value.excludes_zero(lane));
            let seen = (0..TAPE_LANES).filter(|lane| is_seen[*lane]);
            let (free, bound): (Vec<usize>, Vec<usize>) = seen.partition(|lane| is_free(*lane));
            let is_unseen = free.is_empty() && bound.is_empty();
            if bound.is_empty() && !(is_unseen && self.has_exact_state(sampler)) {
                continue;
            }
            let query = Query::of(slope.to_vec());
            let is_lost = match PrimeFieldStates::new(self, sampler).test(&[query])?.first() {
                Some(Answer::Zero(_) | Answer::Partial) => true,
                Some(Answer::NonZero(_)) => false,
                // Where a root is 0 the values may not be known.
                Some(Answer::Silent(_) | Answer::Void) | None => free.is_empty() && !is_unseen,
            };
            if is_lost {
                return Err(JudgeError::Flat(equation.text.clone()));
            }
        }
        Ok(())
    }

    /// Whether some state exists in exact numbers: f64 does not know that √0 does.
    fn has_exact_state(&self, sampler: &Sampler) -> bool {
        let domain = Mixed::new(LADDER_BITS[0]);
        let is_known = |value: &Number| matches!(value, Number::Exact(_) | Number::Ball(_));
        !sampler.is_numerical()
            && (0..PRECISE_STATES)
                .any(|index| sampler.states(&domain, 1, index).iter().all(is_known))
    }
}
