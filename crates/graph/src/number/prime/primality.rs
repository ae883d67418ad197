//! Primality of numbers below 2^62.

use super::modulus::Modulus;

/// Small primes whose multiples are sorted out by division.
const SMALL: [u64; 15] = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47];
/// Further primes, in products below 2^32: a remainder modulo one of these shows all its factors.
const FURTHER: [(u32, &[u32]); 6] = [
    (53 * 59 * 61 * 67, &[53, 59, 61, 67]),
    (71 * 73 * 79 * 83, &[71, 73, 79, 83]),
    (89 * 97 * 101 * 103, &[89, 97, 101, 103]),
    (107 * 109 * 113 * 127, &[107, 109, 113, 127]),
    (131 * 137 * 139 * 149, &[131, 137, 139, 149]),
    (151 * 157 * 163 * 167, &[151, 157, 163, 167]),
];
/// Numbers below which have no divisor other than those above.
const DIVIDED: u64 = 173 * 173;

/// Whether a number is prime, by Miller's test with the bases that decide every number below 2^64
/// (J. Sinclair, 2011).
pub fn is_prime(candidate: u64) -> bool {
    /// The bases but 2, which finds nearly every number that is not prime.
    const BASES: [u64; 6] = [325, 9375, 28178, 450_775, 9_780_504, 1_795_265_022];
    for small in SMALL {
        if candidate.is_multiple_of(small) {
            return candidate == small;
        }
    }
    for (product, primes) in FURTHER {
        let rest = (candidate % u64::from(product)) as u32;
        if let Some(divisor) = primes.iter().find(|prime| rest.is_multiple_of(**prime)) {
            return candidate == u64::from(*divisor);
        }
    }
    if candidate < DIVIDED {
        return candidate > 1;
    }
    if candidate >> 62 != 0 {
        return false;
    }
    let m = Modulus::new(candidate);
    let (minus_one, twos) = (m.sub(0, m.one()), (candidate - 1).trailing_zeros());
    let odd = (candidate - 1) >> twos;
    let passes = |mut x: u64| {
        x == m.one()
            || x == minus_one
            || (1..twos).any(|_| {
                x = m.mul(x, x);
                x == minus_one
            })
    };
    if !passes(power_of_two(&m, odd)) {
        return false;
    }
    // The powers do not wait for one another.
    let bases = BASES.map(|base| m.integer(base));
    let mut powers = [m.one(); BASES.len()];
    for bit in (0..64 - odd.leading_zeros()).rev() {
        for (x, base) in powers.iter_mut().zip(bases) {
            *x = m.mul(*x, *x);
            if odd >> bit & 1 == 1 {
                *x = m.mul(*x, base);
            }
        }
    }
    bases.into_iter().zip(powers).all(|(base, power)| base == 0 || passes(power))
}

/// Computes 2^n.
fn power_of_two(m: &Modulus, n: u64) -> u64 {
    let mut power = m.one();
    for bit in (0..64 - n.leading_zeros()).rev() {
        power = m.mul(power, power);
        if n >> bit & 1 == 1 {
            power = m.add(power, power);
        }
    }
    power
}
