//! Messages about inputs that textbooks suggest: values to give back, starts, levels of energy.

use predicates::prelude::*;
use predicates::str::contains;

use crate::commands::{folder, json, liouville};

const BODY: &str = "title = 'body'\nsystem = 'rolling-plane'\n[parameters]\nm = 1\nR = 1\n\
    I = 'axisymmetric(0.2..0.5)'\ng = 9.81\n[body]\nshape = 'disk'\npotential = 'm*g*h'\n";

const PENDULUM: &str = "title = 'pendulum'\n[state]\n\"θ\" = '-pi..pi'\n\"θ'\" = '-2..2'\n[lagrangian]\n\
    kinetic = \"θ'²/2\"\npotential = '−cos(θ)'\n[[claim]]\nintegral = 'energy'\n[[claim]]\n\
    reversor = { \"θ\" = '-θ' }\n[[claim]]\nindependent = ['energy', 'θ']\n[[claim]]\ndensity = '1'\n\
    [[claim]]\nintegral = 'θ'\nexpect = 'fails'\n";

const FORCED: &str = "title = 'forced'\n[state]\nx = '-2..2'\nv = '-2..2'\n[field]\nx = 'v'\n\
    v = '-x^3 - v/5 + cos(t)'\n";

fn written(name: &str, text: &str) -> String {
    folder(name, &[("case.toml", text)]).join("case.toml").display().to_string()
}

fn printed(arguments: &[&str]) -> String {
    let output = liouville(arguments).assert().success().get_output().stdout.clone();
    String::from_utf8(output).expect("text")
}

#[test]
fn parameters_are_printed_as_they_are_set() {
    let case = written("printed-parameters", BODY);
    let text = printed(&["eval", &case]);
    let row = text.lines().find(|line| line.starts_with("I ")).expect("the parameter");
    let value = row.trim_start_matches('I').trim();
    assert_eq!(value.matches(',').count(), 2, "a diagonal: {row}");
    let set = format!("I={value}");
    let again = printed(&["eval", &case, "--set", &set]);
    assert!(!again.lines().any(|line| line.starts_with("I ")), "it is fixed:\n{again}");
    let orbit = printed(&["motion", "orbit", &case, "--time", "1"]);
    assert!(orbit.contains(&format!("drawn with seed 1: I = {value}")), "{orbit}");
}

#[test]
fn a_disk_is_called_a_disk() {
    let report = json(&["report", &written("disk", BODY), "--json"], 0);
    let sentence = report["sentence"].as_str().expect("a sentence");
    assert!(sentence.starts_with("A disk rolls on a plane without slipping"), "{sentence}");
}

#[test]
fn claims_without_names_are_told_by_kind_and_statement() {
    let case = written("unnamed", PENDULUM);
    let text = printed(&["check", &case]);
    assert!(text.contains("θ → -θ") && text.contains("energy, θ"), "{text}");
    let report = printed(&["report", &case]);
    let claimed = report.split("Claims of the case").nth(1).expect("the section");
    for words in ["reversor", "θ → -θ", "density", "independent", "as the file expects"] {
        assert!(claimed.contains(words), "{words}:\n{claimed}");
    }
    assert!(
        report.contains("in -3.141592653589793..3.141592653589793") || !report.contains("θ in")
    );
}

#[test]
fn an_energy_that_no_state_has_is_told_with_those_that_they_have() {
    let case = written("energies", PENDULUM);
    let section = ["motion", "section", &case, "--section", "θ=0", "--energy", "-100"];
    let message =
        contains("no state with energy = -100").and(contains("drawn states have values from"));
    liouville(&section).assert().code(2).stderr(message);
}

#[test]
fn nothing_closes_beside_a_clock() {
    let case = written("forced", FORCED);
    let closed = ["motion", "periodic", &case, "--start", "1,0,0", "--time", "6.283"];
    let message = contains("no motion closes").and(contains("c' = -w*s"));
    liouville(&closed).assert().code(2).stderr(message);
    let claim = "[[claim]]\nclosed-orbit = 6.283\nstate = { x = '1', v = '0', t = '0' }\n";
    let claimed = written("forced-claim", &format!("{FORCED}{claim}"));
    let found = liouville(&["check", &claimed, "--motion", "-v"]).assert();
    found.stdout(contains("`t` is a variable of rate 1"));
}

#[test]
fn a_start_without_all_values_is_told_with_an_example() {
    let case = written("starts", PENDULUM);
    let orbit = ["motion", "orbit", &case, "--start", "θ=1"];
    let message = contains("no value for `θ'`").and(contains(r"'θ=1 θ'\''=1'"));
    liouville(&orbit).assert().code(2).stderr(message);
}
