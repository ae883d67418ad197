//! Whether polynomials have a common factor, seen on a random line.
//!
//! A common factor h of positive degree becomes a common factor of their restrictions to a line z₀ +
//! t u, of positive degree unless the leading form of h vanishes at u. Restrictions without a common
//! factor prove that there is none.

use crate::graph::{Evaluator, Expr, Graph, Step, Tape};
use crate::number::prime::{Modulus, Prime, UNDEFINED};
use crate::number::{Function, Operation};

use super::bounds::{Bounds, Source};
use super::chance::Chance;

/// Larger degrees are given up.
const LARGEST_DEGREE: f64 = 400.0;
/// A stream for lines, apart from those of proofs.
const LINES: u64 = 30;

/// Whether it is known that some values, polynomials in the inputs, have no common factor.
pub fn are_coprime(graph: &Graph, values: &[Expr], seed: u64) -> bool {
    let reached = graph.reached(values.iter().copied());
    let is_polynomial = |step: Step<'_>| match step {
        Step::Constant(_) | Step::Input(_) | Step::Unary(Function::Neg, _) => true,
        Step::Unary(..) => false,
        Step::Binary(operation, ..) => operation != Operation::Pow,
        Step::Power(_, exponent) => exponent.to_integer().is_some_and(|n| n >= 0),
    };
    let mut steps = graph.steps().zip(&reached).filter(|(_, reached)| **reached);
    if !steps.all(|(step, _)| is_polynomial(step)) {
        return false;
    }
    let sources = vec![Source::Uniform; graph.inputs()];
    let bounds = Bounds::of(graph, &reached, &sources);
    let degrees = values.iter().map(|value| bounds.at(graph.place(*value)).map(|b| b.degree));
    let Some(degrees) = degrees.collect::<Option<Vec<f64>>>() else { return false };
    let degree = degrees.into_iter().fold(0.0, f64::max);
    if degree > LARGEST_DEGREE {
        return false;
    }
    let mut chance = Chance::new(seed, LINES);
    let modulus = chance.prime(&[], &[]);
    let [start, along] = [(); 2].map(|()| {
        (0..graph.inputs()).map(|_| chance.element(&modulus)).collect::<Vec<u64>>()
    });
    let tape = Tape::new(graph, values);
    let mut evaluator = Evaluator::new(&tape, Prime::new([modulus]));
    let points: Vec<u64> = (0..=degree as u64).map(|t| modulus.integer(t)).collect();
    let mut columns: Vec<Vec<u64>> = vec![Vec::new(); values.len()];
    for t in &points {
        let at = |(z, u): (&u64, &u64)| [modulus.add(*z, modulus.mul(*t, *u))];
        evaluator.run(&start.iter().zip(&along).map(at).collect::<Vec<[u64; 1]>>());
        for (column, block) in columns.iter_mut().zip(evaluator.outputs()) {
            if block[0] == UNDEFINED {
                return false;
            }
            column.push(block[0]);
        }
    }
    let polynomials = columns.iter().map(|column| interpolated(&modulus, &points, column));
    let common = polynomials.fold(Vec::new(), |a, b| common_divisor(&modulus, a, b));
    common.len() == 1
}

/// The coefficients of the polynomial with these values, the constant one first.
fn interpolated(m: &Modulus, points: &[u64], values: &[u64]) -> Vec<u64> {
    // Newton's divided differences, multiplied out from the last one.
    let mut differences = values.to_vec();
    for order in 1..points.len() {
        for k in (order..points.len()).rev() {
            let rise = m.sub(differences[k], differences[k - 1]);
            let run = m.sub(points[k], points[k - order]);
            differences[k] = m.mul(rise, m.inverse(run));
        }
    }
    let mut polynomial = Vec::new();
    for (difference, point) in differences.iter().zip(points).rev() {
        // p (t − point) + difference
        let mut next = vec![0; polynomial.len() + 1];
        for (k, coefficient) in polynomial.iter().enumerate() {
            next[k + 1] = m.add(next[k + 1], *coefficient);
            next[k] = m.sub(next[k], m.mul(*coefficient, *point));
        }
        next[0] = m.add(next[0], *difference);
        polynomial = next;
    }
    trimmed(polynomial)
}

fn trimmed(mut polynomial: Vec<u64>) -> Vec<u64> {
    while polynomial.last() == Some(&0) {
        polynomial.pop();
    }
    polynomial
}

/// Euclid's algorithm; the zero polynomial has no coefficients.
fn common_divisor(m: &Modulus, mut a: Vec<u64>, mut b: Vec<u64>) -> Vec<u64> {
    while let Some(leading) = b.last() {
        let inverse = m.inverse(*leading);
        while a.len() >= b.len() {
            let factor = a.last().map_or(0, |last| m.mul(*last, inverse));
            let shift = a.len() - b.len();
            for (k, coefficient) in b.iter().enumerate() {
                a[shift + k] = m.sub(a[shift + k], m.mul(factor, *coefficient));
            }
            a = trimmed(a);
        }
        (a, b) = (b, a);
    }
    a
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::record;

    fn coprime(build: impl FnOnce(&[Expr]) -> Vec<Expr>) -> bool {
        let (graph, values) = record(3, build).expect("records");
        are_coprime(&graph, &values, 1)
    }

    #[test]
    fn common_factors_are_seen() {
        assert!(coprime(|x| vec![x[0], x[1]]), "x and y");
        assert!(!coprime(|x| vec![x[0] * x[1], x[0] * x[2]]), "xy and xz");
        assert!(coprime(|x| vec![x[0] * x[1], x[0] * x[2], x[1] + 1.0]), "with y + 1");
        let cylinder = |x: &[Expr]| x[1] * x[1] + x[2] * x[2] - 1.0;
        assert!(!coprime(|x| vec![cylinder(x), x[0] - x[0]]), "0 is divisible by all");
        assert!(!coprime(|x| vec![cylinder(x) * x[0], cylinder(x) * (x[1] + 2.0)]));
        assert!(coprime(|x| vec![cylinder(x), x[1] - 1.0]), "a line that touches it");
        assert!(coprime(|x| vec![x[0] * 0.0 + 3.0, x[1]]), "a number has no factor");
        assert!(!coprime(|x| vec![x[0].recip(), x[1]]), "quotients are not looked at");
    }
}
