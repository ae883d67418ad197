//! Fields with |x|, min, max and sign: continuous ones are followed through their zeros, jumps are
//! crossed or end the motion.

use std::f64::consts::PI;

use liouville::case::Case;
use liouville::number::double_double::DoubleDouble;
use liouville_flow::{Character, FlowError, Orbit, Precision, QuantityRole, Variational, orbit};

use crate::integration::surfaces::crossings;
use crate::integration::{parse, start};

const BOTH: [Precision; 2] = [Precision::Float, Precision::Pair];

/// A case of these rates of x, y, ….
pub(super) fn field(rates: &[(&str, &str)]) -> Case {
    let state: String = rates.iter().map(|(name, _)| format!("{name} = '-2..2'\n")).collect();
    let field: String =
        rates.iter().map(|(name, rate)| format!("\"{name}'\" = '{rate}'\n")).collect();
    parse(&format!("title = 'a'\n[state]\n{state}[field]\n{field}"))
}

pub(super) fn followed(
    case: &Case,
    begin: &str,
    time: f64,
    precision: Precision,
) -> Result<Orbit, FlowError> {
    orbit(case, start(case, begin), DoubleDouble::from_f64(time), precision)
}

/// Distance of the end of a motion from a state.
fn gap(case: &Case, begin: &str, time: f64, precision: Precision, end: [f64; 2]) -> f64 {
    let found = followed(case, begin, time, precision).expect("a motion");
    let parts = found.end.iter().zip(end).map(|(x, expected)| (x.hi - expected).abs());
    parts.fold(0.0, f64::max)
}

#[test]
fn halves_of_a_bilinear_oscillator_have_periods_of_their_own() {
    // x'' = −3x/2 for x > 0, and −x/2 for x < 0, written in several ways
    let (fast, slow) = (1.5f64.sqrt(), 0.5f64.sqrt());
    let period = PI / fast + PI / slow;
    for rate in ["-x - abs(x)/2", "-max(x, 0) - x/2", "-x/2 + min(-x, 0)", "-x*(1 + sign(x)/2)"] {
        let case = field(&[("x", "y"), ("y", rate)]);
        for precision in BOTH {
            let error = gap(&case, "x=1 y=0", 100.0 * period, precision, [1.0, 0.0]);
            assert!(error < 1e-11, "{rate}, {precision:?}: {error:e}");
            let error = gap(&case, "x=0 y=1", PI / fast, precision, [0.0, -1.0]);
            assert!(error < 1e-14, "{rate}, {precision:?}: from a zero, {error:e}");
            let error = gap(&case, "x=0 y=1", -PI / slow, precision, [0.0, -1.0]);
            assert!(error < 1e-14, "{rate}, {precision:?}: backwards, {error:e}");
        }
    }
}

#[test]
fn a_relay_is_crossed_and_friction_ends_in_a_slide() {
    // x = 1 − t²/2 up to t = √2, and so on in parabolas
    let relay = field(&[("x", "y"), ("y", "-sign(x)")]);
    for precision in BOTH {
        let error = gap(&relay, "x=1 y=0", 40.0 * 2f64.sqrt(), precision, [1.0, 0.0]);
        assert!(error < 1e-11, "{precision:?}: {error:e}");
    }
    // each half turn takes 1/5 from the amplitude, up to where friction is the larger force
    let friction = field(&[("x", "y"), ("y", "-x - sign(y)/10")]);
    match followed(&friction, "x=1 y=0.2", 100.0, Precision::Float) {
        Err(FlowError::Slides { time, state }) => {
            assert!(state[0].abs() <= 0.1 && state[1].abs() < 1e-12, "{state:?}");
            assert!(time > 4.0 * PI && time < 6.0 * PI, "{time}");
        }
        other => panic!("{other:?}"),
    }
    let fork = field(&[("x", "sign(x)")]);
    let found = followed(&fork, "x=0", 1.0, Precision::Float);
    let message = found.expect_err("x could leave to both sides").to_string();
    assert!(message.contains("sign(x)") && message.contains("at the start"), "{message}");
    assert!(followed(&fork, "x=1", 1.0, Precision::Float).is_ok());
    let found = Variational::new(&friction.model, &start(&friction, "x=1 y=0.2"));
    assert!(matches!(found, Err(FlowError::Jumps)), "tangent vectors jump");
}

#[test]
fn what_touches_a_zero_or_stays_there_goes_on() {
    let touch = field(&[("x", "y"), ("y", "-x + abs(x - 1)")]);
    let found = followed(&touch, "x=1 y=0", 20.0, Precision::Float).expect("from a zero at rest");
    assert!(found.steps < 1000, "{} steps", found.steps);
    // the circle touches x = 1 once a turn, and x − x stays 0
    for rate in ["-x + abs(x - 1) - max(1 - x, x - 1)", "-x + abs(sin(x)^2 + cos(x)^2 - 1)"] {
        let case = field(&[("x", "y"), ("y", rate)]);
        let found = followed(&case, "x=1 y=0", 20.0 * PI, Precision::Float).expect("a circle");
        let [x, y] = [found.end[0].hi, found.end[1].hi];
        assert!((x - 1.0).abs() < 1e-12 && y.abs() < 1e-12, "{rate}: {x}, {y}");
        assert!(found.steps < 5000, "{rate}: {} steps", found.steps);
    }
}

#[test]
fn a_double_scroll_is_chaos_and_a_bilinear_oscillator_is_none() {
    let h = "-5/7*x - 3/14*(abs(x + 1) - abs(x - 1))";
    let chua =
        field(&[("x", &format!("9*(y - x - ({h}))")), ("y", "x - y + z"), ("z", "-100/7*y")]);
    let motion = Variational::new(&chua.model, &start(&chua, "x=0.1 y=0 z=0")).expect("a motion");
    let found = motion.exponents(300.0).expect("exponents");
    assert!(found.largest.mean > 0.2 && found.largest.mean < 0.8, "{found:?}");
    assert_eq!(found.character, Character::StrangeAttractor);
    let bilinear = field(&[("x", "y"), ("y", "-x - abs(x)/2")]);
    let motion = Variational::new(&bilinear.model, &start(&bilinear, "x=1 y=0")).expect("a motion");
    let found = motion.exponents(300.0).expect("exponents");
    assert!(found.largest.mean.abs() < 1e-2, "{found:?}");
}

#[test]
fn steep_functions_are_followed_far_out() {
    // dry friction made smooth: the motion comes to rest in the tail of tanh
    for rate in ["-x - tanh(1000*v)/10", "-x - (1 - 2/(1 + exp(2000*v)))/10"] {
        let case = field(&[("x", "v"), ("v", rate)]);
        let found = followed(&case, "x=1 v=0", 5.0, Precision::Float).expect("a motion");
        assert!((found.end[0].hi - 0.0).abs() < 2.0, "{rate}");
    }
    let (fast, steep) = (field(&[("x", "-tanh(x)")]), field(&[("x", "-tanh(400*x)")]));
    for precision in BOTH {
        // sinh x = sinh x₀ e^(−t)
        let found = followed(&fast, "x=2", 3.0, precision).expect("a motion");
        let expected = ((2f64.sinh()) * (-3f64).exp()).asinh();
        assert!((found.end[0].hi - expected).abs() < 1e-15, "{precision:?}");
        let found = followed(&steep, "x=2", 1.0, precision).expect("a motion");
        assert!((found.end[0].hi - 1.0).abs() < 1e-14, "{precision:?}: {:?}", found.end);
    }
}

#[test]
fn zeros_of_high_order_are_passed() {
    for (rate, begin, end) in [
        ("cos(cos(x)^20)", "x=1 y=0", 2.8143965276054343),
        ("exp(-(50*(x - 60))^4)", "x=-400 y=0", 0.0),
    ] {
        let case = field(&[("x", "1"), ("y", rate)]);
        for precision in BOTH {
            let found = followed(&case, begin, 3.0, precision).expect("a motion");
            let error = (found.end[1].hi - end).abs();
            assert!(error < 1e-13, "{rate}, {precision:?}: {error:e}");
        }
    }
}

#[test]
fn a_motion_stays_on_a_level_that_is_unstable_across() {
    // Neumann's system on the sphere, which a rounding error leaves like e^t
    let case = parse(
        "title = 'a'\n[parameters]\nA = [1, 2, 3]\n[state]\nq = 'vector(3, -1..1)'\np = 'vector(3, -1..1)'\n\
         [level]\nequations = ['(q,q) = 1', '(q,p) = 0']\n[field]\n\"q'\" = 'p'\n\
         \"p'\" = '-A*q + ((q,A*q) - (p,p))*q'\n\
         [[claim]]\nname = 'energy'\nintegral = '(p,p) + (q,A*q)'\n",
    );
    let begin = "q=[3/5,4/5,0] p=[0,0,1]";
    let found = followed(&case, begin, 300.0, Precision::Float).expect("a bounded motion");
    for own in found.followed.iter().filter(|own| own.role != QuantityRole::Decoy) {
        assert!(own.drift < 1e-11, "{}: {:e}", own.name, own.drift);
    }
    let motion = Variational::new(&case.model, &start(&case, begin)).expect("a motion");
    let found = motion.exponents(500.0).expect("exponents");
    assert_eq!(found.character, Character::Regular, "an integrable system: {found:?}");
}

#[test]
fn gaps_in_a_series_hide_nothing() {
    // cos(5x⁴) and exp(−x⁴) have terms of the orders 0, 4, 8, … alone where they begin
    let line = field(&[("x", "1"), ("y", "0")]);
    let found = crossings(&line, "cos(5*x^4) = 1/2", "x=0 y=1", 5);
    for ((time, _), turns) in found.iter().zip([1.0, 5.0, 7.0, 11.0, 13.0]) {
        let expected = (PI * turns / 15.0).powf(0.25);
        assert!((time - expected).abs() < 1e-12, "{time}, not {expected}");
    }
    let found = crossings(&line, "x^4*exp(-x^4) = 1/10", "x=0 y=1", 2);
    assert!(
        (found[0].0 - 0.578286).abs() < 1e-5 && (found[1].0 - 1.375257).abs() < 1e-5,
        "{found:?}"
    );
    let steep = field(&[("x", "1"), ("y", "1/(1 + exp(-20*exp(-x^4)))")]);
    assert!(followed(&steep, "x=0 y=1", 4.0, Precision::Float).is_ok(), "no singularity");
}

#[test]
fn the_smaller_of_two_values_keeps_its_digits() {
    for (rate, begin, time, end) in [
        ("max(x, -1)", "x=1/10^20 y=0", 50.0, 50f64.exp() * 1e-20),
        ("min(1, x)", "x=1/10^12 y=0", 26.0, 26f64.exp() * 1e-12),
        ("min(max(x, -1), 1)", "x=1/10^14 y=0", 40.0, 41.0 - 14.0 * 10f64.ln()),
        ("sinh(x)", "x=1/10^20 y=0", 45.0, 2.0 * (45f64.exp() * 5e-21).atanh()),
        ("-sinh(x)", "x=1 y=0", 45.0, 2.0 * ((-45f64).exp() * 0.5f64.tanh()).atanh()),
        ("asinh(x)", "x=1/10^20 y=0", 40.0, 40f64.exp() * 1e-20),
        ("atanh(x)", "x=1/10^20 y=0", 40.0, 40f64.exp() * 1e-20),
        ("-tanh(x)", "x=1 y=0", 30.0, ((-30f64).exp() * 1f64.sinh()).asinh()),
        ("tanh(x)", "x=1/10^30 y=0", 30.0, 30f64.exp() * 1e-30),
    ] {
        let case = field(&[("x", rate), ("y", "0")]);
        for precision in BOTH {
            let found = followed(&case, begin, time, precision).expect("a motion").end[0].hi;
            assert!((found / end - 1.0).abs() < 1e-6, "{rate}, {precision:?}: {found}, not {end}");
        }
    }
}

#[test]
fn functions_that_are_0_far_out_make_no_step_too_short() {
    for rate in ["max(0, 1/(1+exp(50*x)))", "0/(1+exp(50*x))", "min(1, 0/(1+exp(50*x)))"] {
        let case = field(&[("x", "1"), ("y", rate)]);
        let end = followed(&case, "x=1 y=0", 300.0, Precision::Float).expect("a motion").end;
        assert!(end[1].hi.abs() < 4e-24, "{rate}: {end:?}");
    }
    let square = field(&[("x", "1"), ("y", "((exp(x)-1)/(exp(x)+1))^2")]);
    let end = followed(&square, "x=0 y=0", 368.0, Precision::Float).expect("a motion").end;
    assert!((end[1].hi - 366.0).abs() < 1e-11, "{end:?}");
}

#[test]
fn a_level_does_not_depend_on_what_is_beside_it() {
    // A cubic rate towards and away from a circle about (a, 0), with a constant beside it
    for (a, z) in [("0", "0"), ("1000", "0"), ("0", "10^12")] {
        let case = parse(&format!(
            "title = 'a'\n[state]\nx = '-2..2'\ny = '-2..2'\nz = '-2..2'\n\
             [level]\nequations = ['(x-{a})^2 + y^2 = 1']\n[field]\n\
             \"x'\" = '-y + 3*(x-{a})*((x-{a})^2+y^2-1)'\n\
             \"y'\" = 'x - {a} + 3*y*((x-{a})^2+y^2-1)'\n\"z'\" = '0'\n"
        ));
        let begin = format!("x={a}+3/5 y=4/5 z={z}");
        let end = followed(&case, &begin, 100.0, Precision::Float).expect("a motion").end;
        let x = (end[0] - DoubleDouble::from_f64(a.parse().expect("a number"))).hi;
        let off = x * x + end[1].hi * end[1].hi - 1.0;
        assert!(off.abs() < 1e-9, "{a}, {z}: {off:e} off the level");
        // Steps are those for the size of the whole state.
        let error = if z == "0" { 1e-9 } else { 1e-4 };
        let gap = x - (100.0 + 0.8f64.atan2(0.6)).cos();
        assert!(gap.abs() < error, "{a}, {z}: {gap:e}");
    }
}

#[test]
fn motions_begin_on_either_side_of_a_modulus_under_a_root_or_logarithm() {
    // Integrals from −1 to −1/2
    for (rate, integral) in [
        ("sqrt(abs(x))", (2.0 - 0.5f64.sqrt()) / 3.0),
        ("abs(x)^(-1/2)", 2.0 - 2f64.sqrt()),
        ("(1 + 2*abs(x))^(1/2)", 3f64.sqrt() - 8f64.sqrt() / 3.0),
        ("max(x, 1/4)^(3/2)", 0.0625),
        ("asin(max(x, 0)/3)", 0.0),
        ("sqrt(abs(abs(x) - 2) - x)", 0.5 * 2f64.sqrt()),
        ("log(1/5 + abs(x))", 1.2 * 1.2f64.ln() - 0.7 * 0.7f64.ln() - 0.5),
        ("tanh(900) - 1", 0.0),
    ] {
        let case = field(&[("x", "1"), ("y", rate)]);
        for precision in BOTH {
            let error = gap(&case, "x=-1 y=0", 0.5, precision, [-0.5, integral]);
            assert!(error < 1e-14, "{rate}, {precision:?}: {error:e}");
        }
    }
    let circle = field(&[("x", "y"), ("y", "-x")]);
    let found = crossings(&circle, "(1 + abs(x))^(3/2) = 2^(1/2)", "x=-1 y=0", 4);
    let first = PI / 2.0 + (2f64.cbrt() - 1.0).asin();
    assert!((found[1].0 - first).abs() < 1e-14 && found.len() == 4, "{found:?}");
}

#[test]
fn a_motion_runs_away_whatever_falls_beside_it() {
    for rate in ["-y/(1 + y^2)", "1/(1 + (y - 1)^2)", "log(2 + y) - y", "-y"] {
        let case = field(&[("x", "x^2"), ("y", rate)]);
        let end = followed(&case, "x=1 y=1", 5.0, Precision::Float);
        assert!(matches!(end, Err(FlowError::RunsAway { .. })), "{rate}: {end:?}");
    }
    let pole = field(&[("x", "1/(1 - x)"), ("y", "1")]);
    let end = followed(&pole, "x=0 y=0", 5.0, Precision::Float);
    assert!(matches!(end, Err(FlowError::Singular { .. })), "{end:?}");
}

#[test]
fn gates_that_are_1_to_rounding_are_not_jumped() {
    for (rate, closed) in [
        ("1/(1+exp(-(x^2-4)*10))", 60.0 - 56.0010309),
        ("1/(1+exp(-x^2))", 60.0 - 58.927845),
        ("exp(x^2)/(1+exp(x^2))", 60.0 - 58.927845),
    ] {
        let case = field(&[("x", "1"), ("y", rate)]);
        for precision in BOTH {
            let end = followed(&case, "x=-30 y=0", 60.0, precision).expect("a motion").end;
            assert!((60.0 - end[1].hi - closed).abs() < 1e-6, "{rate}, {precision:?}: {end:?}");
        }
    }
}
