//! Hyperbolic tangents in the steps of a program, which are written by the language's own function: the
//! quotient of exponential functions has no value in doubles from an argument of 710 on.

use liouville::graph::{Expr, Graph, Step};
use liouville::number::rational::Rational;
use liouville::number::{BinaryOperation, UnaryFunction};

/// Argument u of (eᵘ − e⁻ᵘ)/(eᵘ + e⁻ᵘ) at a place.
pub fn tangent(graph: &Graph, place: usize) -> Option<usize> {
    let Step::Binary(BinaryOperation::Mul, a, b) = graph.step(place) else { return None };
    [(a, b), (b, a)].into_iter().find_map(|(above, inverse)| {
        let Step::Unary(UnaryFunction::Recip, below) = graph.step(inverse) else { return None };
        let ((c, above), (d, below)) = (scaled(graph, above), scaled(graph, below));
        let Step::Binary(BinaryOperation::Sub, p, q) = graph.step(above) else { return None };
        let Step::Binary(BinaryOperation::Add, r, s) = graph.step(below) else { return None };
        let is_same = c == d && ((p, q) == (r, s) || (p, q) == (s, r));
        let (u, v) = (exponent(graph, p)?, exponent(graph, q)?);
        (is_same && are_opposite(graph, u, v)).then_some(u)
    })
}

/// A step as a constant times another.
fn scaled(graph: &Graph, place: usize) -> (Rational, usize) {
    if let Step::Binary(BinaryOperation::Mul, a, b) = graph.step(place) {
        for (constant, other) in [(a, b), (b, a)] {
            if let Step::Constant(value) = graph.step(constant) {
                return (value.clone(), other);
            }
        }
    }
    (Rational::from(1), place)
}

fn exponent(graph: &Graph, place: usize) -> Option<usize> {
    match graph.step(place) {
        Step::Unary(UnaryFunction::Exp, u) => Some(u),
        _ => None,
    }
}

fn are_opposite(graph: &Graph, u: usize, v: usize) -> bool {
    let is_negated =
        |a: usize, b: usize| matches!(graph.step(a), Step::Unary(UnaryFunction::Neg, x) if x == b);
    match (graph.step(u), graph.step(v)) {
        (Step::Binary(BinaryOperation::Sub, p, q), Step::Binary(BinaryOperation::Sub, r, s))
            if (p, q) == (s, r) =>
        {
            true
        }
        _ => is_negated(u, v) || is_negated(v, u),
    }
}

/// Places that a step is written from: those of its arguments, or the argument of a tangent.
pub fn parts(graph: &Graph, place: usize, has_tangent: bool) -> Vec<usize> {
    match tangent(graph, place).filter(|_| has_tangent) {
        Some(u) => vec![u],
        None => graph.step(place).arguments().collect(),
    }
}

/// Places from which some values are written.
pub fn reached(graph: &Graph, values: impl Iterator<Item = Expr>, has_tangent: bool) -> Vec<bool> {
    let mut reached = vec![false; graph.len()];
    values.for_each(|value| reached[graph.place(value)] = true);
    for place in (0..graph.len()).rev() {
        if reached[place] {
            parts(graph, place, has_tangent).into_iter().for_each(|part| reached[part] = true);
        }
    }
    reached
}
