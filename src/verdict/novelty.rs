//! Independence of an integral from the integrals common to all cases.
//!
//! An enclosure that excludes 0 shows independence; dependence takes a proof, like any identity.

use super::evidence::{Independence, Verdict};
use super::field::{Answer, PrimeFieldStates, Query};
use super::judge::{JudgeError, Trust};
use super::judging::Judging;
use super::ladder::{LADDER_BITS, Open};
use super::recorded::RecordedClaim;
use super::sampler::{Sampler, TAPE_LANES};
use crate::graph::Expr;
use crate::number::ball::Ball;
use crate::number::mixed::Mixed;

/// Number of states in exact numbers at which a value is sought where f64 finds none.
const EXACT_STATES: u64 = 16;

impl Judging<'_> {
    /// Decides, for proved integrals not shown by enclosures to be independent of the level
    /// functions and the energy, whether they are functions of these.
    pub(super) fn settle_novelty(
        &self,
        sampler: &Sampler,
        holding: &mut Open<'_, '_>,
    ) -> Result<(), JudgeError> {
        let mut open: Vec<_> = holding
            .iter_mut()
            .filter(|(item, status)| {
                let seen = status.evidence.independence == Some(Independence::Independent);
                status.settled == Some(Verdict::Proved)
                    && !item.novelty.off_level.is_empty()
                    && !seen
            })
            .collect();
        // An enclosure may already have shown that the integral is not constant on the level.
        let asked = |item: &RecordedClaim<'_>, known: Option<Independence>| {
            let level = (known != Some(Independence::General)).then_some(&item.novelty.off_level);
            let general = Some(&item.novelty.off_general).filter(|group| !group.is_empty());
            [level.cloned(), general.cloned()]
        };
        let queries: Vec<Query> = open
            .iter()
            .flat_map(|(item, status)| {
                let groups = asked(item, status.evidence.independence).into_iter().flatten();
                groups.map(|outputs| Query {
                    outputs,
                    requirement: item.requirement.clone(),
                    ..Query::default()
                })
            })
            .collect();
        let mut answers = match self.options.trust {
            Trust::Float => Vec::new(),
            _ => PrimeFieldStates::new(self, sampler).test(&queries)?,
        }
        .into_iter();
        for (item, status) in &mut open {
            let [level, general] = asked(item, status.evidence.independence)
                .map(|group| group.and_then(|_| answers.next()));
            let novelty = &item.novelty;
            status.evidence.independence = match (level, general) {
                (Some(Answer::Zero(_)), _) => Some(Independence::Constant),
                (_, Some(Answer::Zero(_))) => Some(Independence::General),
                (_, Some(general))
                    if self.is_new(&general, item, &novelty.off_general, sampler) =>
                {
                    Some(Independence::Independent)
                }
                (Some(level), None) if self.is_new(&level, item, &novelty.off_level, sampler) => {
                    Some(Independence::Independent)
                }
                _ => None,
            };
        }
        Ok(())
    }

    /// Whether these values are not identically zero for some choice of listed parameter values, and
    /// have a value at a state for that choice. Modulo a prime half of all numbers have roots, those
    /// of -x for x > 0 among them.
    fn is_new(
        &self,
        answer: &Answer,
        item: &RecordedClaim<'_>,
        values: &[Expr],
        sampler: &Sampler,
    ) -> bool {
        let Answer::NonZero(found) = answer else { return false };
        let whole = found.iter().filter(|found| found.parts.proper().is_none());
        let mut outputs = self.common.required_at(sampler.kept());
        outputs.extend(item.requirement.iter().chain(values));
        let run = self.run(&outputs);
        let outputs = 0..outputs.len();
        let all = std::slice::from_ref(&outputs);
        let has_state = |sampler: &Sampler| {
            let in_f64 = (0..self.blocks()).any(|block| {
                let values = run.at(&Ball::<TAPE_LANES>, &sampler.balls(block * TAPE_LANES as u64));
                values.existing(all).contains(&true)
            });
            let domain = Mixed::new(LADDER_BITS[0]);
            let exists =
                |index| run.at(&domain, &sampler.states(&domain, 1, index)).existing(all)[0];
            in_f64 || (0..EXACT_STATES).any(exists)
        };
        whole.into_iter().any(|found| has_state(&sampler.with(&found.fixed)))
    }
}
