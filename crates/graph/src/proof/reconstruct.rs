//! Rational numbers from their images modulo a prime.

use crate::number::prime::Modulus;
use crate::number::rational::Rational;

/// Bound on numerators and denominators.
const LARGEST: i128 = 1 << 20;

/// Finds the fraction with small parts and this image; it is unique if it exists.
pub fn reconstruct(image: u64, modulus: &Modulus) -> Option<Rational> {
    // Half of Euclid's algorithm: r_i = t_i x mod p at every step.
    let (mut previous, mut current) =
        ((i128::from(modulus.prime()), 0i128), (i128::from(modulus.to_integer(image)), 1i128));
    while current.0 > LARGEST {
        let quotient = previous.0 / current.0;
        let next = (previous.0 - quotient * current.0, previous.1 - quotient * current.1);
        (previous, current) = (current, next);
    }
    let (above, below) = current;
    (below != 0 && below.abs() <= LARGEST).then(|| Rational::new(above as i64, below as i64))
}

#[cfg(test)]
mod tests {
    use super::super::rng::ProofRng;
    use super::*;

    #[test]
    fn fractions_are_found_from_their_images() {
        let modulus = ProofRng::new(3, 0).prime(&[], &[]);
        for (n, d) in [(0, 1), (1, 1), (-1, 2), (22, 7), (-104_729, 1_048_573)] {
            let value = Rational::new(n, d);
            let image = modulus.rational(&value).expect("p does not divide d");
            assert_eq!(reconstruct(image, &modulus), Some(value), "{n}/{d}");
        }
    }
}
