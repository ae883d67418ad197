//! Values of integrals that are held, exponents of maps, and orbits that are stopped.

use std::fs;

use predicates::prelude::*;
use predicates::str::contains;
use serde_json::Value;

use crate::commands::{folder, json, liouville};

/// Restricted three-body problem as a field, with Jacobi's integral.
const THREE: &str = "title = 'three bodies'\n[parameters]\nmu = 0.0121505856\n[state]\n\
    x = '-2..2'\ny = '-2..2'\nu = '-2..2'\nv = '-2..2'\n[field]\n\"x'\" = 'u'\n\"y'\" = 'v'\n\
    \"u'\" = '2*v + x - (1-mu)*(x+mu)/((x+mu)^2+y^2)^(3/2) - mu*(x-1+mu)/((x-1+mu)^2+y^2)^(3/2)'\n\
    \"v'\" = '-2*u + y - (1-mu)*y/((x+mu)^2+y^2)^(3/2) - mu*y/((x-1+mu)^2+y^2)^(3/2)'\n\
    [[claim]]\nname = 'J'\nintegral = 'x^2 + y^2 + 2*(1-mu)/((x+mu)^2+y^2)^(1/2) \
    + 2*mu/((x-1+mu)^2+y^2)^(1/2) - u^2 - v^2'\n[[claim]]\nname = 'W'\nintegral = 'x^2 + y^2'\n\
    expect = 'open'\n";

const START: [&str; 4] = ["--start", "0.8234,0,0,0.1263", "--section", "y = 0"];

#[test]
fn orbits_of_the_restricted_three_body_problem_form_a_family_in_jacobis_integral() {
    let folder = folder("jacobi", &[("three.toml", THREE)]);
    let case = folder.join("three.toml").display().to_string();
    let periodic = |more: &[&str]| {
        liouville(&[&["motion", "periodic", &case], &START[..], more].concat()).assert()
    };
    periodic(&[]).success().stdout(contains("closed orbit of 1 crossing: hyperbolic"));
    periodic(&["--fix", "J=3.174356"]).success().stdout(contains("  proved: a closed orbit"));
    for (fix, message) in [
        ("K=1", "the case claims no scalar integral `K`"),
        ("W=1", "it is not proved that the motions keep `W`"),
        ("J", "`J` has no `=`"),
    ] {
        periodic(&["--fix", fix]).code(2).stderr(contains(message));
    }
    periodic(&["--fix", "J=3", "--fix", "J=3.1"]).code(2).stderr(contains("`J` is fixed twice"));
    let range = ["--parameter", "J", "--from", "3.16", "--to", "3.18", "--count", "4", "--json"];
    let found = json(&[&["motion", "continue", &case], &START[..], &range].concat(), 0);
    let points = found["points"].as_array().expect("points");
    assert!(points.len() > 4, "{found}");
    let periods: Vec<f64> =
        points.iter().filter_map(|point| point["period"]["value"].as_f64()).collect();
    assert!(periods.iter().all(|period| (2.6..2.9).contains(period)), "{found}");
}

#[test]
fn exponents_of_a_map_are_per_iterate() {
    let map = "title = 'Henon'\n[state]\nx = '-2..2'\ny = '-2..2'\n[map]\nx = '1 - 1.4*x^2 + y'\n\
        y = '0.3*x'\n";
    let folder = folder("henon", &[("henon.toml", map)]);
    let case = folder.join("henon.toml").display().to_string();
    let run = ["motion", "exponents", &case, "--start", "0,0"];
    let found = json(&[&run[..], &["--iterates", "2e4", "--json"]].concat(), 0);
    let orbit = &found["orbits"][0];
    let mean = |value: &Value| value["mean"].as_f64().expect("a number");
    assert!((mean(&orbit["largest"]) - 0.419).abs() < 0.01, "{found}");
    assert!((mean(&orbit["volume"]) - 0.3f64.ln()).abs() < 1e-9, "{found}");
    assert_eq!(orbit["class"], "strange attractor");
    let text = liouville(&[&run[..], &["--iterates", "1000", "--spectrum"]].concat()).assert();
    text.success().stdout(contains("0,0, n = 1000").and(contains("mean ln |det DΦ| -1.20397")));
    for (more, message) in [
        (["--time", "5"], "which has iterates and no time"),
        (["--iterates", "50"], "50 iterates are too few"),
    ] {
        liouville(&[&run[..], &more].concat()).assert().code(2).stderr(contains(message));
    }
}

#[test]
fn exponents_of_a_map_end_where_it_has_no_invertible_derivative() {
    let tent = "title = 'tent'\n[state]\nx = '-2..2'\n[map]\nx = '1 - 2*abs(x)'\n";
    let flat = "title = 'flat'\n[state]\nx = '-2..2'\ny = '-2..2'\n[map]\nx = '0*x'\n\
        y = '-y'\n";
    let folder = folder("underivable", &[("tent.toml", tent), ("flat.toml", flat)]);
    for (file, begin, message) in [
        ("tent.toml", "1/4", "the map has no derivative after 2 iterates, at x = 0.0"),
        ("flat.toml", "1,1", "det DΦ is 0 after 0 iterates, at x = 1.0"),
    ] {
        let case = folder.join(file).display().to_string();
        let found = liouville(&["motion", "exponents", &case, "--start", begin]).assert();
        found.code(2).stderr(contains(message));
    }
}

#[test]
fn an_orbit_that_is_stopped_says_where() {
    let text = "title = 'turn'\n[state]\nx = '-2..2'\ny = '-2..2'\n[field]\n\"x'\" = 'y'\n\
        \"y'\" = '-x'\n";
    let folder = folder("stopped", &[("turn.toml", text)]);
    let case = folder.join("turn.toml").display().to_string();
    let out = folder.join("rows.csv").display().to_string();
    let run = ["motion", "orbit", &case, "--start", "1,0", "--time", "1e9", "--within", "0.3"];
    let found = liouville(&[&run[..], &["--every", "1000", "--out", &out]].concat()).assert();
    found
        .code(3)
        .stdout(contains("ended early: stopped at t = "))
        .stderr(contains("error: not finished: stopped after 0.3 s"));
    let rows = fs::read_to_string(&out).expect("what comes before");
    assert!(rows.lines().count() > 2, "{rows}");
    // Crossings, and motions that come to their ends before.
    let surface = ["--section", "x=0", "--axes", "y", "--crossings", "1000000"];
    let section = ["motion", "section", &case, "--start", "1,0", "--within", "0.3"];
    let found = liouville(&[&section[..], &surface, &["--out", &out]].concat()).assert();
    found.code(3).stdout(contains("the motion was stopped"));
    let rows = fs::read_to_string(&out).expect("what comes before");
    assert!(rows.lines().count() > 2, "{rows}");
    // At 0 nothing turns, tangent vectors neither.
    let twist = text.replace("'y'\n", "'y*(x^2 + y^2)'\n").replace("'-x'", "'-x*(x^2 + y^2)'");
    let case = folder.join("twist.toml").display().to_string();
    fs::write(&case, twist).expect("a case");
    let exponents = ["motion", "exponents", &case, "--start", "0,0", "--start", "1,0"];
    let long = ["--time", "1e8", "--one-way", "--within", "0.3"];
    let found = liouville(&[&exponents[..], &long].concat()).assert();
    found.code(3).stdout(contains("0,0").and(contains("stopped")));
}

#[test]
fn exports_have_the_hyperbolic_tangent_of_their_language() {
    let text = "title = 'neuron'\n[state]\nx = '-2..2'\n[field]\n\"x'\" = '-x + 2*tanh(3*x)'\n";
    let folder = folder("tanh", &[("tanh.toml", text)]);
    let case = folder.join("tanh.toml").display().to_string();
    for (language, call) in
        [("c", "tanh("), ("python", "math.tanh("), ("julia", "tanh("), ("rust", "f64::tanh(")]
    {
        let found = liouville(&["export", &case, "--to", language]).assert().success();
        found.stdout(contains(call).and(contains("exp(").not()));
    }
}
