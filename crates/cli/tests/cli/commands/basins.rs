//! Basins of attraction, from the user's side.

use std::fs;

use predicates::prelude::PredicateBooleanExt;
use predicates::str::contains;
use serde_json::Value;

use crate::commands::{folder, json, liouville};

/// The origin attracts from r < 1/2, and the cycle r = 1 from r > 1/2.
const RING: &str = r#"
title = "a point in a cycle"
[state]
x = "-2..2"
y = "-2..2"
[let]
g = "(x² + y² − 1/4)*(1 − x² − y²)"
[field]
"x'" = "g*x − y"
"y'" = "g*y + x"
"#;

/// Two wells with friction.
const WELLS: &str = r#"
title = "two wells"
[state]
x = "-2..2"
v = "-2..2"
[field]
"x'" = "v"
"v'" = "x − x³ − v/2"
"#;

/// Every point of a sphere but one moves to its north pole.
const POLE: &str = r#"
title = "to the north"
[state]
"γ" = "vector(-1..1)"
[field]
"γ'" = "[0, 0, 1] − γ[3]*γ"
[level]
equations = ["|γ|² = 1"]
"#;

const CENTRE: &str = r#"
title = "an oscillator"
[state]
x = "-2..2"
y = "-2..2"
[field]
"x'" = "y"
"y'" = "−x"
"#;

const LEAVES: &str = r#"
title = "to the left it rests, to the right it blows up"
[state]
x = "-2..2"
y = "-2..2"
[field]
"x'" = "x + x²"
"y'" = "−y"
"#;

fn case(name: &str, text: &str) -> (std::path::PathBuf, String) {
    let folder = folder(name, &[("case.toml", text)]);
    let path = folder.join("case.toml").to_str().expect("UTF-8").to_string();
    (folder, path)
}

/// Values of the middle of each part of −2..2.
fn place(index: usize, count: usize) -> f64 {
    -2.0 + 4.0 * (index as f64 + 0.5) / count as f64
}

fn rows(found: &Value) -> Vec<Vec<Value>> {
    let rows = found["rows"].as_array().expect("rows").iter();
    rows.map(|row| row.as_array().expect("a row").clone()).collect()
}

const PLANE: [&str; 6] = ["--x", "x=-2..2", "--y", "y=-2..2", "--size", "20x16"];

#[test]
fn a_cycle_and_the_point_inside_have_their_basins() {
    let (folder, path) = case("ring", RING);
    let own = [&["motion", "basins", &path, "--time", "60"], &PLANE[..]].concat();
    let found = json(&[&own[..], &["--json"]].concat(), 0);
    let attractors = found["attractors"].as_array().expect("attractors");
    let kinds: Vec<&str> = attractors.iter().filter_map(|own| own["kind"].as_str()).collect();
    assert_eq!(kinds, ["cycle or torus", "point"]);
    for range in attractors[0]["ranges"].as_array().expect("ranges") {
        let ends = [0, 1].map(|k| range[k].as_f64().expect("a number"));
        assert!((ends[0] + 1.0).abs() < 1e-2 && (ends[1] - 1.0).abs() < 1e-2, "{ends:?}");
    }
    for (j, row) in rows(&found).iter().enumerate() {
        for (i, end) in row.iter().enumerate() {
            let (x, y) = (place(i, 20), place(j, 16));
            let expected = if x * x + y * y < 0.25 { 2 } else { 1 };
            assert_eq!(end, &Value::from(expected), "({x}, {y})");
        }
    }
    let drawn = |name: &str, threads: &str| {
        let out = folder.join(name).to_str().expect("UTF-8").to_string();
        let arguments = [&own[..], &["--threads", threads, "--out", &out]].concat();
        liouville(&arguments).assert().success().stdout(contains("neighbour in another basin"));
        fs::read(out).expect("a file")
    };
    for ending in ["json", "png"] {
        let [one, two] = ["1", "2"].map(|threads| drawn(&format!("{threads}.{ending}"), threads));
        assert!(one == two, "the same bytes with any threads: {ending}");
    }
}

#[test]
fn wells_that_mirror_each_other_have_mirrored_basins() {
    let (_folder, path) = case("wells", WELLS);
    let own = ["motion", "basins", &path, "--x", "x=-2..2", "--y", "v=-2..2", "--json"];
    let found = json(&[&own[..], &["--size", "20x20", "--time", "150"]].concat(), 0);
    let attractors = found["attractors"].as_array().expect("attractors");
    let at = |index: usize| attractors[index]["state"][0].as_f64().expect("a number");
    assert_eq!(attractors.len(), 2);
    assert!((at(0) + at(1)).abs() < 1e-9 && (at(0).abs() - 1.0).abs() < 1e-9);
    let rows = rows(&found);
    for j in 0..20 {
        for i in 0..20 {
            let (own, other) = (&rows[j][i], &rows[19 - j][19 - i]);
            assert_eq!(own.as_u64().expect("a basin") + other.as_u64().expect("a basin"), 3);
        }
    }
    let right = rows[10][15].as_u64().expect("a basin") as usize;
    assert!(at(right - 1) > 0.0, "near the right well");
}

#[test]
fn starts_are_moved_to_the_level() {
    let (_folder, path) = case("pole", POLE);
    let own = ["motion", "basins", &path, "--x", "γ1=-1..1", "--y", "γ2=-1..1", "--size", "6x6"];
    liouville(&[&own[..], &["--start", "0,0,-1/2", "--time", "80"]].concat())
        .assert()
        .success()
        .stdout(contains("36  100.0 %  1: point").and(contains("γ3 = 1")));
}

#[test]
fn motions_without_an_attractor_say_why() {
    let (_folder, path) = case("centre", CENTRE);
    let own = [&["motion", "basins", &path, "--time", "100"], &PLANE[..]].concat();
    liouville(&own).assert().success().stdout(contains("nothing seems to attract"));
    let (_folder, path) = case("leaves", LEAVES);
    let own = [&["motion", "basins", &path, "--time", "100", "--json"], &PLANE[..]].concat();
    for row in rows(&json(&own, 0)) {
        for (i, end) in row.iter().enumerate() {
            match place(i, 20) < 0.0 {
                true => assert_eq!(end, &Value::from(1)),
                false => assert!(end.is_string(), "{end}"),
            }
        }
    }
}

#[test]
fn basins_that_cannot_be_drawn_say_why() {
    let (_folder, path) = case("wrong", WELLS);
    let wrong = |more: &[&str], message: &'static str| {
        let arguments = [&["motion", "basins", &path], more].concat();
        liouville(&arguments).assert().code(2).stderr(contains(message));
    };
    wrong(&["--x", "x=0..1", "--y", "w=0..1"], "`w` is not a component of the state");
    wrong(&["--x", "x=0..1", "--y", "x=0..2"], "already varies along --x");
    wrong(&["--x", "x=0..0", "--y", "v=0..1"], "the range is empty");
    wrong(&["--x", "x=0..1", "--y", "v=0..1", "--time", "0"], "not 0");
    wrong(&["--x", "x=0..1", "--y", "v=0..1", "--by", "q"], "unknown name `q`");
    wrong(&["--x", "x=0..1", "--y", "v=0..1", "--energy", "1"], "has no energy");
    let (_folder, path) = case("third", POLE);
    let own = ["motion", "basins", &path, "--x", "γ1=-1..1", "--y", "γ2=-1..1"];
    liouville(&own).assert().code(2).stderr(contains("components of the state that do not vary"));
    let own = ["motion", "basins", "one-sided/motion", "--x", "ω1=0..1", "--y", "ω2=0..1"];
    let own = [&own[..], &["--start", "0,0,1"]].concat();
    liouville(&own).assert().code(2).stderr(contains("one-sided"));
}

#[test]
fn an_angle_that_turns_is_told_with_what_to_compare() {
    let kapitza = "title = 'Kapitza'\n[state]\n\"φ\" = '-3..3'\np = '-2..2'\nc = '-2..2'\ns = '-2..2'\n[field]\n\
                   \"φ\" = 'p'\np = '-(1 - 20*c)*sin(φ)'\nc = '-10*s'\ns = '10*c'\n[level]\n\
                   equations = ['c^2 + s^2 = 1']\n";
    let folder = folder("turning", &[("kapitza.toml", kapitza)]);
    let case = folder.join("kapitza.toml").display().to_string();
    let grid = [
        "--x", "φ=-3..3", "--y", "p=-2..2", "--size", "6x6", "--start", "0,0,1,0", "--time", "200",
    ];
    let text = |more: &[&str]| {
        let all = [&["motion", "basins", &case], &grid[..], more].concat();
        let output = liouville(&all).assert().success().get_output().stdout.clone();
        String::from_utf8(output).expect("text")
    };
    let plain = text(&[]);
    assert!(plain.contains("note: φ runs far from the starts"), "{plain}");
    assert!(plain.contains("--by 'cos(φ), sin(φ), p, c, s'"), "{plain}");
    assert!(!text(&["--by", "cos(φ), sin(φ), p"]).contains("note:"), "full turns are one");
}
