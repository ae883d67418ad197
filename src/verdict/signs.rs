//! The signs of densities that hold.

use super::bench::Bench;
use super::evidence::Sign;
use super::finding::{Finding, undecide};
use super::recorded::Recorded;
use super::run::{Values, waves};
use super::sampler::{LANES, Maker, Sampler};
use crate::claim::Kind;
use crate::graph::Expr;
use crate::number::Enclosing;
use crate::number::twofold::TwofoldBall;

/// Parameter sets over which the sign of a density is observed.
const PARAMETER_SETS: usize = 4;

impl Bench<'_> {
    /// The signs of the densities among claims that hold, over all states for each of a few
    /// parameter sets; a density that is nowhere known to be non-zero is none.
    pub(super) fn settle_signs<'f, 'r: 'f>(
        &self,
        sampler: &Sampler,
        items: impl Iterator<Item = (&'f Recorded<'r>, &'f mut Finding)>,
    ) {
        let (densities, mut findings): (Vec<Expr>, Vec<&mut Finding>) = items
            .filter(|(item, _)| matches!(item.claim.kind, Kind::Density(_)))
            .filter_map(|(item, finding)| Some((*item.context.value.first()?, finding)))
            .unzip();
        if densities.is_empty() {
            return;
        }
        let run = self.run(&densities);
        let mut seen = vec![[[false; 2]; PARAMETER_SETS]; densities.len()];
        for blocks in waves(0..self.blocks()) {
            let sharing = |maker: &mut Maker<'_>, start| {
                maker.balls_sharing_parameters(start, PARAMETER_SETS)
            };
            for values in run.at_blocks(sampler, blocks, sharing) {
                observe(&values, &mut seen);
            }
            if seen.iter().all(|seen| sign(seen) == Some(Sign::Changes)) {
                break;
            }
        }
        if seen.iter().any(|seen| sign(seen).is_none()) && !sampler.is_numerical() {
            let domain = TwofoldBall::<LANES>;
            let states = sampler.states_sharing_parameters(&domain, 0, PARAMETER_SETS);
            observe(&run.at(&domain, &states), &mut seen);
        }
        for (finding, seen) in findings.iter_mut().zip(&seen) {
            finding.evidence.sign = sign(seen);
            if finding.evidence.sign.is_none() {
                undecide(finding, "the density is 0 at all states that were tried".to_string());
            }
        }
    }
}

/// Notes the signs of a block of values, by parameter set.
fn observe<D: Enclosing>(values: &Values<D>, seen: &mut [[[bool; 2]; PARAMETER_SETS]]) {
    for (index, seen) in seen.iter_mut().enumerate() {
        let block = values.output(index);
        for lane in (0..LANES).filter(|lane| D::excludes_zero(block, *lane)) {
            if let Some((mid, _)) = D::enclosure(block, lane) {
                seen[lane * PARAMETER_SETS / LANES][usize::from(mid > 0.0)] = true;
            }
        }
    }
}

/// One sign from what was seen, negative and positive, at each set of parameters.
fn sign(seen: &[[bool; 2]]) -> Option<Sign> {
    if seen.contains(&[true, true]) {
        return Some(Sign::Changes);
    }
    // Another sign for other parameters is one measure for each of them, up to a factor -1.
    let [negative, positive] = [0, 1].map(|sign| seen.iter().any(|set| set[sign]));
    match (positive, negative) {
        (true, _) => Some(Sign::Positive),
        (false, true) => Some(Sign::Negative),
        (false, false) => None,
    }
}
