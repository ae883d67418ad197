//! Formulas without a value: `eval` and the exported programs have none either.

use std::fs;

use serde_json::Value;

use super::{is_there, liouville, number, run, scratch};

/// Formulas, each the rate of a variable of its own, with states and whether they have a value.
const FORMULAS: [(&str, &[(&str, bool)]); 16] = [
    ("x^(-2)*0", &[("0", false), ("2", true)]),
    ("x^(−2)", &[("0", false), ("-2", true)]),
    ("x^(1/3)*0", &[("-1", false), ("0", false), ("1", true)]),
    ("x^(1/3)", &[("-8", false), ("0", false), ("8", true)]),
    ("x^(4/3)", &[("-1", false), ("1", true)]),
    ("0*ln(x)", &[("0", false), ("-1", false), ("1", true)]),
    ("ln(x)", &[("0", false), ("3", true)]),
    ("x/x", &[("0", false), ("2", true)]),
    ("(x − x)/(x − x)", &[("1", false)]),
    ("√x*√x", &[("-1", false), ("0", true), ("4", true)]),
    ("0*√x", &[("-1", false), ("4", true)]),
    ("x^y", &[("-8", false), ("0", false), ("2", true)]),
    ("0*x^y", &[("-8", false), ("0", false), ("2", true)]),
    ("|x|/x", &[("0", false), ("-3", true)]),
    ("x^9007199254740993", &[("1", true)]),
    ("x^0 + |x| + x^7", &[("0", true), ("-1", true)]),
];

/// The value of y, by which powers of x are even, odd and neither.
const Y: [&str; 3] = ["3", "-1", "5/2"];

struct Trial {
    formula: &'static str,
    case: String,
    /// States as numbers, with the value of `eval`.
    states: Vec<([f64; 2], Option<f64>)>,
}

fn case(formula: &str) -> String {
    format!(
        "title = \"undefined\"\n[state]\nx = \"-2..2\"\ny = \"-2..2\"\n[field]\n\"x'\" = \"{formula}\"\n\
         \"y'\" = \"0\"\n[[claim]]\nname = \"F\"\nintegral = \"{formula}\"\n"
    )
}

/// Judges all formulas by `eval`, and compares with what is expected.
fn trials(language: &str) -> Vec<Trial> {
    let folder = scratch(&format!("undefined-cases-{language}"));
    let mut all = Vec::new();
    for (index, (formula, known)) in FORMULAS.into_iter().enumerate() {
        let path = folder.join(format!("case{index}.toml"));
        fs::write(&path, case(formula)).expect("a file");
        let path = path.display().to_string();
        let mut states = Vec::new();
        for (x, is_defined) in known {
            for y in Y {
                let state = format!("x={x} y={y}");
                let text = liouville(&["eval", &path, "--json", "--state", &state]);
                let report: Value = serde_json::from_str(&text).expect("JSON");
                let rate = report["field"][0].as_str().map(number);
                assert_eq!(rate.is_some(), *is_defined, "{formula} at {state}: {rate:?}");
                assert_eq!(report["field"][1].is_null(), !is_defined, "a state without a field");
                let value = &report["claims"]["F"]["value"];
                let value = value.get(0).unwrap_or(value).as_str().map(number);
                assert_eq!(value, rate, "{formula} at {state}, as a claim");
                if !is_defined {
                    let residual = &report["claims"]["F"]["residual"];
                    let residual = residual.get(0).unwrap_or(residual);
                    assert!(residual.is_null(), "{formula} at {state}: {residual}");
                }
                states.push(([number(x), number(y)], rate));
            }
        }
        all.push(Trial { formula, case: path, states });
    }
    all
}

/// Compares the numbers that a program prints, a line for a state, with those of `eval`.
fn compare(language: &str, trial: &Trial, printed: &str) {
    let formula = trial.formula;
    let lines: Vec<&str> = printed.lines().collect();
    assert_eq!(lines.len(), trial.states.len(), "{language}: {formula}\n{printed}");
    for (line, (state, known)) in lines.iter().zip(&trial.states) {
        for word in line.split_whitespace() {
            let found: f64 = word.parse().unwrap_or(f64::NAN);
            match known {
                None => assert!(!found.is_finite(), "{language}: {formula} at {state:?}: {line}"),
                Some(known) => {
                    let gap = (found - known).abs();
                    assert!(
                        gap <= 1e-12 * known.abs(),
                        "{language}: {formula} at {state:?}: {line}"
                    );
                }
            }
            assert!(!found.is_infinite(), "{language}: {formula} at {state:?}: {line}");
        }
    }
}

fn with_code(language: &str, driver: impl Fn(&std::path::Path, &str, &Trial) -> String) {
    for (index, trial) in trials(language).iter().enumerate() {
        let code = liouville(&["export", &trial.case, "--to", language]);
        let folder = scratch(&format!("undefined-{language}-{index}"));
        compare(language, trial, &driver(&folder, &code, trial));
    }
}

#[test]
fn python_has_no_value_where_eval_has_none() {
    if !is_there("python3") {
        return;
    }
    with_code("python", |folder, code, trial| {
        fs::write(folder.join("case.py"), code).expect("a file");
        let mut driver = String::from(
            "import case\ndef one(f, x):\n    try:\n        return f(x, [])[0]\n    \
             except (ValueError, ZeroDivisionError):\n        return 'none'\n",
        );
        for (state, _) in &trial.states {
            driver += &format!("print(one(case.field, {state:?}), one(case.value_F, {state:?}))\n");
        }
        fs::write(folder.join("driver.py"), driver).expect("a file");
        run("python3", &["driver.py"], folder)
    });
}

#[test]
fn c_has_no_value_where_eval_has_none() {
    if !is_there("cc") {
        return;
    }
    with_code("c", |folder, code, trial| {
        let mut driver =
            String::from("#include <stdio.h>\n#include \"case.c\"\nint main(void) {\n");
        for ([x, y], _) in &trial.states {
            driver += &format!(
                "{{ const double x[] = {{{x:?}, {y:?}}}; double v[2], w[1];\nfield(x, x, v); \
                 value_F(x, x, w); printf(\"%.17g %.17g\\n\", v[0], w[0]); }}\n"
            );
        }
        fs::write(folder.join("case.c"), code).expect("a file");
        fs::write(folder.join("driver.c"), driver + "return 0;\n}\n").expect("a file");
        let flags = ["-std=c99", "-O2", "-Wall", "-Wextra", "-Wno-unused-function", "-Werror"];
        run("cc", &[&flags[..], &["driver.c", "-o", "driver", "-lm"]].concat(), folder);
        run("./driver", &[], folder)
    });
}

#[test]
fn other_languages_keep_what_has_no_value_in_their_text() {
    let folder = scratch("undefined-text");
    let path = folder.join("case.toml");
    fs::write(&path, case("0*ln(x) + y^(1/3)")).expect("a file");
    let path = path.display().to_string();
    for (language, kept) in [
        ("julia", &["0.0*logarithm(x)", "power(y, 1.0/3.0)", "x > 0 ? x^y"][..]),
        ("rust", &["0.0*logarithm(x)", "power(y, 1.0/3.0)", "if x > 0.0 { x.powf(y) }"]),
        ("matlab", &["0*logarithm(x)", "power_of(y, 1/3)", "if x > 0"]),
        ("sympy", &["No value where this has none: sympy.log(x)."]),
        ("mathematica", &["No value where this has none: Log[x]."]),
        ("maple", &["No value where this has none: ln(x)."]),
        ("latex", &["No value where this has none"]),
    ] {
        let code = liouville(&["export", &path, "--to", language]);
        for text in kept {
            assert!(code.contains(text), "{language}: {text}\n{code}");
        }
    }
}
