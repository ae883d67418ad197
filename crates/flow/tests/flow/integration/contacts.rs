//! A body on a floor that a force presses down or lifts: x' = f(t) above x = 0.

use liouville::case::Case;
use liouville::number::double_double::DoubleDouble;
use liouville_flow::{Contact, Orbit, Precision, orbit};

use crate::integration::{parse, start};

fn floor(f: &str, r: &str) -> Case {
    parse(&format!(
        "title = 'a'\n[state]\nx = '0..5'\nt = '0..30'\n[let]\nf = '{f}'\n[field]\n\"x'\" = 'f'\n\
         [one-sided]\nfunction = '{r}'\nreaction = '-f'\n[one-sided.field]\n\"x'\" = '0'\n\"t'\" = '1'\n"
    ))
}

fn followed(case: &Case, begin: &str, time: f64, precision: Precision) -> Orbit {
    orbit(case, start(case, begin), DoubleDouble::from_f64(time), precision).expect("a motion")
}

#[test]
fn a_reaction_that_touches_0_holds_and_one_below_0_lets_go() {
    // the largest of ∫f from any time on, and of 1 + ∫f from the start on
    for (f, begin, end) in [
        ("sin(t)-1", "x=1 t=0", 0.0),
        ("sin(t)-1+10^(-9)", "x=1 t=0", 0.0),
        ("sin(t)-1+10^(-12)", "x=1 t=0", 0.0),
        ("-1/3*sin(7*t) - 1/3", "x=2 t=0", 0.0),
        ("1/2*sin(2*t) + exp(-50*(t-2-1/3)^2) - 1/2", "x=1 t=0", 0.0),
        ("-sin(t)", "x=0 t=0", 1.0 + 20f64.cos()),
        ("sin(t)-1/2", "x=1 t=0", 0.144520690539576),
    ] {
        for precision in [Precision::Float, Precision::Pair] {
            let found = followed(&floor(f, "x"), begin, 20.0, precision);
            let x = found.end[0].hi;
            assert!((x - end).abs() < 1e-9, "{f}, {precision:?}: {x}, not {end}");
        }
    }
}

#[test]
fn the_function_of_the_floor_may_be_any_that_has_its_sign() {
    for r in ["x^3 + x/10^10", "x^3", "atan(x)", "x/(1 + x^2)", "exp(10*x) - 1", "tanh(400*x)"] {
        let found = followed(&floor("sin(t)-1/2", r), "x=1 t=0", 20.0, Precision::Float);
        let first = &found.events[0];
        assert_eq!(first.kind, Contact::Arrives, "{r}");
        // A root of order 3 is known to a third of the digits.
        let error = if r.starts_with("x^3") { 1e-4 } else { 1e-12 };
        assert!((first.time.hi - 4.473413905714496).abs() < error, "{r}: {}", first.time.hi);
        let x = found.end[0].hi;
        assert!((x - 0.144520690539576).abs() < 2.0 * error, "{r}: {x}");
    }
}

#[test]
fn nothing_falls_through_the_floor_where_force_and_reaction_are_0_for_a_while() {
    for r in ["x", "sinh(x)", "atan(3*x)"] {
        for (f, begin) in [
            ("-1/2*max(0, cos(t) - 1/5)", "x=0 t=0"),
            ("(sin(t/3) - 1)/3 + 1/10^12", "x=1/2 t=0"),
            ("-abs(sin(t))/3", "x=1 t=0"),
        ] {
            let found = followed(&floor(f, r), begin, 20.0, Precision::Float);
            let x = found.end[0].hi;
            assert!(x.abs() < 1e-11, "{f}, {r}: {x}");
        }
    }
}

#[test]
fn a_reaction_of_high_degree_vanishes_at_the_right_time() {
    let case = floor("-1/1000+t^41/10^20", "x");
    let found = followed(&case, "x=1/1000 t=-2", 6.0, Precision::Float);
    let leaves: Vec<f64> = found
        .events
        .iter()
        .filter(|own| own.kind == Contact::Leaves)
        .map(|own| own.time.hi)
        .collect();
    let [time] = leaves[..] else { panic!("{:?}", found.events) };
    assert!((time - 2.0 - 10f64.powf(17.0 / 41.0)).abs() < 1e-12, "{time}");
}

#[test]
fn units_of_time_do_not_decide_where_a_motion_begins() {
    for rate in [5, 40, 1000] {
        let case = parse(&format!(
            "title = 'a'\n[state]\nx = '-2..2'\np = '-100..100'\n[field]\n\"x'\" = 'p'\n\"p'\" = '-{rate}^2*x'\n\
             [one-sided]\nfunction = 'x + 1/2'\nreaction = '1'\n[one-sided.field]\n\"x'\" = '0'\n\"p'\" = '0'\n"
        ));
        let found = followed(&case, "x=1 p=-1", 4.0 / f64::from(rate), Precision::Float);
        assert_eq!(found.events.len(), 1, "{rate}: {:?}", found.events);
        assert!((found.end[0].hi + 0.5).abs() < 1e-12, "{rate}: it sticks to the wall");
    }
}

#[test]
fn a_lift_too_low_to_be_seen_leaves_the_body_on_the_floor() {
    // At each peak the force is positive for 7e-6, and lifts by 5e-15.
    let case = floor("3*(sin(7*t) - 1) + 10^(-9)", "x");
    for begin in ["x=0 t=0", "x=1/10 t=0"] {
        let found = followed(&case, begin, 20.0, Precision::Float);
        assert!(found.end[0].hi.abs() < 1e-13, "{begin}: {:e}", found.end[0].hi);
        assert!(found.events.len() < 60, "{begin}: {} events", found.events.len());
    }
}
