//! A replayed orbit followed from its nodes: parts of its period that are none.

use super::Replay;
use super::matrix::combined;
use super::number::{ReplayNumber, Wide};
use crate::validated::least::{Followed, WINDOWS, place};
use rayon::prelude::*;

/// Closed orbit in boxes about its nodes.
pub struct ReplayedCourse<'c> {
    pub replay: &'c Replay<'c>,
    /// Slopes of the phase.
    pub phase: &'c [f64],
    /// Boxes that hold the orbit, and the time of a period in units of the shares.
    pub states: Vec<Vec<Wide>>,
    pub period: Wide,
}

impl ReplayedCourse<'_> {
    /// Sum of the shares of some segments from the first on.
    fn elapsed(&self, count: usize) -> Wide {
        let shares = self.replay.data.shares[..count].iter();
        shares.fold(Wide::zero(), |sum, share| sum.plus(&Wide::exact(*share)))
    }

    /// Encloses the states of a segment after a share of the period.
    fn after(&self, segment: usize, share: &Wide) -> Option<Vec<Wide>> {
        let time = share.times(&self.period);
        let is_forward = time.mid() >= 0.0;
        let radius = self.replay.data.tails[segment];
        let found = self.replay.scripts.states(&self.states[segment], &time, radius);
        found.filter(|_| is_forward)
    }
}

impl Followed for ReplayedCourse<'_> {
    fn shares(&self) -> &[f64] {
        &self.replay.data.shares
    }

    fn leaves(&self, window: f64) -> usize {
        let rises = |index: &usize| {
            let share = Wide::about((*index as f64 + 0.5) * window, 0.501 * window);
            self.after(0, &share).is_some_and(|state| {
                combined(self.phase, &self.replay.scripts.field(&state)).is_positive()
            })
        };
        (0..WINDOWS).take_while(rises).count()
    }

    fn are_apart(&self, parts: &[usize]) -> Vec<bool> {
        let whole = self.elapsed(self.replay.data.shares.len());
        let is_apart = |part: &usize| {
            let share = whole.times(&Wide::exact(*part as f64).recip());
            let segment = place(&self.replay.data.shares, share.mid());
            let state = self.after(segment, &share.minus(&self.elapsed(segment)));
            state.is_some_and(|state| {
                let mut pairs = state.iter().zip(&self.states[0]);
                pairs.any(|(x, y)| x.is_below(y) || y.is_below(x))
            })
        };
        parts.par_iter().map(is_apart).collect()
    }

    /// Returns are not replayed: a certificate does not state them.
    fn closes(&self, _: usize, _: f64) -> bool {
        false
    }
}
