//! Sines and cosines of sums with arctangents.
//!
//! The cosine and the sine of E = R + Σ n_j atan u_j are the parts of the complex number e^(iR) Π z_j^n_j,
//! z_j = (1 + i u_j)/√(1 + u_j²), at all real u_j.

use rustc_hash::FxHashMap;

use crate::graph::{Expr, Fault, Graph, Step, record};
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};
use crate::scalar::Scalar;

use super::rewrite::Rewrite;

/// Largest multiple of an arctangent that is written out.
const LARGEST_MULTIPLE: i64 = 16;
/// Largest number of terms of a sum that is taken apart.
const MOST_TERMS: usize = 64;

/// An angle as a sum with arctangents.
#[derive(Clone, Debug)]
pub struct Angle {
    /// Places of the u_j with the n_j.
    arctangents: Vec<(usize, i64)>,
    /// Places of the terms of R with their multiples.
    rest: Vec<(usize, Rational)>,
}

/// Lists the sums with arctangents whose sines and cosines some values need.
pub fn angles(graph: &Graph, values: &[Expr]) -> Vec<Rewrite> {
    let rewrite = |argument: usize| {
        Angle::of(graph, argument).map(|angle| Rewrite::Angle { argument, angle })
    };
    arguments(graph, values).into_iter().filter_map(rewrite).collect()
}

/// Records values anew, with sines and cosines of sums with arctangents written out.
pub fn without_arctangents(graph: &Graph, values: &[Expr]) -> Result<(Graph, Vec<Expr>), Fault> {
    let sums: FxHashMap<usize, Angle> = arguments(graph, values)
        .into_iter()
        .filter_map(|argument| Some((argument, Angle::of(graph, argument)?)))
        .collect();
    let reached = graph.reached(values.iter().copied());
    record(graph.inputs(), |inputs| {
        let replayed = graph.replay(&reached, inputs, |_, step, replayed| match step {
            Step::Unary(function @ (UnaryFunction::Sin | UnaryFunction::Cos), a) => {
                sums.get(&a)?.value(function == UnaryFunction::Sin, replayed)
            }
            _ => None,
        });
        let value = |value: &Expr| replayed[graph.place(*value)].unwrap_or_else(Expr::undefined);
        values.iter().map(value).collect()
    })
}

/// Lists the places of the arguments of sines and cosines that some values need.
pub fn arguments(graph: &Graph, values: &[Expr]) -> Vec<usize> {
    let reached = graph.reached(values.iter().copied());
    let mut found: Vec<usize> = Vec::new();
    for (step, _) in graph.steps().zip(&reached).filter(|(_, reached)| **reached) {
        if let Step::Unary(UnaryFunction::Sin | UnaryFunction::Cos, a) = step
            && !found.contains(&a)
        {
            found.push(a);
        }
    }
    found
}

impl Angle {
    /// Takes a sum apart; `None` if it contains no arctangents.
    fn of(graph: &Graph, place: usize) -> Option<Self> {
        let mut found = Self { arctangents: Vec::new(), rest: Vec::new() };
        let mut open = vec![(place, Rational::from(1))];
        while let Some((at, factor)) = open.pop() {
            if found.arctangents.len() + found.rest.len() + open.len() > MOST_TERMS {
                return None;
            }
            let number = |place: usize| match graph.step(place) {
                Step::Constant(value) => Some(value),
                _ => None,
            };
            match graph.step(at) {
                Step::Binary(BinaryOperation::Add, a, b) => {
                    open.extend([(b, factor.clone()), (a, factor)]);
                }
                Step::Binary(BinaryOperation::Sub, a, b) => {
                    open.extend([(b, -&factor), (a, factor)]);
                }
                Step::Unary(UnaryFunction::Neg, a) => open.push((a, -&factor)),
                Step::Binary(BinaryOperation::Mul, a, b) if number(a).is_some() => {
                    open.push((b, &factor * number(a)?));
                }
                Step::Binary(BinaryOperation::Mul, a, b) if number(b).is_some() => {
                    open.push((a, &factor * number(b)?));
                }
                // Multiples of atan 1 are quarter turns.
                Step::Unary(UnaryFunction::Atan, a) if number(a).is_none() => {
                    let multiple = factor.to_integer().filter(|n| n.abs() <= LARGEST_MULTIPLE);
                    match multiple {
                        Some(multiple) => found.arctangents.push((a, multiple)),
                        None => found.rest.push((at, factor)),
                    }
                }
                _ => found.rest.push((at, factor)),
            }
        }
        (!found.arctangents.is_empty()).then_some(found)
    }

    /// Records the sine or the cosine, from the values at places.
    pub fn value(&self, sine: bool, values: &[Option<Expr>]) -> Option<Expr> {
        let one = Expr::rational(&Rational::from(1));
        let mut point = [one, Expr::rational(&Rational::from(0))];
        if !self.rest.is_empty() {
            let mut angle = Expr::rational(&Rational::from(0));
            for (place, factor) in &self.rest {
                angle += values[*place]? * Expr::rational(factor);
            }
            point = [angle.apply(UnaryFunction::Cos), angle.apply(UnaryFunction::Sin)];
        }
        let turned = |[a, b]: [Expr; 2], [c, s]: [Expr; 2]| [a * c - b * s, a * s + b * c];
        for (place, multiple) in &self.arctangents {
            let u = values[*place]?;
            let u = if *multiple < 0 { -u } else { u };
            let below = one + u * u;
            // z², which has no root.
            let double = [(one - u * u) / below, (u + u) / below];
            for _ in 0..multiple.abs() / 2 {
                point = turned(point, double);
            }
            if multiple % 2 != 0 {
                let root = below.apply(UnaryFunction::Sqrt);
                point = turned(point, [one / root, u / root]);
            }
        }
        Some(point[usize::from(sine)])
    }
}
