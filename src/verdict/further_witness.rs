//! Further states at which a claim is tried that prime fields refute, so that its report has a witness.

use super::claim_state::ClaimState;
use super::ends::near_ends;
use super::existence::AtNumbers;
use super::judging::Judging;
use super::ladder::{FEW_OPERATIONS, LADDER_BITS};
use super::missing::neighbours;
use super::recorded::RecordedClaim;
use super::sampler::Sampler;
use crate::number::mixed::{Mixed, Number};
use crate::number::rational::Rational;

/// Number of drawn states that are tried, each with two beside it, and of those near ends of ranges.
const DRAWN: u64 = 16;
const NEAR_ENDS: usize = 32;

impl Judging<'_> {
    /// Looks for a state at which a claim fails; it decides the claim.
    pub(super) fn find_witness(
        &self,
        item: &RecordedClaim<'_>,
        sampler: &Sampler,
        status: &mut ClaimState,
    ) -> bool {
        if sampler.is_numerical() || status.evidence.operations > FEW_OPERATIONS {
            return false;
        }
        let drawn = (0..DRAWN).filter_map(|index| numbers(sampler, index));
        let near = (0..DRAWN).flat_map(|index| neighbours(sampler, index));
        let mut all = drawn.chain(near).chain(near_ends(sampler).take(NEAR_ENDS));
        all.any(|numbers| self.examined_at(item, sampler, &numbers, status) == AtNumbers::Refuted)
    }
}

/// Returns the draws of a state.
fn numbers(sampler: &Sampler, index: u64) -> Option<Vec<Rational>> {
    let drawn = sampler.drawn(&Mixed::new(LADDER_BITS[0]), 1, index).into_iter();
    let exact = |value| match value {
        Number::Exact(value) => Some(value),
        _ => None,
    };
    drawn.map(exact).collect()
}
