//! Common factors of polynomials, tested on a random line.
//!
//! A common factor h of positive degree restricts to a common factor on a line z₀ + t u, of
//! positive degree unless the leading form of h vanishes at u modulo the prime. Four primes and
//! lines, drawn from the values, would all have to be so unlucky: the chance is below 2⁻¹⁶⁰ within
//! the limits on degree and height. Quotients are first brought over one denominator: its factors
//! vanish nowhere where the quotients have values.

use crate::graph::{Evaluator, Expr, Graph, Step, Tape};
use crate::number::prime::{Modulus, Prime, UNDEFINED};
use crate::number::{BinaryOperation, UnaryFunction};

use super::bounds::{Bounds, InputDistribution};
use super::digest::SeedDigest;
use super::rng::{ProofRng, ProofStream};
use super::trial::PRIMES;

/// Largest degree that is tried.
const LARGEST_DEGREE: f64 = 400.0;
/// Largest height that is tried: bits of the sum of the absolute coefficients.
const LARGEST_HEIGHT: f64 = 4000.0;
/// Number of points of the line at which an interpolated quotient is checked.
const CHECKS: usize = 4;

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
    let quotient = |column: &Vec<u64>| match polynomial {
        true => Some((interpolated(m, &points, column), vec![m.one()])),
        false => quotient(m, &points, column, degree),
    };
    let Some(quotients) = columns.iter().map(quotient).collect::<Option<Vec<_>>>() else {
        return false;
    };
    // Use the product of all denominators.
    let product = |a: &[u64], b: &[u64]| multiplied(m, a, b);
    let below = quotients.iter().fold(vec![m.one()], |all, (_, below)| product(&all, below));
    let above = quotients.iter().enumerate().map(|(own, (above, _))| {
        let others = quotients.iter().enumerate().filter(|(k, _)| *k != own);
        others.fold(above.clone(), |all, (_, (_, below))| product(&all, below))
    });
    let mut common = above.fold(Vec::new(), |a, b| common_divisor(m, a, b));
    loop {
        let shared = common_divisor(m, common.clone(), below.clone());
        if shared.len() <= 1 || common.is_empty() {
            return common.len() == 1;
        }
        common = divided(m, common, &shared).0;
    }
}

/// Finds the quotient of polynomials of bounded degree with these values, if there is one.
fn quotient(
    m: &Modulus,
    points: &[u64],
    values: &[u64],
    degree: usize,
) -> Option<(Vec<u64>, Vec<u64>)> {
    let used = 2 * degree + 2;
    let interpolant = interpolated(m, &points[..used], &values[..used]);
    // Remainders of Π(t − tᵢ) by the interpolant, with the multipliers of the interpolant.
    let vanishing = points[..used]
        .iter()
        .fold(vec![m.one()], |all, t| multiplied(m, &all, &[m.sub(0, *t), m.one()]));
    let (mut before, mut last) = ((vanishing, Vec::new()), (interpolant, vec![m.one()]));
    while last.0.len() > degree + 1 {
        let (quotient, rest) = divided(m, before.0, &last.0);
        let multiplier = subtracted(m, &before.1, &multiplied(m, &quotient, &last.1));
        (before, last) = (last, (rest, multiplier));
    }
    let (above, below) = last;
    let common = common_divisor(m, above.clone(), below.clone());
    let (above, below) = (divided(m, above, &common).0, divided(m, below, &common).0);
    let holds = |(t, value): (&u64, &u64)| at(m, &above, *t) == m.mul(*value, at(m, &below, *t));
    points.iter().zip(values).all(holds).then_some((above, below))
}

fn at(m: &Modulus, polynomial: &[u64], t: u64) -> u64 {
    polynomial.iter().rev().fold(0, |sum, coefficient| m.add(m.mul(sum, t), *coefficient))
}

fn multiplied(m: &Modulus, a: &[u64], b: &[u64]) -> Vec<u64> {
    if a.is_empty() || b.is_empty() {
        return Vec::new();
    }
    let mut product = vec![0; a.len() + b.len() - 1];
    for (i, x) in a.iter().enumerate() {
        for (j, y) in b.iter().enumerate() {
            product[i + j] = m.add(product[i + j], m.mul(*x, *y));
        }
    }
    trimmed(product)
}

fn subtracted(m: &Modulus, a: &[u64], b: &[u64]) -> Vec<u64> {
    let at = |x: &[u64], k: usize| x.get(k).copied().unwrap_or(0);
    trimmed((0..a.len().max(b.len())).map(|k| m.sub(at(a, k), at(b, k))).collect())
}

/// Divides with remainder by a nonzero polynomial.
fn divided(m: &Modulus, mut a: Vec<u64>, b: &[u64]) -> (Vec<u64>, Vec<u64>) {
    let inverse = b.last().map_or(0, |leading| m.inverse(*leading));
    let mut quotient = vec![0; (a.len() + 1).saturating_sub(b.len())];
    while a.len() >= b.len() && !b.is_empty() && !a.is_empty() {
        let factor = a.last().map_or(0, |last| m.mul(*last, inverse));
        let shift = a.len() - b.len();
        quotient[shift] = factor;
        for (k, coefficient) in b.iter().enumerate() {
            a[shift + k] = m.sub(a[shift + k], m.mul(factor, *coefficient));
        }
        a = trimmed(a);
    }
    (trimmed(quotient), a)
}

/// Returns the coefficients of the polynomial with these values, constant term first.
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

/// Computes a greatest common divisor by Euclid's algorithm; the zero polynomial has no
/// coefficients.
fn common_divisor(m: &Modulus, mut a: Vec<u64>, mut b: Vec<u64>) -> Vec<u64> {
    while !b.is_empty() {
        let (_, rest) = divided(m, a, &b);
        (a, b) = (b, rest);
    }
    a
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
