//! Tests of intervals: what they must contain.

use super::*;

#[test]
fn ends_are_rounded_outwards_and_only_where_they_are_rounded() {
    let between = |low: f64, high: f64| Extent { low, high };
    let two = between(2.0, 2.0);
    assert_eq!(two.plus(between(-2.0, 2.0)), between(0.0, 4.0), "exact ends stay");
    let third = Extent::at(&Rational::new(1, 3));
    assert!(third.low < third.high, "1/3 is no f64");
    let one = third.times(between(3.0, 3.0));
    assert!(one.low <= 1.0 && one.high >= 1.0 && one.low < one.high, "{one:?}");
    let tiny = between(1e-300, 1e-300);
    assert!(tiny.times(tiny).sign() == Some(true) && tiny.square().high > 0.0, "underflow");
    assert_eq!(between(1e300, 1e300).square().high, f64::INFINITY, "overflow");
    assert!(between(1e300, 1e300).square().low < f64::INFINITY, "to both sides");
}

#[test]
fn sines_and_powers_hold_their_values() {
    let modulus = crate::number::prime::Modulus::new((1 << 61) - 1);
    let mut rng = crate::proof::rng::ProofRng::new(6, 0);
    let mut share = || (rng.element(&modulus) >> 9) as f64 / (1u64 << 52) as f64;
    for round in 0..4000 {
        let low = 40.0 * share() - 20.0;
        let high = low + share() * if round % 2 == 0 { 0.5 } else { 8.0 };
        let extent = Extent { low, high };
        let at = low + share() * (high - low);
        let inside = |extent: Extent, value: f64| {
            extent.low <= value + 1e-12 * value.abs() && value <= extent.high + 1e-12 * value.abs()
        };
        assert!(inside(extent.unary(UnaryFunction::Sin), at.sin()), "sin {at} in {extent:?}");
        assert!(inside(extent.unary(UnaryFunction::Cos), at.cos()), "cos {at} in {extent:?}");
        assert!(inside(extent.unary(UnaryFunction::Atan), at.atan()), "atan {at} in {extent:?}");
        for n in [-3, -2, -1, 0, 1, 2, 3, 5, 8, 13] {
            let power = extent.power(&Rational::from(n));
            assert!(inside(power, at.powi(n as i32)), "{at}^{n} in {extent:?}: {power:?}");
        }
    }
    for round in 0..2000 {
        let low = if round % 9 == 0 { 0.0 } else { libm::exp(20.0 * share() - 10.0) };
        let width = if low == 0.0 { 1.0 } else { low };
        let extent = Extent { low, high: low + width * share() };
        let at = low + share() * (extent.high - low);
        for (above, below) in [(1, 3), (-1, 3), (2, 3), (7, 5), (-3, 4), (1, 64), (63, 2)] {
            let power = extent.power(&Rational::new(above, below));
            let value = libm::pow(at, above as f64 / below as f64);
            let slack = 1e-11 * value;
            assert!(
                power.low <= value + slack && value - slack <= power.high,
                "{at}^{above}/{below}"
            );
            let is_narrow = power.high <= power.low * (2.1 + 2e-6) || above.abs() > below;
            assert!(low == 0.0 || is_narrow, "{extent:?}^{above}/{below}: {power:?}");
            let back = power.power(&Rational::new(below, above));
            assert!(back.low <= at * (1.0 + 1e-9) && at <= back.high * (1.0 + 1e-9), "{at}");
        }
    }
    let narrow = Extent { low: 0.3, high: 1.0 };
    assert!(narrow.unary(UnaryFunction::Cos).low > 0.54, "cos is positive from 0.3 to 1");
    let odd = Extent { low: -2.0, high: 3.0 }.power(&Rational::from(3));
    assert!(odd.low >= -8.0 - 1e-12 && odd.high <= 27.0 + 1e-12, "{odd:?}");
}

#[test]
fn random_results_lie_inside() {
    use crate::number::exact::square_root;
    let modulus = crate::number::prime::Modulus::new((1 << 61) - 1);
    let mut rng = crate::proof::rng::ProofRng::new(5, 0);
    let mut number = || {
        let drawn = modulus.to_integer(rng.element(&modulus));
        let (mantissa, exponent) = ((drawn >> 8) as i64 - (1 << 52), (drawn & 63) as i32 - 40);
        libm::scalbn(mantissa as f64, exponent)
    };
    let exact = |x: f64| Rational::from_f64(x).expect("finite");
    for _ in 0..5000 {
        let (x, y) = (number(), number());
        let (a, b) = (Extent { low: x, high: x }, Extent { low: y, high: y });
        let inside = |extent: Extent, value: Rational| {
            exact(extent.low) <= value && value <= exact(extent.high)
        };
        assert!(inside(a.plus(b), &exact(x) + &exact(y)), "{x} + {y}");
        assert!(inside(a.times(b), &exact(x) * &exact(y)), "{x} · {y}");
        assert!(inside(a.square(), &exact(x) * &exact(x)), "{x}²");
        if let Some(inverse) = exact(x).recip() {
            assert!(inside(a.reciprocal(), inverse), "1/{x}");
        }
        let square = &exact(x) * &exact(x);
        let (root, (near, _)) = (square_root(&square), square.to_f64());
        let of = Extent { low: near.next_down(), high: near.next_up() };
        assert!(inside(of.unary(UnaryFunction::Sqrt), root.expect("a square")), "√{x}²");
    }
}

#[test]
fn products_of_ends_are_rounded_as_far_as_they_must() {
    let modulus = crate::number::prime::Modulus::new((1 << 61) - 1);
    let mut rng = crate::proof::rng::ProofRng::new(9, 0);
    let special = [0.0, 1.0, 1e-320, 1e-160, 1e160, f64::MAX, f64::INFINITY, 0.1, 3.0];
    let mut number = || {
        let bits = rng.element(&modulus);
        let size = match bits & 3 {
            0 => special[(bits >> 2) as usize % special.len()],
            1 => ((bits >> 2) % 64) as f64,
            _ => (bits >> 9) as f64 / (1u64 << 50) as f64,
        };
        if bits >> 60 == 1 { -size } else { size }
    };
    let mut extent = || {
        let (a, b) = (number(), number());
        Extent { low: a.min(b), high: a.max(b) }
    };
    for _ in 0..20_000 {
        let (x, y) = (extent(), extent());
        let found = x.times(y);
        let wide = x.between_any_corners(y);
        let expected = match (x.sign(), y.sign()) {
            (Some(a), Some(b)) => wide.within(a == b),
            _ => wide,
        };
        assert_eq!(found, expected, "{x:?} times {y:?}");
    }
}

#[test]
fn functions_are_exact_where_their_values_are() {
    let unit = Extent { low: 0.0, high: 1.0 };
    for function in [UnaryFunction::Sin, UnaryFunction::Atan, UnaryFunction::Sqrt] {
        let found = unit.unary(function);
        assert_eq!(found.low, 0.0, "{function:?}");
    }
    assert_eq!(unit.unary(UnaryFunction::Exp).low, 1.0);
    assert_eq!(unit.negated().unary(UnaryFunction::Exp).high, 1.0);
    assert_eq!(Extent { low: 1.0, high: 2.0 }.unary(UnaryFunction::Ln).low, 0.0);
    assert!(Extent { low: 2.0, high: 3.0 }.unary(UnaryFunction::Ln).low < libm::log(2.0));
    assert!(Extent { low: 0.0, high: 4.0 }.unary(UnaryFunction::Sin).low < -0.7, "4 > π");
}
