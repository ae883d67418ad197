//! Regular motion and chaos: exponents, vectors, planes of starts.

use liouville::case::{Case, Setting};
use liouville::number::double_double::DoubleDouble;
use liouville::number::rational::Rational;
use liouville::verdict::{evaluate, read_state};
use liouville_flow::{
    Character, ChartAxis, Coordinate, FlowError, Launch, PlaneRequest, Precision, Variational,
    orbit, plane, section_starts,
};

use crate::integration::{catalogue, parse, start};

#[test]
fn exponents_tell_regular_motion_from_chaos() {
    let exponents = |file: &str, at: [f64; 2], time: f64| {
        let case = catalogue(file);
        let plan = case.section.as_ref().expect("a [section]");
        let starts = section_starts(&case, &plan.g0, &plan.energy, &[at], 1).expect("a chart");
        let start = starts.into_iter().next().expect("one").expect("a state");
        Variational::new(&case.model, &start).and_then(|motion| motion.exponents(time))
    };
    let regular = exponents("figures/fig-3.toml", [1.0, 0.3], 1000.0).expect("no singularity");
    assert_eq!(regular.character, Character::Regular, "{regular:?}");
    assert!(regular.largest.mean < 0.004, "falls like (ln t)/t: {regular:?}");
    let chaos =
        exponents("figures/fig-14.toml", [1.26685, 0.42875], 1500.0).expect("no singularity");
    assert_eq!(chaos.character, Character::ConservativeChaos, "{chaos:?}");
    assert!((chaos.largest.mean - 0.104).abs() < 3.0 * (chaos.largest.error + 0.006), "{chaos:?}");
    let back = exponents("figures/fig-14.toml", [1.26685, 0.42875], -1500.0);
    let back = back.expect("no singularity").largest;
    assert!((back.mean - 0.104).abs() < 3.0 * (back.error + 0.006), "a measure is kept: {back:?}");
}

#[test]
fn vectors_align_in_chaos_and_stay_apart_on_tori() {
    let class = |file: &str, at: [f64; 2], time: f64| {
        let case = catalogue(file);
        let plan = case.section.as_ref().expect("a [section]");
        let starts = section_starts(&case, &plan.g0, &plan.energy, &[at], 1).expect("a chart");
        let parameters = starts[0].as_ref().expect("a state").parameters.clone();
        let motion = Variational::all(&case.model, &parameters, &starts).expect("a program");
        let both = [time, -time].map(|time| motion.exponents(time).expect("no singularity"));
        (both[0].class(&both[1]), both[0].alignment.expect("two vectors"))
    };
    let (regular, apart) = class("figures/fig-3.toml", [1.0, 0.3], 600.0);
    assert_eq!(regular, Character::Regular, "a torus");
    assert!(apart.index > 1e-3 && apart.since.is_none(), "like 1/t: {apart:?}");
    let (chaos, aligned) = class("figures/fig-14.toml", [1.26685, 0.42875], 600.0);
    assert_eq!(chaos, Character::ConservativeChaos, "a measure is kept");
    assert!(aligned.index < 1e-8 && aligned.since.is_some(), "one direction is left: {aligned:?}");
}

/// Chaplygin's ball is integrable: its field and its tangent vectors are those off (ω,γ) = 0.
#[test]
fn a_ball_that_spins_moves_on_tori_and_a_rattleback_gains_and_loses_volume() {
    let exponents = |text: &str, state: &str, time: f64| {
        let case = crate::integration::parse(text);
        let motion = Variational::new(&case.model, &crate::integration::start(&case, state));
        motion.and_then(|motion| motion.exponents(time)).expect("no singularity")
    };
    let ball = "title = 'ball'\nsystem = 'rolling-plane'\n[parameters]\nm = 1.1\nR = 1.2\n\
                I = [1.6, 2.5, 2.3]\n[body]\nshape = 'ball'\n";
    let start = "ω=[-1.4,1.5,0.8] γ=[2/3,-1/3,2/3]";
    for time in [1000.0, -1000.0] {
        let regular = exponents(ball, start, time);
        assert_eq!(regular.character, Character::Regular, "{regular:?}");
        assert!(regular.largest.mean < 0.005, "falls like (ln t)/t: {regular:?}");
    }
    // The divergence at the rotations about e₃ is ∓0.15507, by a 100-digit computation.
    let rattleback = "title = 'rattleback'\nsystem = 'rolling-plane'\n[parameters]\nm = 1\n\
                      B = [4, 1, 0.64]\na_g = 9.8\n\
                      I = [[0.30897, -0.0894012, 0], [-0.0894012, 1.19103, 0], [0, 0, 1.3]]\n\
                      [body]\nshape = 'ellipsoid'\npotential = 'm*a_g*h'\n";
    let case = crate::integration::parse(rattleback);
    for spin in [1, -1] {
        let state = read_state(&case, &format!("ω=[0,0,{spin}] γ=[0,0,1]")).expect("a state");
        let found = evaluate(&case, Some(&state), 1, 0).expect("evaluated");
        let (growth, _) = found.level_divergence.expect("defined");
        assert!((growth + 0.15507 * f64::from(spin)).abs() < 1e-5, "{growth} at Ω = {spin}");
    }
}

/// Makes an axis of a plane of starts in figure 14, or of parameters.
fn axis(coordinate: Coordinate, from: f64, to: f64, count: usize) -> ChartAxis {
    let read = |value| Rational::from_f64(value).expect("finite");
    ChartAxis { coordinate, from: read(from), to: read(to), count }
}

#[test]
fn a_chart_agrees_with_the_exact_exponents_and_does_not_depend_on_threads() {
    let case = catalogue("figures/fig-14.toml");
    let plan = case.section.as_ref().expect("a [section]");
    let (g0, energy) = (plan.g0.clone(), plan.energy.clone());
    let launch = Launch::Section { g0: g0.clone(), energy: energy.clone(), at: [0.0, 0.0] };
    let axes = [axis(Coordinate::L, 0.2, 5.0, 3), axis(Coordinate::Z, -0.8, 1.2, 3)];
    let request = PlaneRequest { axes, launch, time: 400.0, seed: 1 };
    let found = plane(&case, &request, 1, &|_| ()).expect("a plane");
    let again = plane(&case, &request, 3, &|_| ()).expect("a plane");
    assert_eq!(found, again, "bit for bit");
    let points: Vec<[f64; 2]> = (0..9)
        .map(|k| [(k % 3, 0), (k / 3, 1)].map(|(k, i)| request.axes[i].value(k).to_f64().0))
        .collect();
    let starts = section_starts(&case, &g0, &energy, &points, 1).expect("a chart");
    for (found, start) in found.iter().zip(starts) {
        let Ok(start) = start else { panic!("all of them have a state") };
        let exact = Variational::new(&case.model, &start).and_then(|one| one.exponents(400.0));
        let (found, exact) = (found.as_ref().expect("a motion"), exact.expect("a motion"));
        let (a, b) = (found.largest, exact.largest);
        // Chaotic motions diverge by rounding, and regular ones agree closely.
        let bound = if exact.character == Character::Regular { 0.002 } else { 0.1 };
        assert!((a.mean - b.mean).abs() < bound, "{a:?} and {b:?}");
    }
}

#[test]
fn a_chart_of_parameters_has_the_motions_of_its_points() {
    let case = catalogue("figures/fig-8.toml");
    let index = |name: &str| case.model.parameters.iter().position(|one| one.name == name);
    let parameter = |name: &str, component| Coordinate::Parameter {
        index: index(name).expect("a parameter"),
        component,
    };
    let plan = case.section.as_ref().expect("a [section]");
    let (g0, energy) = (plan.g0.clone(), plan.energy.clone());
    let launch = Launch::Section { g0: g0.clone(), energy: energy.clone(), at: [3.4, 0.4] };
    let axes = [axis(parameter("c", 2), 0.0, 1.0, 2), axis(parameter("a_g", 0), 4.0, 28.0, 2)];
    let request = PlaneRequest { axes, launch, time: 20.0, seed: 1 };
    let found = plane(&case, &request, 2, &|_| ()).expect("a plane");
    for (k, found) in found.iter().enumerate() {
        let (c3, a_g) = ([0.25, 0.75][k % 2], [10.0, 22.0][k / 2]);
        let set = |name: &str, value: String| Setting { name: name.to_string(), value };
        let settings = [set("c", format!("[1,1.5,{c3}]")), set("a_g", a_g.to_string())];
        let path = std::path::Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
            .join("cases/figures/fig-8.toml");
        let case = Case::read(&path, &settings).1.expect("a case");
        let start = section_starts(&case, &g0, &energy, &[[3.4, 0.4]], 1).expect("a chart");
        match start.into_iter().next().expect("one") {
            Err(problem) => assert_eq!(found.as_ref().err(), Some(&problem), "no state there"),
            Ok(start) => {
                let exact = Variational::new(&case.model, &start);
                let exact = exact.and_then(|one| one.exponents(20.0)).expect("a motion");
                let found = found.as_ref().expect("a motion");
                let apart = (found.largest.mean - exact.largest.mean).abs();
                assert!(apart < 1e-4, "{k}: {found:?} and {exact:?}");
                let apart = (found.divergence.mean - exact.divergence.mean).abs();
                assert!(apart < 1e-5, "{k}: {found:?} and {exact:?}");
            }
        }
    }
    assert!(found[2].is_err() || found[3].is_err(), "22·m·|c| is above the energy somewhere");
}

#[test]
fn a_motion_whose_steps_shrink_without_end_is_given_up() {
    // backwards it grows like e^(10 t), and turns about the x axis as fast as it is large
    let text = "title = 'Lorenz'\n[state]\nx = '-2..2'\ny = '-2..2'\nz = '20..24'\n[field]\n\
                \"x'\" = '10*(y - x)'\n\"y'\" = '28*x - y - x*z'\n\"z'\" = 'x*y - 8/3*z'\n";
    let case = parse(text);
    let motion = Variational::new(&case.model, &start(&case, "x=1 y=2 z=20")).expect("a motion");
    let found = motion.exponents(-2000.0);
    let Err(FlowError::Shrinking { time, step, .. }) = found else { panic!("{found:?}") };
    assert!(time < -0.5 && step.abs() < 1e-3, "given up at t = {time}, step {step:e}");
}

#[test]
fn a_motion_that_grows_slowly_and_turns_ever_faster_is_given_up() {
    // friction backwards: the amplitude grows like e^(t/15), and Duffing's spring turns as fast
    let text = "title = 'a'\n[state]\nx = '-2..2'\np = '-2..2'\ns = '-2..2'\n[field]\n\"x'\" = 'p'\n\
                \"p'\" = 'x - x^3 - p/5 + 3/10*cos(s)'\n\"s'\" = '1'\n";
    let case = parse(text);
    let motion = Variational::new(&case.model, &start(&case, "x=1 p=0 s=0")).expect("a motion");
    let found = motion.exponents(-1000.0);
    let Err(FlowError::Shrinking { time, grown, .. }) = found else { panic!("{found:?}") };
    assert!(time > -200.0 && grown > 1e3, "given up at t = {time}, {grown} times as large");
    let message = found.expect_err("given up").to_string();
    assert!(message.starts_with("backwards in time the motion runs away"), "{message}");
}

#[test]
fn a_motion_that_is_infinite_in_finite_time_runs_away() {
    for (rate, end) in [("x^2", 1.0), ("x^4 + 1/(100 + x^2)", 0.33), ("exp(x)", 0.3678794)] {
        let case =
            parse(&format!("title = 'a'\n[state]\nx = '1..2'\n[field]\n\"x'\" = '{rate}'\n"));
        let found =
            orbit(&case, start(&case, "x=1"), DoubleDouble::from_f64(9.0), Precision::Float);
        let Err(FlowError::RunsAway { time, .. }) = found else { panic!("{rate}: {found:?}") };
        assert!((time - end).abs() < 1e-2, "{rate}: {time}");
    }
    // e^(e^t) is too large, and has no pole
    let case = parse("title = 'a'\n[state]\nx = '1..2'\n[field]\n\"x'\" = 'x*log(x)'\n");
    for begin in ["x=2", "x=0.5"] {
        let found =
            orbit(&case, start(&case, begin), DoubleDouble::from_f64(99.0), Precision::Float);
        assert!(matches!(found, Err(FlowError::Overflow(_))), "{begin}: {found:?}");
    }
}

#[test]
fn a_time_of_too_many_steps_is_given_up() {
    let text = "title = 'a circle'\n[state]\nx = '-2..2'\ny = '-2..2'\n[field]\n\"x'\" = 'y'\n\"y'\" = '-x'\n";
    let case = parse(text);
    let begin = start(&case, "x=1 y=0");
    for time in [1e300, -1e300, 1e12] {
        let time = DoubleDouble::from_f64(time);
        let found = orbit(&case, begin.clone(), time, Precision::Float);
        assert!(matches!(found, Err(FlowError::Endless { .. })), "{time:?}: {found:?}");
    }
    let motion = Variational::new(&case.model, &begin).expect("a motion");
    let found = motion.exponents(1e300);
    assert!(matches!(found, Err(FlowError::Endless { .. })), "{found:?}");
    // steps that grow arrive: the radius of convergence of √(1 + t²) grows with t
    let text =
        "title = 'a'\n[state]\nx = '1..2'\ny = '0..1'\n[field]\n\"x'\" = 'y/x'\n\"y'\" = '1'\n";
    let case = parse(text);
    let time = DoubleDouble::from_f64(1e15);
    let found = orbit(&case, start(&case, "x=1 y=0"), time, Precision::Float);
    let end = found.expect("a motion").end[0].hi;
    assert!((end / 1e15 - 1.0).abs() < 1e-9, "x = √(1 + t²), not {end}");
}

#[test]
fn a_source_that_turns_escapes_and_its_focus_is_an_unstable_rest() {
    // Equal exponents do not align vectors.
    let case = parse(
        "title = 'a'\n[state]\nx = '-2..2'\ny = '-2..2'\nz = '-2..2'\n[field]\n\
         \"x'\" = 'x - 5*y'\n\"y'\" = '5*x + y'\n\"z'\" = '-z'\n",
    );
    for (begin, expected) in
        [("x=1 y=0 z=1", Character::Escape), ("x=0 y=0 z=0", Character::UnstableRest)]
    {
        let motion = Variational::new(&case.model, &start(&case, begin)).expect("a motion");
        let found = motion.exponents(200.0).expect("exponents");
        assert_eq!(found.character, expected, "{begin}: {found:?}");
    }
}

#[test]
fn a_large_component_hides_no_chaos() {
    // Lorenz' equations with a constant of any size, and with a clock in short units of time.
    let lorenz = |k: &str, rate: &str, s: &str, time: f64| {
        let case = parse(&format!(
            "title = 'a'\n[parameters]\nr = '20..30'\nb = '2..3'\n[state]\nx = '-2..2'\ny = '-2..2'\n\
             z = '20..24'\ns = '0..1'\n[field]\n\"x'\" = '{k}*10*(y - x)'\n\
             \"y'\" = '{k}*(r*x - y - x*z)'\n\"z'\" = '{k}*(x*y - b*z)'\n\"s'\" = '{rate}'\n"
        ));
        let axes = [(0, 26.0, 30.0), (1, 2.6, 2.7)].map(|(index, from, to)| {
            axis(Coordinate::Parameter { index, component: 0 }, from, to, 2)
        });
        let state = read_state(&case, &format!("x=1 y=1 z=20 s={s}")).expect("a state");
        let launch = Launch::State(Some(state));
        let request = PlaneRequest { axes, launch, time, seed: 1 };
        plane(&case, &request, 2, &|_| ()).expect("a plane")
    };
    for (k, rate, s, time) in [("1", "0", "1e8", 200.0), ("1/1000000", "1", "0", 2e8)] {
        for found in lorenz(k, rate, s, time) {
            let found = found.expect("a motion");
            assert_eq!(found.character, Character::StrangeAttractor, "{found:?}");
            let largest = found.largest.mean * time / 200.0;
            assert!((largest - 0.85).abs() < 0.2, "{largest}");
        }
    }
}

#[test]
fn a_far_start_is_forgotten_by_a_chart() {
    let case = parse(
        "title = 'a'\n[parameters]\nr = '20..30'\nb = '2..3'\n[state]\nx = '-2..2'\ny = '-2..2'\n\
         z = '20..24'\n[field]\n\"x'\" = '10*(y - x)'\n\"y'\" = 'r*x - y - x*z'\n\
         \"z'\" = 'x*y - b*z'\n",
    );
    let axes = [(0, 26.0, 30.0), (1, 2.6, 2.7)]
        .map(|(index, from, to)| axis(Coordinate::Parameter { index, component: 0 }, from, to, 1));
    let state = read_state(&case, "x=1e7 y=1 z=20").expect("a state");
    let request = PlaneRequest { axes, launch: Launch::State(Some(state)), time: 100.0, seed: 1 };
    let found = plane(&case, &request, 1, &|_| ()).expect("a plane");
    let found = found[0].as_ref().expect("a motion");
    assert_eq!(found.character, Character::StrangeAttractor, "{found:?}");
}
