//! Values at a time of a motion: known solutions lie in their enclosures, and wrong bounds are
//! refuted.

use std::f64::consts::{E, PI};

use liouville::case::Case;
use liouville::verdict::{ClaimReport, Method, Options, Verdict};
use liouville_flow::observe::observe;

fn judged(text: &str) -> ClaimReport {
    let case = Case::parse(text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    observe(&case, &Options::default()).remove(0)
}

fn claim(field: &str, rest: &str) -> ClaimReport {
    judged(&format!("title = \"x\"\n{field}\n[[claim]]\n{rest}\n"))
}

const GROWTH: &str = "[state]\nx = \"-9..9\"\n[field]\n\"x'\" = \"x\"";
const OSCILLATOR: &str =
    "[state]\nx = \"-9..9\"\ny = \"-9..9\"\n[field]\n\"x'\" = \"y\"\n\"y'\" = \"−x\"";
const LOGISTIC: &str = "[state]\nx = \"0..1\"\n[field]\n\"x'\" = \"x*(1 − x)\"";
const TOP: &str = "[parameters]\nA = [\"1/2\", \"1\", \"3\"]\n[state]\nM = \"vector(3, -1..1)\"\n\
                   [level]\nequations = [\"(M,M) = 1\"]\n[field]\n\"M'\" = \"M × (A*M)\"";

#[test]
fn known_solutions_lie_in_their_enclosures() {
    let mut seed: u64 = 7;
    let mut random = || {
        seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (seed >> 11) as f64 / (1u64 << 53) as f64
    };
    for _ in 0..40 {
        let (time, x, y) = (0.1 + 9.0 * random(), 2.0 * random() - 1.0, 2.0 * random() - 1.0);
        let cases = [
            (GROWTH, format!("{{ x = \"{x}\" }}"), x * time.exp()),
            (
                OSCILLATOR,
                format!("{{ x = \"{x}\", y = \"{y}\" }}"),
                x * time.cos() + y * time.sin(),
            ),
            (
                LOGISTIC,
                format!("{{ x = \"{}\" }}", x * x),
                1.0 / (1.0 + (1.0 / (x * x) - 1.0) * (-time).exp()),
            ),
        ];
        for (field, state, known) in cases {
            let found = claim(
                field,
                &format!("reaches = \"x\"\nabove = \"−1e9\"\nstate = {state}\ntime = \"{time}\""),
            );
            assert_eq!(found.verdict, Verdict::Proved, "{:?}", found.evidence);
            assert_eq!(found.evidence.method, Method::EnclosedOrbit);
            let value = &found.evidence.measured[0];
            // the known value is rounded as well
            let slack = 1e-13 * (1.0 + known.abs());
            assert!((value.value - known).abs() <= value.error + slack, "{known}: {value:?}");
            assert!(value.error <= 1e-10 * (1.0 + known.abs()), "{known}: {value:?}");
        }
    }
}

#[test]
fn the_typed_time_is_meant_and_not_its_f64() {
    let turn = |bounds: &str| {
        claim(
            OSCILLATOR,
            &format!("reaches = \"y\"\n{bounds}\nstate = {{ x = \"1\" }}\ntime = \"π/2\""),
        )
    };
    let found = turn("above = \"−1 − 1e-12\"\nbelow = \"−1 + 1e-12\"");
    assert_eq!(found.verdict, Verdict::Proved, "{:?}", found.evidence);
    assert_eq!(turn("above = \"−1 + 1e-12\"").verdict, Verdict::Refuted);
    assert_eq!(turn("above = \"−1\"").verdict, Verdict::Undecided, "it is −1");
    let value = turn("above = \"−2\"").evidence.measured[0].clone();
    assert!((value.value + (PI / 2.0).sin()).abs() <= value.error, "{value:?}");
}

#[test]
fn bounds_are_proved_or_refuted() {
    let grown = |bounds: &str, time: &str| {
        claim(
            GROWTH,
            &format!("reaches = \"x\"\n{bounds}\nstate = {{ x = \"1\" }}\ntime = \"{time}\""),
        )
    };
    assert_eq!(
        grown("above = \"2.718281828459\"\nbelow = \"e\"", "0.999999").verdict,
        Verdict::Refuted
    );
    assert_eq!(
        grown("above = \"2.7182818284\"\nbelow = \"2.7182818285\"", "1").verdict,
        Verdict::Proved
    );
    assert_eq!(grown("below = \"e\"", "1").verdict, Verdict::Undecided, "it is e");
    let value = grown("above = \"0\"", "1").evidence.measured[0].clone();
    assert!((value.value - E).abs() <= value.error, "{value:?}");
}

#[test]
fn a_state_on_a_level_is_exact() {
    let top = |state: &str| {
        claim(
            TOP,
            &format!(
                "reaches = \"(M,M)\"\nabove = \"1 − 1e-10\"\nbelow = \"1 + 1e-10\"\nstate = {{ M = \"{state}\" }}\ntime = 20"
            ),
        )
    };
    let found = top("[3/5, 0, 4/5]");
    assert_eq!(found.verdict, Verdict::Proved, "{:?}", found.evidence);
    for (state, reason) in
        [("[0.6, 0.1, 0.8]", "violates (M,M) = 1"), ("[√2/2, √2/2, 0]", "give rational numbers")]
    {
        let found = top(state);
        assert_eq!(found.verdict, Verdict::Undecided, "{state}");
        let told = found.evidence.reason.unwrap_or_default();
        assert!(told.contains(reason), "{state}: {told}");
    }
}

#[test]
fn what_cannot_be_enclosed_is_undecided() {
    // x = 1/(1 − t) ends at t = 1
    let pole = claim(
        "[state]\nx = \"-9..9\"\n[field]\n\"x'\" = \"x²\"",
        "reaches = \"x\"\nabove = \"0\"\nstate = { x = \"1\" }\ntime = 2",
    );
    assert_eq!(pole.verdict, Verdict::Undecided, "{:?}", pole.evidence);
    let ranges = claim(
        "[parameters]\nk = \"1..2\"\n[state]\nx = \"-9..9\"\n[field]\n\"x'\" = \"k*x\"",
        "reaches = \"x\"\nabove = \"0\"\nstate = { x = \"1\" }\ntime = 2",
    );
    let told = ranges.evidence.reason.unwrap_or_default();
    assert!(told.contains("some parameters have ranges"), "{told}");
}

#[test]
fn chaos_widens_the_box_until_nothing_is_said() {
    let lorenz = "[state]\nx = \"-30..30\"\ny = \"-30..30\"\nz = \"0..60\"\n[field]\n\
                  \"x'\" = \"10*(y − x)\"\n\"y'\" = \"x*(28 − z) − y\"\n\"z'\" = \"x*y − 8*z/3\"";
    let at = |time: u32| {
        claim(
            lorenz,
            &format!(
                "reaches = \"z\"\nabove = \"0\"\nstate = {{ x = \"1\", y = \"1\", z = \"20\" }}\ntime = {time}"
            ),
        )
    };
    let near = at(10);
    assert_eq!(near.verdict, Verdict::Proved, "{:?}", near.evidence);
    assert_eq!(at(60).verdict, Verdict::Undecided);
}

#[test]
#[ignore = "slow: `reaches` of smaller systems is proved above"]
fn the_rattleback_turns_back_one_way() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../cases/spin/rattleback-reversal.toml");
    let case = Case::read(std::path::Path::new(path), &[]).1.expect("a case");
    let claims = observe(&case, &Options::default());
    assert_eq!(claims.len(), 4, "all are about the motion");
    for claim in claims {
        assert!(claim.agrees, "{}: {:?}", claim.name, claim.evidence);
        println!("{}: {:?}", claim.name, claim.evidence.measured);
    }
}

#[test]
fn no_motion_goes_on_where_the_field_as_written_has_no_value() {
    let fields = [
        "1 + 0*log(2 − x)",
        "1 + 0/(x − 2)",
        "1 + (x − x)*log(2 − x)",
        "cos(x)/cos(x)",
        "[1, sqrt(2 − x)][1]",
        "1 + asin(x/2) − asin(x/2)",
        "sqrt(2 − x)/sqrt(2 − x)",
        "1/(1/(x − 2))*(1/(x − 2))",
    ];
    for field in fields {
        let text = format!("[state]\nx = \"0..4\"\n[field]\n\"x'\" = \"{field}\"");
        for (time, is_reached) in [("1/2", true), ("3", false)] {
            let found = claim(
                &text,
                &format!(
                    "reaches = \"x\"\nstate = {{ x = \"1/2\" }}\ntime = \"{time}\"\nabove = \"{time}\""
                ),
            );
            let expected = if is_reached { Verdict::Proved } else { Verdict::Undecided };
            assert_eq!(found.verdict, expected, "{field}, t = {time}: {:?}", found.evidence);
        }
    }
}

#[test]
fn a_function_without_a_value_at_the_end_is_not_reached() {
    for function in
        ["sqrt(−x)^2 + 9", "exp(log(−x)) + 9", "0*log(−x) + 9", "9 + sqrt(−x) − sqrt(−x)"]
    {
        let rest =
            format!("reaches = \"{function}\"\nstate = {{ x = \"1\" }}\ntime = 1\nabove = \"0\"");
        let found = claim(GROWTH, &rest);
        assert_eq!(found.verdict, Verdict::Undecided, "{function}: {:?}", found.evidence);
        let there = rest.replace("x = \"1\"", "x = \"−1\"");
        assert_eq!(claim(GROWTH, &there).verdict, Verdict::Proved, "{function}");
    }
}

#[test]
fn bounds_without_a_value_are_not_compared() {
    let bounded = |bound: &str| {
        let rest = "state = { x = \"1\" }\ntime = 1";
        claim(GROWTH, &format!("reaches = \"x\"\n{bound}\n{rest}"))
    };
    for bound in ["0*sqrt(x − 5)", "(x − e)/(x − e)", "log(x − 5) − log(x − 5)"] {
        for side in ["above", "below"] {
            let found = bounded(&format!("{side} = \"{bound}\""));
            assert_eq!(found.verdict, Verdict::Undecided, "{side} {bound}: {:?}", found.evidence);
            let reason = found.evidence.reason.unwrap_or_default();
            assert!(reason.contains("may have no value"), "{bound}: {reason}");
        }
    }
    assert_eq!(bounded("above = \"0*sqrt(x + 5)\"").verdict, Verdict::Proved, "it has a value");
}

#[test]
fn a_field_whose_terms_cancel_is_enclosed_by_shorter_steps() {
    // The circle about (3, 0), multiplied out: x = 3 + cos t.
    let field = "[state]\nx = \"1..5\"\ny = \"-2..2\"\n[field]\n\
                 \"x'\" = \"-x^3 + 9*x^2 - x*y^2 - 26*x + 3*y^2 - y + 24\"\n\
                 \"y'\" = \"-x^2*y + 6*x*y + x - y^3 - 8*y - 3\"";
    let rest = "reaches = \"x\"\nabove = 3.5403023\nbelow = 3.5403024\n\
                state = { x = \"4\", y = \"0\" }\ntime = 1";
    let found = claim(field, rest);
    assert_eq!(found.verdict, Verdict::Proved, "{:?}", found.evidence.reason);
}

#[test]
fn a_state_on_the_other_half_of_a_level_is_refused() {
    let of = |state: &str| {
        let text = format!(
            "title = 'x'\n[state]\nQ = 'rotation'\n'ω' = 'vector(-2..2)'\n[field]\n\"Q'\" = 'Q*hat(ω)'\n\
             \"ω'\" = '[0, 0, 0]'\n[[claim]]\nreaches = 'det(Q)'\nabove = '0.9'\n\
             state = {{ Q = '{state}', 'ω' = '[0, 0, 1]' }}\ntime = 1\n"
        );
        judged(&text)
    };
    assert_eq!(of("diag(1, 1, 1)").verdict, Verdict::Proved);
    let found = of("diag(−1, 1, 1)");
    assert_eq!(found.verdict, Verdict::Undecided);
    assert!(found.evidence.reason.is_some_and(|own| own.contains("violates det(Q) = 1")));
}
