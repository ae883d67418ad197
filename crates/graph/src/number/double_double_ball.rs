//! Balls over double-double: the midpoint is an unevaluated sum hi + lo of two f64, some 32 digits.
//!
//! With u = 2⁻⁵³ and z the result, the midpoints obey
//!
//! ```text
//! x ± y   within 3u² + 13u³ of the sum      (Joldes, Muller, Popescu 2017, algorithm 6)   4u² used
//! x y     within 5u² of the product         (the same, algorithm 10)                      8u² used
//! 1/x     q + q r,  q = fl(1/hi), r = 1 - q x: r² ≤ 9u², rounding of r ≤ 6u², of q r ≤ 3u²  32u² used
//! √x      s + r/2s, s = fl(√hi),  r = x - s²: (r/2s)²/2s ≤ 2u² s, rounding ≤ 6u² s         16u² used
//! ```
//!
//! and the radii are those of [`ball`](super::ball), in f64. The error of a product is exact by a
//! fused multiply-add as long as it does not underflow; `TINY` restores what is lost then, divided
//! by s for a root. Elementary functions are computed in [`arb`](super::arb) arithmetic.

use super::arb::{Approximation, ArbBall};
use super::double_double::DoubleDouble;
use super::rational::Rational;
use super::{BinaryOperation, Domain, Enclosing, UnaryFunction};

/// u², the unit of the error bounds.
const UNIT: f64 = (f64::EPSILON / 2.0) * (f64::EPSILON / 2.0);
/// More than underflow takes from any operation.
const TINY: f64 = f64::MIN_POSITIVE;
/// Precision in bits of elementary functions.
const ELEMENTARY_BITS: u32 = 140;

/// The domain of double-double balls with `N` lanes.
#[derive(Clone, Copy, Debug, Default)]
pub struct DoubleDoubleBall<const N: usize>;

/// `N` balls: midpoints hi + lo, and radii.
#[derive(Clone, Debug)]
pub struct DoubleDoubleBalls<const N: usize> {
    /// The nearest f64 of each midpoint.
    pub hi: [f64; N],
    /// The remainder of each midpoint, at most half a unit in the last place of `hi`.
    pub lo: [f64; N],
    /// Radii; NaN or infinite where the lane is undefined or unbounded.
    pub rad: [f64; N],
}

/// One lane: hi, lo, radius.
type Lane = (f64, f64, f64);

const UNDEFINED: Lane = (f64::NAN, f64::NAN, f64::NAN);

impl<const N: usize> DoubleDoubleBalls<N> {
    /// Whether the lane has a finite enclosure.
    pub fn is_defined(&self, lane: usize) -> bool {
        self.hi[lane].is_finite() && self.rad[lane].is_finite()
    }

    fn lane(&self, lane: usize) -> Lane {
        (self.hi[lane], self.lo[lane], self.rad[lane])
    }
}

#[inline(always)]
fn pair(hi: f64, lo: f64) -> DoubleDouble {
    DoubleDouble { hi, lo }
}

/// Restores what computing a bound in f64 may have lost.
#[inline(always)]
fn widen(radius: f64) -> f64 {
    radius * (1.0 + 16.0 * f64::EPSILON) + TINY
}

#[inline(always)]
fn add((a, al, ra): Lane, (b, bl, rb): Lane) -> Lane {
    let z = pair(a, al) + pair(b, bl);
    (z.hi, z.lo, widen(ra + rb + 4.0 * UNIT * z.hi.abs()))
}

#[inline(always)]
fn multiply((a, al, ra): Lane, (b, bl, rb): Lane) -> Lane {
    let z = pair(a, al) * pair(b, bl);
    (z.hi, z.lo, widen(a.abs() * rb + b.abs() * ra + ra * rb + 8.0 * UNIT * z.hi.abs()))
}

#[inline(always)]
fn reciprocal((a, al, ra): Lane) -> Lane {
    let z = pair(a, al).recip();
    // The midpoint is |a| up to one part in 2^53.
    let room = a.abs() * (1.0 - f64::EPSILON) - ra;
    let rad = widen(z.hi.abs() * (ra / room) + 32.0 * UNIT * z.hi.abs());
    (z.hi, z.lo, if room > 0.0 { rad } else { f64::NAN })
}

#[inline(always)]
fn square_root((a, al, ra): Lane) -> Lane {
    let s = a.sqrt();
    let z = pair(a, al).sqrt();
    // |√x - √a| ≤ |x - a|/√a; √0 is exactly 0.
    let rad = widen((ra + TINY) / (s * (1.0 - f64::EPSILON)) + 16.0 * UNIT * s);
    let is_zero = a == 0.0 && ra == 0.0;
    let rad = if is_zero { 0.0 } else { rad };
    let lowest = a * (1.0 - f64::EPSILON);
    (z.hi, z.lo, if lowest >= ra || is_zero { rad } else { f64::NAN })
}

/// Computes an elementary function by way of higher precision.
fn elementary(lane: Lane, f: impl Fn(&ArbBall, &Approximation) -> Option<Approximation>) -> Lane {
    let domain = ArbBall::new(ELEMENTARY_BITS);
    Approximation::from_double_double(lane.0, lane.1, lane.2)
        .and_then(|x| f(&domain, &x))
        .map_or(UNDEFINED, |z| z.to_double_double())
}

impl<const N: usize> Domain for DoubleDoubleBall<N> {
    type Block = DoubleDoubleBalls<N>;

    fn constant(&self, value: &Rational) -> DoubleDoubleBalls<N> {
        let (hi, lo, rad) = enclose(value);
        DoubleDoubleBalls { hi: [hi; N], lo: [lo; N], rad: [rad; N] }
    }

    fn values(&self, values: &[Rational]) -> DoubleDoubleBalls<N> {
        let mut block =
            DoubleDoubleBalls { hi: [f64::NAN; N], lo: [f64::NAN; N], rad: [f64::NAN; N] };
        let mut last = UNDEFINED;
        for lane in 0..N {
            last = values.get(lane).map_or(last, enclose);
            (block.hi[lane], block.lo[lane], block.rad[lane]) = last;
        }
        block
    }

    #[inline(always)]
    fn unary(
        &self,
        function: UnaryFunction,
        x: &DoubleDoubleBalls<N>,
        out: &mut DoubleDoubleBalls<N>,
    ) {
        match function {
            UnaryFunction::Neg => map(x, out, |(a, al, ra)| (-a, -al, ra)),
            UnaryFunction::Abs => {
                map(x, out, |(a, al, ra)| if a < 0.0 { (-a, -al, ra) } else { (a, al, ra) });
            }
            UnaryFunction::Recip => map(x, out, reciprocal),
            UnaryFunction::Sqrt => map(x, out, square_root),
            UnaryFunction::Exp
            | UnaryFunction::Ln
            | UnaryFunction::Sin
            | UnaryFunction::Cos
            | UnaryFunction::Atan => {
                map(x, out, |lane| elementary(lane, |domain, x| domain.function(function, x)));
            }
        }
    }

    #[inline(always)]
    fn binary(
        &self,
        operation: BinaryOperation,
        x: &DoubleDoubleBalls<N>,
        y: &DoubleDoubleBalls<N>,
        out: &mut DoubleDoubleBalls<N>,
    ) {
        match operation {
            BinaryOperation::Add => zip(x, y, out, add),
            BinaryOperation::Sub => zip(x, y, out, |x, (b, bl, rb)| add(x, (-b, -bl, rb))),
            BinaryOperation::Mul => zip(x, y, out, multiply),
            BinaryOperation::Pow => zip(x, y, out, |x, y| {
                let y = Approximation::from_double_double(y.0, y.1, y.2);
                elementary(x, |domain, x| domain.power_of(x, y.as_ref()?))
            }),
        }
    }

    fn power(&self, x: &DoubleDoubleBalls<N>, exponent: &Rational, out: &mut DoubleDoubleBalls<N>) {
        map(x, out, |lane| elementary(lane, |domain, x| domain.rational_power(x, exponent)));
    }
}

impl<const N: usize> Enclosing for DoubleDoubleBall<N> {
    const LANES: usize = N;

    fn enclosure(block: &DoubleDoubleBalls<N>, lane: usize) -> Option<(f64, f64)> {
        let (hi, lo, rad) = block.lane(lane);
        // The radius must cover the part of the midpoint that is left out.
        block.is_defined(lane).then(|| (hi, if lo == 0.0 { rad } else { widen(rad + lo.abs()) }))
    }

    fn excludes_zero(block: &DoubleDoubleBalls<N>, lane: usize) -> bool {
        let (hi, lo, rad) = block.lane(lane);
        block.is_defined(lane) && hi.abs() - lo.abs() > rad
    }
}

/// Returns hi, lo and radius of an exact number.
fn enclose(value: &Rational) -> Lane {
    let (hi, exact) = value.to_f64();
    let rest = match Rational::from_f64(hi) {
        Some(nearest) if !exact => (value - &nearest).to_f64(),
        _ => (0.0, true),
    };
    let rad = if rest.1 { 0.0 } else { widen(rest.0.abs() * f64::EPSILON) };
    (hi, rest.0, rad)
}

#[inline(always)]
fn map<const N: usize>(
    x: &DoubleDoubleBalls<N>,
    out: &mut DoubleDoubleBalls<N>,
    f: impl Fn(Lane) -> Lane,
) {
    for lane in 0..N {
        (out.hi[lane], out.lo[lane], out.rad[lane]) = f((x.hi[lane], x.lo[lane], x.rad[lane]));
    }
}

#[inline(always)]
fn zip<const N: usize>(
    x: &DoubleDoubleBalls<N>,
    y: &DoubleDoubleBalls<N>,
    out: &mut DoubleDoubleBalls<N>,
    f: impl Fn(Lane, Lane) -> Lane,
) {
    for lane in 0..N {
        (out.hi[lane], out.lo[lane], out.rad[lane]) =
            f((x.hi[lane], x.lo[lane], x.rad[lane]), (y.hi[lane], y.lo[lane], y.rad[lane]));
    }
}
