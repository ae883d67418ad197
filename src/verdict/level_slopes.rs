//! Slopes of the level equations at the states: where they depend on each other, rates that are 0 do not
//! keep the motion on the level.

use super::claim_state::{ClaimState, undecide};
use super::evidence::Verdict;
use super::field::{Answer, PrimeFieldStates, Query};
use super::judging::Judging;
use super::ladder::{LADDER_BITS, PRECISE_STATES};
use super::recorded::RecordedClaim;
use super::sampler::{Sampler, TAPE_LANES};
use crate::graph::{Expr, Fault};
use crate::mechanics::combinations;
use crate::number::Enclosing;
use crate::number::ball::Ball;
use crate::number::mixed::{Mixed, Number};

/// Place of a claim that does not rest on the level.
const EVERYWHERE: &str = "everywhere";

impl Judging<'_> {
    /// Notes the equations of the user whose slope, without what it has in common with those before it, is 0
    /// on an open set of states, for some listed values, or not known at any: as for (x − 1)² = 0, whose rate
    /// 2(x − 1)x' is 0 at x = 1 whatever x' is.
    pub(super) fn check_slopes(&self, sampler: &Sampler) -> Result<(), Fault> {
        if self.common.dependence.is_empty() {
            return Ok(());
        }
        let choices = combinations(sampler.recipes());
        for fixed in choices.unwrap_or_else(|| vec![vec![None; sampler.recipes().len()]]) {
            self.check_slopes_at(&sampler.with(&fixed))?;
        }
        Ok(())
    }

    fn check_slopes_at(&self, sampler: &Sampler) -> Result<(), Fault> {
        let (width, states) = (self.case.model.dimension(), sampler.balls(0));
        let left = self.run(&self.common.dependence.concat()).at(&Ball::<TAPE_LANES>, &states);
        let exists = left.existing(&[]);
        for index in (0..sampler.kept().len()).filter(|index| sampler.kept()[*index]) {
            let values = left.range(index * width..(index + 1) * width);
            // A slope by a variable at rest may have no value, as that of √(y + |y|) for y < 0.
            let is_free = |lane: usize| {
                values.iter().any(|value| value.is_defined(lane) && value.excludes_zero(lane))
            };
            let seen = (0..TAPE_LANES).filter(|lane| exists[*lane]);
            let (free, bound): (Vec<usize>, Vec<usize>) = seen.partition(|lane| is_free(*lane));
            let is_unseen = free.is_empty() && bound.is_empty();
            if bound.is_empty() && !(is_unseen && self.has_exact_state(sampler)) {
                continue;
            }
            let is_lost = match free.is_empty() {
                true => !self.has_precise_slope(sampler, &self.common.dependence[index]),
                false => self.is_zero_slope(sampler, &self.common.dependence[index])?,
            };
            if is_lost {
                let mut flat = self.flat.borrow_mut();
                if !flat.contains(&index) {
                    flat.push(index);
                }
            }
        }
        Ok(())
    }

    /// Whether all components of a slope are known to be 0 wherever they have a value, for some part of the states
    /// that has some.
    fn is_zero_slope(&self, sampler: &Sampler, slope: &[Expr]) -> Result<bool, Fault> {
        let each: Vec<Query> = slope.iter().map(|own| Query::of(vec![*own])).collect();
        let answers = PrimeFieldStates::new(self, sampler).test(&each)?;
        let is_other = |answer: &Answer| matches!(answer, Answer::NonZero(_) | Answer::Silent(_));
        Ok(!answers.iter().any(is_other))
    }

    /// Whether some component of a slope is not 0 at some state, with many digits: modulo a prime a root
    /// may have the other sign, at which no state is on the level.
    fn has_precise_slope(&self, sampler: &Sampler, slope: &[Expr]) -> bool {
        let (run, domain) = (self.run(slope), Mixed::new(LADDER_BITS[0]));
        let is_free = |index: u64| {
            let values = run.at(&domain, &sampler.states(&domain, 1, index));
            values.range(0..slope.len()).iter().any(|value| Mixed::excludes_zero(value, 0))
        };
        sampler.is_numerical() || (0..TAPE_LANES as u64).any(is_free)
    }

    /// Leaves claims undecided that rest on the slopes of such equations: all but identities, and what holds
    /// everywhere.
    pub(super) fn leave_flat_levels(
        &self,
        recorded: &[RecordedClaim<'_>],
        statuses: &mut [ClaimState],
    ) {
        let flat = self.flat.borrow();
        for (item, status) in recorded.iter().zip(statuses) {
            let kept = &item.claim.place.kept;
            let Some(index) = flat.iter().find(|index| kept[**index]) else { continue };
            status.is_flat = true;
            let evidence = &mut status.evidence;
            if item.claim.kind.name() == "identity"
                || status.settled == Some(Verdict::Undecided)
                || evidence.holds.iter().any(|place| place == EVERYWHERE)
            {
                continue;
            }
            (evidence.proof, evidence.witness) = (None, None);
            evidence.holds.clear();
            let equation = &self.case.model.level[*index].text;
            undecide(
                status,
                format!(
                    "the slope of `{equation}` is 0 at states of the level, or depends there on those of the \
                     equations before it, so that it is not known whether the motion stays: write x = 1 for \
                     (x − 1)² = 0, and leave out listed values for which an equation is a square"
                ),
            );
        }
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
