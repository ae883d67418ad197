//! Domains with a finite field in each lane.

use crate::number::Domain;
use crate::number::prime::{Prime, UNDEFINED};
use crate::number::quadratic::{Element, Quadratic};

use super::draw::TRIAL_LANES;

/// A domain with a finite field in each lane.
pub trait Residues: Domain + Clone {
    /// Converts elements of the prime fields into the domain's form.
    fn blocks(points: &[[u64; TRIAL_LANES]]) -> Vec<Self::Block>;

    /// Whether the value in a lane is 0; `None` where it is undefined.
    fn is_zero(block: &Self::Block, lane: usize) -> Option<bool>;
}

impl Residues for Prime<TRIAL_LANES> {
    fn blocks(points: &[[u64; TRIAL_LANES]]) -> Vec<[u64; TRIAL_LANES]> {
        points.to_vec()
    }

    fn is_zero(block: &[u64; TRIAL_LANES], lane: usize) -> Option<bool> {
        (block[lane] != UNDEFINED).then_some(block[lane] == 0)
    }
}

impl Residues for Quadratic<TRIAL_LANES> {
    fn blocks(points: &[[u64; TRIAL_LANES]]) -> Vec<[Element; TRIAL_LANES]> {
        points.iter().map(|block| block.map(|x| [x, 0])).collect()
    }

    fn is_zero(block: &[Element; TRIAL_LANES], lane: usize) -> Option<bool> {
        (block[lane][0] != UNDEFINED).then_some(block[lane] == [0, 0])
    }
}
