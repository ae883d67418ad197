//! Motions: orbits, sections, charts, exponents.

use std::fs;

use predicates::str::contains;

use crate::commands::{GOOD, folder, json, liouville};

/// Returns the path of a figure of the catalogue.
fn figure(name: &str) -> String {
    format!("{}/cases/figures/{name}.toml", concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

#[test]
fn orbit_reports_drift_beside_a_decoy() {
    let case = figure("fig-4");
    let state = "ω=[1/2,7/10,-1/2] γ=[1/3,2/3,2/3]";
    let report = json(&["orbit", &case, "--state", state, "--time", "50", "--json"], 0);
    let followed = report["followed"].as_array().expect("a list");
    let drift = |role: &str| {
        let entry = followed.iter().find(|entry| entry["role"] == role).expect("it is followed");
        entry["drift"].as_f64().expect("a number")
    };
    assert!(drift("energy") < 1e-14 && drift("integral") < 1e-14, "rounding alone");
    assert!(drift("decoy") > 1e-3, "what is no integral drifts");
    assert!(
        report["moved"].as_f64().is_some_and(|moved| moved > 0.1),
        "the start is off the level"
    );
    let wrong = liouville(&["orbit", &case, "--state", "ω=[0,0,0]"]).assert().code(2);
    wrong.stderr(contains("no value for `γ`"));
}

#[test]
fn section_draws_the_same_bytes_with_any_threads() {
    let folder = folder("section", &[]);
    let case = figure("fig-3");
    for ending in ["svg", "pdf", "png"] {
        let draw = |name: &str, threads: &str| {
            let path = folder.join(format!("{name}.{ending}"));
            let out = path.to_str().expect("UTF-8");
            let arguments =
                ["--orbits", "12", "--crossings", "20", "--threads", threads, "--out", out];
            liouville(&[&["section", &case], &arguments[..]].concat()).assert().success();
            fs::read(path).expect("a picture")
        };
        assert_eq!(draw("one", "1"), draw("three", "3"), "{ending}");
    }
}

#[test]
fn sections_that_cannot_be_drawn_say_why() {
    let fails = |arguments: &[&str], message: &'static str| {
        liouville(arguments).assert().code(2).stderr(contains(message));
    };
    let case = figure("fig-8");
    fails(&["section", &case, "--energy", "10"], "at or above the energy");
    let down = ["section", &figure("fig-3"), "--direction", "down", "--start", "1,0.3"];
    fails(&down, "1001 times in the direction that does not count");
    fails(&["section", &case, "--start", "1,1.5"], "has to be below 1");
    fails(&["section", &case, "--g0", "tomorrow"], "is not an angle");
    fails(
        &["section", &case, "--start", "1,0", "--crossings", "1", "--out", "x.gif"],
        "is none of .svg",
    );
    let free = folder("no-section", &[("free.toml", GOOD)]).join("free.toml");
    let body = &["section", free.to_str().expect("UTF-8")];
    fails(body, "no [section]");
    fails(&["section", "classical/flows/lorenz"], "give a surface, such as --section");
}

#[test]
fn charts_count_what_they_colour_and_draw_the_same_bytes() {
    let folder = folder("chart", &[]);
    let case = figure("fig-8");
    let plane = ["--x", "a_g=5..25", "--y", "c3=0..1", "--size", "6x4", "--time", "20"];
    for ending in ["svg", "pdf", "png"] {
        let draw = |name: &str, threads: &str| {
            let path = folder.join(format!("{name}.{ending}"));
            let out = path.to_str().expect("UTF-8");
            let more = ["--threads", threads, "--out", out];
            let done = liouville(&[&["chart", &case], &plane[..], &more].concat()).assert();
            done.success().stdout(contains("no state; the first: over (l, L/G)"));
            fs::read(path).expect("a picture")
        };
        assert_eq!(draw("one", "1"), draw("three", "3"), "{ending}");
    }
    let report = json(&[&["chart", &case], &plane[..], &["--json"]].concat(), 0);
    let rows = report["rows"].as_array().expect("rows");
    assert!(rows.len() == 4 && rows[0].as_array().expect("a row").len() == 6, "6 by 4");
    let fails = |x: &str, message: &'static str| {
        liouville(&["chart", &case, "--x", x, "--y", "l=0..2pi"])
            .assert()
            .code(2)
            .stderr(contains(message));
    };
    fails("q=0..1", "there is no `q` to vary");
    fails("a_g=1", "there is no `..`");
    fails("a_g=1..1", "the range is empty");
    fails("l=0..1", "already varies");
}

#[test]
fn sections_tell_classes_and_draw_separatrices() {
    let folder = folder("separatrices", &[]);
    let picture = folder.join("saddle.svg");
    let out = picture.to_str().expect("UTF-8");
    let arguments =
        ["--orbits", "4", "--crossings", "5", "--classes=300", "--separatrices", "3.1,0.02"];
    liouville(&[&["section", &figure("fig-3"), "--out", out], &arguments[..]].concat())
        .assert()
        .success()
        .stdout(contains("class: regular (4 regular)"))
        .stdout(contains("kept; over one return"));
    let drawn = fs::read_to_string(&picture).expect("a picture");
    assert!(drawn.contains(">hyperbolic point</text>"), "the saddle is marked");
    assert!(drawn.contains(">unstable curves</text>"), "and what the colours mean is told");
    liouville(&["section", &figure("fig-3"), "--out", out, "--separatrices", "1.5,0.02"])
        .assert()
        .code(2)
        .stderr(contains("not hyperbolic"));
}

#[test]
fn orbits_that_are_run_through_several_times_are_told() {
    fn found<'a>(period: &'a str, more: &[&'a str]) -> Vec<&'a str> {
        let case = "classical/flows/van-der-pol-cycle";
        let orbit = ["motion", "periodic", case, "--start", "2,0", "--section", "p = 0"];
        [&orbit[..], &["--period", period], more].concat()
    }
    let point = |period: &str| json(&found(period, &["--json"]), 0)["points"][0].clone();
    let (once, thrice) = (point("1"), point("3"));
    let number = |point: &serde_json::Value, key: &str| point[key].as_f64().expect("a number");
    assert_eq!((&once["turns"], &thrice["turns"]), (&1.into(), &3.into()));
    let gap = number(&thrice, "least_time") - number(&once, "time");
    assert!(gap.abs() <= number(&thrice, "least_time_error") + number(&once, "time_error"));
    let text = |period: &str| {
        let out = liouville(&found(period, &[])).assert().code(0).get_output().stdout.clone();
        String::from_utf8(out).expect("text")
    };
    assert!(text("3").contains("run through 3 times: the least period is 6."), "{}", text("3"));
    assert!(!text("1").contains("run through"), "{}", text("1"));
}

#[test]
fn an_energy_of_0_is_held() {
    let oscillator = "title = 'a'\n[state]\nq = '-2..2'\np = '-2..2'\n[hamiltonian]\n\
                      function = 'p²/2 + q²/2 + q^4/4 - 3/4'\npairs = [['q', 'p']]\n";
    let folder = folder("zero-energy", &[("oscillator.toml", oscillator)]);
    let case = folder.join("oscillator.toml").display().to_string();
    let orbit = ["motion", "periodic", &case, "--start", "1,0", "--section", "p = 0", "--json"];
    let point = json(&orbit, 0)["points"][0].clone();
    // 4 ∫ dq/√(3/2 − q² − q⁴/2) from 0 to 1
    let period = point["time"].as_f64().expect("a number");
    assert!((period - 4.768_022_3).abs() < 1e-6, "{period}");
}

#[test]
fn periodic_and_exponents_report_in_json() {
    let case = figure("fig-8");
    let report = json(&["periodic", &case, "--start", "3.36,0.32", "--json"], 0);
    assert_eq!(report["points"][0]["kind"], "sink");
    let arguments = ["exponents", &figure("fig-3"), "--start", "1,0.3", "--time", "200", "--json"];
    let report = json(&arguments, 0);
    assert_eq!(report["motions"][0]["character"], "regular");
    let lost = liouville(&["periodic", &case, "--start", "1,0.9"]).assert().code(2);
    lost.stderr(contains("no point of period 1"));
}
