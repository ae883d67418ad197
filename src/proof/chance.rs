//! Random primes and random elements, the same for the same seed.

use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};

use super::digest::Digest;
use crate::number::prime::{Modulus, is_prime};

/// Random numbers for field tests; no stream of states has these numbers.
pub struct Chance(ChaCha8Rng);

impl Clone for Chance {
    // The crate leaves this out, lest keys be copied by accident; here the same draws are meant.
    fn clone(&self) -> Self {
        let mut stream = ChaCha8Rng::from_seed(self.0.get_seed());
        stream.set_stream(self.0.get_stream());
        stream.set_word_pos(self.0.get_word_pos());
        Self(stream)
    }
}

/// The smallest prime that is drawn.
const LEAST: u64 = 1 << 60;

impl Chance {
    /// The random numbers of a seed; `purpose` keeps apart what should not share them.
    pub fn new(seed: u64, purpose: u64) -> Self {
        Self::in_stream(ChaCha8Rng::seed_from_u64(seed), purpose)
    }

    /// The same for what is to be proved: nobody can choose it with regard to these numbers.
    pub fn of(digest: Digest, purpose: u64) -> Self {
        Self::in_stream(ChaCha8Rng::from_seed(digest.0), purpose)
    }

    fn in_stream(mut stream: ChaCha8Rng, purpose: u64) -> Self {
        stream.set_stream((1 << 63) | purpose);
        Self(stream)
    }

    /// A random prime p = 3 mod 4 between 2^60 and 2^61, p ≠ 1 modulo each of `odd`, and with all of
    /// `squares` squares modulo p.
    pub fn prime(&mut self, odd: &[u64], squares: &[u64]) -> Modulus {
        loop {
            let candidate = LEAST | (self.0.next_u64() >> 4) | 3;
            if odd.iter().any(|index| candidate % index == 1) || !is_prime(candidate) {
                continue;
            }
            let modulus = Modulus::new(candidate);
            if squares.iter().all(|n| modulus.is_square(modulus.integer(*n))) {
                return modulus;
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
    }

    #[test]
    fn a_copy_goes_on_with_the_same_numbers() {
        let modulus = Modulus::new((1 << 61) - 1);
        for drawn in [0, 1, 7, 100] {
            let mut chance = Chance::new(3, 1);
            for _ in 0..drawn {
                chance.element(&modulus);
            }
            let mut copy = chance.clone();
            let next = |chance: &mut Chance| [(); 40].map(|()| chance.element(&modulus));
            assert_eq!(next(&mut copy), next(&mut chance), "after {drawn} draws");
        }
    }
}
