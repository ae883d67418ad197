//! Branches of closed orbits and symmetric periodic orbits, from the user's side.

use std::fs;
use std::time::{Duration, Instant};

use predicates::str::contains;
use serde_json::Value;

use crate::commands::{folder, json, liouville};

/// Cycles with r² = R on μ = R² - R: a fold at R = 1/2, μ = -1/4.
const FOLD: &str = r#"
title = "cycles with a fold"
[parameters]
"μ" = "-1..3"
twice = "2*μ"
[state]
x = "-2..2"
y = "-2..2"
[field]
x = "-y + x*(μ + x² + y² - (x² + y²)²)"
y = "x + y*(μ + x² + y² - (x² + y²)²)"
"#;

/// Arguments for the branch through x = 1 at μ = 0.
const BRANCH: [&str; 8] =
    ["--set", "μ=0", "--start", "1,0", "--section", "y = 0", "--parameter", "μ"];

fn place(name: &str) -> (std::path::PathBuf, String) {
    let folder = folder(name, &[("fold.toml", FOLD)]);
    let case = folder.join("fold.toml").to_str().expect("UTF-8").to_string();
    (folder, case)
}

fn own<'a>(case: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    [&["motion", "continue", case][..], &BRANCH, more].concat()
}

#[test]
fn a_branch_with_a_fold_is_reported_drawn_and_written() {
    let (folder, case) = place("branch");
    let file = |name: &str| folder.join(name).to_str().expect("UTF-8").to_string();
    let (svg, csv) = (file("branch.svg"), file("branch.csv"));
    let found =
        json(&own(&case, &["--to", "1", "--axes", "x, x² + y²", "--json", "--out", &svg]), 0);
    let points = found["points"].as_array().expect("points");
    let marked: Vec<&Value> = points.iter().filter(|one| !one["bifurcation"].is_null()).collect();
    assert_eq!(marked.len(), 1, "{marked:?}");
    assert_eq!(marked[0]["bifurcation"], "fold");
    let number = |value: &Value| value.as_f64().expect("a number");
    let gap = (number(&marked[0]["value"]) + 0.25).abs();
    assert!(gap <= number(&marked[0]["value_error"]) && gap < 1e-14, "{}", marked[0]);
    assert_eq!(found["axes"], serde_json::json!(["x", "x² + y²"]));
    assert_eq!((&found["ends"][0], &found["ends"][1]), (&"rest".into(), &"range".into()));
    let start = &points[found["start"].as_u64().expect("an index") as usize];
    assert_eq!((number(&start["value"]), start["kind"].as_str()), (0.0, Some("sink")));
    for point in points {
        let square = number(&point["at"][1]);
        assert!((square * square - square - number(&point["value"])).abs() < 1e-13, "{point}");
    }
    let drawn = fs::read_to_string(&svg).expect("a picture");
    for words in ["stable", "unstable", "fold"] {
        assert!(drawn.contains(&format!(">{words}</text>")), "{words} is in the legend");
    }
    liouville(&own(&case, &["--to", "1", "--count", "4", "--out", &csv]))
        .assert()
        .success()
        .stdout(contains("begins: as many points as asked for"))
        .stdout(contains("sink, start"));
    let rows = fs::read_to_string(&csv).expect("data");
    assert_eq!(
        rows.lines().next(),
        Some("μ,x,period,trace,product,largest_modulus,kind,bifurcation,error")
    );
    assert_eq!(rows.lines().count(), 1 + 7, "the start and three points each way");
}

#[test]
fn what_was_reached_is_kept_at_a_limit() {
    let (_, case) = place("stopped");
    let arguments = [&["motion", "continue", &case][..], &BRANCH].concat();
    let slow = ["--step", "1e-5", "--count", "100000", "--within", "2", "--json"];
    let begun = Instant::now();
    let found = json(&[&arguments[..], &slow].concat(), 3);
    assert!(begun.elapsed() < Duration::from_secs(20), "the limit is kept");
    assert!(found["points"].as_array().expect("points").len() > 1, "some points");
    assert_eq!(found["ends"][1], "stopped");
}

#[test]
fn wrong_branches_are_refused_with_a_remedy() {
    let (_, case) = place("wrong-branches");
    let refuse = |arguments: &[&str], message: &'static str, help: &'static str| {
        liouville(&[&["motion", "continue"], arguments].concat())
            .assert()
            .code(2)
            .stderr(contains(message))
            .stderr(contains(help));
    };
    let with = |more: &[&'static str]| -> Vec<&str> {
        [&[case.as_str(), "--set", "μ=0", "--section", "y = 0"][..], more].concat()
    };
    let at = ["--start", "1,0", "--parameter"];
    let of = |more: &[&'static str]| with(&[&at[..], more].concat());
    refuse(&of(&["q"]), "there is no `q` to vary", "vary μ, twice");
    refuse(&of(&["twice"]), "`twice` is computed from other parameters", "vary those");
    refuse(&of(&["energy"]), "the range of `energy` is not known", "--from and --to");
    refuse(&of(&["energy", "--from", "0", "--to", "1"]), "has no energy", "--energy");
    refuse(&of(&["μ", "--from", "-2"]), "--from -2 is outside -1..3", "change the range");
    refuse(&of(&["μ", "--from", "2", "--to", "1"]), "is not below", "lower end");
    refuse(&of(&["μ", "--from", "1"]), "what varies is 0 at the start", "--set");
    refuse(&of(&["μ", "--from", "low"]), "`low` is not a number", "write one");
    refuse(&of(&["μ", "--axes", "t"]), "has no time", "the period is always reported");
    refuse(&of(&["μ", "--step", "2"]), "from 1e-6 to 0.5", "--step");
    refuse(&with(&["--parameter", "μ"]), "there is no start", "give --start");
    let lost = ["--start", "0,0", "--parameter", "μ"];
    refuse(&with(&lost), "equilibrium", "choose another start");
    let bare = [case.as_str(), "--start", "1,0", "--parameter", "μ"];
    refuse(&bare, "the section of the orbits is not known", "--section");
    let far =
        ["figures/fig-8", "--start", "1,0.9", "--parameter", "a_g", "--from", "9", "--to", "11"];
    refuse(&far, "no point of period 1", "start nearer");
}

#[test]
fn symmetric_orbits_are_listed_with_their_reversors() {
    let points = ["--points", "16", "--json"];
    let wish = ["motion", "periodic", "figures/fig-A2", "--symmetric", "L=0,l=pi/2"];
    let found = json(&[&wish[..], &points].concat(), 0);
    let all = found["points"].as_array().expect("points");
    let near = |l: f64, z: f64| {
        all.iter().find(|point| {
            let [own, height] = [0, 1].map(|k| point["at"][k].as_f64().expect("a number"));
            (own - l).abs() < 1e-9 && (height - z).abs() < 1e-9
        })
    };
    let elliptic = near(std::f64::consts::PI, 0.0).expect("the point of figure A.2");
    assert_eq!((&elliptic["kind"], &elliptic["period"]), (&"elliptic".into(), &1.into()));
    assert_eq!(elliptic["symmetric"], serde_json::json!(["L=0", "l=0"]));
    let hyperbolic = near(std::f64::consts::FRAC_PI_2, 0.0).expect("the other one");
    assert_eq!(hyperbolic["kind"], "hyperbolic");
    assert_eq!(hyperbolic["symmetric"], serde_json::json!(["L=0", "l=π/2"]));
    let refused = ["motion", "periodic", "figures/fig-8", "--symmetric", "L=0"];
    liouville(&refused)
        .assert()
        .code(2)
        .stderr(contains("L=0 is no line of a reversor of this section"))
        .stderr(contains("help: "));
    let both = ["motion", "periodic", "figures/fig-A2", "--symmetric", "L=0", "--start", "1,0"];
    liouville(&both).assert().code(2).stderr(contains("cannot be used with"));
    let other = ["motion", "periodic", "figures/fig-A2", "--symmetric", "L=1"];
    liouville(&other).assert().code(2).stderr(contains("write L=0, l=0 or l=π/2"));
    let field = ["motion", "periodic", "classical/flows/van-der-pol-cycle", "--symmetric", "L=0"];
    liouville(&field).assert().code(2).stderr(contains("for a body that rolls without spinning"));
}

#[test]
fn found_orbits_are_proved_or_the_reason_is_given() {
    let (_, case) = place("proved-orbits");
    let search = ["--start", "1,0", "--section", "y = 0", "--prove", "--json"];
    let wish = [&["motion", "periodic", &case, "--set", "μ=0"], &search[..]].concat();
    let found = json(&wish, 0);
    let theorem = found["points"][0]["theorem"].as_str().expect("a theorem");
    assert!(theorem.contains("least period 6.28318530717") && theorem.contains("of kind sink"));
    assert!(theorem.contains("no invariant measure"), "{theorem}");
    let text = "title = 'o'\n[parameters]\na = '1..2'\n[state]\nx = '-2..2'\ny = '-2..2'\n\
                [field]\nx = 'a*y + x*(1 - x² - y²)'\ny = '-a*x + y*(1 - x² - y²)'\n";
    let drawn = folder("drawn", &[("o.toml", text)]).join("o.toml");
    let wish = ["motion", "periodic", drawn.to_str().expect("UTF-8")];
    let found = json(&[&wish[..], &search].concat(), 0);
    let point = &found["points"][0];
    let reason = point["unproved"].as_str().unwrap_or_default();
    assert!(point["theorem"].is_null() && reason.contains("fixed values"), "{point}");
}

#[test]
#[ignore = "slow: an orbit of a field is proved above, and symmetric orbits are found"]
fn symmetric_orbits_are_proved() {
    let wish = ["motion", "periodic", "figures/fig-A2", "--symmetric", "L=0", "--points", "40"];
    let found = json(&[&wish[..], &["--prove", "--json"]].concat(), 0);
    let points = found["points"].as_array().expect("points");
    assert!(!points.is_empty(), "symmetric orbits");
    for point in points {
        let theorem = point["theorem"].as_str().unwrap_or_default();
        let period = theorem.split(" period ").nth(1).and_then(|rest| rest.split(' ').next());
        let period: f64 = period.and_then(|text| text.parse().ok()).expect("a period");
        let gap = period - point["time"].as_f64().expect("a number");
        assert!(gap.abs() < 1e-10, "{point}");
    }
}
