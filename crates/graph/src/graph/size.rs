//! Sizes of recorded values before anything cancels in their sums.

use super::{Expr, Step, with_graph};
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};
use crate::scalar::Scalar;

/// Operation of a step, as far as its size follows from those of its arguments.
enum Made {
    Sum(usize, usize),
    Product(usize, usize),
    Negative(usize),
    Power(usize, Rational),
    Other,
}

/// Returns the sum of the squares of the terms that are added to make each value: of a sum those of its
/// parts, of a product the product of those of its factors, of anything else its square.
pub fn squares_of_terms(values: &[Expr]) -> Vec<Expr> {
    let (made, places): (Vec<Option<(Expr, Made)>>, Vec<usize>) = with_graph(|graph| {
        let reached = graph.reached(values.iter().copied());
        let of = |place: usize| match graph.step(place) {
            Step::Binary(BinaryOperation::Add | BinaryOperation::Sub, a, b) => Made::Sum(a, b),
            Step::Binary(BinaryOperation::Mul, a, b) => Made::Product(a, b),
            Step::Unary(UnaryFunction::Neg, a) => Made::Negative(a),
            Step::Power(a, exponent)
                if !exponent.is_negative() && exponent.to_integer().is_some() =>
            {
                Made::Power(a, exponent.clone())
            }
            _ => Made::Other,
        };
        let end = reached.iter().rposition(|reached| *reached).map_or(0, |last| last + 1);
        let made = (0..end).map(|place| reached[place].then(|| (graph.at(place), of(place))));
        (made.collect(), values.iter().map(|value| graph.place(*value)).collect())
    });
    let mut sizes: Vec<Expr> = Vec::with_capacity(made.len());
    for step in made {
        let size = match step {
            None => Expr::from(0.0),
            Some((_, Made::Sum(a, b))) => sizes[a] + sizes[b],
            Some((_, Made::Product(a, b))) => sizes[a] * sizes[b],
            Some((_, Made::Negative(a))) => sizes[a],
            Some((_, Made::Power(a, exponent))) => sizes[a].power(&exponent),
            Some((value, Made::Other)) => value * value,
        };
        sizes.push(size);
    }
    places.into_iter().map(|place| sizes[place]).collect()
}

#[cfg(test)]
mod tests {
    use super::super::{Evaluator, Tape, record};
    use super::*;
    use crate::number::float::Float;
    use num_dual::DualNum;

    #[test]
    fn what_cancels_counts() {
        let (graph, sizes) = record(2, |x| {
            let sum = x[0] + x[1];
            let zero = sum * sum - x[0] * x[0] - x[0] * x[1] * Expr::from(2.0) - x[1] * x[1];
            squares_of_terms(&[zero * x[1], x[0].sqrt()])
        })
        .expect("records");
        let tape = Tape::new(&graph, &sizes);
        let mut evaluator = Evaluator::new(&tape, Float::<1>);
        evaluator.run(&[[1.0], [2.0]]);
        let found: Vec<f64> = evaluator.outputs().map(|value| value[0]).collect();
        // ((1 + 4)² + 1 + 4·4 + 16)·4, and the root is one term.
        assert_eq!(found, [232.0, 1.0]);
    }
}
