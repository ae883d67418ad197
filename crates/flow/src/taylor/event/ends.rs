//! Ends of pieces, and bounds of the terms between: what decides that a function has no zero on a piece.

use crate::taylor::number::SeriesNumber;

/// Number of last terms that are looked at: all but the last two may be left out by a gap, as in x⁴.
const TAILS: usize = 6;

/// Values of functions at the ends of their pieces, a piece in each lane. They decide whether a
/// function can vanish.
pub struct Ends<T> {
    pub(super) length: T,
    /// Largest term of the polynomial.
    pub(super) largest: T,
    pub(super) first: T,
    pub(super) last: T,
    /// Derivatives at the ends.
    pub(super) rates: [T; 2],
    /// The last terms of the polynomial.
    tails: [T; TAILS],
    /// Whether zeros, turns and bends are excluded.
    pub(super) shape: Shape<T>,
}

/// Bounds of terms t_k = |c_k| h^k of a polynomial Σ c_k τ^k for |τ| ≤ h.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shape<T> {
    /// t_0, t_1, 2 t_2
    first: [T; 3],
    /// Sums of the terms beyond these of the function, h times its slope, h² times its bend.
    further: [T; 3],
}

impl<T: SeriesNumber> Shape<T> {
    pub(super) const NONE: Self = Self { first: [T::ZERO; 3], further: [T::ZERO; 3] };

    /// Adds the term of order n.
    #[inline(always)]
    pub(super) fn add(&mut self, n: usize, term: T) {
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
    pub(super) fn is_simple(&self, lane: usize) -> bool {
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
        tails: [T::ZERO; TAILS],
        shape: Shape::NONE,
    };

    /// Evaluates polynomials at the ends of their pieces.
    #[inline(always)]
    pub fn new(polynomial: &[T], length: T) -> Self {
        let size = T::ZERO.larger(length);
        let (mut power, mut largest) = (T::ONE, T::ZERO);
        let (mut tails, mut shape) = ([T::ZERO; TAILS], Shape::NONE);
        for (n, coefficient) in polynomial.iter().enumerate() {
            let term = T::ZERO.larger(*coefficient * power);
            tails.rotate_left(1);
            (tails[TAILS - 1], largest) = (term, largest.larger(term));
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

    /// Whether bounds of the terms exclude that a lane's function vanishes, or turns, or bends.
    pub fn is_simple(&self, lane: usize) -> bool {
        self.shape.is_simple(lane)
    }

    /// Largest term of a lane's polynomial.
    pub fn largest(&self, lane: usize) -> f64 {
        self.largest.lane(lane).leading()
    }

    /// Part of a lane's piece after which the last two of its `count` terms that are not 0 are below
    /// e^(−rate n), n their order, relative to the largest term; 1 if they are so now.
    pub fn known_share(&self, lane: usize, count: usize, rate: f64) -> f64 {
        let at = |value: T| value.lane(lane).leading();
        let largest = at(self.largest);
        let orders = (0..count).rev();
        let tails = self.tails.iter().rev().map(|tail| at(*tail)).zip(orders);
        let share = tails.filter(|(tail, _)| *tail != 0.0).take(2).map(|(tail, n)| {
            let limit = libm::exp(-rate * n as f64);
            match n > 0 && tail > largest * limit && largest > 0.0 {
                true => 0.95 * libm::pow(largest * limit / tail, 1.0 / n as f64),
                false => 1.0,
            }
        });
        share.filter(|share| share.is_finite()).fold(1.0, f64::min)
    }
}
