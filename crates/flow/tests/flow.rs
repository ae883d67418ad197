//! Motions: drift of integrals, reversal in time, known solutions, an independent integrator.

use liouville::case::{Case, Setting};
use liouville::number::pair::Pair;
use liouville::number::rational::Rational;
use liouville::verdict::read_state;
use liouville_flow::{
    Axis, Character, Contact, Coordinate, FlowError, Launch, Multipliers, Orbit, PlaneRequest,
    Precision, Role, SectionMap, SectionOrbit, SectionRequest, Start, Variational, area_forms,
    orbit, plane, section, section_starts, separatrices, spread, values_at_starts,
};
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
    orbit(case, start(case, text), Pair::from_f64(time), precision).expect("no singularity")
}

fn parse(text: &str) -> Case {
    Case::parse(text, &[]).expect("a case")
}

fn distance(a: &[Pair], b: &[Pair]) -> f64 {
    a.iter().zip(b).map(|(x, y)| (*x - *y).hi.powi(2)).sum::<f64>().sqrt()
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
                Role::Decoy => assert!(drift > 0.1, "{}: {drift:e}", followed.name),
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
    let back = orbit(&case, begin, Pair::from_f64(-20.0), Precision::Float).expect("runs back");
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
        let last = runge_kutta(ball_by_hand, begin, 20.0, steps).map(Pair::from_f64);
        distance(&found.end, &last)
    };
    let (coarse, fine) = (at_end(2_000), at_end(40_000));
    assert!(fine < 1e-10, "two integrators, two derivations: {fine:e}");
    assert!(coarse > 1e4 * fine, "an error of order 4: {coarse:e} and {fine:e}");
}

/// Integrates a field with a known solution.
fn solved(field: &str, begin: &str, time: f64) -> (f64, Pair) {
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
fn a_singularity_is_told_with_its_time() {
    let text = "title = 't'\nsystem = 'field'\ncheck-weights = false\n[state]\nx = '0.5..2'\n\
                [field]\n\"x'\" = 'x²'\n";
    let case = parse(text);
    let found = orbit(&case, start(&case, "x=1"), Pair::from_f64(2.0), Precision::Float);
    let Err(FlowError::Singular { time, .. }) = found else { panic!("1/(1 - t) ends at t = 1") };
    assert!((time - 1.0).abs() < 1e-9, "found at t = {time}");
}

#[test]
fn a_modulus_is_refused_by_name() {
    let text = "title = 't'\nsystem = 'field'\ncheck-weights = false\n[state]\nx = '0.5..2'\n\
                [field]\n\"x'\" = 'abs(x)'\n";
    let case = parse(text);
    let found = orbit(&case, start(&case, "x=1"), Pair::from_f64(2.0), Precision::Float);
    let error = found.expect_err("|x| has no series at 0").to_string();
    assert!(error.contains("|x|"), "{error}");
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
    let found = orbit(&case, begin, Pair::from_f64(1.0), Precision::Float);
    assert!(matches!(found, Err(FlowError::BehindConstraint { .. })), "(ω,e) < 0");
}

fn request(case: &Case, starts: &[[f64; 2]], crossings: usize) -> SectionRequest {
    let plan = case.section.as_ref().expect("a [section]");
    SectionRequest {
        g0: plan.g0.clone(),
        energy: plan.energy.clone(),
        direction: plan.direction,
        crossings,
        skip: 0,
        starts: starts.to_vec(),
        backwards: false,
        seed: 1,
        index: 0,
    }
}

#[test]
fn sections_do_not_depend_on_threads_and_lie_on_level_lines() {
    let case = catalogue("figures/fig-3.toml");
    let mut starts = spread(20);
    starts.push([1.0, 1.5]);
    let request = request(&case, &starts, 40);
    let one = section(&case, &request, 1, &|| ()).expect("a section");
    let three = section(&case, &request, 3, &|| ()).expect("a section");
    let bits = |orbits: &[SectionOrbit]| -> Vec<u64> {
        let crossings = orbits.iter().flat_map(|orbit| &orbit.crossings);
        crossings.flat_map(|c| c.at.map(f64::to_bits)).collect()
    };
    assert_eq!(bits(&one), bits(&three), "byte for byte");
    assert!(matches!(one[20].problem, Some(FlowError::OffSphere { .. })), "|L/G| > 1 is told");
    for orbit in &one[..20] {
        assert_eq!(orbit.crossings.len(), 40, "each orbit has its crossings");
        assert!(orbit.drift < 1e-14, "energy: {:e}", orbit.drift);
    }
    // F2 is the same at all crossings of an orbit: return the crossings to the section.
    let crossings: Vec<[f64; 2]> =
        one[..4].iter().flat_map(|o| &o.crossings).map(|c| c.at).collect();
    let again = SectionRequest { starts: crossings, ..request };
    let values = values_at_starts(&case, &again, "F2").expect("a claim of the case");
    for orbit in values.chunks(40) {
        let spread = orbit.iter().fold(0f64, |worst, x| worst.max((x / orbit[0] - 1.0).abs()));
        assert!(spread < 1e-12, "a level line of F2: {spread:e}");
    }
}

#[test]
fn the_strange_attractor_fills_the_left_half() {
    let case = catalogue("figures/fig-8.toml");
    let mut request = request(&case, &[[1.26685, -0.04083]], 2000);
    request.skip = 1500;
    request.crossings = 500;
    let orbits = section(&case, &request, 1, &|| ()).expect("a section");
    let range = orbits[0].crossings.iter().map(|c| c.at[0]);
    let (low, high) = range.fold((f64::MAX, f64::MIN), |(a, b), l| (a.min(l), b.max(l)));
    assert!(low > 0.3 && high < 3.0, "0.4 < l < 2.9: {low}, {high}");
}

#[test]
fn fixed_points_have_the_multipliers_of_the_figures() {
    let check = |file: &str, near: [f64; 2], at: [f64; 2], time: f64, product: f64| {
        let case = catalogue(file);
        let plan = case.section.as_ref().expect("a [section]");
        let map = SectionMap::new(&case, &plan.g0, &plan.energy, 1).expect("a map");
        let found = map.periodic(near, 1).expect("it converges");
        for k in 0..2 {
            assert!((found.at[k] - at[k]).abs() < 1e-9, "{file}: {:?} and {at:?}", found.at);
        }
        assert!((found.time - time).abs() < 2e-9, "{file}: returns after {}", found.time);
        assert!((found.determinant - product).abs() < 1e-7, "{file}: {}", found.determinant);
        found.multipliers()
    };
    let half = std::f64::consts::FRAC_PI_2;
    let found = check("figures/fig-3.toml", [1.5, 0.02], [half, 0.0], 4.442882938, 1.0);
    let Multipliers::Complex { argument, .. } = found else { panic!("elliptic") };
    assert!((argument - 0.400072).abs() < 2e-6, "argument {argument}");
    let found = check("figures/fig-3.toml", [3.1, 0.02], [2.0 * half, 0.0], 4.659734937, 1.0);
    let Multipliers::Real(larger, _) = found else { panic!("hyperbolic") };
    assert!((larger - 1.33154584).abs() < 1e-7, "multiplier {larger}");
    let sink = [3.359081287460, 0.324121776845];
    let modulus: f64 = 0.99000342;
    let found = check("figures/fig-8.toml", [3.36, 0.32], sink, 3.197991923, modulus * modulus);
    let Multipliers::Complex { argument, .. } = found else { panic!("a sink that turns") };
    assert!((argument - 0.715269).abs() < 2e-6, "argument {argument}");
}

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

/// Makes an axis of a plane of starts in figure 14, or of parameters.
fn axis(coordinate: Coordinate, from: f64, to: f64, count: usize) -> Axis {
    let read = |value| Rational::from_f64(value).expect("finite");
    Axis { coordinate, from: read(from), to: read(to), count }
}

#[test]
fn a_chart_agrees_with_the_exact_exponents_and_does_not_depend_on_threads() {
    let case = catalogue("figures/fig-14.toml");
    let plan = case.section.as_ref().expect("a [section]");
    let (g0, energy) = (plan.g0.clone(), plan.energy.clone());
    let launch = Launch::Section { g0: g0.clone(), energy: energy.clone(), at: [0.0, 0.0] };
    let axes = [axis(Coordinate::L, 0.2, 5.0, 3), axis(Coordinate::Z, -0.8, 1.2, 3)];
    let request = PlaneRequest { axes, launch, time: 400.0, seed: 1 };
    let found = plane(&case, &request, 1, &|| ()).expect("a plane");
    let again = plane(&case, &request, 3, &|| ()).expect("a plane");
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
    let found = plane(&case, &request, 2, &|| ()).expect("a plane");
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
fn the_area_form_of_a_true_density_is_kept_and_that_of_a_wrong_one_is_not() {
    let path = std::path::Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
        .join("cases/figures/fig-14.toml");
    let text = std::fs::read_to_string(path).expect("a case");
    let wrong = format!("{text}\n[[claim]]\nname = \"wrong\"\ndensity = \"1 + γ1²\"\n");
    let case = parse(&wrong);
    let request = request(&case, &spread(6), 1);
    let areas = area_forms(&case, &request).expect("a section");
    let (last, true_ones) = areas.split_last().expect("two at least");
    assert!(!true_ones.is_empty(), "the claim of the case");
    for area in true_ones {
        assert!(area.points == 6 && area.broken.is_none() && area.deviation < 1e-6, "{area:?}");
    }
    assert!(last.broken.is_some() && last.deviation > 1e-2, "{last:?}");
}

#[test]
fn separatrices_of_an_integrable_case_are_level_lines_through_the_saddle() {
    let case = catalogue("figures/fig-3.toml");
    let request = request(&case, &[[3.1, 0.02]], 1);
    let found = separatrices(&case, &request, [3.1, 0.02], 1, 2).expect("a saddle");
    assert_eq!(found.point.kind(), "hyperbolic");
    let crossings = found.unstable.iter().chain(&found.stable).flat_map(|orbit| &orbit.crossings);
    let mut starts = vec![found.point.at];
    starts.extend(crossings.map(|crossing| crossing.at).step_by(97));
    assert!(starts.len() > 100, "the curves have many points: {}", starts.len());
    let far = starts.iter().filter(|at| (at[0] - found.point.at[0]).abs() > 1.0).count();
    assert!(far > 10, "they leave the saddle: {far}");
    let values = values_at_starts(&case, &SectionRequest { starts, ..request.clone() }, "F2");
    let values = values.expect("a claim of the case");
    for value in &values {
        assert!((value / values[0] - 1.0).abs() < 1e-7, "F2 of the saddle: {value}");
    }
    let elliptic = separatrices(&case, &request, [1.5, 0.02], 1, 2);
    assert!(matches!(elliptic, Err(FlowError::NotHyperbolic { .. })), "(π/2, 0) has none");
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
