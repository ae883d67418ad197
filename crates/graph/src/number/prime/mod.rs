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

mod modulus;
mod polynomial;
mod primality;

#[cfg(test)]
mod tests;

pub use modulus::{Modulus, UNDEFINED};
pub use polynomial::{CHECKS, Polynomial, PrimePolynomials};
pub use primality::is_prime;

use super::rational::Rational;
use super::{BinaryOperation, Domain, UnaryFunction};

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
        for own in self.moduli.chunk_by(|a, b| a.prime() == b.prime()) {
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
    fn unary(&self, function: UnaryFunction, x: &[u64; N], out: &mut [u64; N]) {
        match function {
            UnaryFunction::Neg => self.map(x, out, |m, x| Some(m.sub(0, x))),
            UnaryFunction::Recip => self.reciprocals(x, out),
            UnaryFunction::Sqrt => self.map(x, out, Modulus::root),
            UnaryFunction::Abs => {
                self.map(x, out, |m, x| Some(if m.is_square(x) { x } else { m.sub(0, x) }));
            }
            UnaryFunction::Exp
            | UnaryFunction::Ln
            | UnaryFunction::Sin
            | UnaryFunction::Cos
            | UnaryFunction::Atan => {
                *out = [UNDEFINED; N];
            }
        }
    }

    #[inline(always)]
    fn binary(&self, operation: BinaryOperation, x: &[u64; N], y: &[u64; N], out: &mut [u64; N]) {
        match operation {
            BinaryOperation::Add => self.zip(x, y, out, Modulus::add),
            BinaryOperation::Sub => self.zip(x, y, out, Modulus::sub),
            BinaryOperation::Mul => self.zip(x, y, out, Modulus::mul),
            BinaryOperation::Pow => *out = [UNDEFINED; N],
        }
    }

    fn power(&self, x: &[u64; N], exponent: &Rational, out: &mut [u64; N]) {
        match exponent.to_integer() {
            Some(n) => self.map(x, out, |m, x| m.integer_power(x, n)),
            None => self.map(x, out, |m, x| m.odd_power(x, exponent)),
        }
    }
}
