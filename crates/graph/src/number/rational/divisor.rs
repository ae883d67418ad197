//! Greatest common divisors of integers of any size, by the leading digits of both.

use num_bigint::{BigInt, BigUint};
use num_integer::Integer;
use num_traits::{ToPrimitive, Zero};

/// Number of leading bits that quotients are found from: sums of two such numbers fit an `i64`.
const LEADING: u64 = 62;

/// Computes the greatest common divisor, which is 0 only of zeros and never negative.
pub fn common_divisor(a: &BigInt, b: &BigInt) -> BigInt {
    of_naturals(a.magnitude().clone(), b.magnitude().clone()).into()
}

/// Euclid's algorithm, whose quotients are found from the leading digits and applied many at once
/// (Lehmer; Knuth, The Art of Computer Programming 2, 4.5.2, Algorithm L).
fn of_naturals(mut a: BigUint, mut b: BigUint) -> BigUint {
    if a < b {
        std::mem::swap(&mut a, &mut b);
    }
    loop {
        if b.is_zero() {
            return a;
        }
        if let Some(word) = b.to_u64() {
            let rest = (&a % word).to_u64().unwrap_or(0);
            return word.gcd(&rest).into();
        }
        match steps(&a, &b) {
            Some([[p, q], [r, s]]) => {
                (a, b) = (combined(&a, p, &b, q), combined(&a, r, &b, s));
            }
            None => {
                let rest = &a % &b;
                a = std::mem::replace(&mut b, rest);
            }
        }
    }
}

/// Matrix of the steps of Euclid's algorithm that the leading digits determine, if there are any.
fn steps(a: &BigUint, b: &BigUint) -> Option<[[i64; 2]; 2]> {
    let shift = a.bits().checked_sub(LEADING)?;
    let (mut x, mut y) = ((a >> shift).to_i64()?, (b >> shift).to_i64()?);
    let [mut first, mut second] = [[1, 0], [0, 1]];
    // The quotient is between these two, whatever the other digits are.
    while y + second[0] != 0 && y + second[1] != 0 {
        let quotient = (x + first[0]) / (y + second[0]);
        if quotient != (x + first[1]) / (y + second[1]) {
            break;
        }
        let next = [0, 1].map(|k| first[k] - quotient * second[k]);
        (first, second) = (second, next);
        (x, y) = (y, x - quotient * y);
    }
    (first[1] != 0).then_some([first, second])
}

/// Computes p a + q b, which is not negative, where one factor is positive and the other is not.
fn combined(a: &BigUint, p: i64, b: &BigUint, q: i64) -> BigUint {
    let (a, b) = (a * p.unsigned_abs(), b * q.unsigned_abs());
    if q <= 0 { a - b } else { b - a }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A number of so many bits, the same each time.
    fn number(bits: u64, seed: u64) -> BigInt {
        let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
        let mut value = BigUint::from(1u32);
        while value.bits() < bits {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            value = (value << 32) + (state >> 32);
        }
        (value.clone() >> (value.bits() - bits.max(1))).into()
    }

    #[test]
    fn divisors_are_those_of_the_binary_algorithm() {
        let mut shared = 0;
        for seed in 0..400 {
            let [m, n, k] = [1, 7, 13].map(|step| (seed * step * 37) % 400 + 1);
            let common = number(k, seed + 5000);
            let (a, b) = (number(m, seed) * &common, number(n, seed + 1000) * &common);
            let expected = a.gcd(&b);
            assert_eq!(common_divisor(&a, &b), expected, "{a} and {b}");
            assert_eq!(common_divisor(&-&b, &a), expected, "{b} and {a}");
            shared += usize::from(expected > common);
        }
        assert!(shared > 50, "more than the common factor: {shared}");
    }

    #[test]
    fn extreme_quotients_are_met() {
        let power = |base: u32, exponent: u32| BigInt::from(base).pow(exponent);
        // Neighbours in Fibonacci's sequence have the quotients 1 alone, powers of two large ones.
        let (mut a, mut b) = (BigInt::from(1), BigInt::from(1));
        for _ in 0..700 {
            (a, b) = (&a + &b, a);
        }
        for (a, b) in [
            (a, b),
            (power(2, 300), power(2, 200) * 3),
            (power(2, 300) - 1, power(2, 200) - 1),
            (power(10, 90) + 1, power(10, 90)),
            (power(6, 100), power(10, 80)),
            (power(2, 64), power(2, 64) - 1),
            (power(2, 124) - 1, power(2, 62) - 1),
            (BigInt::ZERO, power(3, 100)),
            (BigInt::ZERO, BigInt::ZERO),
        ] {
            assert_eq!(common_divisor(&a, &b), a.gcd(&b), "{a} and {b}");
        }
    }
}
