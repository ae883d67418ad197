//! Quotients of functions that have a limit where their divisors are 0.

use liouville::case::Case;
use liouville::number::double_double::DoubleDouble;
use liouville_flow::{FlowError, Precision, Variational, orbit};

use crate::integration::{follow, parse, start};

fn case(rate: &str) -> Case {
    parse(&format!(
        "title = 'a'\n[state]\nx = '-2..2'\ny = '-2..2'\n[field]\n\"x'\" = '1'\n\"y'\" = '{rate}'\n"
    ))
}

/// Σ over Gauss's nodes is not needed: integrals of the series, term by term.
fn series(terms: impl Fn(i32) -> f64, to: f64) -> f64 {
    (0..60).map(|n| terms(n) * to.powi(n + 1) / f64::from(n + 1)).sum()
}

#[test]
fn textbook_quotients_are_passed() {
    let factorial = |n: i32| (1..=n).map(f64::from).product::<f64>();
    let odd = |n: i32| n % 2 == 1;
    let sign = |n: i32| if (n / 2) % 2 == 0 { 1.0 } else { -1.0 };
    let sinc = |n: i32| if odd(n) { 0.0 } else { sign(n) / factorial(n + 1) };
    let versine = |n: i32| if odd(n) { 0.0 } else { sign(n) / factorial(n + 2) };
    let growth = |n: i32| 1.0 / factorial(n + 1);
    for (rate, terms) in [
        ("sin(x)/x", &sinc as &dyn Fn(i32) -> f64),
        ("(1-cos(x))/x^2", &versine),
        ("(exp(x)-1)/x", &growth),
        ("(1-exp(-x))/x*exp(x)", &growth),
    ] {
        let case = case(rate);
        for precision in [Precision::Float, Precision::Pair] {
            let expected = series(terms, 1.5) - series(terms, -1.0);
            let found = follow(&case, "x=-1 y=0", 2.5, precision).end[1].hi;
            assert!((found - expected).abs() < 4e-15, "{rate}, {precision:?}: {found} {expected}");
            let expected = series(terms, 1.5);
            let found = follow(&case, "x=0 y=0", 1.5, precision).end[1].hi;
            assert!((found - expected).abs() < 4e-15, "{rate}, {precision:?}, from 0: {found}");
        }
    }
}

#[test]
fn the_logarithm_of_1_plus_x_over_x_is_passed() {
    // Li₂(−x) = −∫ ln(1 + x)/x
    let expected = |x: f64| -> f64 { (1..400).map(|n| -(-x).powi(n) / f64::from(n * n)).sum() };
    let found = follow(&case("ln(1+x)/x"), "x=-1/2 y=0", 1.0, Precision::Float).end[1].hi;
    assert!((found - expected(0.5) + expected(-0.5)).abs() < 4e-15, "{found}");
}

#[test]
fn rates_of_a_nerve_are_passed_with_their_tangent_vectors() {
    // α = (V + 55)/100/(1 − e^(−(V + 55)/10)), and V' a linear motion through −55
    let text = "title = 'nerve'\n[state]\nV = '-80..40'\nn = '0..1'\n[field]\n\"V'\" = '20'\n\
         \"n'\" = '(V+55)/100/(1-exp(-(V+55)/10))*(1-n) - exp(-(V+65)/80)/8*n'\n";
    let nerve = parse(text);
    let float = follow(&nerve, "V=-65 n=0.3", 2.0, Precision::Float).end;
    let pair = follow(&nerve, "V=-65 n=0.3", 2.0, Precision::Pair).end;
    assert!((float[1] - pair[1]).hi.abs() < 1e-15, "{float:?} {pair:?}");
    // The same motion by a start far from −55 and back.
    let back = follow(&nerve, &format!("V=-25 n={}", pair[1].hi), -2.0, Precision::Pair).end;
    assert!((back[1].hi - 0.3).abs() < 1e-15, "{back:?}");
    let begin = start(&nerve, "V=-65 n=0.3");
    let motions = Variational::all(&nerve.model, &[], &[Ok(begin)]).expect("a field");
    let found = motions.all_exponents(2.0, 1, &|_| ());
    assert!(found[0].is_ok(), "{found:?}");
}

#[test]
fn poles_and_rational_quotients_end_motions() {
    for rate in ["cos(x)/x", "x^2/x", "sin(x)/x^2"] {
        let case = case(rate);
        let found =
            orbit(&case, start(&case, "x=-1 y=0"), DoubleDouble::from_f64(2.0), Precision::Float);
        assert!(
            matches!(found, Err(FlowError::Singular { .. } | FlowError::NoValue { .. })),
            "{rate}: {found:?}"
        );
    }
}
