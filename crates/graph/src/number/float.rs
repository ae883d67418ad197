//! Plain f64 in blocks of `N` lanes: the fastest domain. It carries no error bound.

use super::rational::Rational;
use super::{BinaryOperation, Domain, UnaryFunction};

/// The f64 domain with `N` lanes. An undefined lane holds NaN.
#[derive(Clone, Copy, Debug, Default)]
pub struct Float<const N: usize>;

impl<const N: usize> Domain for Float<N> {
    type Block = [f64; N];

    fn constant(&self, value: &Rational) -> Self::Block {
        [value.to_f64().0; N]
    }

    fn values(&self, values: &[Rational]) -> Self::Block {
        let last = values.len().saturating_sub(1);
        std::array::from_fn(|lane| values.get(lane.min(last)).map_or(f64::NAN, |v| v.to_f64().0))
    }

    #[inline(always)]
    fn unary(&self, function: UnaryFunction, x: &Self::Block, out: &mut Self::Block) {
        match function {
            UnaryFunction::Neg => map(x, out, |x| -x),
            UnaryFunction::Recip => map(x, out, |x| 1.0 / x),
            UnaryFunction::Sqrt => map(x, out, f64::sqrt),
            UnaryFunction::Abs => map(x, out, f64::abs),
            UnaryFunction::Exp => map(x, out, libm::exp),
            UnaryFunction::Ln => map(x, out, libm::log),
            UnaryFunction::Sin => map(x, out, libm::sin),
            UnaryFunction::Cos => map(x, out, libm::cos),
            UnaryFunction::Atan => map(x, out, libm::atan),
        }
    }

    #[inline(always)]
    fn binary(
        &self,
        operation: BinaryOperation,
        x: &Self::Block,
        y: &Self::Block,
        out: &mut Self::Block,
    ) {
        match operation {
            BinaryOperation::Add => zip(x, y, out, |x, y| x + y),
            BinaryOperation::Sub => zip(x, y, out, |x, y| x - y),
            BinaryOperation::Mul => zip(x, y, out, |x, y| x * y),
            BinaryOperation::Pow => zip(x, y, out, libm::pow),
        }
    }

    #[inline(always)]
    fn power(&self, x: &Self::Block, exponent: &Rational, out: &mut Self::Block) {
        let exponent = exponent.to_f64().0;
        map(x, out, |x| libm::pow(x, exponent));
    }
}

#[inline(always)]
fn map<const N: usize>(x: &[f64; N], out: &mut [f64; N], f: impl Fn(f64) -> f64) {
    for lane in 0..N {
        out[lane] = f(x[lane]);
    }
}

#[inline(always)]
fn zip<const N: usize>(
    x: &[f64; N],
    y: &[f64; N],
    out: &mut [f64; N],
    f: impl Fn(f64, f64) -> f64,
) {
    for lane in 0..N {
        out[lane] = f(x[lane], y[lane]);
    }
}
