//! Signs and bounds of values over the real inputs at which given values exist and have given
//! signs, and emptiness of such sets of inputs.
//!
//! Bounds are propagated from step to step of a graph in intervals, forwards from the inputs and
//! backwards from the facts. Two rules go beyond interval arithmetic:
//!
//! - values that are equal, or opposite, at random points of prime fields (see [`Classes`]) share
//!   their bounds;
//! - the signs of xy and y determine the sign of x, where y is not 0 at one of these points: its
//!   zeros then have no interior, and x has this sign everywhere else, thus everywhere in the
//!   closure.
//!
//! Without the proviso the second rule is wrong: y + |y| is 0 for all y < 0, and x (y + |y|) ≥ 0
//! says nothing about x there. These are rules S1 to S3 of docs/soundness.md.
//!
//! Products of factors that have one sign together are added by `signed` and `slopes` (S6 and S11).

mod bounds;
mod linked;
mod reach;
mod search;
mod signed;
mod slopes;

#[cfg(test)]
mod tests;

pub use search::{
    MOST_PIECES, is_missing, is_nowhere_zero, is_seen_nowhere_zero, narrowed, point, sign,
};

use crate::graph::Graph;

use super::classes::Classes;
use super::extent::Extent;
use super::fact::SignFact;
use reach::Reach;

/// Largest number of parts of the box on which one value is bounded.
const MOST_PARTS: usize = 64;
/// Largest number of operations of a value whose sign is sought by slopes.
const MOST_OPERATIONS: usize = 600;

/// The sign of a value wherever it exists.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct KnownSign {
    /// Whether the value is never negative; otherwise it is never positive.
    pub is_positive: bool,
    /// Whether it is not known to be different from 0.
    pub may_vanish: bool,
}

/// The real inputs within some extents at which facts hold.
pub struct Region<'r> {
    /// Graph of the computation.
    pub graph: &'r Graph,
    /// Extents of the inputs in order; further inputs are unbounded.
    pub inputs: &'r [Extent],
    /// Places, and the signs of their values.
    pub facts: &'r [(usize, SignFact)],
    /// Equal and opposite values.
    pub classes: &'r Classes,
}

impl Region<'_> {
    /// Whether the region is known to be empty.
    pub fn is_empty(&self) -> bool {
        let mut reach = self.reached(&[]);
        let mut parts = vec![(self.whole(), 0)];
        let mut looked = 0;
        while let Some((part, depth)) = parts.pop() {
            looked += 1;
            if reach.bounds(&part).is_none() {
                continue;
            }
            match self.cut(&reach, part, depth) {
                Some(halves) if looked + parts.len() + 2 <= MOST_PARTS => parts.extend(halves),
                _ => return false,
            }
        }
        true
    }

    /// Whether the region is shown to be empty by bounds on the whole of it.
    pub fn is_empty_at_sight(&self) -> bool {
        self.reached(&[]).bounds(&self.whole()).is_none()
    }

    /// Finds the sign of the value at a place over the region, wherever it exists, where 0 counts
    /// as either sign; `None` if unknown.
    pub fn sign(&self, place: usize) -> Option<bool> {
        self.known_sign(place).map(|known| known.is_positive)
    }

    /// Finds the same, and whether the value may be 0.
    pub fn known_sign(&self, place: usize) -> Option<KnownSign> {
        self.sign_on(&mut self.reached(&[place]), place)
    }

    /// Finds the sign of the value at a place, also from slopes of factors of products.
    pub fn sign_by_slopes(&self, place: usize) -> Option<bool> {
        let value = self.graph.at(place);
        if self.graph.operations(&[value]) > MOST_OPERATIONS {
            return None;
        }
        let mut reach = Reach::with_slopes(self, &[place])?;
        self.sign_on(&mut reach, place).map(|known| known.is_positive)
    }

    fn sign_on(&self, reach: &mut Reach<'_>, place: usize) -> Option<KnownSign> {
        let number = reach.number(place);
        let (mut known, mut may_vanish): (Option<bool>, bool) = (None, false);
        let mut parts = vec![(self.whole(), 0)];
        let mut looked = 0;
        while let Some((part, depth)) = parts.pop() {
            looked += 1;
            let Some(bounds) = reach.bounds(&part) else { continue };
            let extent = bounds[number];
            match (extent.sign(), known) {
                _ if extent.is_empty() => {}
                (Some(sign), Some(before)) if sign != before => return None,
                (Some(sign), _) => {
                    known = Some(sign);
                    may_vanish |= !extent.excludes_zero();
                }
                (None, _) => match self.cut(reach, part, depth) {
                    Some(halves) if looked + parts.len() + 2 <= MOST_PARTS => parts.extend(halves),
                    _ => return None,
                },
            }
        }
        known.map(|is_positive| KnownSign { is_positive, may_vanish })
    }

    /// Returns the signs that follow from bounds on the whole region, by place.
    pub fn at_sight(&self, outputs: &[usize]) -> Vec<Option<bool>> {
        let mut reach = self.reached(outputs);
        let mut known = vec![None; self.graph.len()];
        let signs = reach
            .bounds(&self.whole())
            .map(|bounds| bounds.iter().map(|bound| bound.sign()).collect::<Vec<Option<bool>>>());
        for (place, sign) in reach.places().iter().zip(signs.into_iter().flatten()) {
            known[*place] = sign;
        }
        known
    }

    /// Lays out what the facts and some other places need.
    fn reached(&self, others: &[usize]) -> Reach<'_> {
        Reach::new(self, others)
    }

    fn whole(&self) -> Vec<Extent> {
        let mut whole = self.inputs.to_vec();
        whole.resize(self.graph.inputs().max(self.inputs.len()), Extent::ALL);
        whole
    }

    /// Halves a part along one input after the other, without those that are single numbers.
    fn cut(
        &self,
        reach: &Reach<'_>,
        part: Vec<Extent>,
        depth: usize,
    ) -> Option<[(Vec<Extent>, usize); 2]> {
        let used = reach.inputs();
        let mut depths = depth..depth + used.len();
        let (depth, input, (low, high)) = depths.find_map(|depth| {
            let (_, input) = used[depth % used.len()];
            Some((depth, input, part[input].halves()?))
        })?;
        let (mut lower, mut upper) = (part.clone(), part);
        (lower[input], upper[input]) = (low, high);
        Some([(upper, depth + 1), (lower, depth + 1)])
    }
}
