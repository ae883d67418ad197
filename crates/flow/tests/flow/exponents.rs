//! Claims about exponents and mean divergences, of systems whose exponents are known.

use liouville::case::Case;
use liouville::verdict::{ClaimReport, Options, Verdict, read_state};
use liouville_flow::observe::observe;
use liouville_flow::{Character, MapExponents, Precision, Start, iterates, map_exponents};

/// Report on a claim about the motion of a plane field from a start.
fn judged(field: [&str; 2], start: [&str; 2], claim: &str) -> ClaimReport {
    let [[p, q], [x, y]] = [field, start];
    let text = format!(
        "title = \"plane\"\nsystem = \"field\"\n[state]\nx = \"-1..1\"\ny = \"-1..1\"\n\
         [field]\n\"x'\" = \"{p}\"\n\"y'\" = \"{q}\"\n\
         [[claim]]\n{claim}\nstate = {{ x = \"{x}\", y = \"{y}\" }}\n"
    );
    let case = Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{text}: {error}"));
    observe(&case, &Options::default()).pop().expect("a report")
}

/// Verdicts on a positive exponent, and on the exponent 0.
fn signs(field: [&str; 2], start: [&str; 2], time: &str) -> [Verdict; 2] {
    ["positive", "zero"]
        .map(|word| judged(field, start, &format!("exponent = \"{word}\"\ntime = {time}")).verdict)
}

use Verdict::{Confirmed, Refuted, Undecided};

#[test]
fn an_exponent_that_a_run_cannot_see_is_left_open() {
    let slow = ["x/1000", "−y"];
    assert_eq!(signs(slow, ["0", "0"], "1000"), [Undecided; 2], "e^1 in all");
    let claim = "exponent = \"positive\"\ntime = 1000";
    let reason = judged(slow, ["0", "0"], claim).evidence.reason.expect("a reason");
    assert!(reason.contains("above 7.7e-3, and for 1.0e-3 it takes the time 1.0e4"), "{reason}");
    assert_eq!(signs(slow, ["0", "0"], "12000"), [Confirmed, Refuted], "in the time that it takes");
    let below = ["−x/1000", "−y"];
    assert_eq!(signs(below, ["1", "1"], "1000"), [Undecided; 2], "the same below 0");
    assert_eq!(signs(below, ["1", "1"], "12000"), [Refuted; 2], "negative");
}

#[test]
fn exponents_of_linear_systems() {
    assert_eq!(signs(["x", "−y"], ["0", "0"], "100"), [Confirmed, Refuted], "a rest, and a saddle");
    assert_eq!(signs(["x", "−y"], ["0", "1"], "100"), [Confirmed, Refuted], "on its way to it");
    assert_eq!(signs(["−x", "−2*y"], ["1", "1"], "100"), [Refuted; 2], "a sink has none that is 0");
    assert_eq!(signs(["y", "−4*x"], ["1", "0"], "997"), [Undecided, Confirmed], "turns");
    // Rates that are seen to be those of a power: t, whatever the unit of time is.
    for (field, time) in
        [(["y", "0"], "1000"), (["10⁶*y", "0"], "\"1/1000\""), (["y/10⁶", "0"], "1000000000")]
    {
        let found = signs(field, ["0", "1"], time);
        assert_eq!(found, [Undecided, Confirmed], "{field:?}");
    }
}

#[test]
fn a_spiral_that_is_still_on_its_way_has_no_exponent_yet() {
    // Van der Pol's equation from near its rest, which is left slowly: the cycle has the exponent 0.
    let slow = ["y", "(1 − x²)*y/100 − x"];
    let start = ["10^(−12)", "0"];
    assert_eq!(signs(slow, start, "4000"), [Undecided; 2], "e^18, and still near the rest");
    assert_eq!(signs(slow, ["2", "0"], "4000"), [Undecided, Confirmed], "on the cycle");
    let slower = ["y", "(1 − x²)*y/1000 − x"];
    assert_eq!(signs(slower, start, "1000"), [Undecided; 2], "hardly moved");
    // A weak focus that attracts, and one that repels, by rounds of one shape.
    for rate in ["1/1000", "−1/1000"] {
        let focus = [format!("{rate}*x + 3*y"), format!("{rate}*y − x/3")];
        let found = signs(focus.each_ref().map(String::as_str), ["1", "0"], "1000");
        assert_eq!(found[0], Undecided, "{rate}");
        assert_ne!(found[1], Refuted, "{rate}");
    }
}

#[test]
fn values_are_compared_within_what_a_run_shows() {
    let value = |field: [&str; 2], start, value: &str, time: &str| {
        judged(field, start, &format!("exponent = \"positive\"\nvalue = {value}\ntime = {time}"))
    };
    let slow = ["x/1000", "−y"];
    assert_eq!(value(slow, ["0", "0"], "0.005", "1000").verdict, Undecided, "hidden by the time");
    assert_eq!(value(slow, ["0", "0"], "0.05", "1000").verdict, Refuted, "not hidden");
    assert_eq!(value(["x", "−y"], ["0", "0"], "1.00", "100").verdict, Confirmed);
    // The mean rate of a power is not the exponent.
    let shear = value(["y", "0"], ["0", "1"], "0.0026", "1000");
    assert_eq!(shear.verdict, Undecided, "{:?}", shear.evidence);
    assert!(shear.evidence.measured[0].error > 0.002, "{:?}", shear.evidence.measured);
}

#[test]
fn a_mean_divergence_has_a_sign_where_volumes_change_beyond_the_ends() {
    let of = |field: [&str; 2], word: &str, time: &str| {
        judged(field, ["1", "0"], &format!("mean-divergence = \"{word}\"\ntime = {time}")).verdict
    };
    let weak = ["y − x/2000", "−x − y/2000"];
    for word in ["negative", "zero", "positive"] {
        assert_eq!(of(weak, word, "1000"), Undecided, "{word}: e^(-1) in all");
    }
    assert_eq!(of(weak, "negative", "20000"), Confirmed);
    assert_eq!([of(weak, "zero", "20000"), of(weak, "positive", "20000")], [Refuted; 2]);
    // Volume comes and goes with (1 + x²/2), and the mean is 0: that it is negative is left open.
    let turns = ["y*(1 + x²/2)", "−x*(1 + x²/2)"];
    assert_eq!(of(turns, "zero", "1000"), Confirmed);
    assert_eq!(of(turns, "negative", "1000"), Undecided, "0 within its error is no refutation");
}

#[test]
fn numbers_that_are_exact_have_no_error() {
    let read = |claim: &str| {
        let text = format!(
            "title = \"a\"\n[state]\nx = \"-1..1\"\n[field]\n\"x'\" = \"−x\"\n\
             [[claim]]\n{claim}\nstate = {{ x = \"1\" }}\n"
        );
        Case::parse(&text, &[]).map(|_| ()).map_err(|error| error.to_string())
    };
    for (claim, place) in [
        ("reaches = \"x\"\nabove = 0\ntime = \"1.000 ± 0.1\"", "1.000 ± 0.1"),
        ("exponent = \"zero\"\ntime = \"10 ± 1\"", "10 ± 1"),
        ("closed-orbit = \"3.2 ± 0.1\"", "3.2 ± 0.1"),
    ] {
        let mistake = read(claim).expect_err(claim);
        assert!(mistake.contains(place) && mistake.contains("has an error"), "{mistake}");
    }
    assert_eq!(read("reaches = \"x\"\nabove = 0\ntime = 1.000"), Ok(()));
    assert!(read("exponent = \"zero\"\ntime = 1e400").is_err(), "no time is infinite");
}

/// Exponents of a map of the plane along one orbit.
fn of_map(images: [&str; 2], begin: [&str; 2], count: u64) -> MapExponents {
    let [[p, q], [x, y]] = [images, begin];
    let text = format!(
        "title = \"map\"\n[state]\nx = \"-2..2\"\ny = \"-2..2\"\n[map]\nx = \"{p}\"\ny = \"{q}\"\n"
    );
    let case = Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{text}: {error}"));
    let state = read_state(&case, &format!("x={x} y={y}")).expect("a state");
    let start = Start::new(&case, Some(&state), 1, 0);
    let mut found = map_exponents(&case, &[start], count, 1, &|_| ());
    found.pop().expect("an orbit").expect("all iterates")
}

#[test]
fn exponents_of_maps_are_per_iterate() {
    // λ₁ = 0.41922 and ln |det DΦ| = ln 0.3 (Hénon 1976)
    let henon = of_map(["1 - 7/5*x^2 + y", "3/10*x"], ["0", "0"], 20_000);
    assert!(
        (henon.largest.largest.mean - 0.41922).abs() < 3.0 * henon.largest.largest.error + 1e-3
    );
    assert!((henon.largest.divergence.mean - 0.3f64.ln()).abs() < 1e-12);
    assert_eq!(henon.largest.character, Character::StrangeAttractor);
    let all = &henon.spectrum.exponents;
    let sum = all[0].mean + all[1].mean;
    assert!((sum - 0.3f64.ln()).abs() < 1e-12 && all[1].mean < -1.6, "{all:?}");
    let dimension = henon.spectrum.kaplan_yorke().expect("volume shrinks");
    assert!((dimension - 1.26).abs() < 0.01, "{dimension}");
    // The linear map of the cat: the logarithm of its eigenvalue, and area is kept.
    let cat = of_map(["2*x + y", "x + y"], ["0", "0"], 1000);
    let expected = ((3.0 + 5f64.sqrt()) / 2.0).ln();
    assert!((cat.spectrum.exponents[0].mean - expected).abs() < 1e-12);
    assert_eq!(cat.largest.character, Character::UnstableRest);
    // McMillan's map has an integral: vectors grow like a power.
    let mcmillan = of_map(["y", "-x + 3*y/(1 + y^2)"], ["1/2", "1/3"], 10_000);
    assert_eq!(mcmillan.largest.character, Character::Regular, "{mcmillan:?}");
    assert!(mcmillan.largest.largest.mean.abs() < 2e-3, "{mcmillan:?}");
}

#[test]
fn a_map_that_takes_several_states_to_one_has_chaos_alone() {
    // The map of Ulam and von Neumann takes [0, 1] to itself twice; areas grow by 9/5 on average.
    let found = of_map(["4*x*(1 - x)", "9/10*y"], ["0.3217", "0.1234"], 20_000);
    assert_eq!(found.largest.character, Character::Chaos, "{found:?}");
    assert!((found.largest.divergence.mean - 1.8f64.ln()).abs() < 1e-2, "{found:?}");
}

#[test]
fn areas_of_large_negative_numbers_have_values_in_maps() {
    for x in ["-9e7", "-1e10", "-1e7", "1e10"] {
        let text = "title = \"map\"\n[state]\nx = \"-2..2\"\n[map]\nx = \"asinh(x)\"\n";
        let case = Case::parse(text, &[]).expect("a case");
        let state = read_state(&case, &format!("x={x}")).expect("a state");
        let start = Start::new(&case, Some(&state), 1, 0);
        let mut found = iterates(&case, &[start], (1, Precision::Float), None, 1, &|_| ());
        let end = found.pop().expect("an orbit").orbit.expect("a value").end[0].hi;
        let known = x.parse::<f64>().expect("a number").asinh();
        assert!((end - known).abs() < 1e-14 * known.abs(), "{x}: {end} and {known}");
    }
}
