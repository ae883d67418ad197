//! Motions that nearly close, that rest at a saddle, and that run away.

use predicates::prelude::*;
use predicates::str::contains;
use serde_json::Value;

use crate::commands::{folder, json, liouville};

/// r' = r ((1 − r²)² − s), φ' = 1: two closed orbits for 0 < s < 1, and none for s < 0.
const FOLD: &str = "title = 'fold'\n[parameters]\ns = '-1..1'\n[state]\nx = '-2..2'\ny = '-2..2'\n\
    [field]\n\"x'\" = '-y + x*((1 - x^2 - y^2)^2 - s)'\n\"y'\" = 'x + y*((1 - x^2 - y^2)^2 - s)'\n";

const LINEAR: &str = "title = 'linear'\n[parameters]\na = '-2..2'\nb = '-2..2'\n[state]\n\
    x = '-2..2'\ny = '-2..2'\n[field]\n\"x'\" = 'a*x'\n\"y'\" = 'b*y'\n";

#[test]
fn beyond_a_fold_there_is_no_closed_orbit() {
    let folder = folder("fold", &[("fold.toml", FOLD)]);
    let case = folder.join("fold.toml").display().to_string();
    let periodic = |s: &str, start: &str| {
        let set = format!("s={s}");
        let time = ["--time", "6.283185307179586", "--start", start];
        liouville(&[&["motion", "periodic", &case, "--set", &set], &time[..]].concat()).assert()
    };
    for (s, start) in
        [("-1e-12", "1,0"), ("-1e-12", "1.00001,0"), ("-5e-12", "1,0"), ("-1e-16", "1,0")]
    {
        periodic(s, start).code(2).stdout("");
    }
    periodic("-1e-12", "1,0").stderr(contains("only, and Newton's method does not come nearer"));
    for (start, kind) in [("1.000001,0", "source"), ("0.999999,0", "sink")] {
        // 1 − r² = ±10⁻⁶ and ∮ div v dt = ∓8π·10⁻⁶, in the numbers and in the theorem.
        let volume =
            contains("∮ div v dt = -0.0000251327").or(contains("∮ div v dt = 0.0000251327"));
        let found = periodic("1e-12", start).success().stdout(volume);
        found.stdout(contains(format!("closed orbit: {kind}")).and(contains("  proved: a closed")));
    }
}

#[test]
fn what_rests_or_runs_away_is_no_attractor() {
    let folder = folder("saddle", &[("linear.toml", LINEAR)]);
    let case = folder.join("linear.toml").display().to_string();
    let saddle = ["motion", "exponents", &case, "--set", "a=1", "--set", "b=-2", "--one-way"];
    for (start, class) in [("0,0", "unstable rest"), ("0,1", "unstable rest"), ("1,0", "escape")] {
        let more = ["--time", "100", "--start", start];
        liouville(&[&saddle[..], &more].concat())
            .assert()
            .success()
            .stdout(contains(class).and(contains("attractor").not()));
    }
}

#[test]
fn a_chart_follows_states_that_grow() {
    let folder = folder("growth", &[("linear.toml", LINEAR)]);
    let case = folder.join("linear.toml").display().to_string();
    let plane = ["--x", "a=0..2", "--y", "b=-2..1", "--size", "4x3", "--state", "x=1 y=1"];
    let chart = ["motion", "chart", &case];
    let chart = json(&[&chart[..], &plane, &["--time", "50", "--json"]].concat(), 0);
    for (row, b) in chart["rows"].as_array().expect("rows").iter().zip([-1.5, -0.5, 0.5]) {
        for (cell, a) in row.as_array().expect("cells").iter().zip([0.25_f64, 0.75, 1.25, 1.75]) {
            let exponent = cell[1].as_f64().unwrap_or(f64::NAN);
            assert!((exponent - a.max(b)).abs() < 5e-3, "a = {a}, b = {b}: {cell}");
            assert_eq!(cell[0], Value::from("escape"), "a = {a}, b = {b}: {cell}");
        }
    }
}
