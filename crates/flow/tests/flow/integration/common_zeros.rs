//! Moduli and extremes whose arguments vanish where others turn, or are 0 up to rounding for a while.

use liouville_flow::Precision;

use crate::integration::moduli::{field, followed};

const BOTH: [Precision; 2] = [Precision::Float, Precision::Pair];

#[test]
fn a_modulus_of_a_modulus_turns_with_it() {
    // |sin t |sin t|| = sin² t
    let truth = |from: f64, time: f64| {
        time / 2.0 - ((2.0 * (time + from)).sin() - (2.0 * from).sin()) / 4.0
    };
    for rate in ["abs(sin(t)*abs(sin(t)))", "max(sin(t)*abs(sin(t)), -sin(t)*abs(sin(t)))"] {
        let case = field(&[("x", rate), ("t", "1")]);
        for from in ["0", "0.3", "0.7", "2.9"] {
            let begin = format!("x=0 t={from}");
            let expected = truth(from.parse().expect("a number"), 20.0);
            for precision in BOTH {
                let end = followed(&case, &begin, 20.0, precision).expect("a motion").end;
                let error = (end[0].hi - expected).abs();
                assert!(error < 1e-12, "{rate} from {from}, {precision:?}: {error:e}");
            }
        }
    }
    let half = field(&[("x", "max(0, sin(t)*abs(sin(t)))"), ("t", "1")]);
    let end = followed(&half, "x=0 t=0", 20.0, Precision::Float).expect("a motion").end;
    // Three half waves, and the beginning of a fourth
    let rest = truth(0.0, 20.0 - 6.0 * std::f64::consts::PI);
    let expected = 1.5 * std::f64::consts::PI + rest;
    assert!((end[0].hi - expected).abs() < 1e-12, "{}", end[0].hi);
}

#[test]
fn two_sides_of_a_minimum_vanish_together() {
    let case = field(&[("x", "y"), ("y", "-x"), ("z", "min(abs(y*(x - 1/2)), sin(17*y))")]);
    for precision in BOTH {
        let end = followed(&case, "x=0.8 y=0.37 z=0", 50.0, precision).expect("a motion").end;
        // By quadrature
        assert!((end[2].hi + 9.946167).abs() < 2e-6, "{precision:?}: {}", end[2].hi);
    }
}

#[test]
fn a_sign_is_chosen_again_where_two_sides_were_equal_up_to_rounding() {
    let case = field(&[
        ("x", "y"),
        ("y", "-x"),
        ("u", "v"),
        ("v", "-2*u"),
        ("z", "max(x, min(tanh(30*u), tanh(30*y)))"),
    ]);
    for precision in BOTH {
        let end = followed(&case, "x=1 y=0 u=0.7 v=0.2 z=0", 50.0, precision);
        let z = end.expect("a motion").end[4].hi;
        // By quadrature
        assert!((z - 12.83389191).abs() < 1e-7, "{precision:?}: {z}");
    }
}
