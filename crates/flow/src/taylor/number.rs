//! Numbers of Taylor coefficients: f64, vectors of f64, or double-double.

use std::fmt::Debug;
use std::ops::{Add, Mul, Neg, Sub};

use crate::taylor::lanes::Lanes;
use crate::taylor::machine::TaylorCode;
use crate::taylor::series::Series;
use liouville::number::double_double::{DoubleDouble, two_product, two_sum};
use liouville::number::float::Float;
use liouville::number::rational::Rational;
use liouville::number::{Domain, UnaryFunction};

/// A number that series are made of; undefined ones are not finite.
pub trait SeriesNumber:
    Copy
    + Debug
    + Send
    + Sync
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Neg<Output = Self>
{
    /// Type of one lane.
    type One: SeriesNumber<One = Self::One>;
    /// The number 0.
    const ZERO: Self;
    /// The number 1.
    const ONE: Self;
    /// Number of orbits carried in one number.
    const LANES: usize;
    /// Number of coefficients that a dot product takes at once; rows are padded to multiples of it.
    const WIDTH: usize;
    /// Spacing of numbers at 1.
    const EPSILON: f64;
    /// Dot product before its parts are added up.
    type Partial: Copy;
    /// Machine code of expansions.
    type Machine;

    /// Rounds an exact constant once.
    fn rational(value: &Rational) -> Self;
    /// Builds a number lane by lane.
    fn from_lanes(value: impl Fn(usize) -> Self::One) -> Self;
    /// Returns one lane.
    fn lane(self, lane: usize) -> Self::One;
    /// Copies an f64 to all lanes.
    fn float(value: f64) -> Self;
    /// Leading part of the first lane.
    fn leading(self) -> f64;
    /// First lane as a pair.
    fn pair(self) -> DoubleDouble;
    /// Splits a pair into a number in all lanes and the rounding remainder.
    fn split(value: DoubleDouble) -> (Self, Self);
    /// Returns self + x y, to be normalised after the last term.
    fn fused(self, x: Self, y: Self) -> Self;
    /// Normalises a sum after its last term.
    #[inline(always)]
    fn settled(self) -> Self {
        self
    }
    /// Returns 1/x.
    fn recip(self) -> Self;
    /// Returns f(x).
    fn apply(self, function: UnaryFunction) -> Self;
    /// Returns x^q.
    fn power(self, exponent: &Rational) -> Self;
    /// Returns the larger of a size and |other|, which is left out where it is NaN.
    fn larger(self, other: Self) -> Self;
    /// Adds an increment to a compensated sum hi + lo.
    fn advance(hi: &mut Self, lo: &mut Self, increment: Self);

    /// Computes all orders of an expansion by machine code. Returns `false` where there is none for
    /// such numbers.
    #[inline(always)]
    fn by_machine(_: &mut Series<Self>) -> bool {
        false
    }

    /// Computes the field at the probed state by machine code. Returns `false` where there is none for
    /// such numbers.
    #[inline(always)]
    fn values_by_machine(_: &mut Series<Self>) -> bool {
        false
    }

    /// An empty sum of products.
    fn nothing() -> Self::Partial;
    /// Offset of order n of a copy from its place.
    #[inline(always)]
    fn copied(orders: usize, n: usize) -> usize {
        if Self::WIDTH > 1 { orders - n } else { n }
    }
    /// Returns sum + Σ x_k y_k. Both have the same length, a multiple of `WIDTH`. Where `WIDTH` is 1,
    /// y is in the opposite order, and the products may be negative.
    fn dot(sum: Self::Partial, x: &[Self], y: &[Self], negative: bool) -> Self::Partial;
    /// Adds the parts of several dot products at once.
    fn totals(sums: &[Self::Partial; BLOCK], totals: &mut [Self; BLOCK]);
}

/// Exponent below which an exponential function is 0 in f64.
const VANISHES: f64 = -760.0;

/// Applies a function to an f64, by the platform-independent implementation that tapes use.
#[inline(always)]
pub(crate) fn applied(function: UnaryFunction, x: f64) -> f64 {
    let mut out = [0.0];
    Float::<1>.unary(function, &[x], &mut out);
    out[0]
}

pub(crate) fn powered(x: f64, exponent: &Rational) -> f64 {
    let mut out = [0.0];
    Float::<1>.power(&[x], exponent, &mut out);
    out[0]
}

/// Number of lanes of a dot product along the order.
const WIDTH: usize = 8;
/// Number of dot products finished at once.
pub(crate) const BLOCK: usize = 8;

impl SeriesNumber for f64 {
    type One = f64;
    const ZERO: f64 = 0.0;
    const ONE: f64 = 1.0;
    const LANES: usize = 1;
    const EPSILON: f64 = f64::EPSILON;
    const WIDTH: usize = WIDTH;
    type Partial = Lanes<WIDTH>;
    type Machine = TaylorCode;

    fn rational(value: &Rational) -> Self {
        value.to_f64().0
    }
    #[inline(always)]
    fn from_lanes(value: impl Fn(usize) -> f64) -> Self {
        value(0)
    }
    #[inline(always)]
    fn lane(self, _: usize) -> f64 {
        self
    }
    #[inline(always)]
    fn float(value: f64) -> Self {
        value
    }
    #[inline(always)]
    fn leading(self) -> f64 {
        self
    }
    fn pair(self) -> DoubleDouble {
        DoubleDouble::from_f64(self)
    }
    fn split(value: DoubleDouble) -> (Self, Self) {
        (value.hi, value.lo)
    }
    #[inline(always)]
    fn fused(self, x: f64, y: f64) -> f64 {
        x.mul_add(y, self)
    }
    #[inline(always)]
    fn recip(self) -> Self {
        1.0 / self
    }
    #[inline(always)]
    fn apply(self, function: UnaryFunction) -> Self {
        applied(function, self)
    }
    fn power(self, exponent: &Rational) -> Self {
        powered(self, exponent)
    }
    #[inline(always)]
    fn larger(self, other: f64) -> f64 {
        self.max(other.abs())
    }
    #[inline(always)]
    fn advance(hi: &mut Self, lo: &mut Self, increment: Self) {
        (*hi, *lo) = two_sum(*hi, *lo + increment);
    }
    #[inline(always)]
    fn by_machine(series: &mut Series<f64>) -> bool {
        series.by_machine()
    }
    #[inline(always)]
    fn values_by_machine(series: &mut Series<f64>) -> bool {
        series.values_by_machine()
    }
    #[inline(always)]
    fn nothing() -> Lanes<WIDTH> {
        Lanes::ZERO
    }
    #[inline(always)]
    fn dot(mut sum: Lanes<WIDTH>, x: &[f64], y: &[f64], _: bool) -> Lanes<WIDTH> {
        let (x, y) = (x.as_chunks::<WIDTH>().0, y.as_chunks::<WIDTH>().0);
        for (x, y) in x.iter().zip(y) {
            sum = sum.fused(Lanes(*x), Lanes(*y));
        }
        sum
    }
    #[inline(always)]
    fn totals(sums: &[Lanes<WIDTH>; BLOCK], totals: &mut [f64; BLOCK]) {
        // Halves of two sums, quarters of four, and so on, are added side by side:
        // ((s₀ + s₄) + (s₂ + s₆)) + ((s₁ + s₅) + (s₃ + s₇)) for each.
        let [a, b, c, d] = std::array::from_fn(|k| folded::<4>(&sums[k].0, &sums[k + 4].0));
        let [a, b] = [folded::<2>(&a, &c), folded::<2>(&b, &d)];
        *totals = folded::<1>(&a, &b);
    }
}

/// Folds each run of 2H numbers in the middle: those of a, then those of b.
#[inline(always)]
fn folded<const H: usize>(a: &[f64; WIDTH], b: &[f64; WIDTH]) -> [f64; WIDTH] {
    let (mut near, mut far) = ([0.0; WIDTH], [0.0; WIDTH]);
    for k in 0..WIDTH {
        let (run, place) = (k / (2 * H), k % (2 * H));
        let from = if place < H { a } else { b };
        near[k] = from[run * 2 * H + place % H];
        far[k] = from[run * 2 * H + place % H + H];
    }
    std::array::from_fn(|k| near[k] + far[k])
}

impl SeriesNumber for DoubleDouble {
    type One = DoubleDouble;
    const ZERO: DoubleDouble = DoubleDouble { hi: 0.0, lo: 0.0 };
    const ONE: DoubleDouble = DoubleDouble { hi: 1.0, lo: 0.0 };
    const LANES: usize = 1;
    const EPSILON: f64 = f64::EPSILON * f64::EPSILON;
    const WIDTH: usize = WIDTH;
    type Partial = PairLanes;
    type Machine = ();

    fn rational(value: &Rational) -> Self {
        DoubleDouble::from_rational(value)
    }
    #[inline(always)]
    fn from_lanes(value: impl Fn(usize) -> DoubleDouble) -> Self {
        value(0)
    }
    #[inline(always)]
    fn lane(self, _: usize) -> DoubleDouble {
        self
    }
    #[inline(always)]
    fn float(value: f64) -> Self {
        DoubleDouble::from_f64(value)
    }
    #[inline(always)]
    fn leading(self) -> f64 {
        self.hi
    }
    fn pair(self) -> DoubleDouble {
        self
    }
    fn split(value: DoubleDouble) -> (Self, Self) {
        (value, Self::ZERO)
    }
    #[inline(always)]
    fn fused(self, x: DoubleDouble, y: DoubleDouble) -> DoubleDouble {
        // The rounding errors of products and sums are added up in the low part (Ogita, Rump, Oishi
        // 2005).
        let (product, error) = two_product(x.hi, y.hi);
        let (hi, rest) = two_sum(self.hi, product);
        let cross = x.hi.mul_add(y.lo, x.lo.mul_add(y.hi, error));
        DoubleDouble { hi, lo: self.lo + (rest + cross) }
    }
    #[inline(always)]
    fn settled(self) -> DoubleDouble {
        let (hi, lo) = two_sum(self.hi, self.lo);
        DoubleDouble { hi, lo }
    }
    #[inline(always)]
    fn recip(self) -> Self {
        DoubleDouble::recip(self)
    }
    #[inline(always)]
    fn apply(self, function: UnaryFunction) -> Self {
        match function {
            UnaryFunction::Sqrt => self.sqrt(),
            UnaryFunction::Exp if self.hi < VANISHES => Self::ZERO,
            _ => DoubleDouble::apply(self, function),
        }
    }
    fn power(self, exponent: &Rational) -> Self {
        DoubleDouble::power(self, exponent)
    }
    #[inline(always)]
    fn larger(self, other: DoubleDouble) -> DoubleDouble {
        DoubleDouble::from_f64(self.hi.max(other.hi.abs()))
    }
    #[inline(always)]
    fn advance(hi: &mut Self, _: &mut Self, increment: Self) {
        *hi = *hi + increment;
    }
    #[inline(always)]
    fn nothing() -> PairLanes {
        PairLanes { hi: [0.0; WIDTH], lo: [0.0; WIDTH] }
    }
    #[inline(always)]
    fn dot(mut sum: PairLanes, x: &[DoubleDouble], y: &[DoubleDouble], _: bool) -> PairLanes {
        let (x, y) = (x.as_chunks::<WIDTH>().0, y.as_chunks::<WIDTH>().0);
        for (x, y) in x.iter().zip(y) {
            for k in 0..WIDTH {
                let next = DoubleDouble { hi: sum.hi[k], lo: sum.lo[k] }.fused(x[k], y[k]);
                (sum.hi[k], sum.lo[k]) = (next.hi, next.lo);
            }
        }
        sum
    }
    #[inline(always)]
    fn totals(sums: &[PairLanes; BLOCK], totals: &mut [DoubleDouble; BLOCK]) {
        let (mut hi, mut lo) = ([0.0; BLOCK], [0.0; BLOCK]);
        for lane in 0..WIDTH {
            for (k, sum) in sums.iter().enumerate() {
                let (s, rest) = two_sum(hi[k], sum.hi[lane]);
                (hi[k], lo[k]) = (s, lo[k] + (rest + sum.lo[lane]));
            }
        }
        *totals = std::array::from_fn(|k| DoubleDouble { hi: hi[k], lo: lo[k] }.settled());
    }
}

/// Sums in double-double, one in each lane, not normalised.
#[derive(Clone, Copy)]
#[repr(align(64))]
pub struct PairLanes {
    hi: [f64; WIDTH],
    lo: [f64; WIDTH],
}
