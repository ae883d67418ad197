//! Tests of reading, printing, rounding and arithmetic.

use super::*;

fn read(text: &str) -> Rational {
    text.parse().expect("a number")
}

#[test]
fn decimals_are_exact() {
    assert_eq!(read("0.1"), Rational::new(1, 10), "0.1 is 1/10, not the nearest f64");
    assert_eq!(read("-2.50e1"), Rational::from(-25), "exponents shift the point");
    assert_eq!(read("−3/7"), Rational::new(-3, 7), "the typographic minus is a minus");
    assert_eq!(read("1e-3"), Rational::new(1, 1000), "negative exponents divide");
}

#[test]
fn numbers_of_f64_are_what_their_bits_say() {
    let mut bits = 1u64;
    let random = std::iter::repeat_with(|| {
        bits = bits.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        f64::from_bits(bits)
    });
    let near_one = (0..4000).map(|k| (f64::from(k) - 2000.0) / f64::from(k % 64 + 1));
    let ends = [0.0, -0.0, 5e-324, f64::MIN_POSITIVE, f64::MAX, 2f64.powi(63), 2f64.powi(-62)];
    let beyond = [2f64.powi(62), -(2f64.powi(63)), 2f64.powi(-63), 3.0 * 2f64.powi(-62)];
    for value in random.take(4000).chain(near_one).chain(ends).chain(beyond) {
        let slow = BigRational::from_float(value).map(Rational::from_big);
        assert_eq!(Rational::from_f64(value), slow, "{value:e}");
    }
    assert_eq!(Rational::from_f64(f64::INFINITY), None, "no number");
}

#[test]
fn nonsense_is_refused() {
    for text in ["", "-", "1.2.3", "x", "1e", "nan", "inf", "1/", "0x10"] {
        assert!(text.parse::<Rational>().is_err(), "`{text}` is no number");
    }
    assert_eq!("1/0".parse::<Rational>(), Err(RationalError::ZeroDenominator("1/0".into())));
    assert_eq!("1e999999999".parse::<Rational>(), Err(RationalError::TooLong));
}

#[test]
fn printing_reads_back() {
    for text in ["0.125", "-0.05", "3/7", "12", "-1/3", "0.000001", "1/10000000"] {
        let value = read(text);
        assert_eq!(value.to_string(), text, "the shortest exact form");
        assert_eq!(read(&value.to_string()), value, "and it reads back");
    }
}

#[test]
fn small_and_large_parts_agree() {
    let large = read("9223372036854775807");
    let sum = &large + &large;
    assert_eq!(sum.to_string(), "18446744073709551614", "overflow moves to big integers");
    assert_eq!(&sum - &large, large, "and comes back");
    assert_eq!(read("-9223372036854775808").abs().to_string(), "9223372036854775808");
    let tiny = read("1e-30");
    assert_eq!(&(&tiny * &read("1e30")), &Rational::from(1), "products reduce");
    assert!(tiny > Rational::from(0) && tiny < Rational::new(1, i64::MAX), "order is exact");
    assert_eq!(Rational::new(-6, -4), Rational::new(3, 2), "lowest terms, positive below");
}

#[test]
fn rounding_to_f64_knows_when_it_is_exact() {
    assert_eq!(read("0.5").to_f64(), (0.5, true));
    assert_eq!(read("0.1").to_f64(), (0.1, false));
    let odd = (1u64 << 53) + 1;
    assert_eq!(read(&odd.to_string()).to_f64(), ((odd - 1) as f64, false), "ties to even");
}

#[test]
fn floats_are_dyadic_rationals() {
    let mut bits = 0x1234_5678_9abc_def1u64;
    let special = [0.0, -0.0, f64::MIN_POSITIVE, 5e-324, -1.5e-310, f64::MAX, 1.0, -3.0, 1e23];
    let drawn = std::iter::from_fn(|| {
        bits = bits.wrapping_mul(0x9E37_79B9_7F4A_7C15).rotate_left(31);
        Some(f64::from_bits(bits))
    });
    for value in special.into_iter().chain(drawn.take(5000)) {
        let by_division = BigRational::from_float(value).map(Rational::from_big);
        assert_eq!(Rational::from_f64(value), by_division, "{value:e}");
        if let Some(exact) = by_division {
            assert_eq!(exact.to_f64(), (value, true), "{value:e}");
            let beside = &exact + &Rational::new(1, 3);
            assert!(!beside.to_f64().1, "{value:e} + 1/3 is no dyadic rational");
        }
    }
}

#[test]
fn short_decimals_are_read_like_long_ones() {
    for text in ["0", "-0.0", "12", "1.50", "-0.000000000000000001", "999999999999999999e18"] {
        let long = match text.split_once('e') {
            Some((mantissa, exponent)) => format!("{mantissa}.0000000000000000000e{exponent}"),
            None if text.contains('.') => format!("{text}0000000000000000000"),
            None => format!("{text}.0000000000000000000"),
        };
        assert_eq!(text.parse::<Rational>(), long.parse::<Rational>(), "{text}");
    }
}
