//! Events: zeros of a function of the state within a piece of a motion.
//!
//! The function is known as a polynomial on each piece. A piece on which bounds of its terms exclude
//! zeros, turns or bends is simple; others are halved. On a simple piece the sign at the ends, and at
//! the extremum between them if there is one, brackets each root; Newton's method finds it, guarded by
//! bisection. An extremum whose value is 0 up to rounding is a tangency, not a crossing. Where a modulus in
//! the function turns its sign, the two pieces that meet decide together.

mod ends;
mod pieces;
mod roots;
mod sides;
mod turn;

pub use ends::Ends;
pub(crate) use roots::{extremum, turns};
pub use sides::Sides;
pub(crate) use sides::starts_positive;

use crate::taylor::number::SeriesNumber;

/// Values below this many roundings of the largest term count as 0.
const ROUNDINGS: f64 = 256.0;

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

impl<T: Copy> Event<T> {
    /// Time after the beginning of the piece.
    pub fn after(self) -> T {
        match self {
            Event::Crossing { after, .. } | Event::Tangency { after } => after,
        }
    }
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

/// Largest term of a polynomial on a piece.
pub(crate) fn size<T: SeriesNumber>(polynomial: &[T], length: T) -> f64 {
    let mut power = 1.0;
    let mut largest: f64 = 0.0;
    for coefficient in polynomial {
        largest = largest.max(coefficient.leading().abs() * power);
        power *= length.leading().abs();
    }
    largest
}
