//! Primes in whose fields polynomials over the rationals split more often.

use liouville::number::prime::{Modulus, is_prime};

use liouville::number::rational::Rational;

use super::super::ansatz::Coordinates;
use super::super::streams::SearchStream;

/// Draws primes p = 1 mod 840 between 2^60 and 2^61 modulo which these numbers are squares.
pub fn split(seed: u64, count: usize, radicands: &[Rational]) -> Vec<Modulus> {
    let mut rng = SearchStream::OrbitLines.under(seed);
    let whole = Modulus::new((1 << 61) - 1);
    let candidates = std::iter::repeat_with(|| (rng.element(&whole) | 1 << 60) / 840 * 840 + 1);
    let primes = candidates.filter(|own| own >> 60 == 1 && is_prime(*own)).map(Modulus::new);
    primes.filter(|own| Coordinates::has_roots(radicands, own)).take(count).collect()
}
