//! Numbers a + b √n from their images modulo a prime, or a product of primes.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

/// Number of reductions after which a basis is given up; each at least halves some length.
const ROUNDS: usize = 10_000;

/// Whole numbers (a, b, d), d > 0, with d c = a + b r modulo M, all far below the cubic root of M; they
/// are unique up to a factor where they exist.
pub fn surd(residue: &BigInt, root: &BigInt, modulus: &BigInt) -> Option<[BigInt; 3]> {
    let zero = BigInt::ZERO;
    // The lattice of all (a, b, d) with a + b r − d c = 0 modulo M.
    let mut basis = [
        [modulus.clone(), zero.clone(), zero.clone()],
        [-root, BigInt::one(), zero.clone()],
        [residue.clone(), zero.clone(), BigInt::one()],
    ];
    let mut rounds = 0;
    while reduce(&mut basis) {
        rounds += 1;
        if rounds > ROUNDS {
            return None;
        }
    }
    let shortest = basis.into_iter().min_by_key(|own| product(own, own))?;
    // A vector of this length is there by chance once in 2¹².
    let bound = modulus.cbrt() >> 4u32;
    let is_short = shortest.iter().all(|entry| entry.abs() <= bound);
    let sign = if shortest[2].is_negative() { -1 } else { 1 };
    (is_short && !shortest[2].is_zero()).then(|| shortest.map(|entry| entry * sign))
}

fn product(a: &[BigInt; 3], b: &[BigInt; 3]) -> BigInt {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// Shortens one vector of a basis by another; `false` if none can be.
fn reduce(basis: &mut [[BigInt; 3]; 3]) -> bool {
    for i in 0..3 {
        for j in (0..3).filter(|j| *j != i) {
            let length = product(&basis[j], &basis[j]);
            let twice: BigInt = product(&basis[i], &basis[j]) * 2 + &length;
            let multiple = twice.div_floor(&(&length * 2));
            if multiple.is_zero() {
                continue;
            }
            let shorter: [BigInt; 3] =
                std::array::from_fn(|k| &basis[i][k] - &multiple * &basis[j][k]);
            if product(&shorter, &shorter) < product(&basis[i], &basis[i]) {
                basis[i] = shorter;
                return true;
            }
        }
    }
    // Vectors that are short in pairs: one of these sums may be shorter still.
    for (s, t) in [(1, 1), (1, -1), (-1, 1), (-1, -1)] {
        let sum: [BigInt; 3] =
            std::array::from_fn(|k| &basis[0][k] + &basis[1][k] * s + &basis[2][k] * t);
        let length = |own: &[BigInt; 3]| product(own, own);
        let longest = (0..3).max_by_key(|k| length(&basis[*k]));
        if let Some(longest) = longest.filter(|k| length(&sum) < length(&basis[*k])) {
            basis[longest] = sum;
            return true;
        }
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn surds_come_from_their_images() {
        // p = 7 mod 8: 2 is a square.
        let p: BigInt = (BigInt::one() << 61u32) - 1u32;
        let root = BigInt::from(2).modpow(&((&p + 1u32) / 4u32), &p);
        assert_eq!((&root * &root).mod_floor(&p), BigInt::from(2));
        for (a, b, d) in [(1, 1, 1), (3, -7, 5), (0, 1, 2), (-1200, 911, 640), (5, 0, 3)] {
            let inverse = BigInt::from(d).modinv(&p).expect("prime");
            let image: BigInt = (BigInt::from(a) + BigInt::from(b) * &root) * inverse;
            let image = image.mod_floor(&p);
            assert_eq!(surd(&image, &root, &p), Some([a, b, d].map(BigInt::from)), "{a} + {b} √2");
        }
        let none = BigInt::from(1_234_567_890_123_456_789u64);
        assert_eq!(surd(&none, &root, &p), None, "a random number is none");
    }
}
