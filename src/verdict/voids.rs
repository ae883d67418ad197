//! Listed parameter values for which a claim says nothing.

use super::field::combinations;
use super::judging::Judging;
use super::ladder::Open;
use super::recorded::RecordedClaim;
use super::sampler::Sampler;
use crate::graph::{Expr, Fault};

/// Largest number of choices of values that a remark names.
const MOST_NAMED: usize = 3;

impl Judging<'_> {
    /// Remarks of claims that hold for which choices of listed values a formula of theirs is 1/0 or the
    /// like: these were left out.
    pub(super) fn remark_voids(
        &self,
        sampler: &Sampler,
        holding: &mut Open<'_, '_>,
    ) -> Result<(), Fault> {
        if sampler.is_numerical() || !sampler.has_lists() || holding.is_empty() {
            return Ok(());
        }
        let Some(combinations) = combinations(sampler.recipes()) else { return Ok(()) };
        let common = self.common.required_at(sampler.kept());
        let all = |item: &RecordedClaim<'_>| [&item.requirement[..], &common].concat();
        let written: Vec<Vec<Expr>> = holding.iter().map(|(item, _)| all(item)).collect();
        let mut voids: Vec<Vec<String>> = vec![Vec::new(); written.len()];
        for fixed in combinations {
            let (graph, values) = sampler.compose(self.graph, &written, &fixed)?;
            for (own, void) in values.iter().zip(&mut voids) {
                if own.iter().any(|value| graph.is_nowhere_defined(*value)) {
                    void.push(sampler.with(&fixed).listed(self.case));
                }
            }
        }
        for ((_, status), void) in holding.iter_mut().zip(voids) {
            if void.is_empty() {
                continue;
            }
            let mut named = void[..void.len().min(MOST_NAMED)].join("; ");
            if void.len() > MOST_NAMED {
                named += &format!("; and {} more", void.len() - MOST_NAMED);
            }
            status
                .evidence
                .add_remark(format!("nothing is said for {named}, where a formula has no value"));
        }
        Ok(())
    }
}
