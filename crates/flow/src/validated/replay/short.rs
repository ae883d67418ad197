//! Balls of short integers: (m ± r) 2^e with 62 bits of m and 40 bits of r.
//!
//! Over a box the width leaves no more digits than these. No operation rounds in f64; each rounds the
//! radius up.

use super::number::{ReplayNumber, Wide};
use liouville::number::UnaryFunction;
use liouville::number::arb::Approximation;
use liouville::number::rational::Rational;

/// Largest bits of a midpoint and of a radius.
const BITS: u32 = 62;
const RADIUS_BITS: u32 = 40;
/// Bits of a longer number that are read.
const READ: u64 = 96;
/// Exponents beyond which nothing is known.
const MOST: i64 = 1 << 40;

/// All reals within r 2^e of m 2^e.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Ball {
    m: i64,
    r: u64,
    e: i64,
}

/// Ball of short integers, or an unknown number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Short(Option<Ball>);

/// Number of bits of a number.
fn bits(x: u128) -> u32 {
    128 - x.leading_zeros()
}

/// Encloses (m ± r) 2^e, for |m| and r below 2^126.
fn rounded(m: i128, r: u128, e: i64) -> Short {
    let long = bits(m.unsigned_abs()).saturating_sub(BITS);
    let wide = bits(r).saturating_sub(RADIUS_BITS);
    let shift = long.max(wide);
    let rest = |x: u128| u128::from(x & ((1 << shift) - 1) != 0);
    // A negative midpoint is rounded down, by less than one unit too.
    let radius = (r >> shift) + rest(r) + rest(m.unsigned_abs());
    let (m, r, e) = ((m >> shift) as i64, radius as u64, e + i64::from(shift));
    match (m, r) {
        (0, 0) => Short(Some(Ball { m, r, e: 0 })),
        _ => Short(Some(Ball { m, r, e }).filter(|_| e.abs() < MOST)),
    }
}

impl Ball {
    fn size(&self) -> u128 {
        u128::from(self.m.unsigned_abs())
    }

    fn is_zero(&self) -> bool {
        self.m == 0 && self.r == 0
    }

    fn sum(&self, other: &Self) -> Short {
        let (coarse, fine) = if self.e >= other.e { (self, other) } else { (other, self) };
        if coarse.is_zero() || fine.is_zero() {
            return Short(Some(if coarse.is_zero() { *fine } else { *coarse }));
        }
        let apart = coarse.e - fine.e;
        let up = apart.min(i64::from(BITS));
        // What is finer still is cut off: less than a unit of the midpoint, and of the radius.
        let down = (apart - up).min(64) as u32;
        let cut = u128::from(down > 0);
        let m = (i128::from(coarse.m) << up) + (i128::from(fine.m) >> down);
        let r = (u128::from(coarse.r) << up) + (u128::from(fine.r) >> down) + 2 * cut;
        rounded(m, r, coarse.e - up)
    }

    fn product(&self, other: &Self) -> Short {
        let (r, s) = (u128::from(self.r), u128::from(other.r));
        let radius = self.size() * s + other.size() * r + r * s;
        rounded(i128::from(self.m) * i128::from(other.m), radius, self.e + other.e)
    }

    /// Encloses the reciprocals: |1/x - 1/m| ≤ r/(|m| (|m| - r)).
    fn reciprocal(&self) -> Short {
        let (size, r) = (self.size(), u128::from(self.r));
        if size <= r {
            return Short(None);
        }
        let shift = BITS + bits(size);
        let quotient = (1_u128 << shift) / size;
        // The quotient is cut off, by less than a unit.
        let cut = u128::from(quotient * size != 1 << shift);
        let radius = ((quotient + cut) * r).div_ceil(size - r) + cut;
        let signed = if self.m < 0 { -(quotient as i128) } else { quotient as i128 };
        rounded(signed, radius, -self.e - i64::from(shift))
    }
}

impl Short {
    /// Encloses a ball of many bits.
    pub fn of_wide(x: &Wide) -> Self {
        let Some(value) = x.block() else { return Self(None) };
        let (mantissa, exponent, radius) = value.parts();
        if exponent.abs() >= MOST {
            return Self(None);
        }
        let shift = mantissa.bits().saturating_sub(READ);
        let cut = u128::from(shift > 0);
        let Ok(m) = i128::try_from(mantissa >> shift) else { return Self(None) };
        let radius = (u128::from(radius) >> shift.min(64)) + 2 * cut;
        rounded(m, radius, exponent + shift as i64)
    }

    /// Encloses the ball in one of many bits.
    pub fn wide(&self) -> Wide {
        let Some(Ball { m, r, e }) = self.0 else { return Wide::unknown() };
        let number = |x: i128| Wide::from_block(Some(Approximation::exact(x.into(), e)));
        let around = Wide::about(0.0, 1.0).times(&number(r.into()));
        number(m.into()).plus(&around)
    }

    fn both(&self, other: &Self, operation: impl Fn(&Ball, &Ball) -> Self) -> Self {
        match (&self.0, &other.0) {
            (Some(x), Some(y)) => operation(x, y),
            _ => Self(None),
        }
    }
}

impl ReplayNumber for Short {
    fn exact(x: f64) -> Self {
        let (written, hidden) = (x.to_bits(), 1_u64 << 52);
        let exponent = i64::try_from(written >> 52 & 0x7ff).unwrap_or(0);
        let digits = i128::from(written & (hidden - 1) | if exponent > 0 { hidden } else { 0 });
        let m = if x.is_sign_negative() { -digits } else { digits };
        match x.is_finite() {
            true => rounded(m, 0, exponent.max(1) - 1075),
            false => Self(None),
        }
    }

    fn of(value: &Rational) -> Self {
        Self::of_wide(&Wide::of(value))
    }

    fn unknown() -> Self {
        Self(None)
    }

    fn plus(&self, other: &Self) -> Self {
        self.both(other, Ball::sum)
    }

    fn times(&self, other: &Self) -> Self {
        self.both(other, Ball::product)
    }

    fn neg(&self) -> Self {
        Self(self.0.map(|own| Ball { m: -own.m, ..own }))
    }

    fn recip(&self) -> Self {
        self.0.map_or(Self(None), |own| own.reciprocal())
    }

    fn apply(&self, function: UnaryFunction) -> Self {
        Self::of_wide(&self.wide().apply(function))
    }

    fn power(&self, exponent: &Rational) -> Self {
        Self::of_wide(&self.wide().power(exponent))
    }

    fn is_zero(&self) -> bool {
        self.0.is_some_and(|own| own.is_zero())
    }

    fn is_known(&self) -> bool {
        self.0.is_some()
    }

    fn is_positive(&self) -> bool {
        self.0.is_some_and(|own| own.m > 0 && own.size() > u128::from(own.r))
    }

    fn magnitude(&self) -> Self {
        let Some(own) = self.0 else { return Self(None) };
        rounded((own.size() + u128::from(own.r)) as i128, 0, own.e)
    }

    fn within(bound: &Self) -> Self {
        let Some(own) = bound.magnitude().0 else { return Self(None) };
        rounded(0, own.size() + u128::from(own.r), own.e)
    }

    fn mid(&self) -> f64 {
        self.wide().mid()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::validated::tests::Random;

    fn exact(x: i128, e: i64) -> Wide {
        Wide::from_block(Some(Approximation::exact(x.into(), e)))
    }

    /// Least and largest number of a ball.
    fn ends(x: &Short) -> [Wide; 2] {
        let Ball { m, r, e } = x.0.expect("known");
        [exact(i128::from(m) - i128::from(r), e), exact(i128::from(m) + i128::from(r), e)]
    }

    /// Asserts that a ball holds numbers that nearly fill it.
    fn assert_fits(found: &Short, numbers: &[Wide], what: &str) {
        let Ball { m, r, e } = found.0.expect(what);
        let (mid, radius) = (exact(m.into(), e), exact(r.into(), e));
        let off = |x: &Wide| x.minus(&mid).magnitude();
        let far = numbers.iter().fold(Wide::zero(), |far, x| far.larger(&off(x)));
        let last = far.magnitude().mul(&Wide::exact(1e-60));
        assert!(!radius.add(&last).is_below(&far), "{what}: {found:?} does not hold {numbers:?}");
        let share = |x: &Wide, power: i32| x.magnitude().mul(&Wide::exact(2f64.powi(power)));
        let room = far.add(&share(&far, -36)).add(&share(&mid, -59));
        assert!(!room.is_below(&radius), "{what}: {found:?} is wider than {numbers:?}");
    }

    #[test]
    fn operations_hold_all_results() {
        let mut random = Random(11);
        for trial in 0..20_000 {
            let mut number = || {
                let power = libm::exp2(libm::floor(random.between(-90.0, 90.0)));
                let mid = random.between(-2.0, 2.0) * power;
                let share = [0.0, 1e-30, 1e-17, 1e-9, 0.3, 1e6][trial % 6];
                let rad = mid.abs() * share * random.between(0.0, 1.0);
                Short::of_wide(&Wide::about(mid, rad))
            };
            let (x, y) = (number(), number());
            let (a, b) = (ends(&x), ends(&y));
            let both = |of: &dyn Fn(&Wide, &Wide) -> Wide| -> Vec<Wide> {
                a.iter().flat_map(|x| b.iter().map(move |y| of(x, y))).collect()
            };
            let what = |name: &str| format!("{trial}: {name} of {x:?}, {y:?}");
            assert_fits(&x.plus(&y), &both(&Wide::plus), &what("sum"));
            assert_fits(&x.minus(&y), &both(&Wide::minus), &what("difference"));
            assert_fits(&x.times(&y), &both(&Wide::times), &what("product"));
            assert_eq!(Short::of_wide(&x.wide()), x, "there and back");
            let is_positive = a[0].is_positive();
            assert_eq!(x.is_positive(), is_positive, "{}", what("sign"));
            let excludes = is_positive || a[1].neg().is_positive();
            assert_eq!(x.recip().is_known(), excludes, "{}", what("reciprocal"));
            if excludes {
                assert_fits(&x.recip(), &a.each_ref().map(Wide::recip), &what("reciprocal"));
            }
            assert!(!x.is_below(&y) || a[1].is_below(&b[0]), "{}", what("order"));
            let size = x.magnitude();
            assert!(a.iter().all(|end| !ends(&size)[1].is_below(&end.magnitude())));
        }
    }

    #[test]
    fn long_numbers_are_held() {
        let third = Wide::of(&Rational::new(-1, 3));
        let short = Short::of_wide(&third);
        assert_fits(&short, std::slice::from_ref(&third), "a third");
        assert_fits(&short.neg(), &[third.neg()], "a third");
        let root = Short::exact(2.0).apply(UnaryFunction::Sqrt);
        assert_fits(&root, &[Wide::exact(2.0).apply(UnaryFunction::Sqrt)], "√2");
        for x in [0.1, -0.1, 1.0, -3e200, f64::MIN_POSITIVE, -f64::from_bits(3), f64::MAX] {
            let [least, most] = ends(&Short::exact(x));
            assert!(least.minus(&Wide::exact(x)).is_zero() && most.minus(&least).is_zero(), "{x}");
        }
        assert!(Short::exact(-0.0).is_zero(), "both zeros");
    }

    #[test]
    fn what_is_not_known_stays_so() {
        let (one, none) = (Short::exact(1.0), Short::unknown());
        for x in [one.plus(&none), none.times(&Short::zero()), none.recip(), none.neg()] {
            assert!(!x.is_known() && !x.is_positive() && !x.is_below(&one), "{x:?}");
        }
        assert!(!Short::zero().recip().is_known() && !Short::exact(f64::NAN).is_known());
        assert!(!Short::exact(f64::NEG_INFINITY).is_known());
        assert!(!one.neg().apply(UnaryFunction::Sqrt).is_known(), "no root");
        let mut huge = Short::exact(2.0);
        for _ in 0..60 {
            huge = huge.times(&huge);
        }
        assert!(!huge.is_known(), "out of range: {huge:?}");
    }
}
