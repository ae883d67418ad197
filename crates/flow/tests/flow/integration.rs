//! Motions: drift of integrals, reversal in time, known solutions, an independent integrator.

mod chaos;
mod common_zeros;
mod contacts;
mod cycles;
mod features;
mod jumps;
mod lanes;
mod limits;
mod moduli;
mod powers;
mod presence;
mod progress;
mod roots;
mod sections;
mod sets;
mod surfaces;

use liouville::case::Case;
use liouville::number::double_double::DoubleDouble;
use liouville::number::rational::Rational;
use liouville::verdict::read_state;
use liouville_flow::{Contact, FlowError, Orbit, Precision, QuantityRole, Start, orbit};
use nalgebra::{Matrix3, Vector3};

/// The unbalanced ball of the speed comparison, with the common initial state.
const BALL: &str = r#"
title = "unbalanced ball"
system = "rubber-plane"
[parameters]
m = 1.3
R = 3
c = [0.7, -0.4, 1.1]
I = [2.6, 1.2, 1.8]
[body]
shape = "ball"
[[claim]]
name = "F2"
integral = "|Ĩ*ω × γ|² − 2*m*R*(γ,c)*(Ĩ*ω,ω)"
[[claim]]
name = "wrong sign"
integral = "|Ĩ*ω × γ|² + 2*m*R*(γ,c)*(Ĩ*ω,ω)"
expect = "fails"
"#;

fn start(case: &Case, text: &str) -> Start {
    let state = read_state(case, text).expect("a state");
    Start::new(case, Some(&state), 1, 0).expect("a start on the level")
}

fn follow(case: &Case, text: &str, time: f64, precision: Precision) -> Orbit {
    orbit(case, start(case, text), DoubleDouble::from_f64(time), precision).expect("no singularity")
}

fn parse(text: &str) -> Case {
    Case::parse(text, &[]).expect("a case")
}

fn distance(a: &[DoubleDouble], b: &[DoubleDouble]) -> f64 {
    a.iter().zip(b).map(|(x, y)| (*x - *y).hi.powi(2)).sum::<f64>().sqrt()
}

#[test]
fn drifts_are_relative_to_terms_that_cancel_at_the_start() {
    let case = parse(
        "title = 'double pendulum'\n[state]\na = '-1..1'\nb = '-1..1'\n\"a'\" = '-1..1'\n\
         \"b'\" = '-1..1'\n[lagrangian]\nkinetic = \"a'^2 + b'^2/2 + a'*b'*cos(a - b)\"\n\
         potential = '-2*cos(a) - cos(b)'\n",
    );
    let found = follow(&case, "a=pi/2 b=pi/2 a'=0 b'=0", 20.0, Precision::Float);
    let energy = found.followed.iter().find(|own| own.name == "energy").expect("an energy");
    assert!(energy.drift > 0.0 && energy.drift < 1e-13, "{}", energy.drift);
}

const BALL_START: &str = "ω=[0.5,0.7,-0.5] γ=[1/3,2/3,2/3]";

#[test]
fn integrals_of_a_long_motion_drift_by_rounding_alone() {
    let case = parse(BALL);
    for (precision, bound) in [(Precision::Float, 1e-14), (Precision::Pair, 1e-28)] {
        let found = follow(&case, BALL_START, 1000.0, precision);
        for followed in &found.followed {
            let drift = followed.drift;
            match followed.role {
                QuantityRole::Decoy => assert!(drift > 0.1, "{}: {drift:e}", followed.name),
                _ => assert!(drift <= bound, "{}: {drift:e} in {precision:?}", followed.name),
            }
        }
    }
}

#[test]
fn a_motion_runs_back_to_its_start() {
    let case = parse(BALL);
    let there = follow(&case, BALL_START, 20.0, Precision::Float);
    let mut begin = there.start.clone();
    begin.state = there.end;
    let back =
        orbit(&case, begin, DoubleDouble::from_f64(-20.0), Precision::Float).expect("runs back");
    assert!(distance(&back.end, &there.start.state) < 1e-12, "there and back again");
}

/// Computes γ' = γ × ω and the equations of the ball by hand: r = -Rγ - c.
fn ball_by_hand(state: [f64; 6]) -> [f64; 6] {
    let [w1, w2, w3, g1, g2, g3] = state;
    let (m, radius) = (1.3, 3.0);
    let centre = Vector3::new(0.7, -0.4, 1.1);
    let (omega, gamma) = (Vector3::new(w1, w2, w3), Vector3::new(g1, g2, g3));
    let rate = gamma.cross(&omega);
    let (r, r_rate) = (-gamma * radius - centre, -rate * radius);
    let central = Matrix3::from_diagonal(&Vector3::new(2.6, 1.2, 1.8));
    let inertia = central + (Matrix3::identity() * r.dot(&r) - r * r.transpose()) * m;
    let inverse = inertia.try_inverse().unwrap_or_default();
    let forces = (inertia * omega).cross(&omega) - r.cross(&omega.cross(&r_rate)) * m;
    let multiplier = -(inverse * gamma).dot(&forces) / (inverse * gamma).dot(&gamma);
    let acceleration = inverse * (forces + gamma * multiplier);
    [acceleration.x, acceleration.y, acceleration.z, rate.x, rate.y, rate.z]
}

/// Integrates by the classical Runge-Kutta method of order 4.
fn runge_kutta(
    field: fn([f64; 6]) -> [f64; 6],
    mut y: [f64; 6],
    time: f64,
    steps: u32,
) -> [f64; 6] {
    let h = time / f64::from(steps);
    let moved =
        |y: &[f64; 6], slope: &[f64; 6], h: f64| std::array::from_fn(|i| y[i] + h * slope[i]);
    for _ in 0..steps {
        let k1 = field(y);
        let k2 = field(moved(&y, &k1, h / 2.0));
        let k3 = field(moved(&y, &k2, h / 2.0));
        let k4 = field(moved(&y, &k3, h));
        let mean = std::array::from_fn(|i| (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]) / 6.0);
        y = moved(&y, &mean, h);
    }
    y
}

#[test]
fn an_independent_integrator_agrees() {
    let case = parse(BALL);
    let found = follow(&case, BALL_START, 20.0, Precision::Float);
    let begin: Vec<f64> = found.start.state.iter().map(|x| x.hi).collect();
    let begin: [f64; 6] = begin.try_into().expect("six components");
    let at_end = |steps: u32| {
        let last = runge_kutta(ball_by_hand, begin, 20.0, steps).map(DoubleDouble::from_f64);
        distance(&found.end, &last)
    };
    let (coarse, fine) = (at_end(2_000), at_end(40_000));
    assert!(fine < 1e-10, "two integrators, two derivations: {fine:e}");
    assert!(coarse > 1e4 * fine, "an error of order 4: {coarse:e} and {fine:e}");
}

/// Integrates a field with a known solution.
fn solved(field: &str, begin: &str, time: f64) -> (f64, DoubleDouble) {
    let text = format!(
        "title = 't'\nsystem = 'field'\ncheck-weights = false\n[state]\nx = '0.5..2'\n\
         [field]\n\"x'\" = '{field}'\n"
    );
    let case = parse(&text);
    let float = follow(&case, begin, time, Precision::Float).end[0].hi;
    (float, follow(&case, begin, time, Precision::Pair).end[0])
}

#[test]
fn every_function_has_its_rule() {
    // Each field has a function V of x that grows at rate 1, or a known solution.
    let check = |field: &str, begin: &str, time: f64, exact: f64| {
        let (float, pair) = solved(field, begin, time);
        assert!((float - exact).abs() < 4e-15 * exact.abs(), "{field}: {float} and {exact}");
        assert!((pair.hi - exact).abs() < 4e-15 * exact.abs(), "{field}: {pair:?} and {exact}");
        assert!((float - pair.hi).abs() < 2e-15 * exact.abs(), "{field}: {float} and {pair:?}");
    };
    check("exp(-x)", "x=1", 2.0, (1f64.exp() + 2.0).ln());
    check("√x", "x=1", 3.0, 2.5 * 2.5);
    check("1/x", "x=1", 4.0, 3.0);
    check("x^(1/3)", "x=1", 4.5, 8.0);
    check("x^(-2/3)", "x=1", 4.2, 8f64.powf(0.6));
    check("x*ln(x)", "x=2", 1.0, (2f64.ln() * 1f64.exp()).exp());
    check("sin(x)", "x=1", 1.5, 2.0 * (0.5f64.tan() * 1.5f64.exp()).atan());
    check("cos(x)", "x=1/2", 1.0, (0.5f64.sin().atanh() + 1.0).tanh().asin());
    check("(1 + x²)*atan(x)", "x=1/2", 0.5, (0.5f64.atan() * 0.5f64.exp()).tan());
    check("x^x/((1 + ln(x))*x^x)", "x=2", 1.0, {
        // x ln x grows at rate 1.
        let target = 2.0 * 2f64.ln() + 1.0;
        (0..60).fold(3.0, |x: f64, _| x - (x * x.ln() - target) / (1.0 + x.ln()))
    });
}

#[test]
fn thirty_digits_of_a_known_solution() {
    let (_, pair) = solved("x*(1 - x)", "x=1/3", 1.0);
    // 1/(1 + 2/e), to 36 digits
    let exact: Rational = "0.576116884765829109858318923638500352".parse().expect("a number");
    let error = (&pair.to_rational().expect("finite") - &exact).abs().to_f64().0;
    assert!(error < 1e-30, "off by {error:e}");
}

#[test]
fn a_way_to_infinity_is_told_with_its_time() {
    let text = "title = 't'\nsystem = 'field'\ncheck-weights = false\n[state]\nx = '0.5..2'\n\
                [field]\n\"x'\" = 'x²'\n";
    let case = parse(text);
    let found = orbit(&case, start(&case, "x=1"), DoubleDouble::from_f64(2.0), Precision::Float);
    let Err(FlowError::RunsAway { time, .. }) = found else { panic!("1/(1 - t) ends at t = 1") };
    assert!((time - 1.0).abs() < 1e-9, "found at t = {time}");
}

/// Reads a case of the catalogue.
fn catalogue(path: &str) -> Case {
    let path = std::path::Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
        .join("cases")
        .join(path);
    Case::read(&path, &[]).1.unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

#[test]
fn contact_leaving_and_grazing_at_the_right_times() {
    let case = catalogue("one-sided/motion.toml");
    // Reference times in 24 digits, by an independent computation in high precision.
    let reference = [
        (Contact::Arrives, "2.928150885740918661499363"),
        (Contact::Leaves, "3.814896187257355099547223"),
    ];
    for (precision, bound) in [(Precision::Float, 1e-12), (Precision::Pair, 6e-25)] {
        let found = follow(&case, "ω=[3,-27/10,3/2]", 12.0, precision);
        let kinds: Vec<Contact> = found.events.iter().map(|event| event.kind).collect();
        use Contact::{Arrives, Grazes, Leaves};
        assert_eq!(kinds, [Arrives, Leaves, Grazes, Grazes], "in {precision:?}");
        for (event, (_, time)) in found.events.iter().zip(&reference) {
            let time: Rational = time.parse().expect("a number");
            let error = (&event.time.to_rational().expect("finite") - &time).abs().to_f64().0;
            assert!(error < bound, "{:?} is off by {error:e} in {precision:?}", event.kind);
        }
        let [energy, momentum] = [0, 1].map(|k| &found.followed[k]);
        assert!(energy.drift < 1e-14, "the energy is kept through all phases");
        assert!(momentum.drift > 0.2, "the momentum is not kept in contact");
    }
}

#[test]
fn a_start_behind_the_constraint_is_refused() {
    let case = catalogue("one-sided/motion.toml");
    let begin = start(&case, "ω=[-1,-1,-1]");
    let found = orbit(&case, begin, DoubleDouble::from_f64(1.0), Precision::Float);
    assert!(matches!(found, Err(FlowError::BehindConstraint { .. })), "(ω,e) < 0");
}

/// Writes the Euler top with I33 = 1/ε and its limits, the catalogue's example of the limit
/// theorem.
fn top(field: &str) -> Case {
    parse(&format!(
        "title = 't'\nsystem = 'field'\ncheck-weights = false\n[parameters]\n\
         I = [['5/2', '2/5', '-3/7'], ['2/5', '17/8', '1/2'], ['-3/7', '1/2', 3]]\n{field}"
    ))
}

#[test]
fn heavy_tops_tend_to_the_vakonomic_motion_at_the_stated_rate() {
    let planar = |rates: &str, begin: &str| {
        let text = format!(
            "[state]\nw1 = '-2..2'\nw2 = '-2..2'\nn = '-2..2'\n[let]\n\
             d = 'I[1,1]*I[2,2] − I[1,2]²'\nM3 = 'I[1,3]*w1 + I[2,3]*w2 − n'\n{rates}"
        );
        follow(&top(&text), begin, 2.0, Precision::Pair).end
    };
    let vakonomic = planar(
        "dw1 = '−M3*(I[2,2]*w2 + I[1,2]*w1)/d'\ndw2 = 'M3*(I[1,2]*w2 + I[1,1]*w1)/d'\n\
         [field]\n\"w1'\" = 'dw1'\n\"w2'\" = 'dw2'\n\
         \"n'\" = 'I[1,3]*dw1 + I[2,3]*dw2 + (I[2,2] − I[1,1])*w1*w2 + I[1,2]*(w1² − w2²)'\n",
        "w1=2/3 w2=-4/5 n=0",
    );
    // Reference values by an independent computation in high precision.
    let reference = ["0.219175412765153974817361757237", "-0.993768214773554576043339364269"];
    for (value, exact) in vakonomic.iter().zip(reference) {
        let exact: Rational = exact.parse().expect("a number");
        let error = (&value.to_rational().expect("finite") - &exact).abs().to_f64().0;
        assert!(error < 1e-28, "off by {error:e}");
    }
    // The error times I33, by the theorem's rate O(1/I33).
    for (moment, constant) in [("100", 0.0332518669130), ("10000", 0.0331946942146)] {
        let text = format!(
            "[state]\nw = 'vector(-2..2)'\n[let]\n\
             A = 'mat([I[1,1], I[1,2], I[1,3]], [I[1,2], I[2,2], I[2,3]], [I[1,3], I[2,3], {moment}])'\n\
             [field]\n\"w'\" = 'A⁻¹*(A*w × w)'\n"
        );
        let found = follow(&top(&text), "w=[2/3,-4/5,0]", 2.0, Precision::Pair).end;
        let error = distance(&found[..2], &vakonomic[..2]) * moment.parse::<f64>().expect("one");
        assert!((error - constant).abs() < 1e-10, "I33 = {moment}: {error} and {constant}");
    }
}
