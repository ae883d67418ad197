//! Comparison of the oracle's floats with those of a library.

use libtest_mimic::Failed;

use super::float::Float;
use super::random::Stream;
use super::series::{Foreign, atan, exp, foreign, log, waves};

/// Precisions in bits, with the number of pairs compared.
const PRECISIONS: [(usize, usize); 9] = [
    (40, 4000),
    (64, 4000),
    (160, 4000),
    (256, 2000),
    (640, 4000),
    (704, 2000),
    (768, 2000),
    (2048, 400),
    (6144, 100),
];

/// Draws a number of so many bits, with runs of equal digits.
fn drawn(stream: &mut Stream, bits: usize) -> Float {
    let limb = |stream: &mut Stream| match stream.below(4) {
        0 => 0,
        1 => u64::MAX,
        _ => stream.bits() >> stream.below(64),
    };
    let mut limbs: Vec<u64> = (0..bits.div_ceil(64)).map(|_| limb(stream)).collect();
    let top = stream.below(2 * bits) as isize - bits as isize;
    let top = if stream.once_in(3) { 0 } else { top };
    Float::of_limbs(stream.once_in(2), top, &mut limbs, bits)
}

/// Compares sums, products, quotients and roots with what the library computes in many bits.
pub fn operations() -> Result<(), Failed> {
    let mut stream = Stream::new(4714, 0);
    for (bits, count) in PRECISIONS {
        let wide = 6 * bits + 64;
        let same = |name: &str, ours: &Float, theirs: Foreign| {
            let theirs = theirs.with_precision(bits).value();
            match foreign(ours, bits) == theirs {
                true => Ok(()),
                false => Err(Failed::from(format!("{name} in {bits} bits: {ours:?}, {theirs:?}"))),
            }
        };
        for _ in 0..count {
            let a = drawn(&mut stream, bits);
            // Some are close to the first, so that digits cancel.
            let b = match stream.below(3) {
                0 => a.plus(&drawn(&mut stream, bits).scaled(-(bits as isize) / 2), bits),
                _ => drawn(&mut stream, bits),
            };
            let (x, y) = (foreign(&a, wide), foreign(&b, wide));
            same("a sum", &a.plus(&b, bits), &x + &y)?;
            same("a difference", &a.minus(&b, bits), &x - &y)?;
            same("a product", &a.times(&b, bits), &x * &y)?;
            if !b.is_zero() {
                same("a quotient", &a.over(&b, bits), &x / &y)?;
            }
            if a.sign() > 0 {
                close("a root", &a.root(bits), &x.sqrt(), bits)?;
                same("a square and its root", &a.times(&a, 2 * bits).root(bits), x.clone())?;
            }
            let near = x.to_f64().value();
            if near.is_normal() && a.nearest() != near {
                return Err(Failed::from(format!("{} is not {near} for {a:?}", a.nearest())));
            }
        }
    }
    Ok(())
}

/// Checks that a float differs from one of the library in more bits by rounding only.
fn close(name: &str, ours: &Float, theirs: &Foreign, bits: usize) -> Result<(), Failed> {
    let gap = foreign(ours, 2 * bits + 64) - theirs;
    let units = ours.top().map(|top| gap >> (top - bits as isize));
    match units.is_some_and(|units| units.to_f64().value().abs() < 0.500_000_1) {
        true => Ok(()),
        false => Err(Failed::from(format!("{name} in {bits} bits: {ours:?}, not {theirs:?}"))),
    }
}

/// Compares logarithms, from numbers near 1 to those beyond the range of f64, exponentials, and
/// sines and cosines, near multiples of a quarter turn as well.
pub fn functions() -> Result<(), Failed> {
    let mut stream = Stream::new(4713, 0);
    for bits in [64, 160, 640, 2048] {
        for k in 0..200 {
            let x = match k % 5 {
                0 => Float::exactly(1.0 + 2f64.powi(-(k / 4)) * stream.unit()),
                1 => Float::exactly((1400.0 * (stream.unit() - 0.5)).exp()),
                2 => Float::exactly(2f64.powi(k - 100)),
                3 => drawn(&mut stream, bits).scaled(stream.below(4000) as isize - 2000),
                _ => Float::exactly(stream.unit() + 0.01),
            };
            if x.sign() > 0 && x != Float::whole(1) {
                close("a logarithm", &log(&x, bits), &foreign(&x, bits + 64).ln(), bits)?;
            }
            let x = match k % 3 {
                0 => Float::exactly(600.0 * (stream.unit() - 0.5)),
                1 => Float::exactly(2f64.powi(-k)),
                _ => drawn(&mut stream, bits).scaled(-(bits as isize) - 1),
            };
            close("an exponential", &exp(&x, bits), &foreign(&x, bits + 64).exp(), bits)?;
            let x = match k % 4 {
                0 => Float::exactly(2e6 * (stream.unit() - 0.5)),
                1 => Float::exactly(2f64.powi(-k)),
                2 => atan(&Float::whole(1), bits).times(&Float::whole(2 * i64::from(k)), bits),
                _ => Float::exactly(std::f64::consts::FRAC_PI_2 * f64::from(k)),
            };
            let ((sin, cos), wide) = (waves(&x, bits), foreign(&x, 3 * bits));
            close("a sine", &sin, &wide.sin(), bits)?;
            close("a cosine", &cos, &wide.cos(), bits)?;
        }
    }
    Ok(())
}
