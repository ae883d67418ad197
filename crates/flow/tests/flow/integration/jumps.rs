//! Pulses, walls and poles within what would be one step.

use liouville::case::{Case, Direction};
use liouville::number::double_double::DoubleDouble;
use liouville_flow::{
    Columns, CrossingSurface, FlowError, Lexicon, Orbit, Precision, SurfaceRequest, orbit,
    surface_section,
};

use crate::integration::{parse, start};

const BOTH: [Precision; 2] = [Precision::Float, Precision::Pair];

/// A case of these rates of x, y, ….
fn field(rates: &[(&str, &str)]) -> Case {
    let state: String = rates.iter().map(|(name, _)| format!("{name} = '-50..50'\n")).collect();
    let field: String =
        rates.iter().map(|(name, rate)| format!("\"{name}'\" = '{rate}'\n")).collect();
    parse(&format!("title = 'a'\n[state]\n{state}[field]\n{field}"))
}

fn followed(case: &Case, begin: &str, time: f64, precision: Precision) -> Result<Orbit, FlowError> {
    orbit(case, start(case, begin), DoubleDouble::from_f64(time), precision)
}

/// Checks the end of a motion to some digits.
fn ends_at(rates: &[(&str, &str)], begin: &str, time: f64, end: &[f64], error: f64) {
    let case = field(rates);
    for precision in BOTH {
        let found = followed(&case, begin, time, precision);
        let found = found.unwrap_or_else(|problem| panic!("{rates:?}, {precision:?}: {problem}"));
        for (x, expected) in found.end.iter().zip(end) {
            let gap = (x.hi - expected).abs();
            assert!(gap < error, "{rates:?}, {precision:?}: {:?}, not {end:?}", found.end);
        }
    }
}

#[test]
fn a_pulse_is_felt_that_is_far_below_rounding_at_the_start() {
    // √π e^(−1/4) sin(t − 10) after the pulse
    let pulse = [("x", "p"), ("p", "-x + exp(-(t - 10)^2)"), ("t", "1")];
    let size = std::f64::consts::PI.sqrt() * (-0.25f64).exp();
    let end = [size * 10f64.sin(), size * 10f64.cos(), 20.0];
    ends_at(&pulse, "x=0 p=0 t=0", 20.0, &end, 1e-12);
    ends_at(&pulse, "x=0 p=0 t=-20", 40.0, &end, 1e-12);
    // the same from an equation of its own
    let own = [("x", "p"), ("p", "-x + z"), ("z", "-2*(t - 10)*z"), ("t", "1")];
    let begin = "x=0 p=0 z=3.720075976e-44 t=0";
    ends_at(&own, begin, 20.0, &end[..2], 1e-4);
}

#[test]
fn walls_and_barriers_reflect() {
    let barrier = [("q", "p"), ("p", "2*q*exp(-q^2)")];
    for precision in BOTH {
        let found = followed(&field(&barrier), "q=-10 p=1", 40.0, precision).expect("a motion");
        let [q, p] = [found.end[0].hi, found.end[1].hi];
        assert!(q < -10.0 && (p + 1.0).abs() < 1e-12, "{precision:?}: {q}, {p}");
    }
    // x = ln cosh(20 (t − t₀))/20 − ln(20)/40
    let wall = [("x", "v"), ("v", "exp(-40*x)")];
    let end = [15.0 - 20f64.ln() / 20.0 - 2f64.ln() / 10.0, 1.0];
    ends_at(&wall, "x=5 v=-1", 20.0, &end, 1e-11);
    // a wall of a power beyond the order of the series, and one behind a gap in the series
    for (force, weight, power) in [("-x - 39*x^39", 1.95, 40), ("-x^7", 0.25, 8)] {
        let energy = |state: &[DoubleDouble]| {
            let [x, v] = [state[0].hi, state[1].hi];
            v * v + weight * x.powi(power) + if power == 40 { x * x } else { 0.0 }
        };
        let case = field(&[("x", "v"), ("v", force)]);
        for precision in BOTH {
            for begin in ["x=0 v=6/5", "x=1/1000 v=6/5"] {
                let found = followed(&case, begin, 10.0, precision).expect("a motion");
                let drift = energy(&found.end) - energy(&found.start.state);
                assert!(drift.abs() < 1e-12, "{force}, {precision:?}: {drift:e}");
            }
        }
    }
}

#[test]
fn a_narrow_bump_on_a_cycle_is_met_at_each_turn() {
    let bump = [
        ("x", "-y + x*(1 - x^2 - y^2)"),
        ("y", "x + y*(1 - x^2 - y^2)"),
        ("z", "-z + exp(-1000*x^2)"),
    ];
    // the state of the cycle at x = 1, by quadrature
    let turn = std::f64::consts::TAU;
    ends_at(&bump, "x=1 y=0 z=0.012183983", turn, &[1.0, 0.0, 0.012183983], 1e-8);
    ends_at(&bump, "x=1 y=0 z=1/10", 6.0 * turn, &[1.0, 0.0, 0.012183983], 1e-8);
}

#[test]
fn a_narrow_function_of_a_section_is_crossed_each_time() {
    let case = field(&[("x", "y"), ("y", "-x")]);
    for (steep, width) in [(1000.0, (2f64.ln() / 1000.0).sqrt()), (1e5, (2f64.ln() / 1e5).sqrt())] {
        let lexicon = || Lexicon::new(&case);
        let text = format!("exp(-{steep}*x^2) = 1/2");
        let surface = CrossingSurface::read(lexicon(), &text).expect("a surface");
        let axes = Columns::read(lexicon(), "x").expect("axes");
        let request = SurfaceRequest {
            surface: &surface,
            axes: &axes,
            direction: Direction::Both,
            crossings: 12,
            skip: 0,
            backwards: false,
        };
        let starts = [Ok(start(&case, "x=1 y=0"))];
        let found = surface_section(&case, &request, &starts, 1, &|_| ()).expect("a section");
        assert_eq!(found[0].crossings.len(), 12, "{:?}", found[0].problem);
        for (k, crossing) in found[0].crossings.iter().enumerate() {
            let side = if k % 2 == 0 { width } else { -width };
            let middle = std::f64::consts::FRAC_PI_2 + std::f64::consts::PI * (k / 2) as f64;
            let expected = middle - side.asin();
            assert!((crossing.time - expected).abs() < 1e-10, "{k}: {crossing:?}, not {expected}");
        }
    }
}

#[test]
fn functions_without_poles_end_no_motion() {
    let case = parse(
        "title = 'a'\n[state]\nq = '-20..20'\np = '-2..2'\n[hamiltonian]\nfunction = 'p^2/2 + 1/cosh(q)^2'\n\
         pairs = [['q', 'p']]\n",
    );
    for precision in BOTH {
        for begin in [-20, -40, -12] {
            let found = followed(&case, &format!("q={begin} p=1"), 100.0, precision);
            let end = found.expect("a motion").end;
            let speed = (1.0 + 2.0 / f64::from(begin).cosh().powi(2)).sqrt();
            assert!((end[1].hi + speed).abs() < 1e-12, "{begin}: reflected, {end:?}");
        }
    }
    ends_at(&[("q", "-1 + 1/(1 + exp(q))")], "q=40", 20.0, &[20.0], 1e-7);
    ends_at(&[("q", "-1 + 1/(1 + q^2)^20")], "q=100", 90.0, &[10.0], 1e-10);
}

#[test]
fn poles_and_logarithms_end_motions_that_come_to_them() {
    for (rates, begin, end) in [
        (vec![("x", "1"), ("y", "2*x"), ("z", "1/y")], "x=-1 y=1 z=0", 1.0),
        (vec![("x", "1"), ("y", "log(x^2)")], "x=-1 y=1", 1.0),
        (vec![("x", "1"), ("y", "x*log(x^2)")], "x=-1 y=1", 1.0),
        (vec![("x", "1"), ("y", "x^4*log(x^2)")], "x=-1 y=1", 1.0),
    ] {
        let case = field(&rates);
        for precision in BOTH {
            match followed(&case, begin, 2.0 * end, precision) {
                Err(FlowError::Singular { time, .. } | FlowError::NoValue { time, .. }) => {
                    assert!((time - end).abs() < 1e-6, "{rates:?}: {time}");
                }
                other => panic!("{rates:?}, {precision:?}: {:?}", other.map(|orbit| orbit.end)),
            }
            assert!(followed(&case, begin, 0.9 * end, precision).is_ok(), "{rates:?}");
        }
    }
}

#[test]
fn a_function_that_only_overflows_is_no_singularity() {
    let case = field(&[("x", "v"), ("v", "-x - tanh(1000*v)/10")]);
    let found = followed(&case, "x=1 v=0", 1.0, Precision::Float);
    assert!(!matches!(found, Err(FlowError::Singular { .. })), "{found:?}");
}
