//! Sections: orbits, fixed points, area forms, separatrices.

use liouville::case::{Case, Direction};
use liouville_flow::{
    Columns, CrossingSurface, FlowError, Lexicon, Multipliers, SectionMap, SectionOrbit,
    SectionRequest, SurfaceOrbit, SurfaceRequest, area_forms, section, separatrices, spread,
    surface_section, values_at_starts,
};

use crate::integration::{catalogue, parse, start};

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
    let one = section(&case, &request, 1, &|_| ()).expect("a section");
    let three = section(&case, &request, 3, &|_| ()).expect("a section");
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
    let orbits = section(&case, &request, 1, &|_| ()).expect("a section");
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

/// Crossings of a surface from a state, with the values of some columns.
fn through(case: &Case, state: &str, surface: &str, axes: &str, crossings: usize) -> SurfaceOrbit {
    let surface = CrossingSurface::read(Lexicon::new(case), surface).expect("a surface");
    let axes = Columns::read(Lexicon::new(case), axes).expect("axes");
    let direction = Direction::Both;
    let request = SurfaceRequest {
        surface: &surface,
        axes: &axes,
        direction,
        crossings,
        skip: 0,
        backwards: false,
    };
    let starts = [Ok(start(case, state))];
    let mut found = surface_section(case, &request, &starts, 1, &|_| ()).expect("a section");
    found.remove(0)
}

#[test]
fn surfaces_that_vary_faster_than_the_motion_are_crossed_at_the_right_times() {
    let turn = parse(
        "title = 'a'\n[state]\nx = '-2..2'\nv = '-2..2'\n[field]\n\"x'\" = 'v'\n\"v'\" = '-x'\n",
    );
    // x = cos t
    let power = through(&turn, "x=1 v=0", "x^9 = 0.001", "x^9", 6);
    assert!((power.crossings[0].time - libm::acos(libm::pow(0.001, 1.0 / 9.0))).abs() < 1e-9);
    assert!(power.crossings.iter().all(|met| (met.at[0] - 1e-3).abs() < 1e-12), "{power:?}");
    let exponential = through(&turn, "x=1 v=0", "exp(5*x) = 2", "x", 4);
    let first = libm::acos(libm::log(2.0) / 5.0);
    assert!((exponential.crossings[0].time - first).abs() < 1e-12, "{exponential:?}");
    let fast = through(&turn, "x=1 v=0", "sin(20*x) = 0", "x", 26);
    // cos t = kπ/20 for k = 6, 5, …, -6 and back
    for (place, met) in fast.crossings.iter().enumerate().take(13) {
        let x = std::f64::consts::PI * (6.0 - place as f64) / 20.0;
        assert!((met.time - libm::acos(x)).abs() < 1e-11, "{place}: {met:?}");
    }
    assert_eq!(fast.crossings.len(), 26);
    let clock = parse("title = 'a'\n[state]\na = '-2..2'\n[field]\n\"a'\" = '1'\n");
    let even = through(&clock, "a=0.1", "sin(7*a) = 0", "a", 60);
    for (k, met) in even.crossings.iter().enumerate() {
        let a = std::f64::consts::PI * (k as f64 + 1.0) / 7.0;
        assert!((met.at[0] - a).abs() < 1e-12, "{k}: {met:?}");
    }
}

#[test]
fn motions_that_are_polynomials_of_time_cross_surfaces() {
    let fall = parse(
        "title = 'a'\n[state]\nx = '-2..2'\nv = '-2..2'\n[field]\n\"x'\" = 'v'\n\"v'\" = '-1'\n",
    );
    let ground = through(&fall, "x=-1 v=2", "x = 0", "x, v", 2);
    let times: Vec<f64> = ground.crossings.iter().map(|met| met.time).collect();
    assert_eq!(times.len(), 2, "{ground:?}");
    assert!((times[0] - (2.0 - 2f64.sqrt())).abs() < 1e-12, "{times:?}");
    assert!((times[1] - (2.0 + 2f64.sqrt())).abs() < 1e-12, "{times:?}");
    for (surface, time) in [("v = 0", 2.0), ("x = -3", 2.0 + 8f64.sqrt())] {
        let met = &through(&fall, "x=-1 v=2", surface, "x", 1).crossings[0];
        assert!((met.time - time).abs() < 1e-12, "{surface}: {met:?}");
    }
}

#[test]
fn crossings_are_counted_once_where_operands_cancel() {
    let case = parse(
        "title = 'a'\n[state]\nx = '-2..2'\ny = '-2..2'\n[field]\n\"x'\" = 'y'\n\"y'\" = '-x'\n",
    );
    // x = 0.3, known to some 0.01: steps of the motion end within that of the surface now and then
    let text = "(x + 1e14)^2 = (1e14 + 0.3)^2";
    let surface = CrossingSurface::read(Lexicon::new(&case), text).expect("a surface");
    let axes = Columns::read(Lexicon::new(&case), "x, y").expect("axes");
    let request = SurfaceRequest {
        surface: &surface,
        axes: &axes,
        direction: Direction::Both,
        crossings: 3000,
        skip: 0,
        backwards: false,
    };
    let begin = start(&case, "x=1 y=0");
    let found = surface_section(&case, &request, &[Ok(begin)], 1, &|_| ()).expect("a section");
    let crossings = &found[0].crossings;
    assert_eq!(crossings.len(), 3000);
    for pair in crossings.windows(2) {
        let [earlier, later] = pair else { continue };
        let between = later.time - earlier.time;
        assert!(earlier.rising != later.rising, "up and down in turn: {pair:?}");
        assert!((2.4..3.9).contains(&between), "{pair:?}");
    }
}
