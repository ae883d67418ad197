//! Functions of floats: exp, log, sin and cos by series of their own, atan by that of the library.

use std::cell::RefCell;
use std::collections::BTreeMap;

use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;
use dashu_int::{IBig, Sign, UBig};

use super::float::Float;

/// A float of the library.
pub type Foreign = FBig<HalfEven, 2>;

/// Number of bits in which intermediate results exceed a result.
const GUARD: usize = 64;

/// A constant as a sum of arcus or area tangents of 1/n, with their factors.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Constant {
    /// ln 2 = 18 artanh 1/26 − 2 artanh 1/4801 + 8 artanh 1/8749.
    Ln2,
    /// π/2 = 8 arctan 1/5 − 2 arctan 1/239.
    QuarterTurn,
}

thread_local! {
    static KNOWN: RefCell<BTreeMap<(Constant, usize), Float>> =
        const { RefCell::new(BTreeMap::new()) };
}

impl Constant {
    fn value(self, bits: usize) -> Float {
        if let Some(known) = KNOWN.with_borrow(|known| known.get(&(self, bits)).cloned()) {
            return known;
        }
        let (terms, sign): (&[(i64, i64)], i64) = match self {
            Constant::Ln2 => (&[(18, 26), (-2, 4801), (8, 8749)], 1),
            Constant::QuarterTurn => (&[(8, 5), (-2, 239)], -1),
        };
        let fine = bits + GUARD;
        let mut total = Float::ZERO;
        for (factor, n) in terms {
            let mut power = Float::whole(*factor).over(&Float::whole(*n), fine);
            let square = Float::whole(sign * n * n);
            // Each term is at most a sixteenth of the one before it.
            for odd in (1..).step_by(2).take_while(|odd| 2 * odd < fine as i64 + 2) {
                total = total.plus(&power.over(&Float::whole(odd), fine), fine);
                power = power.over(&square, fine);
            }
        }
        let found = total.with_bits(bits);
        KNOWN.with_borrow_mut(|known| known.insert((self, bits), found.clone()));
        found
    }
}

/// Computes e^x for |x| below 2^20, by the series of a part of x, which is squared again and again.
pub fn exp(x: &Float, bits: usize) -> Float {
    let halvings = bits.isqrt();
    let fine = bits + GUARD + halvings;
    let turns = (x.nearest() / std::f64::consts::LN_2).round();
    let whole = Constant::Ln2.value(fine + 32).times(&Float::exactly(turns), fine + 32);
    let part = x.minus(&whole, fine).scaled(-(halvings as isize));
    // |part| is below 2^-(halvings + 1).
    let (mut terms, mut reached) = (0usize, 0);
    while reached < fine {
        terms += 1;
        reached += halvings + 1 + terms.ilog2() as usize;
    }
    let one = Float::whole(1);
    let mut found = one.clone();
    for term in (1..=terms).rev() {
        // What is multiplied by a small power needs fewer bits.
        let bits = fine.saturating_sub((halvings + 1) * (term - 1)).max(GUARD);
        let product = part.with_bits(bits).times(&found, bits);
        found = one.plus(&product.over(&Float::whole(term as i64), bits), bits);
    }
    for _ in 0..halvings {
        found = found.times(&found, fine);
    }
    found.scaled(turns as isize).with_bits(bits)
}

/// Computes ln x = y + 2 artanh((t − 1)/(t + 1)) for x > 0, with t = x/e^y and y = ln x in f64, or
/// y = 0 near 1.
pub fn log(x: &Float, bits: usize) -> Float {
    let fine = bits + GUARD;
    let near = x.nearest().ln();
    if !(-700.0..700.0).contains(&near) {
        let Some(top) = x.top() else { return Float::ZERO };
        let tops = Constant::Ln2.value(fine).times(&Float::whole(top as i64), fine);
        return tops.plus(&log(&x.scaled(-top), fine), bits);
    }
    // Each term is at most 2^-step times the one before it.
    let (near, t, step) = match near.abs() < 1e-6 {
        true => (Float::ZERO, x.clone(), 41),
        false => {
            let near = Float::exactly(near);
            let t = x.over(&exp(&near, fine), fine);
            (near, t, 80)
        }
    };
    let one = Float::whole(1);
    let small = t.minus(&one, fine).over(&t.plus(&one, fine), fine);
    let square = small.times(&small, fine);
    let (mut power, mut sum) = (small.clone(), small);
    for odd in 1..=fine / step {
        power = power.times(&square, fine);
        sum = sum.plus(&power.over(&Float::whole(2 * odd as i64 + 1), fine), fine);
    }
    near.plus(&sum.scaled(1), bits)
}

/// Computes sin x and cos x for |x| below 2^32.
pub fn waves(x: &Float, bits: usize) -> (Float, Float) {
    let halvings = 2 * bits.isqrt() / 3;
    let fine = bits + GUARD;
    let turns = (x.nearest() / std::f64::consts::FRAC_PI_2).round();
    let beyond = |bits: usize| {
        let whole = Constant::QuarterTurn.value(bits).times(&Float::exactly(turns), bits);
        x.minus(&whole, bits)
    };
    // Close to a quarter turn more digits are needed, and once again as many are enough.
    let near = beyond(fine + GUARD);
    let lost = near.top().map_or(fine, |top| (-top).max(0) as usize);
    let part = if lost < 8 { near } else { beyond((fine + lost + GUARD).next_multiple_of(GUARD)) };
    let part = part.with_bits(fine);
    let small = part.scaled(-(halvings as isize));
    let square = small.times(&small, fine).negated();
    let (mut terms, mut reached) = (1usize, 0);
    while reached < fine {
        terms += 1;
        reached += 2 * halvings + 2 * terms.ilog2() as usize;
    }
    // cos − 1, without a loss where it is small.
    let one = Float::whole(1);
    let mut found = one.clone();
    for term in (2..=terms as i64).rev() {
        let product =
            square.times(&found, fine).over(&Float::whole(2 * term * (2 * term - 1)), fine);
        found = one.plus(&product, fine);
    }
    let mut below = square.times(&found, fine).scaled(-1);
    for _ in 0..halvings {
        below = below.times(&below.plus(&Float::whole(2), fine), fine).scaled(1);
    }
    let cos = one.plus(&below, bits);
    let squared = below.times(&below.plus(&Float::whole(2), fine), fine).negated();
    let sin = if part.is_zero() { Float::ZERO } else { squared.root(bits) };
    let sin = if part.sign() < 0 { sin.negated() } else { sin };
    match turns.rem_euclid(4.0) as u8 {
        0 => (sin, cos),
        1 => (cos, sin.negated()),
        2 => (sin.negated(), cos.negated()),
        _ => (cos.negated(), sin),
    }
}

/// Converts a float to one of the library.
pub fn foreign(x: &Float, bits: usize) -> Foreign {
    let (negative, top, limbs) = x.parts();
    let bytes: Vec<u8> = limbs.iter().rev().flat_map(|limb| limb.to_le_bytes()).collect();
    let sign = if negative { Sign::Negative } else { Sign::Positive };
    let digits = IBig::from_parts(sign, UBig::from_le_bytes(&bytes));
    Foreign::from_parts(digits, top - 64 * limbs.len() as isize).with_precision(bits).value()
}

/// Converts a float of the library.
fn own(x: &Foreign, bits: usize) -> Float {
    let (sign, digits) = x.repr().significand().clone().into_parts();
    let bytes = digits.to_le_bytes();
    let limb = |bytes: &[u8]| {
        let mut all = [0; 8];
        all[..bytes.len()].copy_from_slice(bytes);
        u64::from_le_bytes(all)
    };
    let mut limbs: Vec<u64> = bytes.chunks(8).map(limb).rev().collect();
    let top = x.repr().exponent() + 64 * limbs.len() as isize;
    Float::of_limbs(sign == Sign::Negative, top, &mut limbs, bits)
}

pub fn atan(x: &Float, bits: usize) -> Float {
    own(&foreign(x, bits).atan(), bits)
}
