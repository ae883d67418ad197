//! Formulas without a value, where the recorded field has one.

use liouville::number::double_double::DoubleDouble;
use liouville_flow::{Exponents, FlowError, Precision, Variational, orbit};

use crate::integration::{parse, start};

/// x' = 1 with another rate, whose formula has no value from some x on.
fn case(rate: &str) -> liouville::case::Case {
    parse(&format!(
        "title = 'a'\n[state]\nx = '-2..2'\ny = '-2..2'\n[field]\n\"x'\" = '1'\n\"y'\" = '{rate}'\n"
    ))
}

/// Time at which the motion ends for want of a value, and the formula that has none.
fn end(rate: &str, begin: &str, time: f64, precision: Precision) -> Option<(f64, String)> {
    let case = case(rate);
    match orbit(&case, start(&case, begin), DoubleDouble::from_f64(time), precision) {
        Ok(_) => None,
        Err(FlowError::NoValue { formula, time, .. }) => Some((time, formula)),
        // The divisor is 0 up to rounding.
        Err(FlowError::Singular { time, .. }) if time != 0.0 => Some((time, rate.to_string())),
        Err(other) => panic!("{rate} from {begin}: {other}"),
    }
}

#[test]
fn motions_end_where_a_formula_ends() {
    for precision in [Precision::Float, Precision::Pair] {
        for (rate, begin, time, at) in [
            ("x^2/x", "x=-1 y=1", 2.0, 1.0),
            ("x^2/x", "x=1 y=1", -2.0, -1.0),
            ("(x - 1)^2/(x - 1)", "x=1/2 y=1", 2.0, 0.5),
            ("0*ln(1 - x) + y", "x=0 y=1", 2.0, 1.0),
            ("x^(1/3)*0 + y", "x=1 y=1", -2.0, -1.0),
            ("0*√(x² - 1) + y", "x=-3/2 y=1", 3.0, 0.5),
            ("0/(x² + y² - 1) + 0*y", "x=-2 y=0", 3.0, 1.0),
        ] {
            let (found, formula) = end(rate, begin, time, precision).expect(rate);
            assert!((found - at).abs() < 1e-7, "{rate} from {begin}: {found}, not {at}");
            assert_eq!(formula, rate);
            assert_eq!(end(rate, begin, 0.9 * at, precision), None, "{rate} goes on up to there");
        }
    }
}

#[test]
fn roots_may_touch_what_quotients_may_not() {
    let float = Precision::Float;
    assert_eq!(end("0*√((x - 1)²) + y", "x=0 y=1", 2.0, float), None, "√ has a value at 0");
    let touched = end("0/(x - 1)² + y", "x=0 y=1", 2.0, float).expect("a quotient has none");
    assert!((touched.0 - 1.0).abs() < 1e-7, "{touched:?}");
    assert_eq!(end("0*√(x - 1) + y", "x=1 y=1", 2.0, float), None, "it begins at 0, and grows");
}

#[test]
fn quotients_with_limits_have_values_and_quotients_by_roots_that_vanish_have_none() {
    for precision in [Precision::Float, Precision::Pair] {
        for rate in ["0*(sin(x)/x)", "sin(x)/x*0", "0*(1/(sin(x)/x))", "√(max(x, 0))"] {
            assert_eq!(end(rate, "x=-1/2 y=1", 1.0, precision), None, "{rate}");
        }
        for rate in ["max(x, 0)/√(max(x, 0))", "0*(sin(x)/x) + 0/x"] {
            let (found, _) = end(rate, "x=1/2 y=1", -1.0, precision).expect(rate);
            assert!((found + 0.5).abs() < 1e-7, "{rate}: {found}");
        }
    }
}

#[test]
fn starts_without_a_value_are_told_by_their_formula() {
    for rate in [
        "1/x",
        "x^2/x",
        "ln(x)",
        "0*ln(x)",
        "√(x - 1)",
        "0*√(x - 1)",
        "(x - 1)^(1/3)*0",
        "1 + ln(-2)",
    ] {
        let case = case(rate);
        let begin = || start(&case, "x=0 y=1");
        let second = DoubleDouble::from_f64(1.0);
        let found = orbit(&case, begin(), second, Precision::Float).map(|orbit| orbit.steps);
        let expected = FlowError::NoValue {
            formula: rate.to_string(),
            time: 0.0,
            place: "x = 0.0, y = 1.0".to_string(),
        };
        assert_eq!(found, Err(expected.clone()), "{rate}");
        let exponents = |begin| Variational::new(&case.model, &begin)?.exponents(1.0);
        let found: Result<Exponents, FlowError> = exponents(begin());
        assert_eq!(found.map(|found| found.time), Err(expected), "{rate}, with tangent vectors");
    }
}
