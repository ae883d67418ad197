//! Bifurcation diagrams and rotation numbers, from the user's side.

use std::fs;

use predicates::str::contains;
use serde_json::Value;

use crate::commands::{folder, json, liouville};

/// A cycle of radius √μ, which attracts everything but the rest inside.
const CYCLE: &str = r#"
title = "a growing cycle"
[parameters]
"μ" = "0..2"
v = "[1, 0, -1]"
[state]
x = "-2..2"
y = "-2..2"
[field]
"x'" = "μ*x − y − x*(x² + y²)"
"y'" = "x + (μ + v[2])*y − y*(x² + y²)"
"#;

/// Two oscillators of frequencies 1 and a.
const OSCILLATORS: &str = r#"
title = "two oscillators"
[parameters]
a = "7/5"
[state]
x = "-1..1"
y = "-1..1"
px = "-1..1"
py = "-1..1"
[hamiltonian]
function = "(px² + x²)/2 + (py² + a²*y²)/2"
pairs = [["x", "px"], ["y", "py"]]
"#;

fn case(name: &str, text: &str) -> (std::path::PathBuf, String) {
    let folder = folder(name, &[("case.toml", text)]);
    let case = folder.join("case.toml").to_str().expect("UTF-8").to_string();
    (folder, case)
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

#[test]
fn a_diagram_follows_a_cycle() {
    let (folder, case) = case("diagram", CYCLE);
    let file = |name: &str| folder.join(name).to_str().expect("UTF-8").to_string();
    let own =
        ["motion", "diagram", &case, "--over", "μ=0.5..1.5", "--count", "7", "--crossings", "3"];
    let own = [&own[..], &["--section", "y = 0", "--start", "1,1", "--start", "-1,1"]].concat();
    let (svg, csv) = (file("diagram.svg"), file("diagram.csv"));
    let found = json(&[&own[..], &["--direction", "up", "--json", "--out", &svg]].concat(), 0);
    let values = found["values"].as_array().expect("values");
    assert_eq!((values.len(), &found["axes"]), (7, &serde_json::json!(["x"])));
    for (index, one) in values.iter().enumerate() {
        let mu = number(&one["value"]);
        assert!((mu - (0.5 + (index as f64 + 0.5) / 7.0)).abs() < 1e-15, "{mu}");
        let orbits = one["orbits"].as_array().expect("motions");
        assert_eq!(orbits.len(), 2, "a motion for each start");
        for orbit in orbits {
            let crossings = orbit["crossings"].as_array().expect("crossings");
            assert_eq!(crossings.len(), 3);
            for at in crossings {
                assert!((number(&at[0]) - mu.sqrt()).abs() < 1e-12, "√{mu}: {at}");
            }
        }
    }
    assert!(fs::read_to_string(&svg).expect("a picture").contains("section"));
    liouville(&[&own[..], &["--out", &csv, "--threads", "1"]].concat())
        .assert()
        .success()
        .stdout(contains("7 values, 2 motions at each, 42 crossings"));
    let rows = fs::read_to_string(&csv).expect("data");
    assert_eq!(rows.lines().next(), Some("μ,start,x"));
    assert_eq!(rows.lines().count(), 43, "{rows}");
}

#[test]
fn a_diagram_has_the_crossings_of_its_sections() {
    let own = ["figures/fig-8", "--start", "1.6,-0.3", "--crossings", "5"];
    let found = json(
        &[
            &["motion", "diagram", "--over", "c1=0..2", "--count", "2", "--skip", "4", "--json"],
            &own[..],
        ]
        .concat(),
        0,
    );
    for (index, first) in ["1/2", "3/2"].into_iter().enumerate() {
        let set = format!("c=[{first}, 3/2, 1/2]");
        let one = json(
            &[&["motion", "section", "--skip", "4", "--json", "--set", &set], &own[..]].concat(),
            0,
        );
        let section = one["orbits"][0]["crossings"].as_array().expect("crossings");
        let diagram =
            found["values"][index]["orbits"][0]["crossings"].as_array().expect("crossings");
        assert_eq!(diagram.len(), 5);
        for (a, b) in section.iter().zip(diagram) {
            let at = a.get("at").unwrap_or(a);
            assert_eq!((&at[0], &at[1]), (&b[0], &b[1]), "the same bits at c1 = {first}");
        }
    }
    let found = json(
        &[
            &[
                "motion",
                "diagram",
                "--over",
                "energy=40..60",
                "--count",
                "1",
                "--skip",
                "0",
                "--json",
            ],
            &own[..],
        ]
        .concat(),
        0,
    );
    let one = json(
        &[&["motion", "section", "--energy", "50", "--skip", "0", "--json"], &own[..]].concat(),
        0,
    );
    let (a, b) =
        (&one["orbits"][0]["crossings"][0], &found["values"][0]["orbits"][0]["crossings"][0]);
    assert_eq!((&a.get("at").unwrap_or(a)[0], &a.get("at").unwrap_or(a)[1]), (&b[0], &b[1]));
}

#[test]
fn rotation_numbers_are_those_of_the_frequencies() {
    let (folder, case) = case("rotation", OSCILLATORS);
    let file = |name: &str| folder.join(name).to_str().expect("UTF-8").to_string();
    let own =
        ["motion", "rotation", &case, "--energy", "2", "--section", "y = 0", "--axes", "x, px"];
    let own = [&own[..], &["--from", "0.1,0", "--to", "0.5,0", "--count", "3"]].concat();
    let svg = file("rotation.svg");
    let turning = json(&[&own[..], &["--centre", "0,0", "--json", "--out", &svg]].concat(), 0);
    // x goes clockwise in its plane, by 5/7 of a turn.
    for motion in turning["motions"].as_array().expect("motions") {
        assert_eq!(motion["fraction"], serde_json::json!([2, 7]), "{motion}");
        assert!((number(&motion["rotation"]) - 2.0 / 7.0).abs() < 1e-14, "{motion}");
    }
    assert!(fs::read_to_string(&svg).expect("a picture").contains("2/7"));
    let other = [&own[..], &["--angle", "atan2(x, px)", "--set", "a=1.6180339887498949", "--json"]];
    let other = json(&other.concat(), 0);
    for motion in other["motions"].as_array().expect("motions") {
        assert!(motion["fraction"].is_null(), "{motion}");
        let golden = (5f64.sqrt() - 1.0) / 2.0;
        assert!((number(&motion["rotation"]) - golden).abs() < 1e-11, "{motion}");
    }
    let csv = file("rotation.csv");
    liouville(&[&own[..], &["--centre", "0,0", "--out", &csv]].concat())
        .assert()
        .success()
        .stdout(contains("3 motions, 3 at a fraction, 0 without a number"));
    let rows = fs::read_to_string(&csv).expect("data");
    assert_eq!(rows.lines().next(), Some("x,px,rotation,error,p,q,crossings"));
    // Outside of the energy there is no motion.
    let far = ["--centre", "0,0", "--to", "3,0", "--json"];
    let far = json(&[&own[..own.len() - 4], &["--count", "2"], &far[..]].concat(), 0);
    assert!(far["motions"][1]["rotation"].is_null() && !far["motions"][1]["problem"].is_null());
}

#[test]
fn lines_that_cannot_be_followed_are_refused_with_a_remedy() {
    let (_folder, cycle) = case("lines-refused", CYCLE);
    let diagram = ["motion", "diagram", &cycle, "--section", "y = 0", "--over"];
    let rotation = ["motion", "rotation", &cycle, "--section", "y = 0", "--from"];
    for (arguments, message, help) in [
        (
            [&diagram[..], &["q=0..1"]].concat(),
            "there is no `q` to vary",
            "vary one of μ, v1, v2, v3",
        ),
        (
            [&diagram[..], &["L/G=0..1"]].concat(),
            "coordinates of the section g = g₀",
            "leave out --section",
        ),
        (
            [&diagram[..], &["μ=0..1", "--count", "100000", "--crossings", "1000"]].concat(),
            "more than 20000000",
            "smaller --count",
        ),
        (
            vec!["motion", "diagram", &cycle, "--over", "μ=0..1"],
            "rolls without spinning",
            "--section",
        ),
        ([&rotation[..], &["1,0", "--to", "2,0"]].concat(), "the angle", "--centre U,V"),
        (
            [&rotation[..], &["1,0", "--to", "1,0", "--centre", "0,0"]].concat(),
            "are the same start",
            "",
        ),
        (
            [&rotation[..], &["x=1 y=0", "--to", "1,1", "--centre", "0,0"]].concat(),
            "section of a rotation has two coordinates",
            "--axes",
        ),
        (
            [&rotation[..], &["1,0", "--to", "1,1", "--axes", "x, y", "--centre", "0"]].concat(),
            "`0` is no point",
            "such as 1.2,-0.04",
        ),
    ] {
        liouville(&arguments).assert().code(2).stderr(contains(message)).stderr(contains(help));
    }
}
