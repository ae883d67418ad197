//! Independence of an integral from the integrals common to all cases.
//!
//! An enclosure that excludes 0 shows independence; dependence takes a proof, like any identity.

use super::bench::Bench;
use super::evidence::{Independence, Verdict};
use super::field::{Answer, Field, Query};
use super::judge::{JudgeError, Trust};
use super::ladder::Open;
use super::recorded::Recorded;
use super::sampler::Sampler;

impl Bench<'_> {
    /// Decides, for proved integrals not shown by enclosures to be independent of the level
    /// functions and the energy, whether they are functions of these.
    pub(super) fn settle_novelty(
        &self,
        sampler: &Sampler,
        holding: &mut Open<'_, '_>,
    ) -> Result<(), JudgeError> {
        let mut open: Vec<_> = holding
            .iter_mut()
            .filter(|(item, finding)| {
                let seen = finding.evidence.independence == Some(Independence::Independent);
                finding.settled == Some(Verdict::Proved)
                    && !item.novelty.off_level.is_empty()
                    && !seen
            })
            .collect();
        // An enclosure may already have shown that the integral is not constant on the level.
        let asked = |item: &Recorded<'_>, known: Option<Independence>| {
            let level = (known != Some(Independence::General)).then_some(&item.novelty.off_level);
            let general = Some(&item.novelty.off_general).filter(|group| !group.is_empty());
            [level.cloned(), general.cloned()]
        };
        let queries: Vec<Query> = open
            .iter()
            .flat_map(|(item, finding)| {
                let groups = asked(item, finding.evidence.independence).into_iter().flatten();
                groups.map(|outputs| Query { outputs, requirement: item.requirement.clone() })
            })
            .collect();
        let mut answers = match self.options.trust {
            Trust::Float => Vec::new(),
            _ => Field::new(self, sampler).test(&queries)?,
        }
        .into_iter();
        for (item, finding) in &mut open {
            let [level, general] = asked(item, finding.evidence.independence)
                .map(|group| group.and_then(|_| answers.next()));
            finding.evidence.independence = match (level, general) {
                (Some(Answer::Zero(_)), _) => Some(Independence::Constant),
                (_, Some(Answer::Zero(_))) => Some(Independence::General),
                (_, Some(general)) if general.is_nonzero() => Some(Independence::Independent),
                (Some(level), None) if level.is_nonzero() => Some(Independence::Independent),
                _ => None,
            };
        }
        Ok(())
    }
}
