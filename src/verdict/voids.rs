//! Listed parameter values, and states, for which a claim says nothing.

use super::claim_state::ClaimState;
use super::judging::Judging;
use super::ladder::Open;
use super::recorded::RecordedClaim;
use super::sampler::Sampler;
use crate::graph::{Expr, Fault};
use crate::mechanics::combinations;
use crate::number::rational::Rational;
use crate::proof::is_missing;

/// Values of the listed numbers, by draw.
pub type Choice = Vec<Option<Rational>>;

/// Largest number of choices of values that a remark names.
const MOST_NAMED: usize = 3;

impl Judging<'_> {
    /// Remarks of claims that hold for which listed values, and at how many of the other states, a formula of
    /// theirs, or the accelerations, are 1/0, the root of a negative number or the like: these were left out.
    pub(super) fn remark_voids(
        &self,
        sampler: &Sampler,
        holding: &mut Open<'_, '_>,
    ) -> Result<(), Fault> {
        let voids = self.void_choices(sampler, holding)?;
        for ((item, status), voids) in holding.iter_mut().zip(voids) {
            self.remark_missing(sampler, (item, status), &voids);
            status.voids = voids;
        }
        Ok(())
    }

    /// Finds the choices of listed values for which claims say nothing, and remarks them.
    fn void_choices(
        &self,
        sampler: &Sampler,
        holding: &mut Open<'_, '_>,
    ) -> Result<Vec<Vec<Choice>>, Fault> {
        let mut found: Vec<Vec<Choice>> = vec![Vec::new(); holding.len()];
        if sampler.is_numerical() || !sampler.has_lists() || holding.is_empty() {
            return Ok(found);
        }
        let Some(combinations) = combinations(sampler.recipes()) else { return Ok(found) };
        let items: Vec<&RecordedClaim<'_>> = holding.iter().map(|(item, _)| *item).collect();
        let mut still: Vec<Choice> = Vec::new();
        for fixed in combinations {
            let (are_void, has_motion) = self.are_void(sampler, &items, &fixed)?;
            if !has_motion {
                still.push(fixed);
                continue;
            }
            for (is_void, void) in are_void.into_iter().zip(&mut found) {
                if is_void {
                    void.push(fixed.clone());
                }
            }
        }
        for ((_, status), void) in holding.iter_mut().zip(&mut found) {
            self.remark_choices(sampler, (&still, void), status);
            void.extend(still.iter().cloned());
        }
        Ok(found)
    }

    /// Whether a formula of each claim has no value for a choice of listed values, and whether the equations of motion
    /// have one.
    pub(super) fn are_void(
        &self,
        sampler: &Sampler,
        items: &[&RecordedClaim<'_>],
        fixed: &Choice,
    ) -> Result<(Vec<bool>, bool), Fault> {
        let common = self.common.required_at(sampler.kept());
        let mut written: Vec<Vec<Expr>> =
            items.iter().map(|item| [&item.requirement[..], &common].concat()).collect();
        written.push(self.common.motion.clone());
        let (graph, values) = sampler.compose(self.graph, &written, fixed)?;
        let extents = sampler.extents();
        let is_void = |own: &Vec<Expr>| {
            own.iter().any(|value| graph.is_nowhere_defined(*value))
                || is_missing(&graph, &extents, own)
        };
        let mut are_void: Vec<bool> = values.iter().map(is_void).collect();
        let is_still = are_void.pop().unwrap_or_default();
        Ok((are_void, !is_still))
    }

    /// Remarks the choices of listed values without equations of motion, and those for which another formula has no
    /// value.
    pub(super) fn remark_choices(
        &self,
        sampler: &Sampler,
        (still, void): (&[Choice], &[Choice]),
        status: &mut ClaimState,
    ) {
        for (choices, cause) in [(still, "the equations of motion have"), (void, "a formula has")] {
            let named = choices.iter().map(|fixed| sampler.with(fixed).listed(self.case, |_| true));
            if let Some(named) = named_of(&named.collect::<Vec<String>>()) {
                let remark = format!("nothing is said for {named}, where {cause} no value");
                status.evidence.add_remark(remark);
            }
        }
    }
}

/// Names some choices of listed values; `None` if there are none.
fn named_of(choices: &[String]) -> Option<String> {
    let mut named = choices[..choices.len().min(MOST_NAMED)].join("; ");
    if choices.len() > MOST_NAMED {
        named += &format!("; and {} more", choices.len() - MOST_NAMED);
    }
    (!choices.is_empty()).then_some(named)
}
