//! Random primes and random elements, the same for the same seed.

use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::ToPrimitive;

use super::digest::Digest;
use crate::number::prime::{Modulus, is_prime};
use crate::number::rational::Rational;

/// What random numbers of a proof are drawn for; each purpose has a stream of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stream {
    /// Primes of tests.
    Primes = 0,
    /// Points of tests.
    Points = 1,
    /// Linear relations that are looked for.
    Relations = 2,
    /// Characters of radicands.
    Characters = 3,
    /// Nested roots that are refused.
    Refusals = 4,
    /// Ranks.
    Ranks = 5,
    /// Squares that are looked for.
    Squares = 7,
    /// Values that are equal all over the graph.
    Classes = 8,
}

/// Random numbers for field tests; no stream of states has these numbers.
pub struct Chance(ChaCha8Rng);

/// Roots that a prime field has to have.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Wanted {
    /// Odd primes, of whose powers the indices of unique roots are made: p ≠ 1 modulo each.
    pub odd: Vec<u64>,
    /// Integers that are squares modulo p.
    pub squares: Vec<Rational>,
    /// 2^depth, at least 4, divides p + 1: then 2^depth-th roots exist in the quadratic extension.
    pub depth: u32,
}

/// Jacobi's symbol of an integer over an odd number.
fn jacobi(integer: &Rational, odd: u64) -> i32 {
    let remainder = integer.parts().0.mod_floor(&BigInt::from(odd));
    let (mut a, mut n) = (remainder.to_u64().unwrap_or(0), odd);
    let mut symbol = 1;
    while a != 0 {
        let twos = a.trailing_zeros();
        a >>= twos;
        if twos % 2 == 1 && matches!(n % 8, 3 | 5) {
            symbol = -symbol;
        }
        if a % 4 == 3 && n % 4 == 3 {
            symbol = -symbol;
        }
        (a, n) = (n % a, a);
    }
    if n == 1 { symbol } else { 0 }
}

/// The smallest prime that is drawn.
const LEAST: u64 = 1 << 60;

impl Chance {
    /// The random numbers of a seed; `purpose` keeps apart what should not share them.
    pub fn new(seed: u64, purpose: u64) -> Self {
        Self::in_stream(ChaCha8Rng::seed_from_u64(seed), purpose)
    }

    /// The same for what is to be proved: nobody can choose it with regard to these numbers.
    pub fn of(digest: Digest, stream: Stream) -> Self {
        Self::in_stream(ChaCha8Rng::from_seed(digest.0), stream as u64)
    }

    fn in_stream(mut stream: ChaCha8Rng, purpose: u64) -> Self {
        stream.set_stream((1 << 63) | purpose);
        Self(stream)
    }

    /// A random prime p = 3 mod 4 between 2^60 and 2^61, p ≠ 1 modulo each of `odd`, and with all of
    /// `squares` squares modulo p.
    pub fn prime(&mut self, odd: &[u64], squares: &[u64]) -> Modulus {
        loop {
            let wanted = Wanted { odd: odd.to_vec(), ..Wanted::default() };
            let modulus = self.prime_with_roots(&wanted);
            if squares.iter().all(|n| modulus.is_square(modulus.integer(*n))) {
                return modulus;
            }
        }
    }

    /// A random prime between 2^60 and 2^61 with some roots.
    pub fn prime_with_roots(&mut self, wanted: &Wanted) -> Modulus {
        let low = (1u64 << wanted.depth.max(2)) - 1;
        loop {
            let candidate = LEAST | (self.0.next_u64() >> 4) | low;
            if wanted.odd.iter().any(|index| candidate % index == 1) {
                continue;
            }
            // Symbols are quicker than tests for primes.
            let has_root = |n: &Rational| jacobi(n, candidate) == 1;
            if wanted.squares.iter().all(has_root) && is_prime(candidate) {
                return Modulus::new(candidate);
            }
        }
    }

    /// A uniform element, in Montgomery form (which is a permutation of the elements).
    pub fn element(&mut self, modulus: &Modulus) -> u64 {
        loop {
            let value = self.0.next_u64() >> 3;
            if value < modulus.prime() {
                return value;
            }
        }
    }

    /// Heads or tails.
    pub fn coin(&mut self) -> bool {
        self.0.next_u64() >> 63 == 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn primes_are_as_asked() {
        let mut chance = Chance::new(1, 0);
        let primes: Vec<u64> = (0..6).map(|_| chance.prime(&[3, 5], &[2, 3]).prime()).collect();
        for p in &primes {
            assert!(is_prime(*p) && p % 4 == 3 && *p > LEAST && *p < 2 * LEAST, "{p}");
            assert!(p % 3 == 2 && p % 5 != 1, "cube and fifth roots are unique");
            let m = Modulus::new(*p);
            assert!(m.is_square(m.integer(2)) && m.is_square(m.integer(3)), "√2 and √3 exist");
        }
        let again = Chance::new(1, 0).prime(&[3, 5], &[2, 3]).prime();
        assert_eq!(again, primes[0], "the same seed gives the same primes");
        assert_ne!(Chance::new(2, 0).prime(&[3, 5], &[2, 3]).prime(), again, "another seed others");
        let squares: Vec<Rational> = [5, 6, 7, 11].map(Rational::from).to_vec();
        let wanted = Wanted { squares, depth: 5, ..Wanted::default() };
        let m = Chance::new(1, 0).prime_with_roots(&wanted);
        assert!(is_prime(m.prime()) && m.prime() % 32 == 31, "2^5 divides p + 1");
        assert!([5, 6, 7, 11].iter().all(|n| m.is_square(m.integer(*n))), "all are squares");
    }
}
