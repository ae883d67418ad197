//! Real numbers of the oracle: floats with bounds of their errors.
//!
//! A number that differs from 0 by more than its error is certainly not 0. A sum whose error
//! contains 0 is taken for 0 if its error is 2^[`margin`] times smaller than its terms; otherwise
//! it is blurred, and more bits decide. Claims contain numbers above 10^-40 and their powers, which
//! are far above the error in the highest precision.

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::expr::Number;
use super::float::Float;
use super::series;

/// Precisions in bits; each is used where the one before it does not decide.
pub const LADDER: [usize; 3] = [640, 2048, 6144];
/// Number of bits that rounding may take from a sum that is nevertheless recognised as 0.
const SPENT: isize = 220;
/// Number of bits by which a number must exceed its error.
const SURE: isize = 4;
/// Largest argument of exp that is evaluated.
const STEEP: f64 = 300.0;
/// Exponent of the error of an exact number.
const EXACT: isize = isize::MIN / 4;

thread_local! {
    static BITS: Cell<usize> = const { Cell::new(LADDER[0]) };
    /// Whether a sum was taken for 0.
    static GUESSED: Cell<bool> = const { Cell::new(false) };
    /// Powers of ten by precision.
    static TENS: RefCell<BTreeMap<(usize, u32), Real>> = const { RefCell::new(BTreeMap::new()) };
}

/// Precision in which this thread computes.
pub fn bits() -> usize {
    BITS.get()
}

/// Computes something in another precision.
pub fn with_bits<T>(bits: usize, act: impl FnOnce() -> T) -> T {
    let before = BITS.replace(bits);
    let found = act();
    BITS.set(before);
    found
}

/// Computes something, and tells whether a sum in it was taken for 0.
pub fn guessed<T>(act: impl FnOnce() -> T) -> (T, bool) {
    let before = GUESSED.replace(false);
    let found = act();
    let guessed = GUESSED.replace(before);
    GUESSED.set(before | guessed);
    (found, guessed)
}

/// Number of bits by which the error of a sum must be below its terms for it to be 0.
fn margin() -> isize {
    let bits = bits() as isize;
    (bits - SPENT).max(bits / 2)
}

/// A float that differs from the exact number by at most 2^error.
#[derive(Clone, Debug)]
pub struct Real {
    value: Float,
    error: isize,
}

/// The reason why there is no number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lack {
    /// The formula is undefined.
    Value,
    /// Definedness is not decided here.
    Decision,
    /// The precision does not decide whether a number is 0.
    Digits,
}

pub type Found<T> = Result<T, Lack>;

/// Combines two parts: an undefined part leaves the whole undefined.
pub fn both<A, B>(a: Found<A>, b: Found<B>) -> Found<(A, B)> {
    match (a, b) {
        (Ok(a), Ok(b)) => Ok((a, b)),
        (Err(Lack::Value), _) | (_, Err(Lack::Value)) => Err(Lack::Value),
        (Err(Lack::Decision), _) | (_, Err(Lack::Decision)) => Err(Lack::Decision),
        _ => Err(Lack::Digits),
    }
}

impl Real {
    #[inline]
    fn exact(value: Float) -> Self {
        Self { value: value.cut(bits()), error: EXACT }
    }

    /// Adds the error of one rounding to those of the operands.
    #[inline]
    fn rounded(value: Float, error: isize) -> Self {
        let rounding = tall(&value) - bits() as isize + 1;
        Self { value, error: error.max(rounding) + 1 }
    }

    /// Returns the float itself as an exact number.
    pub fn middle(&self) -> Self {
        Self { value: self.value.clone(), error: EXACT }
    }

    /// Returns the number with an error of at least 2^error.
    pub fn blurred(&self, error: isize) -> Self {
        Self { value: self.value.clone(), error: self.error.max(error) }
    }

    /// Whether the number is 0, or certainly is not.
    #[inline]
    fn is_sure(&self) -> bool {
        tall(&self.value) > self.error + SURE || (is_zero(self) && self.error == EXACT)
    }

    /// Returns the number if it is known whether it is 0, with terms of this height in it.
    #[inline]
    fn settled(self, terms: isize) -> Found<Self> {
        match self.is_sure() {
            true => Ok(self),
            false if self.error <= terms - margin() => {
                GUESSED.set(true);
                Ok(whole(0))
            }
            false => Err(Lack::Digits),
        }
    }
}

/// Returns the place of the leading bit of a float; the least of all for 0.
#[inline]
fn tall(x: &Float) -> isize {
    x.top().unwrap_or(EXACT)
}

#[inline]
fn plus(a: &Real, b: &Real) -> Real {
    if [a, b].iter().all(|own| is_zero(own) && own.error == EXACT) {
        return whole(0);
    }
    Real::rounded(a.value.plus(&b.value, bits()), a.error.max(b.error) + 1)
}

#[inline]
fn minus(a: &Real, b: &Real) -> Real {
    Real::rounded(a.value.minus(&b.value, bits()), a.error.max(b.error) + 1)
}

#[inline]
fn times(a: &Real, b: &Real) -> Real {
    if is_zero(a) && a.error == EXACT || is_zero(b) && b.error == EXACT {
        return whole(0);
    }
    let error = [height(a) + b.error, height(b) + a.error, a.error + b.error];
    Real::rounded(a.value.times(&b.value, bits()), error.into_iter().fold(EXACT, isize::max) + 2)
}

/// Computes a/b for b that is certainly not 0.
fn over(a: &Real, b: &Real) -> Real {
    if is_zero(a) && a.error == EXACT {
        return whole(0);
    }
    // |b| is above 2^(height - 2) within its error.
    let down = height(b) - 2;
    let error = (a.error - down).max(height(a) + b.error - 2 * down).max(EXACT);
    Real::rounded(a.value.over(&b.value, bits()), error + 1)
}

macro_rules! operator {
    ($name:ident, $method:ident, $by:ident) => {
        impl $name<&Real> for &Real {
            type Output = Real;
            #[inline]
            fn $method(self, other: &Real) -> Real {
                $by(self, other)
            }
        }
        impl $name<Real> for &Real {
            type Output = Real;
            #[inline]
            fn $method(self, other: Real) -> Real {
                $by(self, &other)
            }
        }
        impl $name<&Real> for Real {
            type Output = Real;
            #[inline]
            fn $method(self, other: &Real) -> Real {
                $by(&self, other)
            }
        }
        impl $name<Real> for Real {
            type Output = Real;
            #[inline]
            fn $method(self, other: Real) -> Real {
                $by(&self, &other)
            }
        }
    };
}

operator!(Add, add, plus);
operator!(Sub, sub, minus);
operator!(Mul, mul, times);
operator!(Div, div, over);

impl Neg for &Real {
    type Output = Real;
    fn neg(self) -> Real {
        Real { value: self.value.negated(), error: self.error }
    }
}

impl Neg for Real {
    type Output = Real;
    fn neg(self) -> Real {
        -&self
    }
}

#[inline]
pub fn whole(n: i64) -> Real {
    Real::exact(Float::whole(n))
}

/// Converts a finite f64 exactly.
pub fn exactly(x: f64) -> Real {
    Real::exact(Float::exactly(x))
}

pub fn nearest(x: &Real) -> f64 {
    x.value.nearest()
}

pub fn number(number: Number) -> Real {
    let mut value = whole(number.top);
    if number.bottom != 1 {
        value = value / whole(number.bottom);
    }
    match number.tens {
        0 => value,
        1.. => value * tens(number.tens.unsigned_abs()),
        _ => value / tens(number.tens.unsigned_abs()),
    }
}

/// Returns a power of ten.
fn tens(power: u32) -> Real {
    let address = (bits(), power);
    if let Some(known) = TENS.with_borrow(|known| known.get(&address).cloned()) {
        return known;
    }
    let found = (0..power).fold(whole(1), |product, _| product * whole(10));
    TENS.with_borrow_mut(|known| known.insert(address, found.clone()));
    found
}

pub fn is_zero(x: &Real) -> bool {
    x.value.is_zero()
}

/// Returns -1, 0 or 1.
pub fn sign(x: &Real) -> i32 {
    x.value.sign()
}

/// Returns the sign, if it is certain.
pub fn sure_sign(x: &Real) -> Found<i32> {
    if x.is_sure() { Ok(sign(x)) } else { Err(Lack::Digits) }
}

/// Returns the place of the leading bit; the least of all for 0.
pub fn height(x: &Real) -> isize {
    tall(&x.value)
}

/// Computes a + b, or 0 where they cancel.
#[inline]
pub fn sum(a: &Real, b: &Real) -> Found<Real> {
    if is_zero(a) && a.error == EXACT {
        return Ok(b.clone());
    }
    if is_zero(b) && b.error == EXACT {
        return Ok(a.clone());
    }
    plus(a, b).settled(height(a).max(height(b)))
}

/// Computes a − b, or 0 where they cancel.
#[inline]
pub fn difference(a: &Real, b: &Real) -> Found<Real> {
    if is_zero(a) && a.error == EXACT {
        return Ok(-b);
    }
    if is_zero(b) && b.error == EXACT {
        return Ok(a.clone());
    }
    minus(a, b).settled(height(a).max(height(b)))
}

pub fn modulus(a: &Real) -> Real {
    if sign(a) < 0 { -a } else { a.clone() }
}

/// Computes the root of a non-negative number.
pub fn root(a: &Real) -> Found<Real> {
    match sure_sign(a)? {
        -1 => Err(Lack::Value),
        0 => Ok(whole(0)),
        _ => {
            let value = a.value.root(bits());
            let error = (a.error - tall(&value) + 2).max(EXACT);
            Ok(Real::rounded(value, error))
        }
    }
}

pub fn quotient(a: &Real, b: &Real) -> Found<Real> {
    if sure_sign(b)? == 0 { Err(Lack::Value) } else { Ok(a / b) }
}

pub fn exp(a: &Real) -> Found<Real> {
    match nearest(a).abs() {
        _ if is_zero(a) => Ok(whole(1)),
        0.0..STEEP if a.error < 0 => {
            let value = series::exp(&a.value, bits());
            let error = (tall(&value) + a.error + 1).max(EXACT);
            Ok(Real::rounded(value, error))
        }
        _ => Err(Lack::Decision),
    }
}

/// Computes the logarithm of a positive number.
pub fn log(a: &Real) -> Found<Real> {
    match sure_sign(a)? {
        1 if a.value == whole(1).value && a.error == EXACT => Ok(whole(0)),
        1 => {
            let error = (a.error - height(a) + 3).max(EXACT);
            Real::rounded(series::log(&a.value, bits()), error).settled(1)
        }
        _ => Err(Lack::Value),
    }
}

/// Computes sin and cos: 0 at multiples of a quarter turn.
pub fn waves(a: &Real) -> Found<(Real, Real)> {
    if is_zero(a) {
        return Ok((whole(0), whole(1)));
    }
    let (sin, cos) = series::waves(&a.value, bits());
    let settled = |value: Float| Real::rounded(value, a.error).settled(height(a).max(0));
    both(settled(sin), settled(cos))
}

pub fn atan(a: &Real) -> Real {
    if is_zero(a) {
        return whole(0);
    }
    Real::rounded(series::atan(&a.value, bits()), a.error)
}

/// Computes an integer power.
pub fn to_the(a: &Real, n: i64) -> Found<Real> {
    if n < 0 && sure_sign(a)? == 0 {
        return Err(Lack::Value);
    }
    let product = (0..n.unsigned_abs()).fold(whole(1), |product, _| product * a);
    if n < 0 { Ok(whole(1) / product) } else { Ok(product) }
}
