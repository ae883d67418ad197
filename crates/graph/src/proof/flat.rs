//! Factors whose slopes are 0 wherever they are.

use crate::graph::{Expr, Graph, Step};
use crate::number::UnaryFunction;
use crate::number::rational::Rational;

use super::factors::{Read, is_square};
use super::polynomial::{MOST_WORK, Polynomial};

/// Whether a value has a factor whose slopes are 0 at all its zeros, and which has zeros, as far as its form
/// shows: a power, a square that is written out, a sum of squares, 1 − cos u. Newton's method finds no zeros of it.
pub fn has_flat_factor(graph: &Graph, value: Expr) -> bool {
    let mut factors = Vec::new();
    for (place, step) in graph.factors_at(graph.place(value), |_| None) {
        match step {
            Step::Constant(_)
            | Step::Unary(UnaryFunction::Neg | UnaryFunction::Recip | UnaryFunction::Exp, _) => {}
            Step::Power(_, exponent) if *exponent > Rational::from(1) => return true,
            _ if factors.contains(&place) => return true,
            _ => factors.push(place),
        }
    }
    let is_flat = |value: Expr| is_square(graph, value) || has_flat_polynomial(graph, value);
    is_flat(value) || factors.len() > 1 && factors.into_iter().any(|place| is_flat(graph.at(place)))
}

/// Whether a quotient of polynomials in inputs and functions has a repeated factor above, or one that is a sum of
/// squares with zeros.
fn has_flat_polynomial(graph: &Graph, value: Expr) -> bool {
    let Some(Read { whole, .. }) = Read::of(graph, value) else { return false };
    let factors = whole.above.factors();
    let one = Polynomial::of_term(&Rational::from(1), []);
    let product = factors.iter().try_fold(one, |all, own| own.times(&all, &mut { MOST_WORK }));
    let is_repeated = product.is_some_and(|own| own.monic() != whole.above.monic());
    let is_flat = |squares: Vec<Polynomial>| squares.iter().all(|own| own.number().is_none());
    is_repeated || factors.iter().any(|own| own.squares().is_some_and(is_flat))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::record;
    use num_dual::DualNum;

    fn is_flat(build: impl FnOnce(Expr, Expr) -> Expr) -> bool {
        let (graph, value) = record(2, |x| build(x[0], x[1])).expect("records");
        has_flat_factor(&graph, value)
    }

    #[test]
    fn factors_without_slopes_are_seen_by_their_form() {
        assert!(is_flat(|x, y| (x - y).powi(2) * (y * y * y - y * 3.0 + 1.0)), "(x − y)²");
        assert!(is_flat(|x, y| (x * x - x * y * 2.0 + y * y) * (y.powi(5) + x)), "written out");
        assert!(is_flat(|x, y| (x * x + y * y) * (y.powi(5) + x)), "a sum of squares");
        let curve = |x: Expr, y: Expr| y.powi(5) + y + x.powi(5) + x - 1.0;
        assert!(is_flat(|x, y| (x * x + y * y) * curve(x, y)), "of degree 7");
        assert!(is_flat(|x, y| (-x.cos() + 1.0) * (y.powi(5) + x)), "1 − cos x");
        assert!(is_flat(|x, y| (x.sqrt() - y).powi(2) * (y.powi(5) + x)), "with a root");
        assert!(
            is_flat(|x, y| ((x * 2.0).exp() - x.exp() * 2.0 + 1.0) * (y.powi(5) + x)),
            "(eˣ − 1)²"
        );
        assert!(!is_flat(|x, y| (x * x + 1.0) * (y.powi(5) + x)), "x² + 1 is never 0");
        assert!(!is_flat(|x, y| (x * y - 1.0) * (y.powi(5) + x)), "two curves");
        assert!(!is_flat(|x, y| x.powi(5) + y.powi(5) + x - 1.0), "a curve");
        assert!(!is_flat(|x, y| x.exp() * (x.powi(5) + y)), "eˣ is never 0");
    }
}
