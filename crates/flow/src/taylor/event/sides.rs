//! Sides of 0 from piece to piece, by which each crossing is found once.

use super::ends::Ends;
use super::pieces::simple_pieces;
use super::roots::{between, turns};
use super::{Event, ROUNDINGS, size, value};
use crate::taylor::number::SeriesNumber;

/// Multiple of the error of a value at which two pieces meet, above which they disagree: one part for
/// either value, and two for the higher coefficients of the last piece, which have errors of their own.
pub(super) const DOUBTS: f64 = 4.0;

/// Side of 0 on which a function was last seen, from piece to piece.
///
/// A piece that ends at a root up to rounding leaves it to the next one, which begins there: within
/// what both can be wrong by, the side that is remembered decides, so that no crossing is missed or
/// counted twice. Beyond it the function has jumped, which is no crossing.
///
/// What a polynomial can be wrong by is the rounding of its own terms, and that of the operands which
/// the function was made from: (x + 10¹²)² - 10²⁴ is small where these are not. The second is a `doubt`
/// that callers work out, and is asked for where it decides.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sides {
    positive: Option<bool>,
    /// Rounding of the terms of the last piece.
    rounding: f64,
    /// Side before a zero at the end of the last piece, which was left to the next one.
    pub(super) open: Option<bool>,
}

impl Sides {
    /// The sides of a function that is known to come from this side.
    pub fn on(positive: bool) -> Self {
        Self { positive: Some(positive), rounding: 0.0, open: None }
    }

    /// Whether a lane has no event, where `events` would find none. Remembers the side at its end.
    pub fn pass<T: SeriesNumber>(&mut self, ends: &Ends<T>, lane: usize) -> bool {
        let at = |value: T| value.lane(lane).leading();
        let (length, first, last) = (at(ends.length), at(ends.first), at(ends.last));
        let [first_rate, last_rate] = ends.rates.map(at);
        let rounding = at(ends.largest) * ROUNDINGS * T::EPSILON;
        let known = first.abs() > rounding && last.is_finite() && last_rate.is_finite();
        let (begin, end) = (first > 0.0, last > 0.0);
        let simple = ends.shape.is_simple(lane);
        if !simple
            || !known
            || self.open.is_some()
            || self.positive != Some(begin)
            || length == 0.0
            || begin != end
            || turns(first_rate, last_rate, length, begin)
        {
            return false;
        }
        *self = Self { positive: Some(end), rounding, open: None };
        true
    }

    /// Finds the events between 0 and `length`, except at 0 if the motion starts there. `doubt` is the
    /// error of the function's value at 0 that its operands cause.
    pub fn events<T: SeriesNumber<One = T>>(
        &mut self,
        polynomial: &[T],
        length: T,
        doubt: &dyn Fn() -> f64,
    ) -> Vec<Event<T>> {
        if length.leading() == 0.0 {
            return Vec::new();
        }
        let rounding = size(polynomial, length) * ROUNDINGS * T::EPSILON;
        let begin = self.begin(polynomial, length, rounding, doubt);
        let end = value(polynomial, length).0.leading() > 0.0;
        *self = Self { positive: Some(end), rounding, open: None };
        let leading: Vec<f64> = polynomial.iter().map(|own| own.leading()).collect();
        let (mut from, mut side) = (T::ZERO, begin);
        let mut events = Vec::new();
        for to in simple_pieces(&leading, length.leading()) {
            let is_last = to == length.leading();
            let to = if is_last { length } else { T::float(to) };
            let there = if is_last { end } else { value(polynomial, to).0.leading() > 0.0 };
            events.extend(between(polynomial, [from, to], [side, there], rounding, doubt));
            (from, side) = (to, there);
        }
        events
    }

    /// Side on which a piece begins.
    pub(super) fn begin<T: SeriesNumber<One = T>>(
        &self,
        polynomial: &[T],
        length: T,
        rounding: f64,
        doubt: &dyn Fn() -> f64,
    ) -> bool {
        let first = polynomial[0].leading();
        match self.positive {
            Some(positive) if (first > 0.0) == positive => positive,
            Some(positive) => {
                let own = self.rounding + rounding;
                let jumps = first.abs() > own && first.abs() > own + DOUBTS * doubt();
                positive != jumps
            }
            None => {
                let error = rounding + doubt();
                let is_known = first.abs() > error;
                if is_known { first > 0.0 } else { starts_positive(polynomial, error, length) }
            }
        }
    }
}

/// Sign of a function just after a beginning at which it vanishes: that of the first term that is
/// not rounding.
pub(crate) fn starts_positive<T: SeriesNumber>(polynomial: &[T], rounding: f64, length: T) -> bool {
    let mut power = 1.0;
    for coefficient in polynomial {
        let term = coefficient.leading() * power;
        if term.abs() > rounding {
            return term > 0.0;
        }
        power *= length.leading();
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Coefficients of Π (τ - r) over the given roots, and no higher terms.
    fn with_roots(roots: &[f64]) -> Vec<f64> {
        roots.iter().fold(vec![1.0], |polynomial, root| {
            let mut product = vec![0.0; polynomial.len() + 1];
            for (n, coefficient) in polynomial.iter().enumerate() {
                product[n + 1] += coefficient;
                product[n] -= root * coefficient;
            }
            product
        })
    }

    fn events(polynomial: &[f64], length: f64) -> Vec<Event<f64>> {
        Sides::default().events(polynomial, length, &|| 0.0)
    }

    fn times(found: &[Event<f64>]) -> Vec<(f64, bool)> {
        let times = found.iter().filter_map(|event| match event {
            Event::Crossing { after, rising } => Some((*after, *rising)),
            Event::Tangency { .. } => None,
        });
        times.collect()
    }

    #[test]
    fn crossings_are_found_with_their_direction() {
        let [(at, rising)] = times(&events(&with_roots(&[0.3, 2.0]), 1.0))[..] else {
            panic!("one root within the piece")
        };
        assert!((at - 0.3).abs() < 1e-15 && !rising, "falls through 0 at 0.3");
        let [(at, rising)] = times(&events(&with_roots(&[-0.3]), -1.0))[..] else {
            panic!("backwards in time too")
        };
        assert!((at + 0.3).abs() < 1e-15 && rising, "rises with time, met backwards");
    }

    #[test]
    fn a_pair_of_roots_is_told_from_a_tangency() {
        let pair = events(&with_roots(&[0.4, 0.400001]), 1.0);
        assert_eq!(times(&pair).len(), 2, "two crossings between equal signs: {pair:?}");
        let touch = events(&with_roots(&[0.4, 0.4]), 1.0);
        let [Event::Tangency { after }] = touch[..] else { panic!("a double root: {touch:?}") };
        assert!((after - 0.4).abs() < 1e-12, "where the slope vanishes");
        let beside: Vec<f64> = with_roots(&[0.4, 0.4]);
        let beside = [beside[0] + 1e-6, beside[1], beside[2]];
        assert_eq!(events(&beside, 1.0), [], "passes by at a distance");
    }

    #[test]
    fn all_roots_within_a_piece_are_found() {
        for turn in 0..500u32 {
            let count = 1 + turn % 6;
            let at = |k: u32| (f64::from(turn * 7 + k * 29).sin() * 43758.5).abs().fract();
            let mut roots: Vec<f64> = (0..count).map(at).collect();
            roots.sort_by(f64::total_cmp);
            let gap = roots.windows(2).map(|pair| pair[1] - pair[0]).fold(1.0, f64::min);
            if gap < 3e-3 || roots[0] < 1e-3 || roots[count as usize - 1] > 0.999 {
                continue;
            }
            let length = if turn.is_multiple_of(2) { 1.0 } else { -1.0 };
            let signed: Vec<f64> = roots.iter().map(|root| root * length).collect();
            let polynomial = with_roots(&signed);
            assert!(!Sides::default().pass(&Ends::new(&polynomial, length), 0), "{roots:?}");
            let found = times(&events(&polynomial, length));
            assert_eq!(found.len(), roots.len(), "{roots:?} {found:?}");
            for ((after, _), root) in found.iter().zip(&signed) {
                let terms: f64 = polynomial.iter().map(|x| x.abs()).sum();
                let slope: f64 =
                    signed.iter().filter(|own| *own != root).map(|own| root - own).product();
                let error = 100.0 * f64::EPSILON * terms / slope.abs();
                assert!((after - root).abs() < error, "{roots:?} {found:?}");
            }
            assert!(found.windows(2).all(|pair| pair[0].1 != pair[1].1), "directions alternate");
        }
    }

    #[test]
    fn a_root_between_two_pieces_is_found_once() {
        // The first piece ends just before or behind the root; the next one disagrees by rounding.
        for (end, begin) in [(1e-17, -1e-17), (-1e-17, 1e-17), (1e-17, 1e-17), (-1e-17, -1e-17)] {
            let mut sides = Sides::default();
            let mut found = sides.events(&[1.0 + end, -1.0], 1.0, &|| 0.0);
            found.extend(sides.events(&[begin, -1.0], 1.0, &|| 0.0));
            assert_eq!(times(&found).len(), 1, "{end:e}, {begin:e}");
        }
    }

    #[test]
    fn operands_say_how_far_two_pieces_may_disagree() {
        // Values are wrong by 0.1 here, far more than the terms of the polynomials show.
        for (end, begin) in [(0.02, -0.03), (-0.02, 0.03), (0.02, 0.03), (-0.02, -0.03)] {
            let mut sides = Sides::on(true);
            let mut found = sides.events(&[1.0 + end, -1.0], 1.0, &|| 0.1);
            found.extend(sides.events(&[begin, -1.0], 1.0, &|| 0.1));
            assert_eq!(times(&found).len(), 1, "{end}, {begin}");
            let known = Sides::on(end > 0.0).events(&[begin, -1.0], 1.0, &|| 1e-3);
            assert_eq!(times(&known).len(), usize::from(begin > 0.0), "{end}, {begin}: it jumps");
        }
    }

    #[test]
    fn a_jump_between_two_pieces_is_no_crossing() {
        let mut sides = Sides::on(true);
        assert_eq!(sides.events(&[2.0, -1.0], 1.0, &|| 1e-3), []);
        assert_eq!(sides.events(&[-1.0, -1.0], 1.0, &|| 1e-3), [], "from 1 to -1");
        assert_eq!(sides.events(&[-2.0, 3.0], 1.0, &|| 1e-3).len(), 1, "up again");
        let ends = Ends::new(&[-1.0, -1.0], 1.0);
        assert!(!Sides::on(true).pass(&ends, 0), "left to the one that knows the doubt");
    }

    #[test]
    fn a_touch_within_the_doubt_is_a_tangency() {
        let beside = with_roots(&[0.4, 0.41]);
        let touch = Sides::default().events(&beside, 1.0, &|| 1e-3);
        assert!(matches!(touch[..], [Event::Tangency { .. }]), "{touch:?}");
        assert_eq!(times(&Sides::default().events(&beside, 1.0, &|| 1e-6)).len(), 2);
    }

    #[test]
    fn what_passes_has_no_events() {
        let (mut passed, mut stopped) = (0, 0);
        for turn in 0..2000u32 {
            let at = |k: u32| f64::from((turn * 37 + k * (61 + turn % 7)) % 101) / 40.0 - 1.25;
            // Steps are short compared with what is around them.
            let polynomial = with_roots(&[0, 1, 2, 3].map(|k| 3.0 * at(k)));
            let length = if turn.is_multiple_of(2) { 0.7 } else { -0.4 };
            let before = Sides::on(polynomial[0] > 0.0);
            let (mut quick, mut slow) = (before, before);
            let passes = quick.pass(&Ends::new(&polynomial, length), 0);
            let found = slow.events(&polynomial, length, &|| 0.0);
            if passes {
                assert_eq!(found, [], "{polynomial:?}");
                assert_eq!(quick.positive, slow.positive, "{polynomial:?}");
                passed += 1;
            } else {
                assert_eq!(quick.positive, before.positive, "left to the other: {polynomial:?}");
                stopped += 1;
            }
        }
        assert!(passed > 500 && stopped > 500, "{passed} and {stopped}");
    }

    #[test]
    fn a_root_at_the_beginning_is_not_found_again() {
        assert_eq!(events(&with_roots(&[0.0, 2.0]), 1.0), []);
        let next = events(&with_roots(&[0.0, 0.5]), 1.0);
        assert_eq!(times(&next).len(), 1, "the next one is: {next:?}");
    }
}
