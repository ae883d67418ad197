//! Features that are far shorter than the unit of time, in both precisions.

use std::f64::consts::PI;

use liouville::case::Case;
use liouville::number::double_double::DoubleDouble;
use liouville_flow::{Precision, orbit};

use crate::integration::moduli::followed;
use crate::integration::{follow, parse, start};

const BOTH: [Precision; 2] = [Precision::Float, Precision::Pair];

fn field(rates: &[(&str, &str)]) -> Case {
    let state: String = rates.iter().map(|(name, _)| format!("{name} = '-2..2'\n")).collect();
    let field: String =
        rates.iter().map(|(name, rate)| format!("\"{name}'\" = '{rate}'\n")).collect();
    parse(&format!("title = 'a'\n[state]\n{state}[field]\n{field}"))
}

#[test]
fn a_pulse_of_1e_minus_13_is_passed_in_both_precisions() {
    // ∫ d/(x² + d²) = atan(1/d) + atan(2/d)
    for exponent in [10, 13] {
        let rate = format!("10^(-{exponent})/(x^2+10^(-{}))", 2 * exponent);
        let case = field(&[("x", "-1"), ("y", &rate)]);
        let width = 10f64.powi(-exponent);
        let expected = (1.0 / width).atan() + (2.0 / width).atan();
        for precision in BOTH {
            let found = follow(&case, "x=1 y=0", 3.0, precision).end[1].hi;
            assert!((found - expected).abs() < 1e-9, "{exponent}, {precision:?}: {found}");
        }
    }
}

#[test]
fn a_narrow_ellipse_comes_back_in_double_double() {
    // Kepler's ellipse with a pericentre at 2·10⁻¹⁰
    let case = field(&[
        ("x", "p"),
        ("y", "q"),
        ("p", "-x*(x^2+y^2)^(-3/2)"),
        ("q", "-y*(x^2+y^2)^(-3/2)"),
    ]);
    let (r, v) = (2.0, 1e-5f64);
    let axis = 1.0 / (2.0 / r - v * v);
    let period = 2.0 * PI * axis.powf(1.5);
    let found = follow(&case, "x=2 y=0 p=0 q=1/100000", period, Precision::Pair).end;
    let gap = (found[0].hi - 2.0).abs().max(found[1].hi.abs());
    assert!(gap < 1e-9, "{gap:e}");
}

#[test]
fn units_of_time_do_not_matter() {
    // The same oscillator with a period of 2π·10⁻¹⁶, and of 2π·10¹⁶.
    for exponent in [16, -16] {
        let (up, down) = (format!("10^({exponent})*y"), format!("-10^({exponent})*x*(1+x^2)"));
        let (own, fast) =
            (field(&[("x", "y"), ("y", "-x*(1+x^2)")]), field(&[("x", &up), ("y", &down)]));
        let scale = 10f64.powi(-exponent);
        for precision in BOTH {
            let expected = follow(&own, "x=1 y=0", 10.0, precision).end;
            let time = DoubleDouble::from_f64(10.0 * scale);
            let found = orbit(&fast, start(&fast, "x=1 y=0"), time, precision).expect("a motion");
            for (x, y) in found.end.iter().zip(&expected) {
                assert!((*x - *y).hi.abs() < 1e-13, "{exponent} {precision:?}: {x:?} {y:?}");
            }
        }
    }
}

#[test]
fn a_slow_component_keeps_its_digits_beside_a_clock() {
    for slow in [3, 9, 12, 20, 30] {
        let case = field(&[("x", &format!("-x/10^{slow}")), ("y", "1")]);
        let time = 10f64.powi(slow + 1);
        let end = followed(&case, "x=1 y=0", time, Precision::Float).expect("a motion").end;
        let error = end[0].hi / (-10f64).exp() - 1.0;
        assert!(error.abs() < 1e-13, "10^-{slow}: {error:e}");
    }
}

#[test]
fn components_of_any_size_keep_their_digits_beside_larger_ones() {
    for (rates, begin, time, expected) in [
        // A delayed loss of stability, by way of e^(−500)
        ([("x", "y*x"), ("y", "1/1000")], "x=1 y=-1", 2000.0, 1.0),
        ([("x", "-x"), ("y", "1")], "x=1 y=0", 400.0, (-400f64).exp()),
        ([("x", "x*(1 - x)"), ("y", "1")], "x=1/10^200 y=0", 800.0, 1.0),
    ] {
        let case = field(&rates);
        for precision in BOTH {
            let end = followed(&case, begin, time, precision).expect("a motion").end;
            let error = end[0].hi / expected - 1.0;
            assert!(error.abs() < 1e-11, "{rates:?}, {precision:?}: {error:e}");
        }
    }
}

#[test]
fn rates_of_any_size_have_a_first_expansion() {
    let case = field(&[("x", "10^100*y"), ("y", "-10^100*x")]);
    for precision in BOTH {
        let end = followed(&case, "x=1 y=0", 1e-99, precision).expect("a motion").end;
        assert!((end[0].hi - 10f64.cos()).abs() < 1e-13, "{precision:?}: {}", end[0].hi);
    }
}
