//! Arithmetic of balls (m ± r)·2^e, exact up to rounding.

use num_bigint::{BigInt, BigUint};
use num_traits::{One, Signed, ToPrimitive, Zero};

use super::super::rational::Rational;

/// Largest size of a radius in bits: the digits of the midpoint beneath it carry no information.
const RADIUS_BITS: u64 = 32;
/// Bound on exponents, beyond which [`Approximation::in_range`] gives up. A few thousand products
/// of numbers within it do not overflow.
const LARGEST_EXPONENT: u64 = 1 << 45;
/// Largest number of bits to which sums in full precision are aligned.
const MOST_ALIGNED: u64 = 1 << 17;

/// The interval of all reals within r·2^e of m·2^e.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Approximation {
    mantissa: BigInt,
    exponent: i64,
    /// Radius in units of 2^e.
    radius: u64,
}

impl Approximation {
    /// Makes m·2^e exactly.
    pub fn exact(mantissa: BigInt, exponent: i64) -> Self {
        Self { mantissa, exponent, radius: 0 }
    }

    /// Makes (m ± r)·2^e, cut to `bits` and to the digits that the radius leaves significant.
    pub(super) fn new(mantissa: BigInt, radius: BigUint, exponent: i64, bits: u32) -> Self {
        let long = mantissa.bits().saturating_sub(u64::from(bits));
        let wide = radius.bits().saturating_sub(RADIUS_BITS);
        let shift = long.max(wide);
        if shift == 0 {
            let radius = radius.to_u64().unwrap_or(u64::MAX);
            return Self { mantissa, exponent, radius };
        }
        let loses = mantissa.trailing_zeros().is_some_and(|zeros| zeros < shift);
        let mut radius: BigUint =
            if radius.is_zero() { radius } else { (radius >> shift) + BigUint::one() };
        if loses {
            radius += BigUint::one();
        }
        let radius = radius.to_u64().unwrap_or(u64::MAX);
        Self {
            mantissa: mantissa >> shift,
            exponent: exponent.saturating_add(shift as i64),
            radius,
        }
    }

    /// Returns the number unless its exponent is too large or too small to be reliable.
    pub fn in_range(self) -> Option<Self> {
        let fits = self.mantissa.is_zero() && self.radius == 0
            || self.exponent.unsigned_abs() <= LARGEST_EXPONENT;
        fits.then_some(self)
    }

    /// Converts an f64 exactly; `None` for NaN and infinities.
    pub fn from_f64(value: f64) -> Option<Self> {
        let (above, below) = Rational::from_f64(value)?.parts();
        // The denominator of an f64 is a power of two.
        Some(Self::exact(above, 1 - below.bits() as i64))
    }

    /// Makes the ball of radius `rad` around hi + lo.
    pub fn from_double_double(hi: f64, lo: f64, rad: f64) -> Option<Self> {
        let mid = Self::from_f64(hi)?.add(&Self::from_f64(lo)?, u32::MAX);
        let rad = Self::from_f64(rad)?;
        // As an integer number of units that are no larger than either.
        let unit = mid.exponent.min(rad.exponent);
        let mantissa = mid.mantissa << (mid.exponent - unit) as u64;
        let radius = rad.mantissa.magnitude() << (rad.exponent - unit) as u64;
        Some(Self::new(mantissa, radius, unit, u32::MAX))
    }

    /// Returns the midpoint as m·2^e, and the radius in units of 2^e.
    pub fn parts(&self) -> (&BigInt, i64, u64) {
        (&self.mantissa, self.exponent, self.radius)
    }

    /// Returns the midpoint as an exact number.
    pub fn midpoint(&self) -> Self {
        Self { radius: 0, ..self.clone() }
    }

    /// Whether the number is exactly 0.
    pub fn is_zero(&self) -> bool {
        self.mantissa.is_zero() && self.radius == 0
    }

    /// Whether 0 is outside the interval.
    pub fn excludes_zero(&self) -> bool {
        self.mantissa.magnitude() > &BigUint::from(self.radius)
    }

    /// Whether every number of the interval is positive.
    pub fn is_positive(&self) -> bool {
        self.mantissa.is_positive() && self.excludes_zero()
    }

    /// Number of bits of the midpoint before the binary point; negative for small numbers.
    pub(super) fn magnitude(&self) -> i64 {
        (self.mantissa.bits() as i64).saturating_add(self.exponent)
    }

    /// Returns midpoint and radius in f64, the radius covering both roundings.
    pub fn enclosure(&self) -> (f64, f64) {
        let mid = to_f64(&self.mantissa, self.exponent);
        let radius = to_f64(&BigInt::from(self.radius), self.exponent);
        if !mid.is_finite() {
            return (f64::MAX.copysign(mid), f64::INFINITY);
        }
        let exact = self.radius == 0
            && Self::from_f64(mid).is_some_and(|back| back.add(&self.neg(), u32::MAX).is_zero());
        let rounding = if exact { 0.0 } else { mid.abs() * f64::EPSILON + f64::MIN_POSITIVE };
        (mid, radius * (1.0 + 4.0 * f64::EPSILON) + rounding)
    }

    /// Returns hi, lo and radius.
    pub fn to_double_double(&self) -> (f64, f64, f64) {
        let hi = to_f64(&self.mantissa, self.exponent);
        let Some(nearest) = Self::from_f64(hi) else { return (hi, 0.0, f64::INFINITY) };
        let rest = self.add(&nearest.neg(), u32::MAX);
        let (lo, rad) = rest.enclosure();
        (hi, lo, rad)
    }

    /// Returns |approximate - x|, rounded to f64; infinite for arguments that are not finite.
    pub fn distance(&self, approximate: f64) -> f64 {
        Self::from_f64(approximate).map_or(f64::INFINITY, |other| {
            let rest = self.add(&other.neg(), u32::MAX);
            to_f64(&rest.mantissa, rest.exponent).abs()
        })
    }

    /// Computes -x.
    pub fn neg(&self) -> Self {
        Self { mantissa: -&self.mantissa, ..self.clone() }
    }

    /// Returns |x| as the ball around the absolute value of the midpoint.
    pub fn abs(&self) -> Self {
        Self { mantissa: self.mantissa.abs(), ..self.clone() }
    }

    /// Rounds to at most `bits` bits.
    pub fn rounded(self, bits: u32) -> Self {
        Self::new(self.mantissa, self.radius.into(), self.exponent, bits)
    }

    /// Computes x + y.
    pub fn add(&self, other: &Self, bits: u32) -> Self {
        let (coarse, fine) = match self.exponent >= other.exponent {
            true => (self, other),
            false => (other, self),
        };
        if coarse.is_zero() {
            return fine.clone().rounded(bits);
        }
        if fine.is_zero() {
            return coarse.clone().rounded(bits);
        }
        let apart = coarse.exponent.abs_diff(fine.exponent);
        let room = u64::from(bits).min(MOST_ALIGNED).saturating_mul(2).saturating_add(128);
        if coarse.radius > 0 || apart > room.saturating_add(fine.mantissa.bits()) {
            // Digits finer than the coarse radius carry no information; an exact coarse number is
            // first refined as far as the result can be.
            let refine = if coarse.radius > 0 { 0 } else { room };
            let coarse_mantissa = &coarse.mantissa << refine;
            let drop = apart.saturating_sub(refine);
            let mantissa = coarse_mantissa + (&fine.mantissa >> drop);
            let dropped = fine.radius.checked_shr(drop.min(64) as u32).unwrap_or(0) + 2;
            let radius = BigUint::from(coarse.radius) + BigUint::from(dropped);
            let exponent = coarse.exponent.saturating_sub(refine as i64);
            return Self::new(mantissa, radius, exponent, bits);
        }
        let mantissa = (&coarse.mantissa << apart) + &fine.mantissa;
        Self::new(mantissa, fine.radius.into(), fine.exponent, bits)
    }

    /// Computes x y.
    pub fn mul(&self, other: &Self, bits: u32) -> Self {
        let mantissa = &self.mantissa * &other.mantissa;
        // Out of range if it saturates.
        let exponent = self.exponent.saturating_add(other.exponent);
        // |m| s + |n| r + r s
        let mut radius = BigUint::zero();
        if other.radius > 0 {
            radius += self.mantissa.magnitude() * other.radius;
        }
        if self.radius > 0 {
            radius += other.mantissa.magnitude() * self.radius;
            radius += BigUint::from(self.radius) * other.radius;
        }
        Self::new(mantissa, radius, exponent, bits)
    }

    /// Computes 1/x, unless 0 is in the interval.
    pub fn recip(&self, bits: u32) -> Option<Self> {
        let size = self.mantissa.magnitude();
        if !self.excludes_zero() {
            return None;
        }
        let room = size - BigUint::from(self.radius);
        let shift = u64::from(bits.min(1 << 24)) + size.bits() + 1;
        let one = BigInt::one() << shift;
        let quotient = &one / &self.mantissa;
        // |1/x - 1/m| ≤ (1/|m|) r/(|m| - r), and one unit each for two roundings.
        let mut radius = BigUint::zero();
        if self.radius > 0 {
            radius += quotient.magnitude() * self.radius / room + BigUint::from(2u8);
        }
        if &quotient * &self.mantissa != one {
            radius += BigUint::one();
        }
        let exponent = self.exponent.saturating_neg().saturating_sub(shift as i64);
        Some(Self::new(quotient, radius, exponent, bits))
    }

    /// Encloses √x for those x of the interval that are not negative, if there are any.
    pub fn sqrt_where_real(&self, bits: u32) -> Option<Self> {
        let upper = Self::exact(&self.mantissa + BigInt::from(self.radius), self.exponent);
        if self.excludes_zero() || upper.mantissa.is_negative() {
            return self.sqrt(bits);
        }
        let root = upper.sqrt(bits)?;
        let radius = root.mantissa.magnitude() + BigUint::from(root.radius);
        Some(Self::new(BigInt::zero(), radius, root.exponent, bits))
    }

    /// Computes √x, unless a negative number is in the interval.
    pub fn sqrt(&self, bits: u32) -> Option<Self> {
        if self.is_zero() {
            return Some(self.clone());
        }
        if self.mantissa.is_negative() || self.mantissa.magnitude() < &BigUint::from(self.radius) {
            return None;
        }
        let wanted = 2 * u64::from(bits.min(1 << 24)) + 2;
        let mut shift = wanted.saturating_sub(self.mantissa.bits());
        if self.exponent.saturating_sub(shift as i64) % 2 != 0 {
            shift += 1;
        }
        let square = self.mantissa.magnitude() << shift;
        let root = square.sqrt();
        // |√x - √m| ≤ r/√m
        let mut radius = BigUint::zero();
        if self.radius > 0 {
            radius += (BigUint::from(self.radius) << shift) / &root + BigUint::from(2u8);
        }
        if &root * &root != square {
            radius += BigUint::one();
        }
        let exponent = self.exponent.saturating_sub(shift as i64) / 2;
        Some(Self::new(BigInt::from(root), radius, exponent, bits))
    }
}

/// Returns the f64 nearest to m·2^e, or one of the nearest two where it is subnormal.
fn to_f64(mantissa: &BigInt, exponent: i64) -> f64 {
    let size = mantissa.magnitude();
    let shift = size.bits().saturating_sub(64);
    let mut head = (size >> shift).to_u64().unwrap_or(0);
    if size.trailing_zeros().is_some_and(|zeros| zeros < shift) {
        // A bit was cut off: no longer a tie.
        head |= 1;
    }
    let exponent = exponent.saturating_add(shift as i64).clamp(-4000, 4000) as i32;
    let value = libm::scalbn(head as f64, exponent);
    if mantissa.is_negative() { -value } else { value }
}
