//! Arithmetic modulo one prime.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::ToPrimitive;

use crate::number::rational::Rational;

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
    /// Number of products that a sum may get before it is reduced.
    most_products: u64,
    /// Number of products whose sum is reduced as one product is.
    few_products: usize,
}

impl Modulus {
    /// Returns the point origin + t slope of a line.
    pub fn along(&self, origin: &[u64], slope: &[u64], t: u64) -> Vec<u64> {
        origin.iter().zip(slope).map(|(a, b)| self.add(*a, self.mul(t, *b))).collect()
    }

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
        let room = (1u128 << 127) - (wide << 64);
        let most_products = u64::try_from(room / (wide * wide)).unwrap_or(u64::MAX);
        // Their sum is below 2^64 p.
        let few_products = usize::try_from((1u128 << 64) / wide).unwrap_or(usize::MAX);
        let negative_inverse = inverse.wrapping_neg();
        Self { prime, negative_inverse, one, square, most_products, few_products }
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
        self.reduced_below(u128::from(x) * u128::from(y))
    }

    /// Returns the residue of a sum of products below 2^64 p.
    #[inline(always)]
    fn reduced_below(&self, product: u128) -> u64 {
        let factor = (product as u64).wrapping_mul(self.negative_inverse);
        // product + factor p is divisible by 2^64 and below 2^64 · 2p.
        let sum = ((product + u128::from(factor) * u128::from(self.prime)) >> 64) as u64;
        sum.min(sum.wrapping_sub(self.prime))
    }

    /// Returns the number of products of residues that may be added to a widened residue before it
    /// is reduced: so many that the sum stays below 2^127. It is 24 or more for primes below 2^61.
    pub fn most_products(&self) -> u64 {
        self.most_products
    }

    /// Returns x as a sum of products, to which others x y may be added as they are.
    #[inline(always)]
    pub fn widened(&self, x: u64) -> u128 {
        u128::from(x) << 64
    }

    /// Returns the residue of a sum of products.
    #[inline(always)]
    pub fn reduced(&self, sum: u128) -> u64 {
        let factor = (sum as u64).wrapping_mul(self.negative_inverse);
        // The sum is below 2^127, and the other term below 2^126.
        let whole = sum.wrapping_add(u128::from(factor).wrapping_mul(u128::from(self.prime)));
        (whole >> 64) as u64 % self.prime
    }

    /// Computes Σ x_j y_j over two rows of one length.
    pub fn dot(&self, x: &[u64], y: &[u64]) -> u64 {
        let pairs = x.chunks(self.few_products).zip(y.chunks(self.few_products));
        pairs.fold(0, |sum, (x, y)| self.add(sum, self.few(x.iter().zip(y))))
    }

    /// Computes Σ x_j y_{n−1−j} over two rows of length n.
    pub fn convolved(&self, x: &[u64], y: &[u64]) -> u64 {
        let pairs = x.chunks(self.few_products).zip(y.rchunks(self.few_products));
        pairs.fold(0, |sum, (x, y)| self.add(sum, self.few(x.iter().zip(y.iter().rev()))))
    }

    /// Computes a sum of products of residues that are few.
    #[inline(always)]
    fn few<'x>(&self, pairs: impl Iterator<Item = (&'x u64, &'x u64)>) -> u64 {
        self.reduced_below(
            pairs.fold(0, |sum, (x, y)| {
                sum.wrapping_add(u128::from(*x).wrapping_mul(u128::from(*y)))
            }),
        )
    }

    /// Returns 1/0 = 0, 1/1, 1/2, … up to the inverse of `last`, which is less than p.
    pub fn inverses_up_to(&self, last: usize) -> Vec<u64> {
        let mut all = vec![0, self.one];
        for k in 2..=last as u64 {
            // p = q k + r, so that 1/k = −q/r.
            let (quotient, rest) = (self.integer(self.prime / k), (self.prime % k) as usize);
            all.push(self.sub(0, self.mul(quotient, all[rest])));
        }
        all
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

    /// Computes 1/x for x ≠ 0, by some 43 steps without divisions (Kaliski 1995); 0 for 0.
    pub fn inverse(&self, x: u64) -> u64 {
        let (mut u, mut v) = (self.prime, x % self.prime);
        if v == 0 {
            return 0;
        }
        // p = first v + second u, and x second = ±v 2^k, x first = ∓u 2^k modulo p.
        let (mut first, mut second) = (0u64, 1u64);
        let mut k = v.trailing_zeros();
        v >>= k;
        let mut is_negative = false;
        while u != v {
            // Which one is the smaller is a fair coin, so that branches would be predicted wrongly.
            let is_less = v < u;
            is_negative ^= is_less;
            (u, v) = (u.min(v), u.abs_diff(v));
            (first, second) = if is_less { (second, first) } else { (first, second) };
            let zeros = v.trailing_zeros();
            v >>= zeros;
            second = second.wrapping_add(first);
            first <<= zeros;
            k += zeros;
        }
        // Of x 2^64 it is the inverse times 2^-k; that times 2^128 has the form of residues.
        let mut inverse = if is_negative { self.prime - second } else { second };
        if k <= 64 {
            inverse = self.mul(inverse, self.square);
            k += 64;
        }
        self.mul(self.mul(inverse, 1 << (128 - k)), self.square)
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

    /// Returns a root of x, the same each time, if x is a nonzero square. For p = 3 mod 4 it is the
    /// one that is itself a square, so that √x √y = √(xy); for p = 1 mod 4 there is no such rule.
    pub fn root(&self, x: u64) -> Option<u64> {
        if self.prime & 3 == 1 {
            return self.is_square(x).then(|| self.some_root(x));
        }
        // x^((p-3)/4): times x it is the root, and times the root it is χ(x).
        let power = self.power(x, (self.prime - 3) / 4);
        let root = self.mul(power, x);
        (self.mul(power, root) == self.one).then_some(root)
    }

    /// Computes a root of a nonzero square, for any p (Tonelli, Shanks).
    fn some_root(&self, x: u64) -> u64 {
        let twos = (self.prime - 1).trailing_zeros();
        let odd = (self.prime - 1) >> twos;
        let power = self.power(x, odd / 2);
        let mut root = self.mul(power, x);
        // root² = rest x, where rest is of order 2^k, k < twos.
        let mut rest = self.mul(root, power);
        let other = (2..self.prime).map(|n| self.integer(n)).find(|n| !self.is_square(*n));
        let mut factor = self.power(other.unwrap_or(self.one), odd);
        let mut order = twos;
        while rest != self.one {
            let mut square = rest;
            let mut k = 0;
            while square != self.one {
                square = self.mul(square, square);
                k += 1;
            }
            for _ in k + 1..order {
                factor = self.mul(factor, factor);
            }
            root = self.mul(root, factor);
            factor = self.mul(factor, factor);
            rest = self.mul(rest, factor);
            order = k;
        }
        root
    }

    /// Whether x is a nonzero square.
    ///
    /// By Jacobi's symbol, which takes half of the time of a power; that of x·2^64 is that of x.
    pub fn is_square(&self, x: u64) -> bool {
        let (mut above, mut below) = (x % self.prime, self.prime);
        // Bit 1 tells whether the symbol is -1 so far.
        let mut is_negative = 0;
        while above != 0 {
            let twos = above.trailing_zeros();
            above >>= twos;
            // (2/n) is -1 for n = 3, 5 mod 8.
            is_negative ^= u64::from(twos) << 1 & (below ^ below >> 1);
            // Reciprocity: the sign changes if both are 3 mod 4. Which one is the smaller is a fair coin,
            // so that branches would be predicted wrongly.
            let is_less = above < below;
            is_negative ^= if is_less { above & below } else { 0 };
            (above, below) = (above.abs_diff(below), above.min(below));
        }
        below == 1 && is_negative & 2 == 0
    }

    /// Computes x^(a/b) for x ≠ 0 and b prime to p - 1, hence odd: the root is unique.
    pub fn odd_power(&self, x: u64, exponent: &Rational) -> Option<u64> {
        let (above, below) = exponent.parts();
        let order = BigInt::from(self.prime - 1);
        let inverse = below.modinv(&order)?;
        let exponent = (above * inverse).mod_floor(&order).to_u64()?;
        (x != 0).then(|| self.power(x, exponent))
    }

    /// Computes x^n; `None` for 0 to a negative power.
    pub(super) fn integer_power(&self, x: u64, exponent: i64) -> Option<u64> {
        let power = self.power(x, exponent.unsigned_abs());
        match (exponent < 0, power) {
            (false, _) => Some(power),
            (true, 0) => None,
            (true, _) => Some(self.inverse(power)),
        }
    }
}
