//! Plain f64 in blocks of `N` lanes: the fastest domain. It carries no error bound.

use super::rational::Rational;
use super::{Domain, Function, Operation};

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
    fn unary(&self, function: Function, x: &Self::Block, out: &mut Self::Block) {
        match function {
            Function::Neg => map(x, out, |x| -x),
            Function::Recip => map(x, out, |x| 1.0 / x),
            Function::Sqrt => map(x, out, f64::sqrt),
            Function::Abs => map(x, out, f64::abs),
            Function::Exp => map(x, out, libm::exp),
            Function::Ln => map(x, out, libm::log),
            Function::Sin => map(x, out, libm::sin),
            Function::Cos => map(x, out, libm::cos),
            Function::Atan => map(x, out, libm::atan),
        }
    }

    #[inline(always)]
    fn binary(
        &self,
        operation: Operation,
        x: &Self::Block,
        y: &Self::Block,
        out: &mut Self::Block,
    ) {
        match operation {
            Operation::Add => zip(x, y, out, |x, y| x + y),
            Operation::Sub => zip(x, y, out, |x, y| x - y),
            Operation::Mul => zip(x, y, out, |x, y| x * y),
            Operation::Pow => zip(x, y, out, libm::pow),
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
