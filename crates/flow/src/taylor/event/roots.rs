//! Events on a simple piece, by the signs at its ends and at its extremum.

use super::{Event, slope, value};
use crate::taylor::number::SeriesNumber;

/// Iteration limit, above the count of bisection alone.
const MAX_STEPS: usize = 200;
/// Events on a simple piece, with the signs at its ends. The polynomial may be wrong by `rounding`, and
/// by a `doubt` that is asked for where it decides.
pub(super) fn between<T: SeriesNumber<One = T>>(
    polynomial: &[T],
    [from, to]: [T; 2],
    [begin, end]: [bool; 2],
    rounding: f64,
    doubt: &dyn Fn() -> f64,
) -> Vec<Event<T>> {
    let length = (to - from).leading();
    let forward = length > 0.0;
    let crossing = |after: T, to: bool| Event::Crossing { after, rising: to == forward };
    if begin != end {
        return vec![crossing(root(polynomial, from, to, begin), end)];
    }
    // Between equal signs, the function can reach 0 only where its slope changes sign.
    let rate = slope(polynomial);
    let (first, last) = (value(&rate, from).0.leading(), value(&rate, to).0.leading());
    if !turns(first, last, length, begin) {
        return Vec::new();
    }
    let extremum = root(&rate, from, to, first > 0.0);
    let depth = value(polynomial, extremum).0.leading();
    let touches = |doubt: f64| depth.abs() <= rounding + doubt;
    if touches(0.0) {
        return vec![Event::Tangency { after: extremum }];
    }
    if (depth > 0.0) == begin {
        return Vec::new();
    }
    if touches(doubt()) {
        return vec![Event::Tangency { after: extremum }];
    }
    vec![
        crossing(root(polynomial, from, extremum, begin), !begin),
        crossing(root(polynomial, extremum, to, !begin), begin),
    ]
}

/// Whether a function with these rates at its ends comes nearer to 0 from a side, and turns back.
pub(crate) fn turns(first: f64, last: f64, length: f64, begin: bool) -> bool {
    let leaves = ((first > 0.0) == (length > 0.0)) == begin;
    (first > 0.0) != (last > 0.0) && !leaves
}

/// Finds where a function turns that has slopes of different signs at the ends of a piece.
pub(crate) fn extremum<T: SeriesNumber<One = T>>(polynomial: &[T], length: T) -> T {
    let rate = slope(polynomial);
    root(&rate, T::ZERO, length, rate[0].leading() > 0.0)
}

/// Finds the root between `a`, where the sign is `positive`, and `b`, where it is the other.
fn root<T: SeriesNumber<One = T>>(polynomial: &[T], a: T, b: T, positive: bool) -> T {
    let (mut a, mut b) = (a, b);
    let half = T::float(0.5);
    let tolerance = 4.0 * T::EPSILON * (b - a).leading().abs();
    let mut at = (a + b) * half;
    for _ in 0..MAX_STEPS {
        let (value, slope) = value(polynomial, at);
        if value.leading() == 0.0 {
            break;
        }
        match (value.leading() > 0.0) == positive {
            true => a = at,
            false => b = at,
        }
        let step = value * slope.recip();
        let newton = at - step;
        // Between a and b, whichever is the larger.
        let inside = (newton - a).leading() * (b - newton).leading() > 0.0;
        let next = if inside { newton } else { (a + b) * half };
        let moved = (next - at).leading().abs();
        at = next;
        if moved <= tolerance {
            break;
        }
    }
    at
}
