//! num-dual's [`DualNum`] for [`Expr`], so that `Dual<Expr>` and its nestings record derivatives.
//!
//! Functions outside the graph's vocabulary are written in terms of it: `sinh x = (eˣ - e⁻ˣ)/2`,
//! `asin x = atan(x/√(1 - x²))`. Operations that need a magnitude or an order are refused.

use std::cmp::Ordering;
use std::iter::{Product, Sum};

use num_dual::{DualNum, DualStruct, Mappable};
use num_traits::{FromPrimitive, Inv, Num, One, Signed, Zero};

use super::expr::Expr;
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};
use crate::scalar::Scalar;

fn whole(value: i64) -> Expr {
    Expr::constant(Rational::from(value))
}

impl Zero for Expr {
    fn zero() -> Self {
        Expr::zero_node()
    }
    fn is_zero(&self) -> bool {
        self.is_zero_node()
    }
}

impl One for Expr {
    fn one() -> Self {
        Expr::one_node()
    }
    fn is_one(&self) -> bool {
        self.is_one_node()
    }
}

impl Num for Expr {
    type FromStrRadixErr = String;
    fn from_str_radix(text: &str, radix: u32) -> Result<Self, String> {
        if radix != 10 {
            return Err("only decimal numbers are read".to_string());
        }
        text.parse()
            .map(Expr::constant)
            .map_err(|error: crate::number::rational::RationalError| error.to_string())
    }
}

impl Inv for Expr {
    type Output = Expr;
    fn inv(self) -> Expr {
        self.recip()
    }
}

impl Sum for Expr {
    fn sum<I: Iterator<Item = Self>>(values: I) -> Self {
        values.fold(Self::zero(), |a, b| a + b)
    }
}

impl Product for Expr {
    fn product<I: Iterator<Item = Self>>(values: I) -> Self {
        values.fold(Self::one(), |a, b| a * b)
    }
}

impl FromPrimitive for Expr {
    fn from_i64(value: i64) -> Option<Self> {
        Some(whole(value))
    }
    fn from_u64(value: u64) -> Option<Self> {
        i64::try_from(value).ok().map(whole)
    }
    fn from_f64(value: f64) -> Option<Self> {
        Rational::from_f64(value).map(Expr::constant)
    }
}

impl Signed for Expr {
    fn abs(&self) -> Self {
        Expr::refuse("abs");
        *self
    }
    fn abs_sub(&self, _: &Self) -> Self {
        Expr::refuse("abs_sub");
        *self
    }
    fn signum(&self) -> Self {
        Expr::refuse("signum");
        *self
    }
    fn is_positive(&self) -> bool {
        Expr::refuse("is_positive");
        false
    }
    fn is_negative(&self) -> bool {
        Expr::refuse("is_negative");
        false
    }
}

impl PartialOrd for Expr {
    fn partial_cmp(&self, _: &Self) -> Option<Ordering> {
        Expr::refuse("<");
        None
    }
}

impl PartialOrd<f64> for Expr {
    fn partial_cmp(&self, _: &f64) -> Option<Ordering> {
        Expr::refuse("<");
        None
    }
}

impl DualStruct for Expr {
    type Real = f64;
    type Inner = Expr;
    fn re(&self) -> f64 {
        Expr::refuse("re");
        f64::NAN
    }
    fn from_inner(inner: &Expr) -> Self {
        *inner
    }
}

impl Mappable<Expr> for Expr {
    type Output<O> = O;
    fn map_dual<M: Fn(Expr) -> O, O>(self, f: M) -> O {
        f(self)
    }
}

impl DualNum for Expr {
    type Primitive = f64;
    const NDERIV: usize = 0;
    type InnerDual = Expr;

    fn from_re(re: Expr) -> Self {
        re
    }
    fn scale(self, factor: &Expr) -> Self {
        self * factor
    }
    fn recip(&self) -> Self {
        self.unary(UnaryFunction::Recip)
    }
    fn powi(&self, n: i32) -> Self {
        self.power(&Rational::from(i64::from(n)))
    }
    fn powf(&self, n: f64) -> Self {
        self.power_of(Expr::from(n))
    }
    fn powd(&self, exponent: Self) -> Self {
        self.power_of(exponent)
    }
    fn sqrt(&self) -> Self {
        self.unary(UnaryFunction::Sqrt)
    }
    fn cbrt(&self) -> Self {
        self.power(&Rational::new(1, 3))
    }
    fn exp(&self) -> Self {
        self.unary(UnaryFunction::Exp)
    }
    fn exp2(&self) -> Self {
        whole(2).power_of(*self)
    }
    fn exp_m1(&self) -> Self {
        self.exp() - Self::one()
    }
    fn ln(&self) -> Self {
        self.unary(UnaryFunction::Ln)
    }
    fn log(&self, base: f64) -> Self {
        self.ln() / Expr::from(base).ln()
    }
    fn log2(&self) -> Self {
        self.ln() / whole(2).ln()
    }
    fn log10(&self) -> Self {
        self.ln() / whole(10).ln()
    }
    fn ln_1p(&self) -> Self {
        (Self::one() + *self).ln()
    }
    fn sin(&self) -> Self {
        self.unary(UnaryFunction::Sin)
    }
    fn cos(&self) -> Self {
        self.unary(UnaryFunction::Cos)
    }
    fn tan(&self) -> Self {
        self.sin() / self.cos()
    }
    fn sin_cos(&self) -> (Self, Self) {
        (self.sin(), self.cos())
    }
    fn asin(&self) -> Self {
        (*self / (Self::one() - *self * *self).sqrt()).atan()
    }
    fn acos(&self) -> Self {
        // π/2 = 2 atan 1
        whole(2) * Self::one().atan() - self.asin()
    }
    fn atan(&self) -> Self {
        self.unary(UnaryFunction::Atan)
    }
    fn atan2(&self, _: Self) -> Self {
        Expr::refuse("atan2");
        *self
    }
    fn sinh(&self) -> Self {
        (self.exp() - (-*self).exp()) / whole(2)
    }
    fn cosh(&self) -> Self {
        (self.exp() + (-*self).exp()) / whole(2)
    }
    fn tanh(&self) -> Self {
        self.sinh() / self.cosh()
    }
    fn asinh(&self) -> Self {
        let by_root = || (*self + (*self * *self + Self::one()).sqrt()).ln();
        self.area_of_sine().unwrap_or_else(by_root)
    }
    fn acosh(&self) -> Self {
        let by_root = || (*self + (*self * *self - Self::one()).sqrt()).ln();
        self.area_of_cosine().unwrap_or_else(by_root)
    }
    fn atanh(&self) -> Self {
        ((Self::one() + *self) / (Self::one() - *self)).ln() / whole(2)
    }
    fn sph_j0(&self) -> Self {
        self.sin() / *self
    }
    fn sph_j1(&self) -> Self {
        (self.sin() - *self * self.cos()) / (*self * *self)
    }
    fn sph_j2(&self) -> Self {
        let square = *self * *self;
        ((whole(3) - square) * self.sin() - whole(3) * *self * self.cos()) / (square * *self)
    }
    fn mul_add(&self, a: Self, b: Self) -> Self {
        self.binary(BinaryOperation::Mul, a) + b
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Evaluator, Fault, Tape, record};
    use super::*;
    use crate::number::float::Float;
    use num_dual::Dual;

    /// Compares second derivatives recorded through the graph with those of num-dual at f64.
    fn second_derivative_agrees(
        name: &str,
        point: f64,
        f: impl Fn(Nested<Expr>) -> Nested<Expr>,
        g: impl Fn(Nested<f64>) -> Nested<f64>,
    ) {
        let (graph, recorded) = record(1, |inputs| {
            let x =
                Dual::new(Dual::new(inputs[0], Expr::one()), Dual::new(Expr::one(), Expr::zero()));
            let value = f(x);
            [value.re.re, value.re.eps, value.eps.eps]
        })
        .expect("a smooth function records");
        let tape = Tape::new(&graph, &recorded);
        let mut evaluator = Evaluator::new(&tape, Float::<1>);
        evaluator.run(&[[point]]);
        let direct = g(Dual::new(Dual::new(point, 1.0), Dual::new(1.0, 0.0)));
        for (output, expected) in
            [direct.re.re, direct.re.eps, direct.eps.eps].into_iter().enumerate()
        {
            let found = evaluator.output(output)[0];
            let error = (found - expected).abs() / expected.abs().max(1.0);
            assert!(error < 1e-12, "{name}, derivative {output}: {found} against {expected}");
        }
    }

    type Nested<T> = Dual<Dual<T>>;

    macro_rules! check {
        ($($name:ident($argument:literal) at $point:literal;)*) => {$(
            second_derivative_agrees(stringify!($name), $point, |x| x.$name($argument), |x| x.$name($argument));
        )*};
        ($($name:ident at $point:literal;)*) => {$(
            second_derivative_agrees(stringify!($name), $point, |x| x.$name(), |x| x.$name());
        )*};
    }

    #[test]
    fn every_function_records_what_num_dual_computes() {
        check! {
            recip at 0.7; sqrt at 0.7; cbrt at 0.7; exp at 0.7; exp2 at 0.7; exp_m1 at 0.7;
            ln at 0.7; log2 at 0.7; log10 at 0.7; ln_1p at 0.7; sin at 0.7; cos at 0.7; tan at 0.7;
            asin at 0.7; acos at 0.7; atan at 0.7; sinh at 0.7; cosh at 0.7; tanh at 0.7;
            asinh at 0.7; acosh at 1.7; atanh at 0.7;
        }
        check! { powi(3) at 0.7; powi(-2) at 0.7; powf(2.5) at 0.7; log(3.0) at 0.7; }
    }

    #[test]
    fn what_needs_a_magnitude_is_refused() {
        let fault = record(1, |inputs| inputs[0].abs()).expect_err("abs has no meaning here");
        assert_eq!(fault, Fault::NeedsValue("abs"));
        let fault = record(1, |inputs| inputs[0] < inputs[0]).expect_err("nor has an order");
        assert_eq!(fault, Fault::NeedsValue("<"));
        let fault = record(2, |inputs| inputs[0].atan2(inputs[1])).expect_err("nor a quadrant");
        assert_eq!(fault, Fault::NeedsValue("atan2"));
    }

    #[test]
    fn a_value_of_another_recording_is_refused() {
        let (_, stray) = record(1, |inputs| inputs[0]).expect("records");
        let fault = record(1, |inputs| inputs[0] + stray).expect_err("it belongs to another graph");
        assert_eq!(fault, Fault::ForeignValue);
    }
}
