//! Motions in lanes: bit for bit those of single motions, whatever their number.

use std::fmt::Write;

use liouville::case::{Case, Direction};
use liouville::mechanics::ParameterOrigin;
use liouville::number::rational::Rational;
use liouville_flow::{
    Columns, CrossingSurface, FlowError, Lexicon, Start, SurfaceOrbit, SurfaceRequest, Variational,
    surface_section,
};

use crate::integration::{BALL, catalogue, parse};

/// Numbers of motions: alone, fewer than lanes, as many, more, and two refills and one.
const COUNTS: [usize; 5] = [1, 3, 8, 9, 17];

const ROESSLER: &str = r#"
title = "a band"
system = "field"
check-weights = false
[state]
x = "1..5"
y = "-4..-1"
z = "0..1/2"
[field]
"x'" = "−y − z"
"y'" = "x + 0.2*y"
"z'" = "0.2 + z*(x − 5.7)"
"#;

/// Oscillations that grow until they leave the well, each start after other times, and then run to
/// infinity in finite time.
const LEAVING: &str = r#"
title = "a leaking well"
system = "field"
check-weights = false
[state]
x = "-0.6..0.6"
v = "-0.5..0.5"
[field]
"x'" = "v"
"v'" = "x³ − x + v/20"
"#;

const DOUBLE_PENDULUM: &str = r#"
title = "double pendulum"
system = "nonholonomic"
check-weights = false
[state]
"α"  = "-2..2"
"β"  = "-2..2"
"α'" = "-2..2"
"β'" = "-2..2"
[lagrangian]
kinetic     = "α'² + β'²/2 + α'*β'*cos(α − β)"
potential   = "−2*cos(α) − cos(β)"
constraints = []
"#;

fn crossed(
    case: &Case,
    (surface, axes): (&str, &str),
    starts: &[Result<Start, FlowError>],
    crossings: usize,
    threads: usize,
) -> Vec<SurfaceOrbit> {
    let surface = CrossingSurface::read(Lexicon::new(case), surface).expect("a surface");
    let axes = Columns::read(Lexicon::new(case), axes).expect("axes");
    let request = SurfaceRequest {
        surface: &surface,
        axes: &axes,
        direction: Direction::Up,
        crossings,
        skip: 1,
        backwards: false,
    };
    surface_section(case, &request, starts, threads, &|_| ()).expect("a section")
}

/// All that is known of an orbit, with the bits of its numbers.
fn bits(orbit: &SurfaceOrbit) -> String {
    let mut text = format!("{} {} {}", orbit.steps, orbit.others, orbit.tangencies);
    for crossing in &orbit.crossings {
        let numbers = crossing.at.iter().chain([&crossing.time]).map(|x| x.to_bits());
        write!(text, "\n{:x?} {}", numbers.collect::<Vec<_>>(), crossing.rising).expect("memory");
    }
    let drift = orbit.drift.map(f64::to_bits);
    write!(text, "\n{drift:?} {:?}", orbit.problem).expect("memory");
    text
}

fn starts(case: &Case, count: usize) -> Vec<Result<Start, FlowError>> {
    (0..count)
        .map(|index| {
            // Another draw of the state, with the parameters of the first one.
            let first = Start::new(case, None, 1, 0)?;
            let drawn = Start::new(case, None, 1, index as u64)?;
            Ok(Start { parameters: first.parameters, ..drawn })
        })
        .collect()
}

#[test]
fn sections_do_not_show_the_lanes() {
    let ball = parse(BALL);
    let band = parse(ROESSLER);
    let well = parse(LEAVING);
    let pendulum = parse(DOUBLE_PENDULUM);
    // A motion has left the well before so many crossings.
    for (case, surface, crossings, fails) in [
        (&ball, ("γ3 = 0", "γ1, ω3"), 4, false),
        (&band, ("y = x/3", "x, z"), 4, false),
        (&well, ("v = 0", "x"), 25, true),
        (&pendulum, ("α = β", "β, β'"), 4, false),
    ] {
        let mut starts = starts(case, COUNTS[4]);
        // One does not start at all.
        starts[5] = Err(FlowError::NoStart);
        let alone: Vec<String> = starts
            .iter()
            .map(|start| {
                // Two are followed one by one; a start that fails needs another beside it.
                let pair = [starts[0].clone(), start.clone()];
                crossed(case, surface, &pair, crossings, 1).swap_remove(1)
            })
            .map(|orbit| {
                let failed = matches!(
                    orbit.problem,
                    Some(FlowError::Singular { .. } | FlowError::RunsAway { .. })
                );
                let is_absent = orbit.problem == Some(FlowError::NoStart);
                assert!(failed == fails || is_absent, "{}: {:?}", case.title, orbit.problem);
                let met = orbit.crossings.len();
                // A double pendulum need not cross at all.
                let is_full = met == crossings || surface.0 == "α = β";
                assert!(is_absent || failed || is_full, "{}: {met} crossings", case.title);
                bits(&orbit)
            })
            .collect();
        for (count, threads) in COUNTS.into_iter().zip([1, 3].into_iter().cycle()) {
            let found = crossed(case, surface, &starts[..count], crossings, threads);
            let found: Vec<String> = found.iter().map(bits).collect();
            let differs = (0..count).find(|index| found[*index] != alone[*index]);
            assert_eq!(differs, None, "{}: {count} motions, {threads} threads", case.title);
        }
        let distinct = alone.iter().collect::<std::collections::BTreeSet<_>>().len();
        assert_eq!(distinct, alone.len(), "{}: each start has an orbit of its own", case.title);
    }
}

#[test]
fn orbits_that_leave_have_crossings_before() {
    let well = parse(LEAVING);
    let found = crossed(&well, ("v = 0", "x"), &starts(&well, 17), 25, 1);
    let met: Vec<usize> = found.iter().map(|orbit| orbit.crossings.len()).collect();
    let (least, most) = (met.iter().min(), met.iter().max());
    assert!(most > Some(&3) && least < most, "lanes end at different times: {met:?}");
}

#[test]
fn exponents_do_not_show_the_lanes() {
    let figure = catalogue("figures/fig-8.toml");
    let band = parse(ROESSLER);
    for case in [&figure, &band] {
        assert!(
            case.model.parameters.iter().all(|own| matches!(own.origin, ParameterOrigin::Fixed(_)))
        );
        let starts = starts(case, 9);
        let parameters: Vec<Rational> = Vec::new();
        let measured = |starts: &[Result<Start, FlowError>], threads| {
            let motions = Variational::all(&case.model, &parameters, starts).expect("equations");
            let found = motions.all_exponents(20.0, threads, &|_| ());
            found.into_iter().map(|one| format!("{one:?}")).collect::<Vec<_>>()
        };
        let alone: Vec<String> =
            starts.iter().flat_map(|start| measured(std::slice::from_ref(start), 1)).collect();
        assert!(alone.iter().all(|one| one.starts_with("Ok")), "{alone:?}");
        for (count, threads) in [(3, 1), (8, 1), (9, 2)] {
            assert_eq!(measured(&starts[..count], threads), alone[..count], "{}", case.title);
        }
    }
}
