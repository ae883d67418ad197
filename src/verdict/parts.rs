//! Parts of the states: a value that is not 0 at one state may still be 0 on an open set of others,
//! if it contains moduli, or roots that depend on each other.

use super::claim_state::ClaimState;
use super::conjugates::is_one_function;
use super::evidence::Verdict;
use super::judging::Judging;
use super::ladder::Open;
use super::recorded::RecordedClaim;
use super::sampler::Sampler;
use crate::graph::{Expr, Fault};
use crate::mechanics::combinations;
use crate::proof::Prover;

impl Judging<'_> {
    /// Notes which of the claims that a value does not vanish are shown on a part of the states only,
    /// as far as is known (docs/soundness.md, "Independence").
    pub(super) fn settle_parts(
        &self,
        sampler: &Sampler,
        open: &mut Open<'_, '_>,
    ) -> Result<(), Fault> {
        let is_shown = |item: &RecordedClaim<'_>, status: &ClaimState| {
            item.claim.kind.is_negated() && status.settled == Some(Verdict::Refuted)
        };
        for (item, status) in open.iter_mut().filter(|(item, status)| is_shown(item, status)) {
            status.is_on_a_part = !self.is_nonzero_on_all_parts(sampler, &item.residual)?;
        }
        Ok(())
    }

    /// Whether one of some values is known to vanish on no open set of states.
    fn is_nonzero_on_all_parts(&self, sampler: &Sampler, values: &[Expr]) -> Result<bool, Fault> {
        // A level without a solution may have several branches.
        if sampler.is_numerical() {
            return Ok(false);
        }
        let Some(combinations) = combinations(sampler.recipes()) else { return Ok(false) };
        let (extents, sources) = (sampler.extents(), sampler.sources());
        let prover = Prover { sources: &sources, extents: &extents, seed: self.options.seed };
        for fixed in combinations {
            let (graph, groups) = sampler.compose(self.graph, &[values.to_vec()], &fixed)?;
            let values = groups.concat();
            if is_one_function(&graph, &values, sampler.recipes()) {
                continue;
            }
            let mut is_nonzero = false;
            for value in values {
                is_nonzero |= prover.is_nonzero_on_all_cells(&graph, value)?;
            }
            if !is_nonzero {
                return Ok(false);
            }
        }
        Ok(true)
    }
}
