//! Functions exp, ln, sin, cos and atan of balls, by series in fixed-point integers.
//!
//! Each is computed at the midpoint with w bits after the point, where one unit is 2^-w. A step of
//! a series (a truncated product or quotient) is off by at most 2 units, its terms only shrink, and
//! the truncated rest is below one unit; so K terms are within 4K + 4 units. The effect of the
//! argument reduction is stated at each function. The radius of the argument is added, times a
//! bound on the derivative.

use std::collections::BTreeMap;
use std::sync::{LazyLock, Mutex};

use num_bigint::{BigInt, BigUint};
use num_integer::Integer;
use num_traits::{One, Signed, ToPrimitive, Zero};

use super::Approximation;

/// Log₂ of the largest argument of exp, sin and cos.
const LARGEST: i64 = 52;
/// Number of guard bits for the multiples of ln 2 and π/2 in the argument reduction.
const GUARD: u32 = 72;
/// Number of halvings of the argument of exp before the series, and of squarings after it.
const HALVINGS: u32 = 12;

/// Truncates the midpoint m·2^e to an integer number of units 2^-w: off by less than one unit.
fn fixed(x: &Approximation, w: u32) -> BigInt {
    let (mantissa, exponent, _) = x.parts();
    let shift = exponent + i64::from(w);
    if shift >= 0 { mantissa << shift as u64 } else { mantissa >> (-shift) as u64 }
}

/// Bounds the radius from above in units of 2^-w.
fn spread(x: &Approximation, w: u32) -> BigUint {
    let (_, exponent, radius) = x.parts();
    let (radius, shift) = (BigUint::from(radius), exponent + i64::from(w));
    match shift {
        0.. => radius << shift as u64,
        _ if radius.is_zero() => radius,
        _ => (radius >> (-shift) as u64) + BigUint::one(),
    }
}

fn made(value: BigInt, error: BigUint, w: u32, bits: u32) -> Approximation {
    Approximation::new(value, error, -i64::from(w), bits)
}

/// Computes ln 2 and π with w bits after the point, each within 8w + 64 units.
fn constants(w: u32) -> (BigInt, BigInt) {
    static KNOWN: LazyLock<Mutex<BTreeMap<u32, (BigInt, BigInt)>>> = LazyLock::new(Mutex::default);
    if let Ok(known) = KNOWN.lock()
        && let Some(found) = known.get(&w)
    {
        return found.clone();
    }
    let one = BigInt::one() << w;
    // ln 2 = 18 artanh(1/26) - 2 artanh(1/4801) + 8 artanh(1/8749), the coefficients taken in guard
    // bits; π = 16 arctan(1/5) - 4 arctan(1/239).
    let guard = 8u32;
    let one = one << guard;
    let series = |n: u32, sign: i32| {
        let (square, mut power) = (BigInt::from(n) * n, &one / n);
        let (mut sum, mut k, mut positive) = (power.clone(), 1u32, true);
        while !power.is_zero() {
            power /= &square;
            k += 2;
            positive = positive == (sign > 0);
            let term = &power / k;
            if positive { sum += term } else { sum -= term }
        }
        sum
    };
    let ln2 = series(26, 1) * 18 - series(4801, 1) * 2 + series(8749, 1) * 8;
    let pi = series(5, -1) * 16 - series(239, -1) * 4;
    let found = (ln2 >> guard, pi >> guard);
    if let Ok(mut known) = KNOWN.lock() {
        known.insert(w, found.clone());
    }
    found
}

/// Computes e^x; `None` beyond 2^52 or where the radius exceeds 1/2.
pub fn exp(x: &Approximation, bits: u32) -> Option<Approximation> {
    if x.magnitude() > LARGEST {
        return None;
    }
    // Guard bits for the terms and for the squarings.
    let w = bits + HALVINGS + 48;
    let units = spread(x, w);
    if units.bits() >= u64::from(w) {
        return None;
    }
    let (ln2, _): (BigInt, BigInt) = constants(w + GUARD);
    let argument: BigInt = fixed(x, w + GUARD);
    let doubled: BigInt = &argument * 2 + &ln2;
    let turns = doubled.div_floor(&(&ln2 * 2));
    // |r| ≤ ln 2/2 + 1 unit; n ln 2 is off by less than 2^53 (8w + 640) units of 2^-(w+72).
    let reduced: BigInt = (argument - &turns * ln2) >> (GUARD + HALVINGS);
    let one = BigInt::one() << w;
    let (mut sum, mut term, mut k) = (&one + &reduced, reduced.clone(), 1u32);
    while !term.is_zero() && term != BigInt::from(-1) {
        k += 1;
        term = ((term * &reduced) >> w) / k;
        sum += &term;
    }
    for _ in 0..HALVINGS {
        sum = (&sum * &sum) >> w;
    }
    // Squaring doubles the relative error each time, and adds a unit; all values are below 2.
    let own = BigUint::from(16 * k + 64) << (HALVINGS + 2);
    // e^x changes by at most e^x (e^ρ - 1) ≤ 2 ρ e^x for ρ ≤ 1/2.
    let error = own + ((units + 1u8) << 3);
    let turns = turns.to_i64()?;
    Some(Approximation::new(sum, error, turns - i64::from(w), bits))
}

/// Computes ln x, for x > 0.
pub fn ln(x: &Approximation, bits: u32) -> Option<Approximation> {
    if !x.is_positive() {
        return None;
    }
    let (mantissa, exponent, radius) = x.parts();
    // x = f 2^n with f between 3/4 and 3/2.
    let length = mantissa.bits() as i64;
    let top = (mantissa >> (length - 2).max(0) as u64).to_i64()?;
    let binary = if length == 1 || top == 2 { length - 1 } else { length };
    let turns = binary + exponent;
    let w = bits + 48;
    let scaled = Approximation::exact(mantissa.clone(), -binary);
    let f = fixed(&scaled, w);
    let one = BigInt::one() << w;
    // ln f = 2 artanh z with |z| = |f - 1|/(f + 1) ≤ 1/5; the derivative of artanh is below 2
    // there.
    let z = ((&f - &one) << w) / (&f + &one);
    let square = (&z * &z) >> w;
    let (mut sum, mut power, mut k) = (z.clone(), z, 1u32);
    while !power.is_zero() && power != BigInt::from(-1) {
        power = (power * &square) >> w;
        k += 2;
        sum += &power / k;
    }
    let (ln2, _) = constants(w);
    let value = (sum << 1) + ln2 * turns;
    let constant = BigUint::from(turns.unsigned_abs()) * (8 * w + 64);
    // |ln x - ln m| ≤ r/(m - r)
    let mut error = BigUint::from(8 * k + 64) + constant;
    if radius > 0 {
        let room = mantissa.magnitude() - BigUint::from(radius);
        error += (BigUint::from(radius) << w) / room + BigUint::one();
    }
    Some(made(value, error, w, bits))
}

/// Computes sin x and cos x; `None` beyond 2^52.
pub fn sin_cos(x: &Approximation, bits: u32) -> Option<(Approximation, Approximation)> {
    if x.magnitude() > LARGEST {
        return None;
    }
    let w = bits + 48;
    let (_, pi) = constants(w + GUARD);
    let argument = fixed(x, w + GUARD);
    // x = q π/2 + r with |r| ≤ π/4; the error of q π/2 vanishes in the guard bits.
    let scaled: BigInt = &argument * 4 + &pi;
    let quarter = scaled.div_floor(&(&pi * 2));
    let r: BigInt = (argument - ((&quarter * &pi) >> 1)) >> GUARD;
    let one = BigInt::one() << w;
    let (mut sine, mut cosine) = (r.clone(), one.clone());
    let (mut term, mut k) = (r.clone(), 1u32);
    while !term.is_zero() && term != BigInt::from(-1) {
        k += 1;
        term = ((term * &r) >> w) / k;
        match k % 4 {
            0 => cosine += &term,
            1 => sine += &term,
            2 => cosine -= &term,
            _ => sine -= &term,
        }
    }
    let error = BigUint::from(8 * k + 64) + spread(x, w);
    let pair = match quarter.mod_floor(&BigInt::from(4)).to_i64()? {
        0 => (sine, cosine),
        1 => (cosine, -sine),
        2 => (-sine, -cosine),
        _ => (-cosine, sine),
    };
    Some((made(pair.0, error.clone(), w, bits), made(pair.1, error, w, bits)))
}

/// Computes arctan x.
pub fn atan(x: &Approximation, bits: u32) -> Option<Approximation> {
    let w = bits + 48;
    // |x| > 1: arctan x = ±π/2 - arctan(1/x).
    let turned = x.magnitude() > 0;
    let argument = match turned {
        false => x.clone(),
        true => match x.recip(w + 8) {
            Some(inverse) => inverse,
            None => return Some(made(BigInt::zero(), BigUint::from(2u8) << w, w, bits)),
        },
    };
    let is_negative = argument.parts().0.is_negative();
    let mut t = fixed(&argument, w);
    let one = BigInt::one() << w;
    // arctan t = 2 arctan(t/(1 + √(1 + t²))) halves the argument, and errors do not grow.
    const HALVED: u32 = 4;
    for _ in 0..HALVED {
        let square: BigInt = &t * &t + (&one << w);
        let root = BigInt::from(square.magnitude().sqrt());
        t = (t << w) / (&one + root);
    }
    let square = (&t * &t) >> w;
    let (mut sum, mut power, mut k) = (t.clone(), t, 1u32);
    while !power.is_zero() && power != BigInt::from(-1) {
        power = -((power * &square) >> w);
        k += 2;
        sum += &power / k;
    }
    let mut value = sum << HALVED;
    if turned {
        let (_, pi) = constants(w);
        let half: BigInt = pi >> 1;
        let half = if is_negative { -half } else { half };
        value = half - value;
    }
    // Four halvings are off by a few units each, doubled again on the way back; π by 8w + 64.
    let own = (BigUint::from(8 * k + 128) << HALVED) + BigUint::from(8 * w + 64);
    Some(made(value, own + spread(&argument, w), w, bits))
}
