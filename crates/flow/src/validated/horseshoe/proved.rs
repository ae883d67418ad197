//! Horseshoes that are proved, and their entropy.

use super::super::enclosure::{Enclosure, raised};
use super::super::replay::HorseshoeData;
use super::cover::Margin;

/// Horseshoe that is proved to exist.
#[derive(Clone, Debug)]
pub struct ProvedHorseshoe {
    /// Box that contains the rectangle at the saddle.
    pub start: Vec<Enclosure>,
    /// Half sides of that rectangle.
    pub half: [f64; 2],
    /// Times of the two loops, over all motions that follow them.
    pub times: [Enclosure; 2],
    /// Lower bound of the topological entropy of the flow, per unit of time.
    pub entropy: f64,
    /// Number of covering relations.
    pub relations: usize,
    /// Number of conserved functions, the level's among them.
    pub kept: usize,
    /// Whether the field is proved analytic near its motions for all parameters near those of the
    /// case, so that it persists.
    pub persists: bool,
    /// Distance between the state given and the closed orbit's node, relative to the state.
    pub moved: f64,
    /// Course of the search; `None` for a replay, which has none.
    pub trace: Option<HorseshoeTrace>,
    /// Numbers by which the proof can be replayed.
    pub data: HorseshoeData,
}

/// Numbers of the search for a horseshoe, on which the proof does not rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HorseshoeTrace {
    /// Side of the rectangle over that from which the first loop reaches far enough, and over the
    /// stable extent of the images of both loops.
    pub margin: Margin,
    /// Approximate multipliers of the closed orbit.
    pub multipliers: [f64; 2],
    /// Greatest distance of the homoclinic orbit from the saddle's orbit, approximately.
    pub away: f64,
}

/// Covering relations of the two loops, the sets of the short loop before those of the long one.
pub fn relations(short: usize, long: usize) -> Vec<[usize; 2]> {
    let count = short + long;
    let along = (0..count).map(|set| [set, (set + 1) % count]);
    along.chain([[short - 1, 0]]).collect()
}

/// Upper bound of a positive number.
pub fn upper(x: Enclosure) -> f64 {
    raised(x.mid.abs() + x.rad, 2)
}

/// Lower bound of the number h > 0 with e^(-h a) + e^(-h b) = 1.
pub fn entropy(times: [f64; 2]) -> f64 {
    let excess = |h: f64| times.iter().map(|t| libm::exp(-h * t)).sum::<f64>() - 1.0;
    let (mut low, mut high) = (0.0, 1.0 / times[0].min(times[1]));
    for _ in 0..60 {
        let middle = (low + high) / 2.0;
        if excess(middle) > 1e-12 { low = middle } else { high = middle }
    }
    low
}
