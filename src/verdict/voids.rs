//! Listed parameter values, and states, for which a claim says nothing.

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
        let common = self.common.required_at(sampler.kept());
        let all = |item: &RecordedClaim<'_>| [&item.requirement[..], &common].concat();
        let mut written: Vec<Vec<Expr>> = holding.iter().map(|(item, _)| all(item)).collect();
        written.push(self.common.motion.clone());
        let mut still: Vec<Choice> = Vec::new();
        let extents = sampler.extents();
        for fixed in combinations {
            let (graph, values) = sampler.compose(self.graph, &written, &fixed)?;
            let is_void = |own: &Vec<Expr>| {
                own.iter().any(|value| graph.is_nowhere_defined(*value))
                    || is_missing(&graph, &extents, own)
            };
            if values.last().is_some_and(is_void) {
                still.push(fixed);
                continue;
            }
            for (own, void) in values.iter().zip(&mut found) {
                if is_void(own) {
                    void.push(fixed.clone());
                }
            }
        }
        for ((_, status), void) in holding.iter_mut().zip(&mut found) {
            for (choices, cause) in
                [(&still, "the equations of motion have"), (&*void, "a formula has")]
            {
                let named =
                    choices.iter().map(|fixed| sampler.with(fixed).listed(self.case, |_| true));
                if let Some(named) = named_of(&named.collect::<Vec<String>>()) {
                    let remark = format!("nothing is said for {named}, where {cause} no value");
                    status.evidence.add_remark(remark);
                }
            }
            void.extend(still.iter().cloned());
        }
        Ok(found)
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
