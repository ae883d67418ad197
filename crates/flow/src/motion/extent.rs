//! Places that a motion visits, block by block: whether it rests in the end, or goes away for ever.

use crate::motion::lyapunov::{BLOCKS, Character};
use liouville::number::double_double::DoubleDouble;

/// Number of blocks before the later half, that of the transient among them.
const HALF: usize = 1 + BLOCKS / 2;
/// Distance, relative to the largest size of a component, within which it is at rest.
const STILL: f64 = 1e-12;
/// Roundings of the components that move, below which another is at rest where it is near 0.
const ROUNDINGS: f64 = 16.0;
/// Growth of the largest state from the earlier to the later half beyond which a motion escapes; a
/// turning angle grows by 2.
const ESCAPED: f64 = 4.0;

/// Places of a motion, block by block.
#[derive(Debug, Default)]
pub(crate) struct Extent {
    /// Largest size of the state in each block.
    sizes: Vec<f64>,
    /// State at which the later half begins, and the largest distance of each component from it
    /// since.
    middle: Vec<f64>,
    away: Vec<f64>,
    /// State at which the motion begins, and for each component its largest size, and whether it
    /// has moved.
    first: Vec<f64>,
    largest: Vec<f64>,
    has_moved: Vec<bool>,
    /// Last state, the box around the states of its block, and the diagonals of those before.
    last: Vec<f64>,
    bounds: Vec<[f64; 2]>,
    spreads: Vec<f64>,
}

impl Extent {
    /// Records a state in a block.
    pub fn visit(&mut self, block: usize, state: &[DoubleDouble]) {
        let norm = |parts: &mut dyn Iterator<Item = f64>| parts.map(|x| x * x).sum::<f64>().sqrt();
        let size = norm(&mut state.iter().map(|x| x.hi));
        if self.sizes.len() <= block {
            self.sizes.resize(block + 1, 0.0);
        }
        self.sizes[block] = self.sizes[block].max(size);
        self.enclose(block, state);
        if self.first.is_empty() {
            self.first = state.iter().map(|x| x.hi).collect();
            (self.largest, self.away) = (vec![0.0; state.len()], vec![0.0; state.len()]);
            self.has_moved = vec![false; state.len()];
        }
        for (k, x) in state.iter().enumerate() {
            self.largest[k] = self.largest[k].max(x.hi.abs());
            self.has_moved[k] |= x.hi != self.first[k];
        }
        if block < HALF {
            return;
        }
        if self.middle.is_empty() {
            self.middle = state.iter().map(|x| x.hi).collect();
        }
        for ((away, x), middle) in self.away.iter_mut().zip(state).zip(&self.middle) {
            *away = away.max((x.hi - middle).abs());
        }
    }

    /// Whether every component rests in the later half, by its own size, or by the rounding of
    /// those that move: one that is constant, however large, hides nothing.
    fn is_at_rest(&self) -> bool {
        let moving = self.largest.iter().zip(&self.has_moved).filter(|(_, has_moved)| **has_moved);
        let rounding = ROUNDINGS * f64::EPSILON * moving.fold(0.0, |a: f64, (x, _)| a.max(*x));
        let bounds = self.largest.iter().map(|size| (STILL * size).max(rounding));
        self.away.iter().zip(bounds).all(|(away, bound)| *away <= bound)
    }

    /// Puts a state into the box of its block; a box begins with the last state of the one before.
    fn enclose(&mut self, block: usize, state: &[DoubleDouble]) {
        if self.bounds.is_empty() {
            self.bounds = state.iter().map(|x| [x.hi, x.hi]).collect();
        } else if block != self.spreads.len() {
            self.spreads.push(self.diagonal());
            self.bounds = self.last.iter().map(|x| [*x, *x]).collect();
        }
        for ([low, high], x) in self.bounds.iter_mut().zip(state) {
            (*low, *high) = (low.min(x.hi), high.max(x.hi));
        }
        self.last.clear();
        self.last.extend(state.iter().map(|x| x.hi));
    }

    fn diagonal(&self) -> f64 {
        self.bounds.iter().map(|[low, high]| (high - low) * (high - low)).sum::<f64>().sqrt()
    }

    /// Diagonals of the boxes of all blocks.
    pub fn spreads(&self) -> Vec<f64> {
        self.spreads.iter().copied().chain([self.diagonal()]).collect()
    }

    /// Class of a motion with a positive exponent that comes to rest, or goes away for ever.
    pub fn character(&self) -> Option<Character> {
        let (early, late) = self.sizes.split_at(HALF.min(self.sizes.len()));
        let largest = |sizes: &[f64]| sizes.iter().fold(0.0, |a: f64, b| a.max(*b));
        let grows = late.windows(2).all(|pair| pair[0] < pair[1]);
        match late {
            [] | [_] => None,
            _ if self.is_at_rest() => Some(Character::UnstableRest),
            _ if grows && largest(late) > ESCAPED * largest(early) => Some(Character::Escape),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn character(state: impl Fn(f64) -> [f64; 3]) -> Option<Character> {
        let mut extent = Extent::default();
        for k in 0..2200 {
            let state = state(f64::from(k)).map(DoubleDouble::from_f64);
            extent.visit(k as usize / 200, &state);
        }
        extent.character()
    }

    #[test]
    fn a_large_constant_hides_no_motion_and_rounding_is_none() {
        assert_eq!(character(|t| [t.sin(), t.cos(), 1e20]), None, "it moves");
        let rest = Some(Character::UnstableRest);
        assert_eq!(character(|t| [(-t / 10.0).exp(), 3.0, 1e20]), rest, "it comes to rest");
        let noise = |t: f64| [1.0 + (-t / 10.0).exp(), 1e-16 * t.sin(), 1.0];
        assert_eq!(character(noise), rest, "rounding beside 1");
    }
}
