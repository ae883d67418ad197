//! Digest of a statement to be proved, from which primes and points are drawn.
//!
//! Theorem 1 needs primes that do not depend on the residual. Primes from a published seed are not
//! enough: a constant could be chosen as a multiple of all of them. Primes are therefore drawn from
//! the seed *and* every step of the graph, so that a change of a constant changes them.
//!
//! The digest is SHA-256 of an unambiguous encoding: every step begins with its kind, and numbers of
//! any length with theirs.

use sha2::{Digest as _, Sha256};

use crate::graph::{Expr, Graph, Step};
use crate::number::rational::Rational;

/// Seed material of the random numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SeedDigest(pub [u8; 32]);

impl SeedDigest {
    /// Computes the digest of a seed, of the steps that `groups` of outputs need, and of these
    /// outputs.
    pub fn of(seed: u64, graph: &Graph, groups: &[Vec<Expr>]) -> Self {
        let mut statement = StatementHash { hash: Sha256::new(), waiting: [0; WAITING], count: 0 };
        statement.word(seed);
        let reached = graph.reached(groups.iter().flatten().copied());
        for (place, step) in graph.steps().enumerate().filter(|(place, _)| reached[*place]) {
            statement.step(place, step);
        }
        for group in groups {
            statement.word(group.len() as u64);
            group.iter().for_each(|output| statement.word(graph.place(*output) as u64));
        }
        Self(statement.finished())
    }
}

/// Seed of random numbers that depend on the values for which they are used, so that no constant in
/// these can be chosen to suit them.
pub fn statement_seed(seed: u64, graph: &Graph, values: &[Expr]) -> u64 {
    let SeedDigest([a, b, c, d, e, f, g, h, ..]) = SeedDigest::of(seed, graph, &[values.to_vec()]);
    u64::from_le_bytes([a, b, c, d, e, f, g, h])
}

/// Number of bytes that are hashed together.
const WAITING: usize = 1024;

/// The hash of what was written of a statement so far, and what waits to be hashed.
struct StatementHash {
    hash: Sha256,
    waiting: [u8; WAITING],
    count: usize,
}

impl StatementHash {
    #[inline]
    fn word(&mut self, word: u64) {
        if self.count == WAITING {
            self.flush();
        }
        self.waiting[self.count..self.count + 8].copy_from_slice(&word.to_le_bytes());
        self.count += 8;
    }

    /// Hashes what waits.
    fn flush(&mut self) {
        self.hash.update(&self.waiting[..self.count]);
        self.count = 0;
    }

    fn finished(mut self) -> [u8; 32] {
        self.flush();
        self.hash.finalize().into()
    }

    /// Writes a step with its place: a word for the operation, then its arguments.
    fn step(&mut self, place: usize, step: Step<'_>) {
        let mut head =
            |kind: u64, which: u64| self.word((kind << 56) | (which << 48) | place as u64);
        match step {
            Step::Constant(value) => {
                head(0, 0);
                self.number(value);
            }
            Step::Input(input) => {
                head(1, 0);
                self.word(input as u64);
            }
            Step::Unary(function, a) => {
                head(2, function as u64);
                self.word(a as u64);
            }
            Step::Binary(operation, a, b) => {
                head(3, operation as u64);
                self.word(((a as u64) << 32) | b as u64);
            }
            Step::Power(a, exponent) => {
                head(4, 0);
                self.word(a as u64);
                self.number(exponent);
            }
        }
    }

    fn number(&mut self, value: &Rational) {
        if let Some((above, below)) = value.small_parts() {
            self.word(0);
            self.word(above as u64);
            return self.word(below as u64);
        }
        let (above, below) = value.parts();
        for part in [above, below] {
            let bytes = part.to_signed_bytes_le();
            self.word(bytes.len() as u64);
            self.flush();
            self.hash.update(&bytes);
        }
    }
}

#[cfg(test)]
mod tests {
    use num_dual::DualNum;

    use super::*;
    use crate::graph::record;
    use crate::scalar::Scalar;

    fn digest(seed: u64, build: impl FnOnce(&[Expr]) -> Expr) -> SeedDigest {
        let (graph, value) = record(2, build).expect("records");
        SeedDigest::of(seed, &graph, &[vec![value]])
    }

    #[test]
    fn all_that_is_proved_enters() {
        let times = |text: &'static str| {
            move |x: &[Expr]| x[0] * Expr::rational(&text.parse().expect("a number")) + x[1]
        };
        let first = digest(1, times("3"));
        assert_eq!(first, digest(1, times("3")), "the same twice");
        assert_ne!(first, digest(2, times("3")), "another seed");
        assert_ne!(first, digest(1, times("5")), "another constant");
        assert_ne!(digest(1, times("1e40")), digest(1, times("1e41")), "or one of many digits");
        assert_ne!(first, digest(1, |x| x[0].sqrt() + x[1]), "another function");
        assert_ne!(digest(1, |x| x[0]), digest(1, |x| x[1]), "another input");
        let group = |split: bool| {
            let (graph, all) = record(2, |x| [x[0], x[1]]).expect("records");
            let groups = if split { vec![vec![all[0]], vec![all[1]]] } else { vec![all.to_vec()] };
            SeedDigest::of(1, &graph, &groups)
        };
        assert_ne!(group(true), group(false), "other groups");
    }
}
