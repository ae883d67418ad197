//! Stable sorting by code that is compiled once: the sort of the standard library is compiled for each
//! type and each order, which takes a seventh of a second.

use std::cmp::Ordering;

/// Stable sorting that is quick to compile, for slices that are not sorted in a hot loop.
pub trait StableOrder<T> {
    /// Sorts by a comparison.
    fn order_by(&mut self, compare: impl FnMut(&T, &T) -> Ordering);

    /// Sorts by keys.
    fn order_by_key<K: Ord>(&mut self, mut key: impl FnMut(&T) -> K) {
        self.order_by(|a, b| key(a).cmp(&key(b)));
    }

    /// Sorts by the order of the values.
    fn order(&mut self)
    where
        T: Ord,
    {
        self.order_by(T::cmp);
    }
}

impl<T> StableOrder<T> for [T] {
    fn order_by(&mut self, compare: impl FnMut(&T, &T) -> Ordering) {
        let count = self.len();
        ordered(&mut Values { values: self, compare }, count);
    }
}

/// What a sort needs of its values.
trait Row {
    fn compare(&mut self, a: usize, b: usize) -> Ordering;

    fn swap(&mut self, a: usize, b: usize);
}

struct Values<'a, T, C> {
    values: &'a mut [T],
    compare: C,
}

impl<T, C: FnMut(&T, &T) -> Ordering> Row for Values<'_, T, C> {
    fn compare(&mut self, a: usize, b: usize) -> Ordering {
        (self.compare)(&self.values[a], &self.values[b])
    }

    fn swap(&mut self, a: usize, b: usize) {
        self.values.swap(a, b);
    }
}

/// The longest row that is sorted by insertion, in its place.
const SHORT: usize = 12;

fn ordered(row: &mut dyn Row, count: usize) {
    if count > SHORT {
        let mut sources: Vec<usize> = (0..count).collect();
        sources.sort_by(|a, b| row.compare(*a, *b));
        return arrange(row, &mut sources);
    }
    for end in 1..count {
        let mut place = end;
        while place > 0 && row.compare(place - 1, place) == Ordering::Greater {
            row.swap(place - 1, place);
            place -= 1;
        }
    }
}

/// Moves to each place what stands at its source, along the cycles of the permutation.
fn arrange(row: &mut dyn Row, sources: &mut [usize]) {
    for start in 0..sources.len() {
        let mut place = start;
        loop {
            let source = std::mem::replace(&mut sources[place], place);
            if source == start || source == place {
                break;
            }
            row.swap(place, source);
            place = source;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{SHORT, StableOrder};

    /// Against the sort of the standard library, with few keys and many of them equal, on both sides of
    /// the length from which values are sorted by their places.
    #[test]
    fn equal_keys_keep_their_places() {
        let mut state = 1_u64;
        for count in 0..4 * SHORT {
            for keys in [1, 2, 5, 1000] {
                let mut draw = || {
                    state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
                    (state >> 33) % keys
                };
                let values: Vec<(u64, usize)> = (0..count).map(|place| (draw(), place)).collect();
                let mut expected = values.clone();
                expected.sort_by_key(|(key, _)| *key);
                let mut by_key = values.clone();
                by_key.order_by_key(|(key, _)| *key);
                assert_eq!(by_key, expected, "of {count} values with {keys} keys");
                let mut falling = values.clone();
                falling.order_by(|a, b| b.cmp(a));
                falling.order();
                expected.sort();
                assert_eq!(falling, expected, "of {count} values with {keys} keys");
            }
        }
    }
}
