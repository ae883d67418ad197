//! Values whose signs are alike or opposite, as those of e^p − e^q and p − q: from the sign of one follows that
//! of the other. Rule S7 of docs/soundness.md.

use crate::graph::Graph;
use crate::proof::alike::{Likeness, contains_increasing, likeness};
use crate::proof::fact::SignFact;

use super::bounds::{is_within_half_turns, narrow};
use super::reach::Reach;

/// Two values, by number, whose product has a known sign.
#[derive(Clone, Copy)]
pub(super) struct Link {
    values: [usize; 2],
    likeness: Likeness,
}

/// Finds such values among those at some places, of which each has a number.
pub(super) fn links(graph: &Graph, places: &[usize], numbers: &[usize]) -> Vec<Link> {
    let has_function: Vec<bool> =
        places.iter().map(|place| contains_increasing(graph, *place)).collect();
    let mut all = Vec::new();
    for (i, a) in places.iter().enumerate() {
        for (j, b) in places.iter().enumerate().take(i).filter(|(_, b)| *b != a) {
            if !has_function[i] && !has_function[j] {
                continue;
            }
            if let Some(found) = likeness(graph, *a, *b) {
                let likeness = found.numbered(numbers);
                all.push(Link { values: [numbers[*a], numbers[*b]], likeness });
            }
        }
    }
    all
}

impl Reach<'_> {
    /// Bounds each of two linked values by the sign of the other; returns whether a bound has changed.
    pub(super) fn follow_links(&mut self) -> bool {
        let Self { links, facts, bounds, changes, .. } = self;
        let mut is_narrower = false;
        for Link { values: [a, b], likeness } in links.iter() {
            for (from, to) in [(*a, *b), (*b, *a)] {
                let (known, other) = (bounds[from], bounds[to]);
                let Some(sign) = known.sign() else { continue };
                let is_alike = match *likeness {
                    // Both are 0 where one of them is.
                    Likeness::Signed(is_alike) => is_alike,
                    // sin p is 0 for p = ±π, too.
                    Likeness::WithinHalfTurns(angle, is_alike) => {
                        let is_nonzero =
                            known.excludes_zero() || facts.contains(&(from, SignFact::Positive));
                        match is_nonzero && is_within_half_turns(bounds[angle]) {
                            true => is_alike,
                            false => continue,
                        }
                    }
                };
                if !other.is_empty() && narrow(&mut bounds[to], other.within(sign == is_alike)) {
                    is_narrower = true;
                    changes.note(to);
                }
            }
        }
        is_narrower
    }
}
