//! Balls over f64: a value with a running bound on its own error.
//!
//! A lane (a, r) stands for every real within r of a, and every operation returns a ball that
//! contains all results: with u = 2⁻⁵³ the unit roundoff and z = fl(a ∘ b),
//!
//! ```text
//! a ± b   r = ra + rb + u|z|
//! a b     r = |a| rb + |b| ra + ra rb + u|z|
//! 1/a     r = |z| ra/(|a| - ra) + u|z|                 only for |a| > ra
//! √a      r = ra/√a + u z                              only for a ≥ ra
//! ```
//!
//! The bounds are computed in f64 too: each is a sum of a few non-negative terms, so its own
//! relative error stays below 16u, and underflow adds less than `TINY`; both are put back by
//! `widen`. A lane that has no result holds NaN as its radius, and so do all that follow from it.
//!
//! Elementary functions come from the pure-Rust `libm`, whose sources (FreeBSD's msun) state an
//! error below one unit in the last place; two are allowed for here.

use super::rational::Rational;
use super::{BinaryOperation, Domain, Enclosing, UnaryFunction};

/// Unit roundoff of f64 under rounding to nearest.
pub(crate) const UNIT: f64 = f64::EPSILON / 2.0;
/// Two units in the last place, the error granted to an elementary function.
const ELEMENTARY: f64 = 2.0 * f64::EPSILON;
/// More than the underflow of any bound below: a handful of products, each off by at most 2⁻¹⁰⁷⁴.
pub(crate) const TINY: f64 = f64::MIN_POSITIVE;
/// Factor that restores the relative error of a bound.
pub(crate) const WIDER: f64 = 1.0 + 32.0 * UNIT;

/// The ball domain with `N` lanes.
#[derive(Clone, Copy, Debug, Default)]
pub struct Ball<const N: usize>;

/// `N` balls: midpoints and radii.
#[derive(Clone, Debug)]
pub struct Balls<const N: usize> {
    /// Midpoints.
    pub mid: [f64; N],
    /// Radii, non-negative; NaN or infinite where the lane is undefined or unbounded.
    pub rad: [f64; N],
}

impl<const N: usize> Balls<N> {
    /// Makes balls with the given midpoints and radii.
    pub fn new(mid: [f64; N], rad: [f64; N]) -> Self {
        Self { mid, rad }
    }

    /// Encloses numbers by their nearest f64; the flag tells whether the f64 is exact.
    pub fn about(nearest: impl Fn(usize) -> (f64, bool)) -> Self {
        let mut balls = Self { mid: [0.0; N], rad: [0.0; N] };
        for lane in 0..N {
            (balls.mid[lane], balls.rad[lane]) = about(nearest(lane));
        }
        balls
    }

    /// Whether the lane has a finite enclosure.
    pub fn is_defined(&self, lane: usize) -> bool {
        self.mid[lane].is_finite() && self.rad[lane].is_finite()
    }

    /// Whether 0 is outside the ball: a proof that the enclosed number is not 0.
    pub fn excludes_zero(&self, lane: usize) -> bool {
        self.is_defined(lane) && self.mid[lane].abs() > self.rad[lane]
    }

    /// Ratio |midpoint| / radius: at most 1 when the ball contains 0 (0/0 counts as 0).
    pub fn scaled(&self, lane: usize) -> f64 {
        if self.mid[lane] == 0.0 { 0.0 } else { self.mid[lane].abs() / self.rad[lane] }
    }
}

/// Restores what computing a bound in f64 may have lost.
#[inline(always)]
fn widen(radius: f64) -> f64 {
    radius * WIDER + TINY
}

/// Bounds e^x - 1 from above for x ≥ 0; unbounded from 1 on, where an enclosure is no longer
/// useful.
#[inline(always)]
fn growth(x: f64) -> f64 {
    if x < 1.0 { x + x * x } else { f64::INFINITY }
}

/// Encloses an exact number.
fn enclose(value: &Rational) -> (f64, f64) {
    about(value.to_f64())
}

/// Encloses a number by its nearest f64, given whether that is exact: midpoint and radius.
pub fn about((mid, exact): (f64, bool)) -> (f64, f64) {
    (mid, if exact { 0.0 } else { mid.abs() * f64::EPSILON + TINY })
}

impl<const N: usize> Domain for Ball<N> {
    type Block = Balls<N>;

    fn constant(&self, value: &Rational) -> Balls<N> {
        let (mid, rad) = enclose(value);
        Balls { mid: [mid; N], rad: [rad; N] }
    }

    fn values(&self, values: &[Rational]) -> Balls<N> {
        let mut block = Balls { mid: [f64::NAN; N], rad: [f64::NAN; N] };
        let mut last = (f64::NAN, f64::NAN);
        for lane in 0..N {
            last = values.get(lane).map_or(last, enclose);
            (block.mid[lane], block.rad[lane]) = last;
        }
        block
    }

    #[inline(always)]
    fn unary(&self, function: UnaryFunction, x: &Balls<N>, out: &mut Balls<N>) {
        match function {
            UnaryFunction::Neg => map(x, out, |a, r| (-a, r)),
            UnaryFunction::Abs => map(x, out, |a, r| (a.abs(), r)),
            UnaryFunction::Recip => map(x, out, reciprocal),
            UnaryFunction::Sqrt => map(x, out, square_root),
            UnaryFunction::Exp => map(x, out, exponential),
            UnaryFunction::Ln => map(x, out, logarithm),
            UnaryFunction::Sin => map(x, out, |a, r| bounded(libm::sin(a), r)),
            UnaryFunction::Cos => map(x, out, |a, r| bounded(libm::cos(a), r)),
            UnaryFunction::Atan => map(x, out, |a, r| bounded(libm::atan(a), r)),
        }
    }

    #[inline(always)]
    fn binary(&self, operation: BinaryOperation, x: &Balls<N>, y: &Balls<N>, out: &mut Balls<N>) {
        match operation {
            BinaryOperation::Add => zip(x, y, out, |a, ra, b, rb| {
                let z = a + b;
                (z, widen(ra + rb + UNIT * z.abs()))
            }),
            BinaryOperation::Sub => zip(x, y, out, |a, ra, b, rb| {
                let z = a - b;
                (z, widen(ra + rb + UNIT * z.abs()))
            }),
            BinaryOperation::Mul => zip(x, y, out, |a, ra, b, rb| {
                let z = a * b;
                (z, widen(a.abs() * rb + b.abs() * ra + ra * rb + UNIT * z.abs()))
            }),
            BinaryOperation::Pow => zip(x, y, out, power),
        }
    }

    #[inline(always)]
    fn power(&self, x: &Balls<N>, exponent: &Rational, out: &mut Balls<N>) {
        let (b, rb) = enclose(exponent);
        map(x, out, |a, ra| power(a, ra, b, rb));
    }
}

impl<const N: usize> Enclosing for Ball<N> {
    const LANES: usize = N;

    fn enclosure(block: &Balls<N>, lane: usize) -> Option<(f64, f64)> {
        block.is_defined(lane).then(|| (block.mid[lane], block.rad[lane]))
    }

    fn excludes_zero(block: &Balls<N>, lane: usize) -> bool {
        block.excludes_zero(lane)
    }
}

#[inline(always)]
fn reciprocal(a: f64, ra: f64) -> (f64, f64) {
    let z = 1.0 / a;
    let room = a.abs() - ra;
    let rad = widen(z.abs() * (ra / room) + UNIT * z.abs());
    (z, if room > 0.0 { rad } else { f64::NAN })
}

#[inline(always)]
fn square_root(a: f64, ra: f64) -> (f64, f64) {
    let z = a.sqrt();
    // |√x - √a| = |x - a|/(√x + √a) ≤ ra/√a; √0 is exactly 0.
    let spread = if ra > 0.0 { ra / z } else { 0.0 };
    let rad = widen(spread + UNIT * z);
    (z, if a >= ra { rad } else { f64::NAN })
}

fn exponential(a: f64, ra: f64) -> (f64, f64) {
    let z = libm::exp(a);
    (z, widen(z * growth(ra) + ELEMENTARY * z))
}

fn logarithm(a: f64, ra: f64) -> (f64, f64) {
    let z = libm::log(a);
    (z, if a > ra { widen(ra / (a - ra) + ELEMENTARY * z.abs()) } else { f64::NAN })
}

/// Encloses a function with slope and value at most 2: sin, cos, atan.
fn bounded(z: f64, ra: f64) -> (f64, f64) {
    (z, widen(ra + 2.0 * ELEMENTARY))
}

/// Encloses x^y = e^(y ln x): |y ln x - b ln a| ≤ rb |ln a| + (|b| + rb) t with
/// t = ra/(a - ra) ≥ |ln x - ln a|.
fn power(a: f64, ra: f64, b: f64, rb: f64) -> (f64, f64) {
    let z = libm::pow(a, b);
    let shift = ra / (a - ra);
    let exponent = widen(rb * libm::log(a).abs() * (1.0 + ELEMENTARY) + (b.abs() + rb) * shift);
    let rad = widen(z * growth(exponent) + ELEMENTARY * z);
    (z, if a > ra { rad } else { f64::NAN })
}

#[inline(always)]
fn map<const N: usize>(x: &Balls<N>, out: &mut Balls<N>, f: impl Fn(f64, f64) -> (f64, f64)) {
    for lane in 0..N {
        (out.mid[lane], out.rad[lane]) = f(x.mid[lane], x.rad[lane]);
    }
}

#[inline(always)]
fn zip<const N: usize>(
    x: &Balls<N>,
    y: &Balls<N>,
    out: &mut Balls<N>,
    f: impl Fn(f64, f64, f64, f64) -> (f64, f64),
) {
    for lane in 0..N {
        (out.mid[lane], out.rad[lane]) = f(x.mid[lane], x.rad[lane], y.mid[lane], y.rad[lane]);
    }
}
