//! Maps from the surface of a set to the next, in balls of many bits.
//!
//! ```text
//! P(z) = L' (φ(t(z), X(z)) - o'),  (n', φ(t(z), X(z)) - o') = 0
//! DP = L' (V W - f (n'ᵀ V W)/(n', f)),  W = X', V the derivative of the flow, f the field there
//! ```

use super::cover::ReplayedMap;
use super::data::{CoveringSet, about_set};
use super::patch::ReplayedPatch;
use crate::validated::Obstacle;
use crate::validated::replay::matrix::combined;
use crate::validated::replay::number::{ReplayNumber, Wide};
use crate::validated::replay::segment::Scripts;

/// Motions from the points of a set over all times of its window.
pub struct ReplayedLeg {
    /// States at the ends.
    pub end: Vec<Wide>,
    /// Field there.
    field: Vec<Wide>,
    /// State after the time in the middle of the window, from the point of the middle.
    middle: Vec<Wide>,
    /// Derivatives of the ends by each coordinate.
    slopes: [Vec<Wide>; 2],
    /// Half sides of the rectangle, and radius of the window.
    half: [f64; 2],
    window: f64,
}

fn sum(terms: impl Iterator<Item = Wide>) -> Wide {
    terms.fold(Wide::zero(), |sum, x| sum.plus(&x))
}

impl ReplayedLeg {
    /// Encloses the motions from a set.
    pub fn new(
        scripts: &Scripts<'_>,
        index: usize,
        set: &CoveringSet,
        patch: &ReplayedPatch,
    ) -> Result<Self, Obstacle> {
        let [time, window] = set.time;
        let no_step = |part| about_set(index, part, "has no step that is proved");
        let centre: Vec<Wide> = set.centre.iter().map(|x| Wide::exact(*x)).collect();
        let after = scripts.end(&centre, &Wide::exact(time), set.tail);
        let after = after.ok_or_else(|| no_step("centre"))?;
        let passage = scripts.passage(&patch.states, &Wide::about(time, window), set.tail);
        let passage = passage.ok_or_else(|| no_step("time"))?;
        let moved = |vector: &[Wide]| -> Vec<Wide> {
            let row = |row: &Vec<Wide>| sum(row.iter().zip(vector).map(|(v, x)| v.times(x)));
            passage.derivative.iter().map(row).collect()
        };
        let shift = moved(&patch.middle);
        Ok(Self {
            field: scripts.field(&passage.end),
            middle: after.iter().zip(&shift).map(|(x, shift)| x.plus(shift)).collect(),
            slopes: [moved(&patch.slopes[0]), moved(&patch.slopes[1])],
            end: passage.end,
            half: set.half,
            window,
        })
    }

    /// Encloses the map to the surface of another set. `None` where not every motion is proved to
    /// meet that surface, upwards and once, in the window.
    pub fn map(&self, target: &CoveringSet) -> Option<ReplayedMap> {
        let height = |vector: &[Wide]| combined(&target.normal, vector);
        let speed = height(&self.field);
        if !speed.is_positive() {
            return None;
        }
        let origin = target.origin.iter();
        let off: Vec<Wide> =
            self.middle.iter().zip(origin).map(|(x, o)| x.minus(&Wide::exact(*o))).collect();
        let high = |k: usize| height(&self.slopes[k]).magnitude().mul(&Wide::exact(self.half[k]));
        let highest = height(&off).magnitude().add(&high(0)).add(&high(1));
        if !highest.is_below(&speed.times(&Wide::exact(self.window))) {
            return None;
        }
        let per_speed = speed.recip();
        let turned = |vector: &[Wide], row: &[f64]| {
            let late = height(vector).times(&per_speed);
            combined(row, vector).minus(&combined(row, &self.field).times(&late))
        };
        let rows = &target.rows;
        Some(ReplayedMap {
            middle: [0, 1].map(|row: usize| turned(&off, &rows[row])),
            slopes: [0, 1]
                .map(|row: usize| [0, 1].map(|k: usize| turned(&self.slopes[k], &rows[row]))),
        })
    }
}
