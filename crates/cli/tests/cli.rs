//! The program from the user's side: commands, exit codes, JSON, wrong input.

use std::fs;
use std::path::PathBuf;

use assert_cmd::Command;
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
        let arguments = ["check", "--json", "--threads", threads, "cases/plane", "cases/flat-base"];
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
        .stdout(contains("balanced ball"))
        .stdout(contains("1 file could not be judged"));
}

/// Each case: the mistake, the message, and the remedy it offers.
#[test]
fn wrong_input_gets_a_clear_message_and_exit_code_2() {
    let head = "title = 'x'\nsystem = 'rubber-plane'\n";
    let body = "[parameters]\nm = 1\nR = 2\nI = [1, 2, 2.5]\n[body]\nshape = 'ball'\n";
    let claim = |text: &str| format!("{head}{body}[[claim]]\nintegral = '{text}'\n");
    let field = |text: &str| format!("title = 'x'\n[state]\nx = '-1..1'\ny = '-1..1'\n{text}");
    let lagrangian = |system: &str, text: &str| {
        let state = "x = '-1..1'\ny = '-1..1'\n\"x'\" = '-1..1'\n\"y'\" = '-1..1'\n";
        format!("title = 'x'\nsystem = '{system}'\n[state]\n{state}[lagrangian]\n{text}\n")
    };
    let turning = |claim: &str| field(&format!("[field]\n\"x'\" = 'y'\n\"y'\" = '-x'\n{claim}\n"));
    let skate = "kinetic = \"x'² + y'²\"\nconstraints = [\"x*y' = x'\"]";
    let twice = "kinetic = \"x'² + y'²\"\nconstraints = [\"x*y' = x'\", \"2*x*y' = 2*x'\"]";
    let quasi = "kinetic = 'y²'\nquasi-velocities = ['y']\nalgebra = 'so(4)'";
    let exists = |more: &str, kind: &str| {
        format!("{head}{body}{more}[[claim]]\n{kind}-density = 'exists'\n")
    };
    let moved = "[state]\ns = '-1..1'\n[field]\n\"s'\" = '2*s'\n";
    let twisted = exists("", "position")
        .replace("shape = 'ball'", "contact = 'vec(−γ2*(1 + γ1), γ1*(1 + γ1), 0)'");
    let bent = "title = 'x'\nsystem = 'nonholonomic'\n[state]\nx = '1..2'\nu = '1..2'\n[field]\n\"x'\" = 'u²'\n\
                [lagrangian]\nkinetic = 'u^4/2'\npotential = 'x'\nquasi-velocities = ['u']\n";
    let deep = format!("{}γ{}", "(".repeat(100_000), ")".repeat(100_000));
    let cases: Vec<(&str, String, &str, &str)> = vec![
        ("empty", String::new(), "the file is empty", "writing-a-case"),
        ("not-toml", "title = ".into(), "not-toml.toml:1", ""),
        ("no-system", "title = 'x'\n".into(), "has no `system`", "rubber-plane"),
        ("system", "title = 'x'\nsystem = 'rubber-plain'".into(), "unknown system", "rubber-plane"),
        (
            "key",
            format!("titel = 'x'\n{head}{body}"),
            "unknown key `titel`",
            "did you mean `title`",
        ),
        ("unknown-name", claim("Jtild*ω"), "unknown name", ""),
        ("times", claim("2*m*R(γ,ω)"), "missing `*`", "write `R*(γ,ω)`"),
        ("kinds", claim("ω3 + γ"), "scalar", ""),
        ("bracket", claim("((γ,ω)"), "bracket", ""),
        ("weights", claim("(γ,γ) + ω3"), "unequal weight", "check-weights"),
        (
            "vector",
            claim("γ").replace("integral", "density"),
            "should be a scalar, but this is a vector",
            "",
        ),
        ("deep", claim(&deep), "nested too deeply", ""),
        ("nan", format!("{head}{}", body.replace("m = 1", "m = nan")), "is not a number", ""),
        ("range", format!("{head}{}", body.replace("m = 1", "m = '2..1'")), "is empty", ""),
        (
            "singular",
            format!("{head}{}", body.replace("m = 1", "m = 0").replace("[1, 2, 2.5]", "[0, 0, 0]")),
            "equations of motion are undefined",
            "singular inertia",
        ),
        (
            "unreachable",
            field("[field]\n\"x'\" = 'y'\n\"y'\" = '-x'\n[level]\nequations = ['x² + y² = -1']\n"),
            "no state on the level set",
            "[level]",
        ),
        (
            "leaves",
            field("[field]\n\"x'\" = '1'\n\"y'\" = 'x'\n[level]\nequations = ['x² + y² = 1']\n"),
            "the level set is not invariant",
            "correct the equation",
        ),
        (
            "criterion",
            field("[field]\n\"x'\" = 'y'\n\"y'\" = '-x'\n[[claim]]\nanalytic-density = 'exists'\n"),
            "decided by a criterion",
            "",
        ),
        (
            "damped",
            exists("moment = '−ω'\n", "analytic"),
            "`moment` depends on `ω`",
            "state a density instead",
        ),
        ("added", exists(moved, "analytic"), "no variables that [state] adds", "without them"),
        ("growing", exists(moved, "position"), "leaves out the divergence", "without them"),
        ("twisted", twisted, "∂r is not symmetric across γ", "state a density instead"),
        (
            "bent",
            bent.into(),
            "the rate of `x` is not linear in the velocities",
            "other quasi-velocities",
        ),
        (
            "block",
            turning("[variables]\nX = 'x'\nY = 'y'\n[poisson]\n'X,Y' = '1'\n'Y,X' = '1'"),
            "the block Y,X is given already",
            "follows from skewness",
        ),
        (
            "own-potential",
            format!("{head}{body}potential = 'U'"),
            "`potential` depends on `U`, which it determines",
            "by γ, h and the parameters",
        ),
        (
            "own-surface",
            format!("{head}[let]\nw = '2*h'\n{body}").replace("shape = 'ball'", "support = 'w'"),
            "`support` depends on `h`, which it determines",
            "by γ and the parameters",
        ),
        (
            "own-surface-of-a-ball",
            "title = 'x'\nsystem = 'ball-on-surface'\n[parameters]\nm = 1\nR = 2\nmu = 1\n[body]\nsupport = 'h'"
                .into(),
            "`support` depends on `h`, which it determines",
            "by γ and the parameters",
        ),
        (
            "own-reaction",
            lagrangian("nonholonomic", "kinetic = \"x'² + y'²\"\nconstraints = ['μ = 0']"),
            "each side may depend on the state and parameters only, not on `μ`",
            "",
        ),
        ("nothing-moved", turning("[[claim]]\nreversor = {}"), "names nothing that is moved", "image"),
        ("no-map", turning("[[claim]]\nmap = {}\nfield = {}"), "names no new variable", "give one"),
        (
            "no-time",
            turning("[[claim]]\nsymmetry = { x = '0*x', y = '0*y' }\ntime = '1 − 1'"),
            "`time` is 0",
            "t → λt",
        ),
        (
            "moving-time",
            turning("[[claim]]\nsymmetry = { x = 'x', y = 'y' }\ntime = '1 + x − x'"),
            "`time` depends on the state",
            "write λ by numbers and parameters",
        ),
        (
            "surface",
            "title = 'x'\nsystem = 'ball-on-surface'\n[parameters]\nm = 1\nR = 2\nmu = 1\n[body]\nsurface = '(r,γ)'"
                .into(),
            "may depend on r and parameters only, not on `γ`",
            "",
        ),
        (
            "own-energy",
            lagrangian("nonholonomic", "kinetic = \"x'² + y'²\"\npotential = 'energy'"),
            "may depend on the state and parameters only",
            "",
        ),
        (
            "feedback",
            format!("{head}{body}moment = \"ω'\""),
            "feedback.toml:9:10",
            "by the state, r, r' and γ'",
        ),
        (
            "tiny-range",
            field("[field]\n").replace("x = '-1..1'", "x = '-1e-400..1e-400'"),
            "beyond the numbers that f64 can hold",
            "-2..2",
        ),
        (
            "singular-level",
            turning("[level]\nequations = ['(x² + y²)^3 = 0']"),
            "no state on the level set",
            "may not all vanish",
        ),
        ("no-level", turning("[level]\nequations = ['1 = 0']"), "on no state variable", "remove"),
        (
            "open-level",
            turning("[level]\nequations = ['y = ∫(x, x)']"),
            "contains an ∫, whose constant is open",
            "write the antiderivative out",
        ),
        (
            "open-point",
            turning("[[claim]]\nfixed-point = { x = '∫(1, 2)' }"),
            "a point has no ∫ in it",
            "write the antiderivative out",
        ),
        (
            "open-slope",
            turning("[parameters]\ne = '1..2'\n[[claim]]\nlimit = '∫(e*x, x)'\nequals = '∫(0*x, x)'\nslope = '0'\nparameter = 'e'"),
            "the slope of an ∫ by a parameter is open",
            "write the antiderivative out",
        ),
        ("kinetic", lagrangian("nonholonomic", ""), "has no `kinetic`", "add kinetic"),
        ("multipliers", lagrangian("vakonomic", skate), "0 multipliers", "multipliers = [\"λ\"]"),
        ("dependent", lagrangian("nonholonomic", twice), "depends on those before", "remove"),
        ("algebra", lagrangian("nonholonomic", quasi), "is no algebra that is known", "so(3)"),
        ("variables", turning("[[claim]]\ncasimir = 'x'"), "has none", "add [variables]"),
        (
            "two",
            turning("[[claim]]\nintegral = 'x'\ndensity = '1'"),
            "this claim makes 2 statements",
            "a [[claim]] for each",
        ),
        ("rate", field("[field]\n\"x'\" = 'y'\n"), "has no rate for `y`", "y'"),
    ];
    for (name, text, message, remedy) in cases {
        let path = folder("wrong", &[(&format!("{name}.toml"), &text)]);
        liouville(&["check", path.to_str().expect("UTF-8")])
            .assert()
            .code(2)
            .stdout(contains(message))
            .stdout(contains(remedy));
    }
    liouville(&["check", "no-such-folder"]).assert().code(2).stdout(contains("cannot read"));
    let huge = format!("#{}", "x".repeat(5 << 20));
    let path = folder("huge", &[("huge.toml", &huge)]);
    liouville(&["check", path.to_str().expect("UTF-8")]).assert().code(2).stdout(contains("bytes"));
}

#[test]
fn eval_refuses_what_it_does_not_understand() {
    let path = folder("eval", &[("good.toml", GOOD)]).join("good.toml");
    let path = path.to_str().expect("UTF-8");
    let refused = [
        (vec!["--set", "q=1"], "there is no parameter `q`"),
        (vec!["--set", "m"], "not of the form name=value"),
        (vec!["--state", "ω=[1,2]"], "has 3 components"),
        (vec!["--state", "ω=[1,2,3]"], "no value for `γ`"),
        (vec!["--state", "ω=[1,2,x] γ=[0,0,1]"], "is not a number"),
        (vec!["--state", "v=[1,2,3]"], "is no state variable"),
    ];
    for (options, message) in refused {
        let mut arguments = vec!["eval", path];
        arguments.extend(&options);
        liouville(&arguments).assert().code(2).stderr(contains(message));
    }
    let bare = "title = 'x'\n[state]\nx = '-1..1'\n[field]\n\"x'\" = '-x'\n";
    let path = folder("bare", &[("bare.toml", bare)]).join("bare.toml");
    liouville(&["eval", path.to_str().expect("UTF-8"), "--set", "x=1"])
        .assert()
        .code(2)
        .stderr(contains("this case has no parameters"));
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
        let told = String::from_utf8_lossy(&output.stdout).contains("has a meaning of its own");
        assert_eq!(told, warned, "{taken}");
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
fn both_tables_come_out_of_the_catalogue() {
    for (number, columns) in [("1", 6), ("2", 8)] {
        let table = json(&["table", number, "--json"], 0);
        assert_eq!(table["columns"].as_array().map(Vec::len), Some(columns), "table {number}");
        for row in table["rows"].as_array().expect("rows") {
            for cell in row["cells"].as_array().expect("cells") {
                assert_ne!(cell["status"], "contradicts", "{row}");
            }
        }
        liouville(&["table", number]).assert().code(0).stdout(contains("proved"));
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
    let numerical = "title = 'circle'\n[state]\nx = '-2..2'\ny = '-2..2'\n[field]\n\"x'\" = 'y*(x² + 3*y²)'\n\
         \"y'\" = '−x*(x² + 3*y²)'\n[level]\nequations = ['x^4 + y^4 + 2*x²*y² = 1']\n[[claim]]\n\
         integral = 'x² + y²'\n";
    let path = folder("numerical", &[("circle.toml", numerical)]).join("circle.toml");
    let path = path.to_str().expect("UTF-8");
    let seen = json(&["check", "--json", path], 0);
    assert_eq!(seen["cases"][0]["claims"][0]["verdict"], "confirmed", "no chart, no proof");
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

#[test]
fn stress_reports_no_wrong_verdict() {
    let report = json(&["stress", "--json"], 0);
    let verdicts = &report["verdicts"];
    assert!(verdicts["judged"].as_u64().expect("a count") > 3000, "{verdicts}");
    assert_eq!(verdicts["wrong"], 0, "{verdicts}");
    let points = report["scenarios"][0]["points"].as_array().expect("points");
    assert!(points.iter().all(|point| point["field"].is_number()), "digits lost at each x");
}

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
    for ending in ["svg", "png"] {
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
    fails(&["section", &case, "--g0", "tomorrow"], "is no angle");
    fails(
        &["section", &case, "--start", "1,0", "--crossings", "1", "--out", "x.gif"],
        "neither .svg",
    );
    let free = folder("no-section", &[("free.toml", GOOD)]).join("free.toml");
    fails(&["section", free.to_str().expect("UTF-8")], "no [section]");
}

#[test]
fn charts_count_what_they_colour_and_draw_the_same_bytes() {
    let folder = folder("chart", &[]);
    let case = figure("fig-8");
    let plane = ["--x", "a_g=5..25", "--y", "c3=0..1", "--size", "6x4", "--time", "20"];
    for ending in ["svg", "png"] {
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
    assert!(drawn.contains("class=\"mark\""), "the saddle is marked");
    liouville(&["section", &figure("fig-3"), "--out", out, "--separatrices", "1.5,0.02"])
        .assert()
        .code(2)
        .stderr(contains("no hyperbolic one"));
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
