//! Numbers that must be squares modulo a prime for roots to keep their ratios.
//!
//! Modulo p = 3 mod 4 the root of a square is the one that is a square itself, so that √x √y = √(xy).
//! With √(k²) = k for the numbers k in a graph, √(k² f) is k √f as it is for real numbers. Otherwise it
//! is −k √f for every f, and no further point would show that.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

use crate::graph::{Graph, Step};
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};
use crate::order::StableOrder;

/// Primes whose roots [`ProofRng::prime_for`](super::ProofRng::prime_for) provides anyway.
pub const SMALL_PRIMES: [u64; 15] = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47];
/// Largest prime factor that is looked for.
const LARGEST_FACTOR: u64 = 1000;
/// Largest number of further factors: each of them excludes half of the primes.
const MOST: usize = 6;

/// Lists 2 and the larger prime factors of the numbers in a graph; nothing if the graph has no roots.
/// Of a number with large factors the product of these stands for them.
pub fn root_numbers(graph: &Graph) -> Vec<Rational> {
    let is_root = |step: Step<'_>| match step {
        Step::Unary(UnaryFunction::Sqrt | UnaryFunction::Abs, _) => true,
        Step::Power(_, exponent) => exponent.to_integer().is_none(),
        Step::Binary(BinaryOperation::Pow, ..) => true,
        _ => false,
    };
    if !graph.steps().any(is_root) {
        return Vec::new();
    }
    let mut found: Vec<BigInt> = Vec::new();
    for step in graph.steps() {
        let Step::Constant(value) = step else { continue };
        let (above, below) = value.parts();
        found.extend([above, below].into_iter().flat_map(|part| large_factors(part.abs())));
    }
    found.order();
    found.dedup();
    found.truncate(MOST);
    found.insert(0, BigInt::from(SMALL_PRIMES[0]));
    found.into_iter().map(|n| Rational::from_parts(n, BigInt::one())).collect()
}

fn large_factors(mut number: BigInt) -> Vec<BigInt> {
    if number.is_zero() {
        return Vec::new();
    }
    let mut found = Vec::new();
    for factor in (2..=LARGEST_FACTOR).filter(|n| *n == 2 || n % 2 == 1) {
        if number.is_one() {
            break;
        }
        let factor = BigInt::from(factor);
        let mut is_factor = false;
        while number.is_multiple_of(&factor) {
            number /= &factor;
            is_factor = true;
        }
        if is_factor && factor > BigInt::from(SMALL_PRIMES[SMALL_PRIMES.len() - 1]) {
            found.push(factor);
        }
    }
    while !number.is_one() {
        let root = number.sqrt();
        if &root * &root != number {
            found.push(number);
            break;
        }
        number = root;
    }
    found
}

#[cfg(test)]
mod tests {
    use num_dual::DualNum;

    use super::*;
    use crate::graph::record;

    #[test]
    fn large_factors_of_numbers_beside_roots_are_listed() {
        let listed = |root: bool| {
            let (graph, _) = record(1, |x| {
                let scaled = x[0] * 2809.0 * 44.0 + 0.25;
                if root { scaled.sqrt() } else { scaled }
            })
            .expect("records");
            root_numbers(&graph)
        };
        assert_eq!(listed(false), []);
        assert_eq!(listed(true), [2, 53].map(Rational::from));
    }
}
