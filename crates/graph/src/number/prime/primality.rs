//! Primality of numbers below 2^62.

use super::modulus::Modulus;

/// Whether a number is prime, by Miller's test with the bases that decide every number below 2^64
/// (J. Sinclair, 2011).
pub fn is_prime(candidate: u64) -> bool {
    const SMALL: [u64; 12] = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37];
    const BASES: [u64; 7] = [2, 325, 9375, 28178, 450_775, 9_780_504, 1_795_265_022];
    if let Some(divisor) = SMALL.iter().find(|base| candidate.is_multiple_of(**base)) {
        return candidate == *divisor;
    }
    if candidate < 41 {
        return candidate > 1;
    }
    if candidate >> 62 != 0 {
        return false;
    }
    let m = Modulus::new(candidate);
    let (minus_one, twos) = (m.sub(0, m.one()), (candidate - 1).trailing_zeros());
    BASES.iter().all(|base| {
        let base = base % candidate;
        let mut x = m.power(m.integer(base), (candidate - 1) >> twos);
        if base == 0 || x == m.one() || x == minus_one {
            return true;
        }
        (1..twos).any(|_| {
            x = m.mul(x, x);
            x == minus_one
        })
    })
}
