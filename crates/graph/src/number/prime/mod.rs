//! Prime fields: exact arithmetic modulo random primes of 61 bits, in which algebraic identities
//! are tested instead of approximated.
//!
//! Each lane has its own prime p = 3 mod 4. Then -1 is not a square, exactly one of ±x is (for x ≠
//! 0), and the root of a square that is itself a square, √x = x^((p+1)/4), behaves like the
//! positive root under products: √x √y = √(xy). Under sums it does not; docs/soundness.md states
//! what may be concluded from values in these fields.
//!
//! A lane is undefined after 1/0 and after a root of 0 or of a non-square. Functions without a
//! value in a field (exp, ln, sin, cos, atan, x^y) are always undefined and must have been replaced
//! before.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::ToPrimitive;

use super::rational::Rational;
use super::{Domain, Function, Operation};

/// Marks a lane without a value; every residue is smaller.
pub const UNDEFINED: u64 = u64::MAX;

/// Arithmetic modulo an odd prime below 2^62, on residues in Montgomery form: x stands for x·2^64.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Modulus {
    prime: u64,
    /// -p⁻¹ mod 2^64
    negative_inverse: u64,
    /// 2^64 mod p, the image of 1.
    one: u64,
    /// 2^128 mod p, which turns an integer into its image.
    square: u64,
}

impl Modulus {
    /// Makes the field of `prime` elements; `prime` must be odd and below 2^62.
    pub fn new(prime: u64) -> Self {
        // Newton's iteration doubles the number of correct low bits; p is its own inverse mod 8.
        let mut inverse = prime;
        for _ in 0..5 {
            inverse = inverse.wrapping_mul(2u64.wrapping_sub(prime.wrapping_mul(inverse)));
        }
        let wide = u128::from(prime);
        let one = ((1u128 << 64) % wide) as u64;
        let square = (u128::from(one) * u128::from(one) % wide) as u64;
        Self { prime, negative_inverse: inverse.wrapping_neg(), one, square }
    }

    /// Returns the prime.
    pub fn prime(&self) -> u64 {
        self.prime
    }

    /// Returns the image of 1.
    pub fn one(&self) -> u64 {
        self.one
    }

    /// Returns the image of an integer below 2^64.
    pub fn integer(&self, value: u64) -> u64 {
        self.mul(value % self.prime, self.square)
    }

    /// Returns the least non-negative integer with this image.
    pub fn to_integer(&self, x: u64) -> u64 {
        self.mul(x, 1)
    }

    /// Returns the image of a rational number, `None` where p divides its denominator.
    pub fn rational(&self, value: &Rational) -> Option<u64> {
        let (numerator, denominator) = value.small_parts().map_or_else(
            || {
                let (numerator, denominator) = value.parts();
                let modulus = BigInt::from(self.prime);
                let image = |x: &BigInt| x.mod_floor(&modulus).to_u64().unwrap_or(0);
                (image(&numerator), image(&denominator))
            },
            |(n, d)| {
                let above = n.unsigned_abs() % self.prime;
                let above = if n < 0 && above > 0 { self.prime - above } else { above };
                (above, d.unsigned_abs() % self.prime)
            },
        );
        match denominator {
            0 => None,
            1 => Some(self.integer(numerator)),
            _ => Some(self.mul(self.integer(numerator), self.inverse(self.integer(denominator)))),
        }
    }

    /// Computes x + y.
    #[inline(always)]
    pub fn add(&self, x: u64, y: u64) -> u64 {
        let sum = x + y;
        sum.min(sum.wrapping_sub(self.prime))
    }

    /// Computes x - y.
    #[inline(always)]
    pub fn sub(&self, x: u64, y: u64) -> u64 {
        let difference = x.wrapping_sub(y);
        difference.min(difference.wrapping_add(self.prime))
    }

    /// Computes x y.
    #[inline(always)]
    pub fn mul(&self, x: u64, y: u64) -> u64 {
        let product = u128::from(x) * u128::from(y);
        let factor = (product as u64).wrapping_mul(self.negative_inverse);
        // product + factor p is divisible by 2^64 and below 2^64 · 2p.
        let sum = ((product + u128::from(factor) * u128::from(self.prime)) >> 64) as u64;
        sum.min(sum.wrapping_sub(self.prime))
    }

    /// Computes x^n.
    pub fn power(&self, x: u64, n: u64) -> u64 {
        let mut result = self.one;
        for bit in (0..64 - n.leading_zeros()).rev() {
            result = self.mul(result, result);
            if n >> bit & 1 == 1 {
                result = self.mul(result, x);
            }
        }
        result
    }

    /// Computes 1/x for x ≠ 0.
    pub fn inverse(&self, x: u64) -> u64 {
        self.power(x, self.prime - 2)
    }

    /// Computes all 1/x by one inversion (Montgomery 1987); `UNDEFINED` for 0 and for undefined
    /// values.
    pub fn inverses(&self, x: &[u64], out: &mut [u64]) {
        let is_unit = |x: u64| x != 0 && x != UNDEFINED;
        let mut product = self.one;
        for (x, out) in x.iter().zip(out.iter_mut()) {
            *out = product;
            if is_unit(*x) {
                product = self.mul(product, *x);
            }
        }
        let mut rest = self.inverse(product);
        for (x, out) in x.iter().zip(out).rev() {
            if is_unit(*x) {
                *out = self.mul(rest, *out);
                rest = self.mul(rest, *x);
            } else {
                *out = UNDEFINED;
            }
        }
    }

    /// Returns the root of x that is itself a square, if x is a nonzero square (for p = 3 mod 4).
    pub fn root(&self, x: u64) -> Option<u64> {
        // x^((p-3)/4): times x it is the root, and times the root it is χ(x).
        let power = self.power(x, (self.prime - 3) / 4);
        let root = self.mul(power, x);
        (self.mul(power, root) == self.one).then_some(root)
    }

    /// Whether x is a nonzero square.
    pub fn is_square(&self, x: u64) -> bool {
        self.power(x, (self.prime - 1) / 2) == self.one
    }

    /// Computes x^(a/b) for x ≠ 0 and b prime to p - 1, hence odd: the root is unique.
    pub fn odd_power(&self, x: u64, exponent: &Rational) -> Option<u64> {
        let (above, below) = exponent.parts();
        let order = BigInt::from(self.prime - 1);
        let inverse = below.modinv(&order)?;
        let exponent = (above * inverse).mod_floor(&order).to_u64()?;
        (x != 0).then(|| self.power(x, exponent))
    }

    fn integer_power(&self, x: u64, exponent: i64) -> Option<u64> {
        let power = self.power(x, exponent.unsigned_abs());
        match (exponent < 0, power) {
            (false, _) => Some(power),
            (true, 0) => None,
            (true, _) => Some(self.inverse(power)),
        }
    }
}

/// The domain of prime fields with `N` lanes, one field for each lane.
#[derive(Clone, Debug)]
pub struct Prime<const N: usize> {
    moduli: [Modulus; N],
}

impl<const N: usize> Prime<N> {
    /// Makes the domain whose lanes compute modulo these primes.
    pub fn new(moduli: [Modulus; N]) -> Self {
        Self { moduli }
    }

    /// Returns the moduli of the lanes.
    pub fn moduli(&self) -> &[Modulus; N] {
        &self.moduli
    }

    /// Inverts all lanes; neighbours with the same prime share one inversion.
    fn reciprocals(&self, x: &[u64; N], out: &mut [u64; N]) {
        let mut begin = 0;
        for own in self.moduli.chunk_by(|a, b| a.prime == b.prime) {
            let lanes = begin..begin + own.len();
            own[0].inverses(&x[lanes.clone()], &mut out[lanes.clone()]);
            begin = lanes.end;
        }
    }

    #[inline(always)]
    fn map(&self, x: &[u64; N], out: &mut [u64; N], f: impl Fn(&Modulus, u64) -> Option<u64>) {
        for lane in 0..N {
            out[lane] = match x[lane] {
                UNDEFINED => UNDEFINED,
                value => f(&self.moduli[lane], value).unwrap_or(UNDEFINED),
            };
        }
    }

    #[inline(always)]
    fn zip(
        &self,
        x: &[u64; N],
        y: &[u64; N],
        out: &mut [u64; N],
        f: impl Fn(&Modulus, u64, u64) -> u64,
    ) {
        for lane in 0..N {
            let defined = x[lane] != UNDEFINED && y[lane] != UNDEFINED;
            // Operating on the mark is harmless and avoids a branch.
            let (a, b) = if defined { (x[lane], y[lane]) } else { (0, 0) };
            let value = f(&self.moduli[lane], a, b);
            out[lane] = if defined { value } else { UNDEFINED };
        }
    }
}

impl<const N: usize> Domain for Prime<N> {
    type Block = [u64; N];

    fn constant(&self, value: &Rational) -> [u64; N] {
        let mut block = [UNDEFINED; N];
        for lane in 0..N {
            // Neighbours mostly share their prime.
            block[lane] = match lane {
                1.. if self.moduli[lane] == self.moduli[lane - 1] => block[lane - 1],
                _ => self.moduli[lane].rational(value).unwrap_or(UNDEFINED),
            };
        }
        block
    }

    fn values(&self, values: &[Rational]) -> [u64; N] {
        let last = values.len().saturating_sub(1);
        std::array::from_fn(|lane| {
            let value = values.get(lane.min(last));
            value.and_then(|value| self.moduli[lane].rational(value)).unwrap_or(UNDEFINED)
        })
    }

    #[inline(always)]
    fn unary(&self, function: Function, x: &[u64; N], out: &mut [u64; N]) {
        match function {
            Function::Neg => self.map(x, out, |m, x| Some(m.sub(0, x))),
            Function::Recip => self.reciprocals(x, out),
            Function::Sqrt => self.map(x, out, Modulus::root),
            Function::Abs => {
                self.map(x, out, |m, x| Some(if m.is_square(x) { x } else { m.sub(0, x) }));
            }
            Function::Exp | Function::Ln | Function::Sin | Function::Cos | Function::Atan => {
                *out = [UNDEFINED; N];
            }
        }
    }

    #[inline(always)]
    fn binary(&self, operation: Operation, x: &[u64; N], y: &[u64; N], out: &mut [u64; N]) {
        match operation {
            Operation::Add => self.zip(x, y, out, Modulus::add),
            Operation::Sub => self.zip(x, y, out, Modulus::sub),
            Operation::Mul => self.zip(x, y, out, Modulus::mul),
            Operation::Pow => *out = [UNDEFINED; N],
        }
    }

    fn power(&self, x: &[u64; N], exponent: &Rational, out: &mut [u64; N]) {
        match exponent.to_integer() {
            Some(n) => self.map(x, out, |m, x| m.integer_power(x, n)),
            None => self.map(x, out, |m, x| m.odd_power(x, exponent)),
        }
    }
}

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
    let (minus_one, twos) = (m.sub(0, m.one), (candidate - 1).trailing_zeros());
    BASES.iter().all(|base| {
        let base = base % candidate;
        let mut x = m.power(m.integer(base), (candidate - 1) >> twos);
        if base == 0 || x == m.one || x == minus_one {
            return true;
        }
        (1..twos).any(|_| {
            x = m.mul(x, x);
            x == minus_one
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const MERSENNE: u64 = (1 << 61) - 1;

    #[test]
    fn primes_are_told_from_the_rest() {
        let small: Vec<u64> = (0..50).filter(|n| is_prime(*n)).collect();
        assert_eq!(small, [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47]);
        assert!(is_prime(MERSENNE), "2^61 - 1");
        let mut sieve = vec![true; 100_000];
        for n in 2..317 {
            (n * n..sieve.len()).step_by(n).for_each(|multiple| sieve[multiple] = false);
        }
        let wrong = (2..sieve.len()).find(|n| is_prime(*n as u64) != sieve[*n]);
        assert_eq!(wrong, None, "the sieve of Eratosthenes knows better");
        // A strong pseudoprime to the first nine bases, and a Carmichael number.
        assert!(!is_prime(3_825_123_056_546_413_051), "149491 · 747451 · 34233211");
        assert!(!is_prime(2_147_483_647 * 1_073_741_789), "(2^31 - 1)(2^30 - 35)");
        assert!(!is_prime(561), "3 · 11 · 17");
    }

    #[test]
    fn many_inverses_take_one_inversion() {
        let moduli = [3, 5, 7, 11].map(|n| Modulus::new((1u64 << 61) - if n > 5 { 1 } else { 31 }));
        let x = [12, UNDEFINED, 0, 5];
        let mut out = [0; 4];
        Prime::new(moduli).unary(Function::Recip, &x, &mut out);
        assert_eq!(out[1..3], [UNDEFINED; 2], "of nothing, and of 0");
        for lane in [0, 3] {
            let product = moduli[lane].mul(x[lane], out[lane]);
            assert_eq!(product, moduli[lane].one(), "x · 1/x in lane {lane}");
        }
    }

    #[test]
    fn residues_compute() {
        let m = Modulus::new(MERSENNE);
        let third = m.rational(&Rational::new(1, 3)).expect("3 is a unit");
        assert_eq!(m.mul(third, m.integer(3)), m.one(), "1/3 · 3");
        assert_eq!(m.to_integer(m.sub(0, m.integer(5))), MERSENNE - 5, "-5");
        assert_eq!(m.rational(&Rational::from(-5)), Some(m.sub(0, m.integer(5))), "-5 again");
        let zero: Rational = MERSENNE.to_string().parse().expect("a number");
        assert_eq!(m.rational(&zero), Some(0), "p is 0");
        assert_eq!(m.rational(&zero.recip().expect("not 0")), None, "1/p is nothing");
        let large: Rational = "123456789012345678901234567890/7".parse().expect("a number");
        let by_hand = 123456789012345678901234567890u128 % u128::from(MERSENNE);
        let image = m.rational(&large).map(|x| m.to_integer(m.mul(x, m.integer(7))));
        assert_eq!(image, Some(by_hand as u64), "large parts are reduced");
    }

    #[test]
    fn roots_are_squares_and_multiply() {
        let m = Modulus::new(MERSENNE);
        let (mut roots, mut none) = (0, 0);
        for n in 1..200u64 {
            let x = m.integer(n * n * n + 7);
            match m.root(x) {
                Some(root) => {
                    assert_eq!(m.mul(root, root), x, "√x √x = x");
                    assert!(m.is_square(root), "the root is a square itself");
                    roots += 1;
                }
                None => {
                    assert!(!m.is_square(x), "no square, no root");
                    assert!(m.is_square(m.sub(0, x)), "then -x is one, as p = 3 mod 4");
                    none += 1;
                }
            }
        }
        assert!(roots > 50 && none > 50, "half of all elements are squares");
        assert_eq!(m.root(0), None, "√0 is refused: it has no sign");
        assert_eq!(m.root(m.integer(3)), None, "3 is no square mod 2^61 - 1");
    }

    #[test]
    fn roots_of_odd_index_need_a_suitable_prime() {
        // 2^61 - 2 is divisible by 3, so cube roots are not unique there.
        let x = Modulus::new(MERSENNE).integer(4);
        assert_eq!(Modulus::new(MERSENNE).odd_power(x, &Rational::new(1, 3)), None);
        let prime = (1u64 << 60..).find(|p| p % 12 == 11 && is_prime(*p)).expect("there is one");
        let m = Modulus::new(prime);
        for n in 1..50 {
            let root = m.odd_power(m.integer(n), &Rational::new(2, 3)).expect("it is not 0");
            assert_eq!(m.power(root, 3), m.integer(n * n), "({n}^(2/3))³ = {n}²");
        }
        let half = m.odd_power(m.integer(4), &Rational::new(1, 2));
        assert_eq!(half, None, "the root of even index has two signs");
    }
}
