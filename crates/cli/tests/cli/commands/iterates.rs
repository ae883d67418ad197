//! Iterates of maps: values, drifts, data and pictures, and what ends an orbit.

use std::fs;
use std::path::PathBuf;

use predicates::prelude::PredicateBooleanExt;
use predicates::str::contains;

use super::{folder, json, liouville};

/// A map in a file of its own.
fn map(name: &str, state: &str, images: &str) -> PathBuf {
    let text = format!("title = 'a map'\n[state]\n{state}\n[map]\n{images}\n");
    folder(&format!("iterates-{name}"), &[("map.toml", &text)]).join("map.toml")
}

#[test]
fn iterates_are_exact_where_numbers_are_whole() {
    let path = map("fibonacci", "x = '-9..9'\ny = '-9..9'", "x = 'y'\ny = 'x + y'");
    let path = path.to_str().expect("a path");
    let found = json(&["motion", "orbit", path, "--start", "0,1", "--iterates", "10", "--json"], 0);
    assert_eq!(found["end"]["x"][0], "55.0");
    assert_eq!(found["end"]["y"][0], "89.0");
    assert_eq!(found["iterates"], 10);
    let digits = ["motion", "orbit", path, "--start", "0,1/3", "--iterates", "2"];
    let both = [&digits[..], &["--precision", "double-double"]].concat();
    liouville(&both).assert().code(0).stdout(contains("0.666666666666666666666666666666"));
}

#[test]
fn integrals_of_a_map_do_not_drift() {
    let arguments =
        ["motion", "orbit", "classical/maps/mcmillan", "--set", "s=3/2", "--start", "1/2,1/3"];
    let found = json(&[&arguments[..], &["--iterates", "1e4", "--json"]].concat(), 0);
    let followed = found["followed"].as_array().expect("a list");
    let drift = |role: &str| {
        let one = followed.iter().find(|own| own["role"] == role).expect("one of this role");
        one["drift"].as_f64().expect("a number")
    };
    assert!(drift("integral") < 1e-11, "{followed:?}");
    assert!(drift("decoy") > 0.1, "{followed:?}");
}

#[test]
fn samples_are_iterates() {
    let path = map("doubling", "x = '-9..9'", "x = '2*x'");
    let out = path.with_file_name("rows.csv");
    let picture = path.with_file_name("dots.svg");
    let path = path.to_str().expect("a path");
    let file = out.to_str().expect("a path");
    let arguments = [
        "motion",
        "orbit",
        path,
        "--start",
        "1",
        "--start",
        "3",
        "--iterates",
        "6",
        "--every",
        "3",
    ];
    liouville(&[&arguments[..], &["--out", file]].concat()).assert().code(0);
    let rows = fs::read_to_string(&out).expect("rows");
    assert_eq!(
        rows,
        "start,n,x\n0,0.0,1.0\n0,3.0,8.0\n0,6.0,64.0\n1,0.0,3.0\n1,3.0,24.0\n1,6.0,192.0\n"
    );
    let file = picture.to_str().expect("a path");
    let arguments = ["motion", "orbit", "classical/maps/standard", "--set", "s=2", "--orbits", "3"];
    liouville(&[&arguments[..], &["--iterates", "50", "--out", file]].concat()).assert().code(0);
    let drawn = fs::read_to_string(&picture).expect("a picture");
    assert!(!drawn.contains("NaN") && drawn.contains("<svg"), "a phase portrait");
}

#[test]
fn an_orbit_ends_where_an_image_has_no_value() {
    let path = map("poles", "x = '-9..9'", "x = '1/x − 1'");
    let path = path.to_str().expect("a path");
    liouville(&["motion", "orbit", path, "--start", "1", "--iterates", "5"])
        .assert()
        .code(2)
        .stderr(contains("`1/x − 1` has no value after 1 iterate, at x = 0.0"));
    // One orbit that ends leaves the others.
    liouville(&["motion", "orbit", path, "--start", "1", "--start", "3", "--iterates", "3"])
        .assert()
        .code(0)
        .stdout(contains("ended early").and(contains("3 iterates")));
    // As written: x²/x and 0·ln x have no value at 0 and below.
    for (name, image, start) in [("quotient", "x²/x", "0"), ("logarithm", "x + 0*log(x)", "-1")] {
        let path = map(name, "x = '-9..9'", &format!("x = '{image}'"));
        let path = path.to_str().expect("a path");
        let start = format!("--start={start}");
        liouville(&["motion", "orbit", path, &start, "--iterates", "5"])
            .assert()
            .code(2)
            .stderr(contains("has no value after 0 iterates"));
    }
}

#[test]
fn an_orbit_that_escapes_says_where() {
    let path = map("escape", "x = '-9..9'", "x = 'x²'");
    let path = path.to_str().expect("a path");
    liouville(&["motion", "orbit", path, "--start", "2", "--iterates", "100"])
        .assert()
        .code(2)
        .stderr(
            contains("escapes: after 9 iterates, at x = 1.3").and(contains("fewer --iterates")),
        );
}

#[test]
fn small_values_of_extremes_and_hyperbolic_functions_keep_their_digits() {
    for (name, image, expected) in [
        ("max", "max(2*x, -1)", 2f64.powi(60) * 1e-20),
        ("min", "min(1, 2*x)", 2f64.powi(60) * 1e-20),
        ("tanh", "2*tanh(x)", 1.1529215e-2),
        ("sinh", "2*sinh(x)", 1.1529215e-2),
        ("modulus", "-2*abs(x)", -(2f64.powi(60)) * 1e-20),
    ] {
        let path = map(&format!("small-{name}"), "x = '-9..9'", &format!("x = '{image}'"));
        let path = path.to_str().expect("a path");
        let arguments = ["motion", "orbit", path, "--start", "1e-20", "--iterates", "60", "--json"];
        for precision in ["float", "double-double"] {
            let found = json(&[&arguments[..], &["--precision", precision]].concat(), 0);
            let end = found["end"]["x"][0].as_str().and_then(|x| x.parse::<f64>().ok());
            let end = end.expect("a number");
            assert!((end / expected - 1.0).abs() < 1e-4, "{image}, {precision}: {end}");
        }
    }
}

#[test]
fn an_orbit_that_underflows_does_not_escape() {
    let path = map("underflow", "x = '-9..9'\ny = '-9..9'", "x = 'x/2'\ny = 'x^2/x'");
    let path = path.to_str().expect("a path");
    liouville(&["motion", "orbit", path, "--start", "1,1", "--iterates", "2000"])
        .assert()
        .code(2)
        .stderr(contains("too large or too small for f64").and(contains("escapes").not()));
}

#[test]
fn maps_and_flows_have_their_own_options() {
    let refuse = |arguments: &[&str], message: &str| {
        liouville(arguments).assert().code(2).stderr(contains(message));
    };
    let map = ["motion", "orbit", "classical/maps/standard"];
    refuse(&[&map[..], &["--time", "10"]].concat(), "--iterates 1000");
    refuse(&[&map[..], &["--iterates", "0"]].concat(), "from 1 to 1e10");
    refuse(&[&map[..], &["--iterates", "2.5"]].concat(), "from 1 to 1e10");
    refuse(&[&map[..], &["--every", "1/2", "--out", "a.csv"]].concat(), "a whole number from 1 on");
    refuse(&[&map[..], &["--columns", "t, x", "--out", "a.csv"]].concat(), "unknown name `t`");
    let flow = ["motion", "orbit", "classical/tops/euler", "--iterates", "10"];
    refuse(&flow, "is not a map");
    refuse(&["motion", "section", "classical/maps/standard"], "motion orbit --iterates N");
}
