//! Common factors of polynomials, tested on a random line.
//!
//! A common factor h of positive degree restricts to a common factor on a line z₀ + t u, of
//! positive degree unless the leading form of h vanishes at u modulo the prime. Four primes and
//! lines, drawn from the values, would all have to be so unlucky: the chance is below 2⁻¹⁶⁰ within
//! the limits on degree and height. Quotients are first brought over one denominator: its factors
//! vanish nowhere where the quotients have values.

use crate::graph::{Evaluator, Expr, Graph, Step, Tape};
use crate::number::prime::{CHECKS, Polynomial, Prime, PrimePolynomials, UNDEFINED};
use crate::number::{BinaryOperation, UnaryFunction};

use super::bounds::{Bounds, InputDistribution};
use super::digest::SeedDigest;
use super::rng::{ProofRng, ProofStream};
use super::trial::PRIMES;

/// Largest degree that is tried.
const LARGEST_DEGREE: f64 = 400.0;
/// Largest height that is tried: bits of the sum of the absolute coefficients.
const LARGEST_HEIGHT: f64 = 4000.0;

/// Whether the values are polynomials in the inputs as they stand.
pub fn are_polynomials(graph: &Graph, values: &[Expr]) -> bool {
    consist_of(graph, values, |step| match step {
        Step::Unary(function, _) => function == UnaryFunction::Neg,
        Step::Power(_, exponent) => exponent.to_integer().is_some_and(|n| n >= 0),
        _ => true,
    })
}

/// Whether the values are meromorphic functions of all complex inputs as they stand, so that one
/// that vanishes on an open set vanishes everywhere. Roots, moduli, logarithms and arcs may not.
pub fn is_single_valued(graph: &Graph, values: &[Expr]) -> bool {
    consist_of(graph, values, |step| match step {
        Step::Unary(function, _) => matches!(
            function,
            UnaryFunction::Neg
                | UnaryFunction::Recip
                | UnaryFunction::Exp
                | UnaryFunction::Sin
                | UnaryFunction::Cos
        ),
        Step::Power(_, exponent) => exponent.to_integer().is_some(),
        _ => true,
    })
}

fn consist_of(graph: &Graph, values: &[Expr], of: impl Fn(Step<'_>) -> bool) -> bool {
    let reached = graph.reached(values.iter().copied());
    let mut steps = graph.steps().zip(&reached).filter(|(_, reached)| **reached);
    steps.all(|(step, _)| !matches!(step, Step::Binary(BinaryOperation::Pow, ..)) && of(step))
}

/// Whether some values, quotients of polynomials in the inputs, are known to have no common factor
/// other than factors of their denominators.
pub fn are_coprime(graph: &Graph, values: &[Expr], seed: u64) -> bool {
    let is_rational = consist_of(graph, values, |step| step.is_rational());
    if !is_rational {
        return false;
    }
    let reached = graph.reached(values.iter().copied());
    let sources = vec![InputDistribution::Uniform; graph.inputs()];
    let bounds = Bounds::of(graph, &reached, &sources);
    let expanded = values.iter().map(|value| bounds.multiplied_out(graph.place(*value)));
    let Some(expanded) = expanded.collect::<Option<Vec<(f64, f64)>>>() else { return false };
    let largest = |(d, h): (f64, f64), (e, i): (f64, f64)| (d.max(e), h.max(i));
    let (degree, height) = expanded.into_iter().fold((0.0, 0.0), largest);
    if degree > LARGEST_DEGREE || height > LARGEST_HEIGHT {
        return false;
    }
    let mut rng =
        ProofRng::of(SeedDigest::of(seed, graph, &[values.to_vec()]), ProofStream::Factors);
    (0..PRIMES).all(|_| are_coprime_on_line(graph, values, degree as usize, &mut rng))
}

/// Whether the restrictions of the values to a random line, modulo a random prime, have no common
/// factor other than factors of their denominators.
fn are_coprime_on_line(graph: &Graph, values: &[Expr], degree: usize, rng: &mut ProofRng) -> bool {
    let modulus = rng.prime(&[], &[]);
    let m = &modulus;
    let [start, along] =
        [(); 2].map(|()| (0..graph.inputs()).map(|_| rng.element(m)).collect::<Vec<u64>>());
    let tape = Tape::new(graph, values);
    let mut evaluator = Evaluator::new(&tape, Prime::new([modulus]));
    let polynomial = are_polynomials(graph, values);
    let count = if polynomial { degree + 1 } else { 2 * degree + 2 + CHECKS };
    let points: Vec<u64> = (0..count as u64).map(|t| m.integer(t)).collect();
    let mut columns: Vec<Vec<u64>> = vec![Vec::new(); values.len()];
    for t in &points {
        let at = |(z, u): (&u64, &u64)| [m.add(*z, m.mul(*t, *u))];
        evaluator.run(&start.iter().zip(&along).map(at).collect::<Vec<[u64; 1]>>());
        for (column, block) in columns.iter_mut().zip(evaluator.outputs()) {
            if block[0] == UNDEFINED {
                return false;
            }
            column.push(block[0]);
        }
    }
    let ring = PrimePolynomials(modulus);
    let quotient = |column: &Vec<u64>| -> Option<(Polynomial, Polynomial)> {
        let points: Vec<(u64, u64)> = points.iter().copied().zip(column.iter().copied()).collect();
        match polynomial {
            true => Some((ring.through(&points).0, vec![m.one()])),
            false => ring.fraction(&points),
        }
    };
    let Some(quotients) = columns.iter().map(quotient).collect::<Option<Vec<_>>>() else {
        return false;
    };
    // Use the product of all denominators.
    let product = |a: &[u64], b: &[u64]| ring.product(a, b);
    let below = quotients.iter().fold(vec![m.one()], |all, (_, below)| product(&all, below));
    let above = quotients.iter().enumerate().map(|(own, (above, _))| {
        let others = quotients.iter().enumerate().filter(|(k, _)| *k != own);
        others.fold(above.clone(), |all, (_, (_, below))| product(&all, below))
    });
    let mut common = above.fold(Vec::new(), |a, b| ring.common(&a, &b));
    loop {
        let shared = ring.common(&common, &below);
        if shared.len() <= 1 || common.is_empty() {
            return common.len() == 1;
        }
        common = ring.divided(&common, &shared).0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::record;
    use num_dual::DualNum;

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
        assert!(!coprime(|x| vec![x[0].sqrt(), x[1]]), "roots are not looked at");
    }
    #[test]
    fn factors_of_denominators_do_no_harm() {
        assert!(coprime(|x| vec![x[0] / x[2], x[1] / (x[2] + 1.0)]), "x/z and y/(z + 1)");
        assert!(coprime(|x| vec![x[2].recip(), x[2] * x[2] * x[0]]), "1/z and z²x where z ≠ 0");
        assert!(!coprime(|x| vec![x[0] * x[1] / x[2], x[0] / (x[1] + 1.0)]), "x is common");
        let cylinder = |x: &[Expr]| x[1] * x[1] + x[2] * x[2] - 1.0;
        assert!(!coprime(|x| vec![cylinder(x) / x[0], cylinder(x) * x[1]]), "a cylinder");
        let product = |x: &[Expr]| x[2] * (x[2] - x[1]);
        assert!(!coprime(|x| vec![product(x) / x[2], product(x) * x[0]]), "x = y is left");
    }
}
