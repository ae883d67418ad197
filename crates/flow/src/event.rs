//! Events: zeros of a function of the state within a piece of a motion.
//!
//! The function is known as a polynomial on each piece. A piece on which bounds of its terms exclude
//! zeros, turns or bends is simple; others are halved. On a simple piece the sign at the ends, and at
//! the extremum between them if there is one, brackets each root; Newton's method finds it, guarded by
//! bisection. An extremum whose value is 0 up to rounding is a tangency, not a crossing.

use super::number::SeriesNumber;

/// Iteration limit, above the count of bisection alone.
const MAX_STEPS: usize = 200;
/// Values below this many roundings of the largest term count as 0.
const ROUNDINGS: f64 = 256.0;

/// Largest number of times that a piece is halved.
const HALVINGS: usize = 12;

/// A zero of a function within a piece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Event<T> {
    /// The function changes its sign.
    Crossing {
        /// Time after the beginning of the piece.
        after: T,
        /// Whether the function grows with time there.
        rising: bool,
    },
    /// The function touches 0 and turns back.
    Tangency {
        /// Time after the beginning of the piece.
        after: T,
    },
}

/// Evaluates a polynomial and its derivative.
pub fn value<T: SeriesNumber>(polynomial: &[T], at: T) -> (T, T) {
    let (mut sum, mut slope) = (T::ZERO, T::ZERO);
    for coefficient in polynomial.iter().rev() {
        slope = slope * at + sum;
        sum = sum * at + *coefficient;
    }
    (sum, slope)
}

/// Coefficients of the derivative of a polynomial.
pub fn slope<T: SeriesNumber>(polynomial: &[T]) -> Vec<T> {
    let terms = polynomial.iter().enumerate().skip(1);
    terms.map(|(n, coefficient)| T::float(n as f64) * *coefficient).collect()
}

/// Values of functions at the ends of their pieces, a piece in each lane. They decide whether a
/// function can vanish.
pub struct Ends<T> {
    length: T,
    /// Largest term of the polynomial.
    largest: T,
    first: T,
    last: T,
    /// Derivatives at the ends.
    rates: [T; 2],
    /// The last two terms of the polynomial.
    tails: [T; 2],
    /// Whether zeros, turns and bends are excluded.
    shape: Shape<T>,
}

/// Bounds of terms t_k = |c_k| h^k of a polynomial Σ c_k τ^k for |τ| ≤ h.
#[derive(Clone, Copy, Debug)]
struct Shape<T> {
    /// t_0, t_1, 2 t_2
    first: [T; 3],
    /// Sums of the terms beyond these of the function, h times its slope, h² times its bend.
    further: [T; 3],
}

impl<T: SeriesNumber> Shape<T> {
    const NONE: Self = Self { first: [T::ZERO; 3], further: [T::ZERO; 3] };

    /// Adds the term of order n.
    #[inline(always)]
    fn add(&mut self, n: usize, term: T) {
        for (k, weight) in [1, n, n * n.saturating_sub(1)].into_iter().enumerate() {
            let weighted = T::float(weight as f64) * term;
            match n {
                _ if n == k => self.first[k] = weighted,
                _ if n > k => self.further[k] = self.further[k] + weighted,
                _ => {}
            }
        }
    }

    /// Whether a function has no zero, does not turn, or bends to one side alone.
    fn is_simple(&self, lane: usize) -> bool {
        let at = |value: T| value.lane(lane).leading();
        let pairs = self.first.iter().zip(&self.further);
        pairs.into_iter().any(|(first, further)| at(*first) > at(*further))
    }
}

impl<T: SeriesNumber> Ends<T> {
    /// Ends of no pieces.
    pub const NONE: Self = Self {
        length: T::ZERO,
        largest: T::ZERO,
        first: T::ZERO,
        last: T::ZERO,
        rates: [T::ZERO; 2],
        tails: [T::ZERO; 2],
        shape: Shape::NONE,
    };

    /// Evaluates polynomials at the ends of their pieces.
    #[inline(always)]
    pub fn new(polynomial: &[T], length: T) -> Self {
        let size = T::ZERO.larger(length);
        let (mut power, mut largest) = (T::ONE, T::ZERO);
        let (mut tails, mut shape) = ([T::ZERO; 2], Shape::NONE);
        for (n, coefficient) in polynomial.iter().enumerate() {
            let term = T::ZERO.larger(*coefficient * power);
            (tails, largest) = ([tails[1], term], largest.larger(term));
            shape.add(n, term);
            power = power * size;
        }
        let (mut last, mut rate) = (T::ZERO, T::ZERO);
        for (n, coefficient) in polynomial.iter().enumerate().rev() {
            last = last * length + *coefficient;
            if n > 0 {
                rate = rate * length + T::float(n as f64) * *coefficient;
            }
        }
        let rates = [polynomial[1], rate];
        Self { length, largest, first: polynomial[0], last, rates, tails, shape }
    }

    /// Part of a lane's piece after which the last two of its `count` terms are within their limits,
    /// relative to the largest term; 1 if they are so now.
    pub fn known_share(&self, lane: usize, count: usize, limits: [f64; 2]) -> f64 {
        let at = |value: T| value.lane(lane).leading();
        let largest = at(self.largest);
        let tails = self.tails.map(at).into_iter().zip(limits).zip(count.saturating_sub(2)..);
        let share = tails.map(|((tail, limit), n)| match tail > largest * limit && largest > 0.0 {
            true => 0.95 * libm::pow(largest * limit / tail, 1.0 / n as f64),
            false => 1.0,
        });
        share.filter(|share| share.is_finite()).fold(1.0, f64::min)
    }
}

/// Side of 0 on which a function was last seen, from piece to piece.
///
/// A piece that ends at a root up to rounding leaves it to the next one, which begins there: the
/// side that is remembered decides, so that no crossing is missed or counted twice.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sides {
    positive: Option<bool>,
}

impl Sides {
    /// The sides of a function that is known to come from this side.
    pub fn on(positive: bool) -> Self {
        Self { positive: Some(positive) }
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
            || length == 0.0
            || begin != end
            || turns(first_rate, last_rate, length, begin)
        {
            return false;
        }
        self.positive = Some(end);
        true
    }

    /// Finds the events between 0 and `length`, except at 0 if the motion starts there.
    pub fn events<T: SeriesNumber<One = T>>(
        &mut self,
        polynomial: &[T],
        length: T,
    ) -> Vec<Event<T>> {
        if length.leading() == 0.0 {
            return Vec::new();
        }
        let rounding = size(polynomial, length) * ROUNDINGS * T::EPSILON;
        let first = polynomial[0].leading();
        let begin = match self.positive {
            _ if first.abs() > rounding => first > 0.0,
            Some(positive) => positive,
            None => starts_positive(polynomial, rounding, length),
        };
        let end = value(polynomial, length).0.leading() > 0.0;
        self.positive = Some(end);
        let leading: Vec<f64> = polynomial.iter().map(|own| own.leading()).collect();
        let (mut from, mut side) = (T::ZERO, begin);
        let mut events = Vec::new();
        for to in simple_pieces(&leading, length.leading()) {
            let is_last = to == length.leading();
            let to = if is_last { length } else { T::float(to) };
            let there = if is_last { end } else { value(polynomial, to).0.leading() > 0.0 };
            events.extend(between(polynomial, [from, to], [side, there], rounding));
            (from, side) = (to, there);
        }
        events
    }
}

/// Ends of simple pieces from 0 to `length`, in order.
fn simple_pieces(polynomial: &[f64], length: f64) -> Vec<f64> {
    let mut ends = Vec::new();
    let mut open = vec![(0.0, length, 0)];
    while let Some((from, to, halvings)) = open.pop() {
        let middle = 0.5 * (from + to);
        if halvings == HALVINGS || middle == from || middle == to || is_simple(polynomial, from, to)
        {
            ends.push(to);
        } else {
            open.push((middle, to, halvings + 1));
            open.push((from, middle, halvings + 1));
        }
    }
    ends
}

/// Whether bounds about the middle of a piece show that it is simple.
fn is_simple(polynomial: &[f64], from: f64, to: f64) -> bool {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from).abs());
    let mut about = polynomial.to_vec();
    for k in 0..about.len() {
        for n in (k..about.len() - 1).rev() {
            about[n] += middle * about[n + 1];
        }
    }
    let (mut shape, mut power) = (Shape::<f64>::NONE, 1.0);
    for (n, coefficient) in about.iter().enumerate() {
        shape.add(n, (coefficient * power).abs());
        power *= half;
    }
    shape.is_simple(0)
}

/// Events on a simple piece, with the signs at its ends.
fn between<T: SeriesNumber<One = T>>(
    polynomial: &[T],
    [from, to]: [T; 2],
    [begin, end]: [bool; 2],
    rounding: f64,
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
    if depth.abs() <= rounding {
        return vec![Event::Tangency { after: extremum }];
    }
    if (depth > 0.0) == begin {
        return Vec::new();
    }
    vec![
        crossing(root(polynomial, from, extremum, begin), !begin),
        crossing(root(polynomial, extremum, to, !begin), begin),
    ]
}

/// Whether a function with these rates at its ends comes nearer to 0 from a side, and turns back.
fn turns(first: f64, last: f64, length: f64, begin: bool) -> bool {
    let leaves = ((first > 0.0) == (length > 0.0)) == begin;
    (first > 0.0) != (last > 0.0) && !leaves
}

/// Sign of a function just after a beginning at which it vanishes: that of the first term that is
/// not rounding.
fn starts_positive<T: SeriesNumber>(polynomial: &[T], rounding: f64, length: T) -> bool {
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

/// Largest term of a polynomial on a piece.
pub(super) fn size<T: SeriesNumber>(polynomial: &[T], length: T) -> f64 {
    let mut power = 1.0;
    let mut largest: f64 = 0.0;
    for coefficient in polynomial {
        largest = largest.max(coefficient.leading().abs() * power);
        power *= length.leading().abs();
    }
    largest
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
        Sides::default().events(polynomial, length)
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
            let mut found = sides.events(&[1.0 + end, -1.0], 1.0);
            found.extend(sides.events(&[begin, -1.0], 1.0));
            assert_eq!(times(&found).len(), 1, "{end:e}, {begin:e}");
        }
    }

    #[test]
    fn what_passes_has_no_events() {
        let (mut passed, mut stopped) = (0, 0);
        for turn in 0..2000u32 {
            let at = |k: u32| f64::from((turn * 37 + k * (61 + turn % 7)) % 101) / 40.0 - 1.25;
            // Steps are short compared with what is around them.
            let polynomial = with_roots(&[0, 1, 2, 3].map(|k| 3.0 * at(k)));
            let length = if turn.is_multiple_of(2) { 0.7 } else { -0.4 };
            let (mut quick, mut slow) = (Sides::default(), Sides::default());
            let passes = quick.pass(&Ends::new(&polynomial, length), 0);
            let found = slow.events(&polynomial, length);
            if passes {
                assert_eq!(found, [], "{polynomial:?}");
                assert_eq!(quick.positive, slow.positive, "{polynomial:?}");
                passed += 1;
            } else {
                assert_eq!(quick.positive, None, "left to the other: {polynomial:?}");
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
