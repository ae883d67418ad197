//! Simple pieces: those on which a polynomial has no zero, does not turn, or bends to one side alone.

use super::ends::Shape;

/// Largest number of times that a piece is halved.
const HALVINGS: usize = 12;

/// Ends of simple pieces from 0 to `length`, in order.
pub(super) fn simple_pieces(polynomial: &[f64], length: f64) -> Vec<f64> {
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
