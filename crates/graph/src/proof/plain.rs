//! Bounds for programs of + − × ÷, integer powers and independent square roots, for checkers outside
//! of the tool.

use crate::graph::{Evaluator, Expr, Graph, Step, Tape};
use crate::number::prime::{Prime, UNDEFINED};
use crate::number::{BinaryOperation, UnaryFunction};

use super::bounds::{Bounds, InputDistribution};
use super::rng::ProofRng;
use super::trial::TRIAL_LANES;

/// Stream of the points at which radicands are looked at.
const PURPOSE: u64 = 1 << 32;
/// Largest number of square roots.
const MOST_ROOTS: usize = 100;
/// Number of points beyond the number of roots.
const SPARE_POINTS: usize = 24;

/// Bounds degree and height of the numerators of some values, all inputs uniform, by Theorem 1 of
/// docs/soundness.md.
///
/// `None` if they contain other operations than + − × ÷, integer powers and square roots, if a
/// radicand is a constant or contains a root, or if the roots are not seen to be independent.
pub fn plain_bounds(graph: &Graph, outputs: &[Expr], seed: u64) -> Option<(f64, f64)> {
    let reached = graph.reached(outputs.iter().copied());
    let mut has_root = vec![false; graph.len()];
    let mut radicands: Vec<Expr> = Vec::new();
    for (place, step) in graph.steps().enumerate().filter(|(place, _)| reached[*place]) {
        has_root[place] = step.arguments().any(|argument| has_root[argument]);
        match step {
            Step::Unary(UnaryFunction::Sqrt, a) => {
                if has_root[a] || matches!(graph.step(a), Step::Constant(_)) {
                    return None;
                }
                radicands.push(graph.at(a));
                has_root[place] = true;
            }
            Step::Constant(_) | Step::Input(_) => {}
            Step::Unary(UnaryFunction::Neg | UnaryFunction::Recip, _) => {}
            Step::Binary(
                BinaryOperation::Add | BinaryOperation::Sub | BinaryOperation::Mul,
                ..,
            ) => {}
            Step::Power(_, exponent) if exponent.to_integer().is_some() => {}
            _ => return None,
        }
    }
    if !are_independent(graph, &radicands, seed) {
        return None;
    }
    let bounds = Bounds::of(graph, &reached, &vec![InputDistribution::Uniform; graph.inputs()]);
    outputs.iter().try_fold((0f64, 0f64), |(degree, height), output| {
        let (d, h) = bounds.numerator(graph.place(*output))?;
        Some((degree.max(d), height.max(h)))
    })
}

/// Whether roots of these values, which contain none, are seen to be independent: the vectors that
/// tell where each is a square modulo a prime, and that of −1, are linearly independent.
fn are_independent(graph: &Graph, radicands: &[Expr], seed: u64) -> bool {
    if radicands.is_empty() || radicands.len() > MOST_ROOTS {
        return radicands.is_empty();
    }
    let mut rng = ProofRng::new(seed, PURPOSE);
    let modulus = rng.prime(&[], &[]);
    let tape = Tape::new(graph, radicands);
    let mut evaluator = Evaluator::new(&tape, Prime::new([modulus; TRIAL_LANES]));
    let (mut rows, mut count) = (vec![0u128; radicands.len() + 1], 0);
    let wanted = radicands.len() + SPARE_POINTS;
    for _ in 0..2 * wanted {
        let point = |_| [0; TRIAL_LANES].map(|_: u64| rng.element(&modulus));
        evaluator.run(&(0..graph.inputs()).map(point).collect::<Vec<[u64; TRIAL_LANES]>>());
        let values: Vec<[u64; TRIAL_LANES]> = evaluator.outputs().copied().collect();
        for lane in 0..TRIAL_LANES {
            let is_met = values.iter().all(|block| block[lane] != UNDEFINED && block[lane] != 0);
            if !is_met || count == wanted {
                continue;
            }
            for (row, block) in rows.iter_mut().zip(&values) {
                *row |= u128::from(!modulus.is_square(block[lane])) << count;
            }
            count += 1;
        }
        if count == wanted {
            break;
        }
    }
    // The prime is 3 mod 4, so that −1 is a square nowhere.
    if let Some(last) = rows.last_mut() {
        *last = (1 << count) - 1;
    }
    let mut basis: Vec<u128> = Vec::new();
    rows.into_iter().all(|row| {
        let rest = basis.iter().fold(row, |rest, other| rest.min(rest ^ other));
        basis.push(rest);
        rest != 0
    })
}

#[cfg(test)]
mod tests {
    use num_dual::DualNum;

    use super::*;
    use crate::graph::record;

    fn bounds(build: impl FnOnce(&[Expr]) -> Expr) -> Option<(f64, f64)> {
        let (graph, value) = record(2, build).expect("records");
        plain_bounds(&graph, &[value], 1)
    }

    #[test]
    fn rational_values_are_bounded() {
        assert_eq!(bounds(|x| x[0] * x[1] + x[0]), Some((2.0, 1.0)), "x y + x");
        let inverted = bounds(|x| ((x[0] + x[1]).recip() * x[0]).recip());
        assert_eq!(inverted, Some((1.0, 1.0)), "(x + y)/x: what is inverted twice is above");
        assert_eq!(bounds(|x| x[0].exp()), None, "a function");
    }

    #[test]
    fn roots_are_bounded_if_they_are_independent() {
        let sum = |x: &[Expr]| x[0].sqrt() + (x[1] + x[0]).sqrt();
        assert_eq!(bounds(sum), Some((0.5, 1.5)), "√x + √(x + y)");
        let product = |x: &[Expr]| x[0].sqrt() + x[1].sqrt() + (x[0] * x[1]).sqrt();
        assert_eq!(bounds(product), None, "√x √y = ±√(xy)");
        assert_eq!(bounds(|x| x[0].sqrt() + (-x[0]).sqrt()), None, "√−x = ±i √x");
        assert_eq!(bounds(|x| (x[0].sqrt() + x[1]).sqrt()), None, "a root within a root");
        assert_eq!(
            bounds(|x| (x[0] * x[0] + x[1] * x[1]).sqrt()).map(|own| own.0),
            Some(1.0),
            "|x|"
        );
    }
}
