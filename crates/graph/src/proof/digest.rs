//! Digest of a statement to be proved, from which primes and points are drawn.
//!
//! Theorem 1 needs primes that do not depend on the residual. Primes from a published seed are not
//! enough: a constant could be chosen as a multiple of all of them. Primes are therefore drawn from
//! the seed *and* every step of the graph, so that a change of a constant changes them.
//!
//! The steps are absorbed word by word in the rounds of SipHash (Aumasson and Bernstein, INDOCRYPT
//! 2012, LNCS 7668, 489–508), with the whole state of 256 bits as the result.

use crate::graph::{Expr, Graph, Step};
use crate::number::rational::Rational;

/// Seed material of the random numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Digest(pub [u8; 32]);

/// Initial state of SipHash.
const BEGINNING: [u64; 4] =
    [0x736f_6d65_7073_6575, 0x646f_7261_6e64_6f6d, 0x6c79_6765_6e65_7261, 0x7465_6462_7974_6573];

impl Digest {
    /// Computes the digest of a seed, of the steps that `groups` of outputs need, and of these
    /// outputs.
    pub fn of(seed: u64, graph: &Graph, groups: &[Vec<Expr>]) -> Self {
        let mut sponge = Sponge(BEGINNING);
        sponge.absorb(seed);
        let reached = graph.reached(groups.iter().flatten().copied());
        for (place, step) in graph.steps().enumerate().filter(|(place, _)| reached[*place]) {
            sponge.step(place, step);
        }
        for group in groups {
            sponge.absorb(group.len() as u64);
            group.iter().for_each(|output| sponge.absorb(graph.place(*output) as u64));
        }
        sponge.finish()
    }
}

/// Internal state of SipHash.
struct Sponge([u64; 4]);

impl Sponge {
    fn round(&mut self) {
        let [a, b, c, d] = &mut self.0;
        *a = a.wrapping_add(*b);
        *b = b.rotate_left(13) ^ *a;
        *a = a.rotate_left(32);
        *c = c.wrapping_add(*d);
        *d = d.rotate_left(16) ^ *c;
        *a = a.wrapping_add(*d);
        *d = d.rotate_left(21) ^ *a;
        *c = c.wrapping_add(*b);
        *b = b.rotate_left(17) ^ *c;
        *c = c.rotate_left(32);
    }

    fn absorb(&mut self, word: u64) {
        self.0[3] ^= word;
        self.round();
        self.round();
        self.0[0] ^= word;
    }

    /// Absorbs a step with its place: a word for the operation, then its arguments.
    fn step(&mut self, place: usize, step: Step<'_>) {
        let mut head =
            |kind: u64, which: u64| self.absorb((kind << 56) | (which << 48) | place as u64);
        match step {
            Step::Constant(value) => {
                head(0, 0);
                self.number(value);
            }
            Step::Input(input) => {
                head(1, 0);
                self.absorb(input as u64);
            }
            Step::Unary(function, a) => {
                head(2, function as u64);
                self.absorb(a as u64);
            }
            Step::Binary(operation, a, b) => {
                head(3, operation as u64);
                self.absorb(((a as u64) << 32) | b as u64);
            }
            Step::Power(a, exponent) => {
                head(4, 0);
                self.absorb(a as u64);
                self.number(exponent);
            }
        }
    }

    fn number(&mut self, value: &Rational) {
        if let Some((above, below)) = value.small_parts() {
            self.absorb(2);
            self.absorb(above as u64);
            return self.absorb(below as u64);
        }
        let (above, below) = value.parts();
        for part in [above, below] {
            let bytes = part.to_signed_bytes_le();
            self.absorb(bytes.len() as u64);
            for bytes in bytes.chunks(8) {
                let mut word = [0; 8];
                word[..bytes.len()].copy_from_slice(bytes);
                self.absorb(u64::from_le_bytes(word));
            }
        }
    }

    fn finish(mut self) -> Digest {
        self.0[2] ^= 0xff;
        (0..4).for_each(|_| self.round());
        let mut digest = [0; 32];
        for (bytes, word) in digest.chunks_mut(8).zip(self.0) {
            bytes.copy_from_slice(&word.to_le_bytes());
        }
        Digest(digest)
    }
}

#[cfg(test)]
mod tests {
    use num_dual::DualNum;

    use super::*;
    use crate::graph::record;
    use crate::scalar::Scalar;

    fn digest(seed: u64, build: impl FnOnce(&[Expr]) -> Expr) -> Digest {
        let (graph, value) = record(2, build).expect("records");
        Digest::of(seed, &graph, &[vec![value]])
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
    }
}
