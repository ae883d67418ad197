//! Functions of floats: exp and log by series of their own, the others by those of the library.

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

thread_local! {
    /// ln 2 by precision.
    static LN_2: RefCell<BTreeMap<usize, Float>> = const { RefCell::new(BTreeMap::new()) };
}

/// Computes ln 2 = 18 artanh 1/26 − 2 artanh 1/4801 + 8 artanh 1/8749.
fn ln_2(bits: usize) -> Float {
    if let Some(known) = LN_2.with_borrow(|known| known.get(&bits).cloned()) {
        return known;
    }
    let fine = bits + GUARD;
    let mut total = Float::ZERO;
    for (factor, n) in [(18, 26), (-2, 4801), (8, 8749)] {
        let mut power = Float::whole(factor).over(&Float::whole(n), fine);
        let square = Float::whole(n * n);
        for odd in (1..).step_by(2).take_while(|odd| (*odd as usize) * 4 < fine + GUARD) {
            total = total.plus(&power.over(&Float::whole(odd), fine), fine);
            power = power.over(&square, fine);
        }
    }
    let found = total.with_bits(bits);
    LN_2.with_borrow_mut(|known| known.insert(bits, found.clone()));
    found
}

/// Computes e^x for |x| below 2^20, by the series of a part of x, which is squared again and again.
pub fn exp(x: &Float, bits: usize) -> Float {
    let halvings = bits.isqrt();
    let fine = bits + GUARD + halvings;
    let turns = (x.nearest() / std::f64::consts::LN_2).round();
    let whole = ln_2(fine + 32).times(&Float::exactly(turns), fine + 32);
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
        let tops = ln_2(fine).times(&Float::whole(top as i64), fine);
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

/// Converts a float to one of the library.
pub fn foreign(x: &Float, bits: usize) -> Foreign {
    let (negative, top, limbs) = x.parts();
    let bytes: Vec<u8> = limbs.iter().rev().flat_map(|limb| limb.to_le_bytes()).collect();
    let sign = if negative { Sign::Negative } else { Sign::Positive };
    let digits = IBig::from_parts(sign, UBig::from_le_bytes(&bytes));
    Foreign::from_parts(digits, top - 64 * limbs.len() as isize).with_precision(bits).value()
}

/// Converts a float of the library.
pub fn own(x: &Foreign, bits: usize) -> Float {
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

/// Computes a function of the library.
pub fn by_library(x: &Float, of: fn(&Foreign) -> Foreign, bits: usize) -> Float {
    own(&of(&foreign(x, bits)), bits)
}
