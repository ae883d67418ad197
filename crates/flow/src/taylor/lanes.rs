//! Vectors of f64, one lane for each orbit.

use std::ops::{Add, Mul, Neg, Sub};

use crate::taylor::batch::MOTION_LANES;
use crate::taylor::machine::LaneMachine;
use crate::taylor::number::{BLOCK, SeriesNumber, applied, powered};
use crate::taylor::series::Series;
use liouville::number::UnaryFunction;
use liouville::number::double_double::{DoubleDouble, two_sum};
use liouville::number::rational::Rational;

/// A vector of `N` f64, one lane for each orbit.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub struct Lanes<const N: usize>(pub [f64; N]);

macro_rules! lanewise {
    ($($trait:ident $method:ident $operator:tt;)*) => {$(
        impl<const N: usize> $trait for Lanes<N> {
            type Output = Self;
            #[inline(always)]
            fn $method(mut self, other: Self) -> Self {
                for lane in 0..N {
                    self.0[lane] $operator other.0[lane];
                }
                self
            }
        }
    )*};
}

lanewise! { Add add +=; Sub sub -=; Mul mul *=; }

impl<const N: usize> Neg for Lanes<N> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(self.0.map(|x| -x))
    }
}

impl<const N: usize> Default for Lanes<N> {
    fn default() -> Self {
        Self([0.0; N])
    }
}

/// Number of lanes that series have.
const N: usize = MOTION_LANES;

impl SeriesNumber for Lanes<N> {
    type One = f64;
    const ZERO: Self = Self([0.0; N]);
    const ONE: Self = Self([1.0; N]);
    const LANES: usize = N;
    const EPSILON: f64 = f64::EPSILON;
    const WIDTH: usize = 1;
    /// Sums of every eighth term, as a dot product of one motion has them.
    type Partial = [Self; BLOCK];
    type Machine = LaneMachine;

    fn rational(value: &Rational) -> Self {
        Self([value.to_f64().0; N])
    }
    #[inline(always)]
    fn from_lanes(value: impl Fn(usize) -> f64) -> Self {
        Self(std::array::from_fn(value))
    }
    #[inline(always)]
    fn lane(self, lane: usize) -> f64 {
        self.0[lane]
    }
    #[inline(always)]
    fn float(value: f64) -> Self {
        Self([value; N])
    }
    #[inline(always)]
    fn leading(self) -> f64 {
        self.0[0]
    }
    fn pair(self) -> DoubleDouble {
        DoubleDouble::from_f64(self.0[0])
    }
    fn split(value: DoubleDouble) -> (Self, Self) {
        (Self([value.hi; N]), Self([value.lo; N]))
    }
    #[inline(always)]
    fn fused(mut self, x: Self, y: Self) -> Self {
        for lane in 0..N {
            self.0[lane] = x.0[lane].mul_add(y.0[lane], self.0[lane]);
        }
        self
    }
    #[inline(always)]
    fn recip(self) -> Self {
        Self(self.0.map(|x| 1.0 / x))
    }
    #[inline(always)]
    fn apply(self, function: UnaryFunction) -> Self {
        Self(self.0.map(|x| applied(function, x)))
    }
    fn power(self, exponent: &Rational) -> Self {
        Self(self.0.map(|x| powered(x, exponent)))
    }
    #[inline(always)]
    fn advance(hi: &mut Self, lo: &mut Self, increment: Self) {
        for lane in 0..N {
            (hi.0[lane], lo.0[lane]) = two_sum(hi.0[lane], lo.0[lane] + increment.0[lane]);
        }
    }
    #[inline(always)]
    fn larger(mut self, other: Self) -> Self {
        for lane in 0..N {
            self.0[lane] = self.0[lane].max(other.0[lane].abs());
        }
        self
    }
    #[inline(always)]
    fn by_machine(series: &mut Series<Self>) -> bool {
        series.by_machine()
    }
    #[inline(always)]
    fn values_by_machine(series: &mut Series<Self>) -> bool {
        series.values_by_machine()
    }
    #[inline(always)]
    fn nothing() -> [Self; BLOCK] {
        [Self::ZERO; BLOCK]
    }
    #[inline(always)]
    fn dot(mut sums: [Self; BLOCK], x: &[Self], y: &[Self], negative: bool) -> [Self; BLOCK] {
        for (k, (x, y)) in x.iter().zip(y.iter().rev()).enumerate() {
            let x = if negative { -*x } else { *x };
            sums[k % BLOCK] = sums[k % BLOCK].fused(x, *y);
        }
        sums
    }
    #[inline(always)]
    fn totals(sums: &[[Self; BLOCK]; BLOCK], totals: &mut [Self; BLOCK]) {
        for (total, s) in totals.iter_mut().zip(sums) {
            *total = ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7]));
        }
    }
}
