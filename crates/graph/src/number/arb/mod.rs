//! Arbitrary-precision ball arithmetic on big integers.
//!
//! An [`Approximation`] (m ± r)·2^e stands for every real in that interval; the radius counts units
//! of the last place and is never rounded down. Results are cut to the working precision, and to
//! the digits that their radius leaves significant.

mod approximation;
mod decimal;
mod elementary;

pub use approximation::Approximation;

use num_bigint::BigInt;

use super::rational::Rational;
use super::{BinaryOperation, Domain, Enclosing, UnaryFunction};

/// Largest exponent of an integer power that is multiplied out.
const LARGEST_POWER: i64 = 1 << 12;

/// The domain of balls with a given precision, one lane.
#[derive(Clone, Copy, Debug)]
pub struct ArbBall {
    bits: u32,
}

impl ArbBall {
    /// Makes a domain of balls with midpoints of `bits` bits, at least 16.
    pub fn new(bits: u32) -> Self {
        Self { bits: bits.max(16) }
    }

    /// Returns the working precision in bits.
    pub fn bits(&self) -> u32 {
        self.bits
    }

    /// Encloses an exact number.
    pub fn rational(&self, value: &Rational) -> Approximation {
        let (above, below) = value.parts();
        let above = Approximation::exact(above, 0);
        if below == BigInt::from(1) {
            return above.rounded(self.bits);
        }
        let below = Approximation::exact(below, 0);
        // The denominator is not 0.
        below.recip(self.bits + 2).map_or(above.clone(), |inverse| above.mul(&inverse, self.bits))
    }

    /// Computes f(x); `None` where it is undefined or too large to be useful.
    pub fn function(&self, function: UnaryFunction, x: &Approximation) -> Option<Approximation> {
        let value = match function {
            UnaryFunction::Neg => Some(x.neg()),
            UnaryFunction::Abs => Some(x.abs()),
            UnaryFunction::Recip => x.recip(self.bits),
            UnaryFunction::Sqrt => x.sqrt(self.bits),
            UnaryFunction::Exp => elementary::exp(x, self.bits),
            UnaryFunction::Ln => elementary::ln(x, self.bits),
            UnaryFunction::Sin => elementary::sin_cos(x, self.bits).map(|(sine, _)| sine),
            UnaryFunction::Cos => elementary::sin_cos(x, self.bits).map(|(_, cosine)| cosine),
            UnaryFunction::Atan => elementary::atan(x, self.bits),
        };
        value?.in_range()
    }

    /// Computes x^y = exp(y ln x) for x > 0.
    pub fn power_of(&self, x: &Approximation, y: &Approximation) -> Option<Approximation> {
        // exp turns absolute errors into relative ones: the exponent needs as many more bits as it
        // has before the point, and these are few.
        let more = self.bits + 48;
        elementary::exp(&elementary::ln(x, more)?.mul(y, more).in_range()?, self.bits)
    }

    /// Computes x^q, for x > 0 unless q is an integer.
    pub fn rational_power(&self, x: &Approximation, exponent: &Rational) -> Option<Approximation> {
        match exponent.to_integer().filter(|n| n.abs() <= LARGEST_POWER) {
            Some(n) => {
                let mut power = Approximation::exact(BigInt::from(1), 0);
                for bit in (0..64 - n.unsigned_abs().leading_zeros()).rev() {
                    power = power.mul(&power, self.bits + 16);
                    if n.unsigned_abs() >> bit & 1 == 1 {
                        power = power.mul(x, self.bits + 16);
                    }
                }
                let power = power.in_range()?;
                if n < 0 { power.recip(self.bits) } else { Some(power.rounded(self.bits)) }
            }
            None => self.power_of(x, &ArbBall::new(self.bits + 48).rational(exponent)),
        }
    }
}

impl Domain for ArbBall {
    type Block = Option<Approximation>;

    fn constant(&self, value: &Rational) -> Option<Approximation> {
        Some(self.rational(value))
    }

    fn values(&self, values: &[Rational]) -> Option<Approximation> {
        values.first().map(|value| self.rational(value))
    }

    fn unary(
        &self,
        function: UnaryFunction,
        x: &Option<Approximation>,
        out: &mut Option<Approximation>,
    ) {
        *out = x.as_ref().and_then(|x| self.function(function, x));
    }

    fn binary(
        &self,
        operation: BinaryOperation,
        x: &Option<Approximation>,
        y: &Option<Approximation>,
        out: &mut Option<Approximation>,
    ) {
        *out = x.as_ref().zip(y.as_ref()).and_then(|(x, y)| {
            let value = match operation {
                BinaryOperation::Add => x.add(y, self.bits),
                BinaryOperation::Sub => x.add(&y.neg(), self.bits),
                BinaryOperation::Mul => x.mul(y, self.bits),
                BinaryOperation::Pow => self.power_of(x, y)?,
            };
            value.in_range()
        });
    }

    fn power(
        &self,
        x: &Option<Approximation>,
        exponent: &Rational,
        out: &mut Option<Approximation>,
    ) {
        *out = x.as_ref().and_then(|x| self.rational_power(x, exponent));
    }
}

impl Enclosing for ArbBall {
    const LANES: usize = 1;

    fn enclosure(block: &Option<Approximation>, _: usize) -> Option<(f64, f64)> {
        block.as_ref().map(Approximation::enclosure)
    }

    fn excludes_zero(block: &Option<Approximation>, _: usize) -> bool {
        block.as_ref().is_some_and(Approximation::excludes_zero)
    }

    fn is_positive(block: &Self::Block, _: usize) -> bool {
        block.as_ref().is_some_and(Approximation::is_positive)
    }

    fn beyond_f64(block: &Option<Approximation>, _: usize) -> Option<String> {
        let value = block.as_ref().filter(|value| value.excludes_zero())?;
        let (mid, rad) = value.enclosure();
        (mid.abs() <= rad).then(|| value.rough())
    }
}
