//! Listed parameter values for which a claim says nothing.

use super::judging::Judging;
use super::ladder::Open;
use super::recorded::RecordedClaim;
use super::sampler::Sampler;
use crate::graph::{Expr, Fault};
use crate::mechanics::combinations;
use crate::proof::is_missing;

/// Largest number of choices of values that a remark names.
const MOST_NAMED: usize = 3;

impl Judging<'_> {
    /// Remarks of claims that hold for which choices of listed values a formula of theirs, or the
    /// accelerations, are 1/0, the root of a negative number or the like: these were left out.
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
        let mut written: Vec<Vec<Expr>> = holding.iter().map(|(item, _)| all(item)).collect();
        written.push(self.common.motion.clone());
        let mut voids: Vec<Vec<String>> = vec![Vec::new(); holding.len()];
        let mut still: Vec<String> = Vec::new();
        let extents = sampler.extents();
        for fixed in combinations {
            let (graph, values) = sampler.compose(self.graph, &written, &fixed)?;
            let is_void = |own: &Vec<Expr>| {
                own.iter().any(|value| graph.is_nowhere_defined(*value))
                    || is_missing(&graph, &extents, own)
            };
            let name = || sampler.with(&fixed).listed(self.case);
            if values.last().is_some_and(is_void) {
                still.push(name());
                continue;
            }
            for (own, void) in values.iter().zip(&mut voids) {
                if is_void(own) {
                    void.push(name());
                }
            }
        }
        for ((_, status), void) in holding.iter_mut().zip(voids) {
            for (choices, cause) in
                [(&still, "the equations of motion have"), (&void, "a formula has")]
            {
                if let Some(named) = named(choices) {
                    let remark = format!("nothing is said for {named}, where {cause} no value");
                    status.evidence.add_remark(remark);
                }
            }
        }
        Ok(())
    }
}

/// Names some choices of listed values; `None` if there are none.
fn named(choices: &[String]) -> Option<String> {
    let mut named = choices[..choices.len().min(MOST_NAMED)].join("; ");
    if choices.len() > MOST_NAMED {
        named += &format!("; and {} more", choices.len() - MOST_NAMED);
    }
    (!choices.is_empty()).then_some(named)
}
