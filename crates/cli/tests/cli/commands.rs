//! The program from the user's side: commands, exit codes, JSON, wrong input.

mod basins;
mod bodies;
mod branches;
mod grounds;
mod held;
mod iterates;
mod keys;
mod limits;
mod lines;
mod motion;
mod near;
mod orbits;
mod parts;
mod pictures;
mod site;
mod start;
mod stress;
mod tables;
mod textbook_inputs;
mod watch;
mod wrong;

use std::fs;
use std::path::PathBuf;

use assert_cmd::Command;
use predicates::prelude::PredicateBooleanExt;
use predicates::str::contains;
use serde_json::Value;

fn liouville(arguments: &[&str]) -> Command {
    let mut command = Command::cargo_bin("liouville").expect("the binary is built");
    // paths are given from the top of the tree
    command.current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
    command.args(arguments);
    command
}

/// Makes a separate scratch folder for a test.
fn folder(name: &str, files: &[(&str, &str)]) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).expect("a scratch folder");
    for (file, text) in files {
        fs::write(path.join(file), text).expect("a scratch file");
    }
    path
}

fn json(arguments: &[&str], code: i32) -> Value {
    let output = liouville(arguments).output().expect("it runs");
    assert_eq!(output.status.code(), Some(code), "exit code of {arguments:?}");
    serde_json::from_slice(&output.stdout).expect("JSON on standard output")
}

const GOOD: &str = r#"
title = "balanced ball"
system = "rubber-plane"
[parameters]
m = "0.5..2"
R = "1..3"
I = "inertia(0.5..5)"
[body]
shape = "ball"
[[claim]]
name = "F2"
integral = "|J*ω × γ|²"
[[claim]]
name = "without the root"
density = "(γ,J⁻¹*γ)"
expect = "fails"
"#;

#[test]
fn check_reports_in_the_documented_form() {
    let path = folder("form", &[("good.toml", GOOD)]);
    let report = json(&["check", "--json", path.to_str().expect("UTF-8")], 0);
    assert_eq!(report["seed"], 1, "the seed is printed");
    let case = &report["cases"][0];
    assert_eq!(case["title"], "balanced ball", "with title, system and claims");
    assert_eq!(case["system"], "rubber-plane");
    let claim = &case["claims"][0];
    for key in ["name", "kind", "source", "where", "expect", "verdict", "agrees", "evidence"] {
        assert!(claim.get(key).is_some(), "a claim has `{key}`");
    }
    assert_eq!(claim["verdict"], "proved");
    let evidence = &claim["evidence"];
    let keys = ["method", "primes", "points", "draws", "degree", "roots", "error_log2"];
    for key in keys.iter().chain(&["samples", "max_residual", "max_scaled_residual", "climb"]) {
        assert!(evidence.get(key).is_some(), "evidence has `{key}`");
    }
    assert!(evidence["error_log2"].as_f64().expect("a number") < -100.0, "the error is stated");
    let summary = &report["summary"];
    for key in ["cases", "claims", "proved", "confirmed", "refuted", "undecided", "disagreements"] {
        assert!(summary[key].is_u64(), "the summary counts `{key}`");
    }
    assert!(summary["seconds"].is_f64(), "and tells the time");
}

#[test]
fn a_witness_is_reproduced_by_eval() {
    let path = folder("witness", &[("good.toml", GOOD)]).join("good.toml");
    let path = path.to_str().expect("UTF-8");
    let report = json(&["check", "--json", path], 0);
    let witness = &report["cases"][0]["claims"][1]["evidence"]["witness"];
    let mut arguments: Vec<String> = vec!["eval".into(), path.into(), "--json".into()];
    for (name, value) in witness["parameters"].as_object().expect("parameters") {
        arguments.push("--set".into());
        arguments.push(format!("{name}={}", value.as_str().expect("text")));
    }
    arguments.push("--state".into());
    arguments.push(witness["state"].as_str().expect("a state").into());
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let point = json(&arguments, 0);
    let claim = &point["claims"]["without the root"];
    let again: f64 = claim["residual"].as_str().expect("text").parse().expect("a decimal");
    let bound: f64 = claim["residual_error"].as_str().expect("text").parse().expect("a decimal");
    let first = witness["residual"].as_f64().expect("a number");
    let allowed = bound + witness["error_bound"].as_f64().expect("a number");
    assert!((again - first).abs() <= allowed, "{again} against {first}");
    assert!(again.abs() > bound, "and it excludes zero here too");
}

#[test]
fn the_same_seed_gives_the_same_bytes_for_any_number_of_threads() {
    let run = |threads: &str| {
        let arguments =
            ["check", "--json", "--threads", threads, "cases/flat-base", "cases/surface"];
        let mut report = json(&arguments, 0);
        report["summary"]["seconds"] = Value::Null;
        report.to_string()
    };
    let one = run("1");
    assert!(one == run("2") && one == run("7"), "only the time may differ");
}

#[test]
fn another_seed_gives_other_states_and_the_same_verdicts() {
    let path = folder("seed", &[("good.toml", GOOD)]);
    let path = path.to_str().expect("UTF-8");
    let (one, two) =
        (json(&["check", "--json", path], 0), json(&["check", "--json", "--seed", "2", path], 0));
    let witness = |report: &Value| report["cases"][0]["claims"][1]["evidence"]["witness"].clone();
    assert_ne!(witness(&one)["state"], witness(&two)["state"], "other states");
}

#[test]
fn a_disagreement_exits_with_1() {
    let wrong = GOOD.replace("expect = \"fails\"", "expect = \"holds\"");
    let path = folder("disagreement", &[("wrong.toml", &wrong)]);
    liouville(&["check", path.to_str().expect("UTF-8")])
        .assert()
        .code(1)
        .stdout(contains("expected: holds"));
}

#[test]
fn one_bad_file_does_not_stop_the_others() {
    let path = folder("mixed", &[("a-bad.toml", "title = "), ("b-good.toml", GOOD)]);
    liouville(&["check", path.to_str().expect("UTF-8")])
        .assert()
        .code(2)
        .stdout(contains("b-good.toml: 1 proved"))
        .stdout(contains("1 file could not be judged"));
}

#[test]
fn what_is_impossible_but_meaningful_runs_with_a_warning() {
    let text = GOOD
        .replace("R = \"1..3\"", "R = -2\nc = [0, 3, 0]")
        .replace("\"inertia(0.5..5)\"", "[1, 1, 5]")
        .replace("|J*ω × γ|²", "energy")
        .replace("without the root\"\ndensity = \"(γ,J⁻¹*γ)\"", "ω1\"\nintegral = \"ω1\"");
    let path = folder("impossible", &[("impossible.toml", &text)]);
    liouville(&["check", path.to_str().expect("UTF-8")])
        .assert()
        .code(0)
        .stdout(contains("triangle inequality"))
        .stdout(contains("not convex"))
        .stdout(contains("outside the ball"));
}

#[test]
fn a_reaction_by_definition_is_named() {
    let text = |constraint: &str| {
        format!(
            "title = 'x'\nsystem = 'nonholonomic'\n[state]\nx = '1..2'\ny = '1..2'\ns = '0..1'\n\"x'\" = '1..2'\n\
             \"y'\" = '1..2'\n[field]\n\"s'\" = \"√(x'² + y'²)\"\n[lagrangian]\nkinetic = \"(x'² + y'²)/2\"\n\
             constraints = [\"{constraint}\"]\n[[claim]]\nintegral = 'energy'\n"
        )
    };
    for (constraint, warned) in [("x'² = y*y'²", true), ("x' = y*y'", false)] {
        let path = folder("chetaev", &[("case.toml", &text(constraint))]);
        let report = json(&["check", "--json", path.to_str().expect("UTF-8")], 0);
        let warnings = report["cases"][0]["warnings"].to_string();
        assert_eq!(warnings.contains("Chetaev's rule"), warned, "{constraint}: {warnings}");
    }
}

#[test]
fn names_that_a_file_takes_from_the_system_are_told() {
    for (taken, warned) in [("J", true), ("γ3", true), ("E", true), ("energy", true), ("q", false)]
    {
        let text = "title = 'x'\nsystem = 'rubber-plane'\n[parameters]\nm = 1\nR = 2\nI = [1, 2, 2.5]\n\
                    TAKEN = 2\n[body]\nshape = 'ball'\n[[claim]]\nintegral = '(γ,γ)'\n";
        let text = text.replace("TAKEN", &format!("\"{taken}\""));
        let path = folder("hidden", &[("case.toml", &text)]);
        let output =
            liouville(&["check", path.to_str().expect("UTF-8")]).output().expect("it runs");
        let told = String::from_utf8_lossy(&output.stdout).contains("already has a meaning here");
        assert_eq!(told, warned, "{taken}");
    }
}

#[test]
fn a_hidden_component_is_written_with_its_index() {
    for name in ["x2", "x_2"] {
        let text = format!(
            "title = 'x'\n[parameters]\n{name} = '1..2'\n[state]\nx = 'vector(3, -2..2)'\n[field]\n\
             \"x'\" = '0*x'\n[[claim]]\nintegral = '{name}'\n"
        );
        let path = folder("component", &[("case.toml", &text)]);
        let output =
            liouville(&["check", path.to_str().expect("UTF-8")]).output().expect("it runs");
        let report = String::from_utf8_lossy(&output.stdout).into_owned();
        assert!(report.contains("write x[2] for the component"), "{report}");
    }
}

#[test]
fn what_has_nothing_to_show_shows_nothing() {
    liouville(&["table", "1", "no-such-folder"])
        .assert()
        .code(2)
        .stdout("")
        .stderr(contains("cannot read"))
        .stderr(contains("no case belongs to table 1"));
    liouville(&["stress", "--bodies", "0"]).assert().code(2).stderr(contains("0 is not in 1.."));
}

#[test]
fn check_tells_what_is_recorded() {
    for (case, line) in [
        ("plane/balanced-ball", "; not recorded: potential, moment, rotor, curvature"),
        ("plane/balanced-ball-gyrostat", ", of which rotor "),
        ("plane/balanced-ball-brun", ", of which potential "),
        ("sphere/balanced-ball", "; not recorded: potential, moment, rotor"),
    ] {
        let told = liouville(&["check", case, "-v"]).output().expect("it runs");
        let told = String::from_utf8_lossy(&told.stdout).into_owned();
        let found = told.lines().find(|line| line.starts_with("  equations: "));
        assert!(found.is_some_and(|found| found.contains(line)), "{case}: {found:?}");
        liouville(&["check", case]).assert().stdout(contains("equations: ").not());
    }
}

#[test]
fn claims_are_selected_by_what_they_state() {
    let text = GOOD
        .replace("title", "source = \"BMB 2013, §3.4\"\ntitle")
        .replace("integral =", "source = \"(3.18), Theorem 2.2\"\nintegral =");
    let path = folder("labels", &[("good.toml", &text)]);
    let path = path.to_str().expect("UTF-8");
    let found = |labels: &[&str]| {
        let options: Vec<&str> = labels.iter().flat_map(|label| ["--source", label]).collect();
        let report = json(&[&["check", "--json", path], options.as_slice()].concat(), 0);
        report["summary"]["claims"].as_u64()
    };
    assert_eq!(found(&["§3.4"]), Some(2), "a label of the case is one of its claims");
    assert_eq!(found(&["(3.18)"]), Some(1), "an equation");
    assert_eq!(found(&["Theorem ?.2"]), Some(1), "a pattern");
    assert_eq!(found(&["(9.9)", "Theorem 2.2"]), Some(1), "one of several");
    for label in ["(3.1", "Theorem 2"] {
        liouville(&["check", path, "--source", label])
            .assert()
            .code(2)
            .stderr(contains(format!("no claim has a name or source like `{label}`")));
    }
}

#[test]
fn trust_says_what_is_insisted_on() {
    let near = GOOD.replace("|J*ω × γ|²", "|J*ω × γ|² + 1e-16*(J*ω,J*ω)");
    let path = folder("trust", &[("good.toml", GOOD), ("near.toml", &near)]);
    let good = path.join("good.toml");
    let good = good.to_str().expect("UTF-8");
    let verdict = |trust: &str| {
        let report = json(&["check", "--json", "--trust", trust, good], 0);
        report["cases"][0]["claims"][0]["verdict"].as_str().map(String::from)
    };
    assert_eq!(verdict("float").as_deref(), Some("confirmed"), "no proof is tried");
    assert_eq!(verdict("proof").as_deref(), Some("proved"), "a proof is found");
    let near = path.join("near.toml");
    let near = near.to_str().expect("UTF-8");
    let seen = json(&["check", "--json", "--trust", "float", near], 0);
    assert_eq!(seen["cases"][0]["claims"][0]["verdict"], "confirmed", "f64 cannot tell");
    let seen = json(&["check", "--json", near], 1);
    assert_eq!(seen["cases"][0]["claims"][0]["verdict"], "refuted", "more digits can");
    let numerical = "title = 'curve'\n[state]\nx = '-2..2'\ny = '-2..2'\n[field]\n\"x'\" = '5*y^4 + 1'\n\
         \"y'\" = '−5*x^4 − 1'\n[level]\nequations = ['x^5 + x + y^5 + y = 1']\n[[claim]]\n\
         integral = 'x^5 + x + y^5 + y'\n[[claim]]\nidentity = 'exp(x^5 + x) = exp(1 − y − y^5)'\n";
    let path = folder("numerical", &[("curve.toml", numerical)]).join("curve.toml");
    let path = path.to_str().expect("UTF-8");
    let seen = json(&["check", "--json", path], 0);
    assert_eq!(seen["cases"][0]["claims"][0]["verdict"], "proved", "it holds in the plane");
    assert_eq!(seen["cases"][0]["claims"][1]["verdict"], "confirmed", "no chart, no proof");
    let seen = json(&["check", "--json", "--trust", "proof", path], 1);
    assert_eq!(seen["summary"]["disagreements"], 1, "which is not enough for a proof");
}

#[test]
fn mutants_are_counted() {
    let path = folder("mutants", &[("good.toml", GOOD)]);
    let report = json(&["check", "--json", "--mutants", path.to_str().expect("UTF-8")], 0);
    let mutants = &report["summary"]["mutants"];
    assert!(mutants["killed"].as_u64().expect("a count") >= 5, "{mutants}");
    assert_eq!(mutants["survived"], 0, "{mutants}");
    assert!(mutants["equivalent"].is_u64() && mutants["discovered"].is_u64(), "{mutants}");
}

#[test]
fn mutants_are_those_of_the_claims_that_are_meant() {
    let top = "title = 'top'\n[parameters]\nI = 'inertia(0.5..5)'\n[state]\nM = 'vector(-2..2)'\n\
               \"γ\" = 'vector(-1..1)'\n[field]\n\"M'\" = 'M × inverse(I)*M'\n\"γ'\" = 'γ × inverse(I)*M'\n\
               [[claim]]\nname = 'energy'\nintegral = '(M,inverse(I)*M)'\n[[claim]]\nintegral = '(M,γ)'\n";
    let path = folder("mutants-meant", &[("top.toml", top)]);
    let path = path.to_str().expect("UTF-8");
    let mutants = |more: &[&str]| {
        let report = json(&[&["check", "--json", "--mutants", path], more].concat(), 0);
        report["cases"][0]["mutants"].clone()
    };
    let discovered = |of: &Value| -> Vec<String> {
        let all = of["discovered"].as_array().expect("a list");
        all.iter().map(|one| one["formula"].as_str().expect("text").to_string()).collect()
    };
    let (all, energy) = (mutants(&[]), mutants(&["--claim", "energy"]));
    assert_eq!(discovered(&all), ["(M,M)", "(γ,γ)", "(M,M)"], "{all}");
    assert_eq!(discovered(&energy), ["(M,M)"], "{energy}");
}

#[test]
fn digits_are_all_right() {
    let evaluate = |digits: &str| {
        let arguments = [
            "eval",
            "cases/plane/unbalanced-ball.toml",
            "--json",
            "--digits",
            digits,
            "--state",
            "ω=[3/7,0,-1/7] γ=[2/7,3/7,6/7]",
        ];
        json(&arguments, 0)
    };
    let (short, long) = (evaluate("30"), evaluate("60"));
    let fields = |report: &Value| -> Vec<String> {
        let field = report["field"].as_array().expect("a list");
        field.iter().map(|x| x.as_str().expect("text").to_string()).collect()
    };
    for (short, long) in fields(&short).iter().zip(fields(&long)) {
        let digits = |text: &str| text.chars().filter(char::is_ascii_digit).collect::<String>();
        let significant = |text: &str| digits(text).trim_start_matches('0').to_string();
        let kept: String = significant(&long).chars().take(29).collect();
        assert!(significant(short).starts_with(&kept[..28]), "{short} and {long}");
        assert_eq!(significant(short).len(), 30, "thirty digits: {short}");
    }
    assert_eq!(short["claims"]["F2"]["residual"], "0", "a residual that vanishes is 0");
    liouville(&["eval", "cases/plane/disk.toml", "--digits", "0"]).assert().code(2);
}
