//! Polynomials in one variable modulo a prime, and their irreducible factors.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Zero};

use crate::proof::rng::{ProofRng, ProofStream};

/// Coefficients by increasing powers, the last of them not 0.
pub type Coefficients = Vec<BigInt>;

/// Largest number of random polynomials by which one division is tried.
const MOST_TRIES: u64 = 64;

/// The numbers modulo an odd prime p.
pub struct Residues {
    prime: BigInt,
}

impl Residues {
    /// Makes the numbers modulo 2^bits − 1, which must be a prime.
    pub fn below_power(bits: u32) -> Self {
        Self { prime: (BigInt::one() << bits) - 1 }
    }

    /// Reduces coefficients.
    pub fn reduced(&self, of: &[BigInt]) -> Coefficients {
        trimmed(of.iter().map(|value| value.mod_floor(&self.prime)).collect())
    }

    /// Returns the coefficients of least size with the same residues.
    pub fn symmetric(&self, of: &[BigInt]) -> Coefficients {
        let half: BigInt = &self.prime >> 1;
        let nearest = |value: &BigInt| match *value > half {
            true => value - &self.prime,
            false => value.clone(),
        };
        of.iter().map(nearest).collect()
    }

    /// Computes the product.
    pub fn times(&self, a: &[BigInt], b: &[BigInt]) -> Coefficients {
        self.reduced(&product(a, b))
    }

    /// Multiplies by a number.
    pub fn scaled(&self, a: &[BigInt], factor: &BigInt) -> Coefficients {
        trimmed(a.iter().map(|value| (value * factor).mod_floor(&self.prime)).collect())
    }

    /// Returns the inverse of a number.
    pub fn inverse(&self, value: &BigInt) -> BigInt {
        value.modpow(&(&self.prime - 2), &self.prime)
    }

    /// Makes the leading coefficient 1.
    pub fn monic(&self, a: &[BigInt]) -> Coefficients {
        a.last().map_or_else(Vec::new, |head| self.scaled(a, &self.inverse(head)))
    }

    /// Divides with a remainder by a polynomial with leading coefficient 1.
    pub fn divided(&self, a: &[BigInt], monic: &[BigInt]) -> [Coefficients; 2] {
        let mut rest = a.to_vec();
        let Some(count) = (a.len() + 1).checked_sub(monic.len()) else {
            return [Vec::new(), rest];
        };
        let mut quotient = vec![BigInt::zero(); count];
        for place in (0..count).rev() {
            let head = rest[place + monic.len() - 1].mod_floor(&self.prime);
            if !head.is_zero() {
                for (k, value) in monic.iter().enumerate() {
                    rest[place + k] -= &head * value;
                }
            }
            quotient[place] = head;
        }
        rest.truncate(monic.len() - 1);
        [trimmed(quotient), self.reduced(&rest)]
    }

    /// Computes the difference.
    pub fn minus(&self, a: &[BigInt], b: &[BigInt]) -> Coefficients {
        let zero = BigInt::zero();
        let at = |of: &[BigInt], k: usize| of.get(k).unwrap_or(&zero).clone();
        let all: Coefficients = (0..a.len().max(b.len())).map(|k| at(a, k) - at(b, k)).collect();
        self.reduced(&all)
    }

    /// Returns the greatest common divisor, with leading coefficient 1; none of two zeros.
    pub fn common_divisor(&self, a: &[BigInt], b: &[BigInt]) -> Coefficients {
        let (mut a, mut b) = (self.monic(a), self.monic(b));
        while !b.is_empty() {
            let [_, rest] = self.divided(&a, &b);
            (a, b) = (b, self.monic(&rest));
        }
        a
    }

    /// Returns s with s a = 1 modulo a polynomial with leading coefficient 1; `None` if they have a common
    /// divisor.
    pub fn inverse_modulo(&self, a: &[BigInt], monic: &[BigInt]) -> Option<Coefficients> {
        let [_, mut r] = self.divided(&self.reduced(a), monic);
        let (mut before, mut s_before, mut s) = (monic.to_vec(), Vec::new(), vec![BigInt::one()]);
        while r.len() > 1 {
            let unit = self.inverse(r.last()?);
            (r, s) = (self.scaled(&r, &unit), self.scaled(&s, &unit));
            let [quotient, rest] = self.divided(&before, &r);
            let next = self.minus(&s_before, &self.times(&quotient, &s));
            (before, s_before, r, s) = (r, s, rest, next);
        }
        let unit = self.inverse(r.first()?);
        let [_, inverse] = self.divided(&self.scaled(&s, &unit), monic);
        Some(inverse)
    }

    fn power(&self, base: &[BigInt], exponent: &BigInt, modulus: &[BigInt]) -> Coefficients {
        let mut power = vec![BigInt::one()];
        for bit in (0..exponent.bits()).rev() {
            let [_, square] = self.divided(&self.times(&power, &power), modulus);
            power = square;
            if exponent.bit(bit) {
                let [_, next] = self.divided(&self.times(&power, base), modulus);
                power = next;
            }
        }
        power
    }

    /// Returns the irreducible factors of a polynomial with leading coefficient 1 and without repeated factors;
    /// `None` if they are not found.
    pub fn irreducible(&self, monic: &[BigInt]) -> Option<Vec<Coefficients>> {
        let (mut left, mut factors) = (monic.to_vec(), Vec::new());
        let x = vec![BigInt::zero(), BigInt::one()];
        let mut power = x.clone();
        for degree in 1.. {
            if left.len() <= 2 * degree {
                break;
            }
            // The factors of this degree divide x^(p^degree) − x.
            power = self.power(&power, &self.prime, &left);
            let own = self.common_divisor(&self.minus(&power, &x), &left);
            if own.len() > 1 {
                [left, _] = self.divided(&left, &own);
                [_, power] = self.divided(&power, &left);
                self.split(own, degree, &mut factors)?;
            }
        }
        if left.len() > 1 {
            factors.push(left);
        }
        Some(factors)
    }

    /// Divides a product of irreducible factors of one degree.
    fn split(
        &self,
        product: Coefficients,
        degree: usize,
        found: &mut Vec<Coefficients>,
    ) -> Option<()> {
        let mut open = vec![product];
        // Half of all polynomials are squares modulo a factor, independently of the others.
        let exponent: BigInt = (self.prime.pow(u32::try_from(degree).ok()?) - 1) >> 1;
        let one = vec![BigInt::one()];
        let mut rng = ProofRng::for_trials(ProofStream::Divisors);
        for _ in 0..MOST_TRIES {
            let Some(own) = open.pop() else { break };
            if own.len() == degree + 1 {
                found.push(own);
                continue;
            }
            let drawn = (0..own.len() - 1).map(|_| BigInt::from(rng.below(1 << 32))).collect();
            let drawn = trimmed(drawn);
            let square = self.minus(&self.power(&drawn, &exponent, &own), &one);
            let part = self.common_divisor(&square, &own);
            if part.len() > 1 && part.len() < own.len() {
                let [rest, _] = self.divided(&own, &part);
                open.push(rest);
                open.push(part);
            } else {
                open.push(own);
            }
        }
        open.is_empty().then_some(())
    }
}

/// Computes the product of polynomials with whole coefficients.
pub fn product(a: &[BigInt], b: &[BigInt]) -> Coefficients {
    if a.is_empty() || b.is_empty() {
        return Vec::new();
    }
    let mut product = vec![BigInt::zero(); a.len() + b.len() - 1];
    for (i, x) in a.iter().enumerate() {
        for (j, y) in b.iter().enumerate() {
            product[i + j] += x * y;
        }
    }
    product
}

/// Leaves out leading zeros.
pub fn trimmed(mut of: Coefficients) -> Coefficients {
    while of.last().is_some_and(Zero::is_zero) {
        of.pop();
    }
    of
}
