//! States near the ends of the ranges, for claims that no other state refutes: acos(cos x) = |x| fails for
//! |x| > π alone.

use super::existence::AtNumbers;
use super::judging::Judging;
use super::ladder::{LADDER_BITS, Open};
use super::sampler::Sampler;
use crate::mechanics::{Draw, NumberLine};
use crate::number::mixed::{Mixed, Number};
use crate::number::rational::Rational;

/// Shares of a range between an end and a state, as powers of 2.
const DISTANCES: [i64; 2] = [10, 20];
/// Largest number of states.
const MOST: usize = 128;
/// Number of states at which all draws are near ends.
const CORNERS: usize = 8;
/// Factors of numbers without a range, as a time that the file does not declare.
const FAR: [i64; 4] = [4, 16, 64, 256];
/// Number of states for each factor.
const MOST_FAR: usize = 8;

impl Judging<'_> {
    /// Looks for a witness near the ends of the ranges, and far away where there are none, against claims that are
    /// still open.
    pub(super) fn states_near_ends(&self, sampler: &Sampler, open: &mut Open<'_, '_>) {
        let unsettled = open.iter_mut().filter(|(_, status)| {
            status.settled.is_none() && status.undefined.is_none() && !status.is_zero
        });
        for (item, status) in unsettled {
            let mut all = near_ends(sampler).chain(far_away(sampler));
            all.any(|numbers| {
                self.examined_at(item, sampler, &numbers, status) == AtNumbers::Refuted
            });
        }
    }
}

/// Iterates over draws of states near the ends of the range of one draw, and near those of all.
pub(super) fn near_ends(sampler: &Sampler) -> impl Iterator<Item = Vec<Rational>> + '_ {
    let recipes = sampler.recipes();
    let ranged: Vec<usize> =
        (0..recipes.len()).filter(|k| matches!(recipes[*k], Draw::Within(_))).collect();
    let count = ranged.len();
    let single = (0..count * 2 * DISTANCES.len()).map(move |number| {
        let (place, number) = (number % count, number / count);
        (vec![ranged[place]], number)
    });
    let corners = (0..CORNERS).filter(move |_| count > 1).map(|number| (Vec::new(), number));
    let chosen = single.take(MOST).chain(corners).enumerate();
    chosen.filter_map(move |(index, (places, number))| {
        let domain = Mixed::new(LADDER_BITS[0]);
        let drawn = sampler.drawn(&domain, 1, index as u64);
        let moved = |(k, (value, draw)): (usize, (&Number, &Draw))| {
            let Number::Exact(value) = value else { return None };
            let Draw::Within(range) = draw else { return Some(value.clone()) };
            let (is_moved, is_low, distance) = match places.first() {
                Some(place) => (*place == k, number % 2 == 0, DISTANCES[number / 2]),
                None => (true, (number >> (k % 3)) % 2 == 0, DISTANCES[0]),
            };
            if !is_moved {
                return Some(value.clone());
            }
            let away = &(&range.high - &range.low) * &Rational::new(1, 1 << distance);
            Some(if is_low { &range.low + &away } else { &range.high - &away })
        };
        drawn.iter().zip(recipes).enumerate().map(moved).collect()
    })
}

/// Iterates over draws of states at which all numbers without a range are larger than they are drawn.
pub(super) fn far_away(sampler: &Sampler) -> impl Iterator<Item = Vec<Rational>> + '_ {
    let is_free = |draw: &Draw| matches!(draw, Draw::Of(NumberLine::All, _));
    let has_free = sampler.recipes().iter().any(is_free);
    let count = if has_free { FAR.len() * MOST_FAR } else { 0 };
    (0..count).filter_map(move |index| {
        let domain = Mixed::new(LADDER_BITS[0]);
        let drawn = sampler.drawn(&domain, 1, index as u64);
        let factor = Rational::from(FAR[index % FAR.len()]);
        let moved = |(value, draw): (&Number, &Draw)| {
            let Number::Exact(value) = value else { return None };
            Some(if is_free(draw) { value * &factor } else { value.clone() })
        };
        drawn.iter().zip(sampler.recipes()).map(moved).collect()
    })
}
