//! Exact rational arithmetic, one lane: the reference for every other domain, and the form in which
//! sampled states are printed so that they can be typed in again.

use num_bigint::BigInt;
use num_traits::Signed;

use super::rational::Rational;
use super::{BinaryOperation, Domain, UnaryFunction};

/// Size in bits beyond which a number is given up: too long to read, and slow.
const MAX_BITS: u64 = 1 << 16;

/// The domain of exact rationals. A lane is `None` where the result is not rational, or too long.
#[derive(Clone, Copy, Debug, Default)]
pub struct Exact;

impl Domain for Exact {
    type Block = Option<Rational>;

    fn constant(&self, value: &Rational) -> Option<Rational> {
        Some(value.clone())
    }

    fn values(&self, values: &[Rational]) -> Option<Rational> {
        values.first().cloned()
    }

    fn unary(&self, function: UnaryFunction, x: &Option<Rational>, out: &mut Option<Rational>) {
        *out = x.as_ref().and_then(|x| match function {
            UnaryFunction::Neg => Some(-x),
            UnaryFunction::Recip => x.recip(),
            UnaryFunction::Sqrt => square_root(x),
            UnaryFunction::Abs => Some(x.abs()),
            UnaryFunction::Exp | UnaryFunction::Sin | UnaryFunction::Atan if x.is_zero() => {
                Some(Rational::from(i64::from(function == UnaryFunction::Exp)))
            }
            UnaryFunction::Cos if x.is_zero() => Some(Rational::from(1)),
            UnaryFunction::Ln if x.is_one() => Some(Rational::from(0)),
            UnaryFunction::Exp
            | UnaryFunction::Ln
            | UnaryFunction::Sin
            | UnaryFunction::Cos
            | UnaryFunction::Atan => None,
        });
    }

    fn binary(
        &self,
        operation: BinaryOperation,
        x: &Option<Rational>,
        y: &Option<Rational>,
        out: &mut Option<Rational>,
    ) {
        *out = x.as_ref().zip(y.as_ref()).and_then(|(x, y)| match operation {
            BinaryOperation::Add => Some(x + y),
            BinaryOperation::Sub => Some(x - y),
            BinaryOperation::Mul => Some(x * y),
            BinaryOperation::Pow => power(x, y),
        });
        if out.as_ref().is_some_and(|value| value.bits() > MAX_BITS) {
            *out = None;
        }
    }

    fn power(&self, x: &Option<Rational>, exponent: &Rational, out: &mut Option<Rational>) {
        *out = x.as_ref().and_then(|x| power(x, exponent));
    }
}

/// Returns the root of the square of a rational, `None` for anything else.
pub fn square_root(x: &Rational) -> Option<Rational> {
    let (numerator, denominator) = x.parts();
    let root = |n: &BigInt| {
        let root = (!n.is_negative()).then(|| n.sqrt())?;
        (&root * &root == *n).then_some(root)
    };
    let (above, below) = (root(&numerator)?, root(&denominator)?);
    Some(Rational::from_parts(above, below))
}

fn power(x: &Rational, exponent: &Rational) -> Option<Rational> {
    let exponent = i32::try_from(exponent.to_integer()?).ok()?;
    let size = x.bits().saturating_mul(u64::from(exponent.unsigned_abs()));
    if size > MAX_BITS { None } else { x.powi(exponent) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_squares_have_roots() {
        assert_eq!(square_root(&Rational::new(9, 16)), Some(Rational::new(3, 4)));
        assert_eq!(square_root(&Rational::from(2)), None, "√2 is not rational");
        assert_eq!(square_root(&Rational::from(-4)), None, "nor is √-4 real");
    }
}
