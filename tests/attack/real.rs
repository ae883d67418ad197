//! Real numbers of the oracle: floats of 640 bits in which a sum that cancels is 0.
//!
//! Claims contain numbers above 10^-40, whose squares can matter. A sum more than 2^420 times
//! smaller than its terms is taken for 0; between that and 2^340 it is undecided.

use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;

use super::expr::Number;

/// A float of [`BITS`] bits.
pub type Real = FBig<HalfEven, 2>;

pub const BITS: usize = 640;
/// Number of lost bits above which a sum is 0.
const ZERO: isize = 420;
/// Number of lost bits below which a sum is not 0.
const CLEAR: isize = 340;
/// Largest argument of exp that is evaluated.
const STEEP: f64 = 300.0;

/// The reason why there is no number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lack {
    /// The formula is undefined.
    Value,
    /// Definedness is not decided here.
    Decision,
}

pub type Found<T> = Result<T, Lack>;

/// Combines two parts: an undefined part leaves the whole undefined.
pub fn both<A, B>(a: Found<A>, b: Found<B>) -> Found<(A, B)> {
    match (a, b) {
        (Ok(a), Ok(b)) => Ok((a, b)),
        (Err(Lack::Value), _) | (_, Err(Lack::Value)) => Err(Lack::Value),
        _ => Err(Lack::Decision),
    }
}

pub fn whole(n: i64) -> Real {
    Real::from(n).with_precision(BITS).value()
}

/// Converts a finite f64 exactly.
pub fn exactly(x: f64) -> Real {
    Real::try_from(x).expect("a finite number").with_precision(BITS).value()
}

pub fn nearest(x: &Real) -> f64 {
    x.to_f64().value()
}

pub fn number(number: Number) -> Real {
    let mut value = whole(number.top);
    if number.bottom != 1 {
        value /= whole(number.bottom);
    }
    let tens = (0..number.tens.unsigned_abs()).fold(whole(1), |product, _| product * whole(10));
    match number.tens {
        0 => value,
        1.. => value * tens,
        _ => value / tens,
    }
}

pub fn is_zero(x: &Real) -> bool {
    x.repr().significand().is_zero()
}

/// Returns -1, 0 or 1.
pub fn sign(x: &Real) -> i32 {
    match is_zero(x) {
        true => 0,
        false if x.repr().significand() < &dashu_int::IBig::ZERO => -1,
        false => 1,
    }
}

/// Returns the place of the leading bit; the least of all for 0.
pub fn height(x: &Real) -> isize {
    if is_zero(x) { isize::MIN / 4 } else { x.repr().exponent() + x.repr().digits() as isize }
}

/// Computes a + b, or 0 where they cancel.
pub fn sum(a: &Real, b: &Real) -> Found<Real> {
    if is_zero(a) {
        return Ok(b.clone());
    }
    if is_zero(b) {
        return Ok(a.clone());
    }
    let total = a + b;
    let lost = height(a).max(height(b)) - height(&total);
    match lost {
        ZERO.. => Ok(whole(0)),
        CLEAR.. => Err(Lack::Decision),
        _ => Ok(total),
    }
}

pub fn difference(a: &Real, b: &Real) -> Found<Real> {
    sum(a, &-b)
}

pub fn modulus(a: &Real) -> Real {
    if sign(a) < 0 { -a } else { a.clone() }
}

/// Computes the root of a non-negative number.
pub fn root(a: &Real) -> Found<Real> {
    match sign(a) {
        -1 => Err(Lack::Value),
        0 => Ok(whole(0)),
        _ => Ok(a.sqrt()),
    }
}

pub fn quotient(a: &Real, b: &Real) -> Found<Real> {
    if is_zero(b) { Err(Lack::Value) } else { Ok(a / b) }
}

pub fn exp(a: &Real) -> Found<Real> {
    match nearest(a).abs() {
        _ if is_zero(a) => Ok(whole(1)),
        0.0..STEEP => Ok(a.exp()),
        _ => Err(Lack::Decision),
    }
}

/// Computes the logarithm of a positive number.
pub fn log(a: &Real) -> Found<Real> {
    match sign(a) {
        1 if *a == whole(1) => Ok(whole(0)),
        1 => Ok(a.ln()),
        _ => Err(Lack::Value),
    }
}

/// Computes an integer power.
pub fn to_the(a: &Real, n: i64) -> Found<Real> {
    if n < 0 && is_zero(a) {
        return Err(Lack::Value);
    }
    let product = (0..n.unsigned_abs()).fold(whole(1), |product, _| product * a);
    if n < 0 { Ok(whole(1) / product) } else { Ok(product) }
}
