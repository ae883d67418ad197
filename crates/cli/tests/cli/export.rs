//! Exported code: run where the machine can, and compared with `eval`; otherwise as it is printed.

mod snapshots;
mod undefined;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use liouville::number::rational::Rational;
use serde_json::Value;

/// Cases of all kinds of systems, with roots, powers, logarithms, sums, lists and abbreviations.
const CASES: [&str; 12] = [
    "plane/balanced-ball",
    "sphere/balanced-ball-gyrostat",
    "spin/chaplygin-ball-gyrostat",
    "classical/kepler/central-power",
    "classical/planar/fokas-lagerstrom",
    "classical/maps/kahan-nahm",
    "classical/maps/standard",
    "classical/nonholonomic/snakeboard",
    "classical/populations/lotka-volterra",
    "classical/lattices/toda-periodic-3",
    "classical/lattices/sutherland",
    "classical/lattices/calogero-moser-4",
];

/// Largest difference of doubles from the true values, relative to the largest number beside them.
const ROUNDING: f64 = 1e-11;

/// Functions that are not exported, but used by those that are.
const HELPERS: [&str; 3] = ["reciprocal", "logarithm", "power"];

/// Number of states at which values are compared.
const STATES: u64 = 4;

fn run(program: &str, arguments: &[&str], folder: &Path) -> String {
    let mut command = Command::new(program);
    let output = command.args(arguments).current_dir(folder).output().expect("it starts");
    let problem = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{program} {arguments:?}: {problem}");
    String::from_utf8(output.stdout).expect("text")
}

fn liouville(arguments: &[&str]) -> String {
    let program = env!("CARGO_BIN_EXE_liouville");
    run(program, arguments, Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")))
}

/// Whether a program is there; says so if not.
fn is_there(program: &str) -> bool {
    let found = Command::new(program).arg("--version").output().is_ok();
    if !found {
        println!("not run: there is no {program} on this machine");
    }
    found
}

fn scratch(name: &str) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("export").join(name);
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).expect("a scratch folder");
    path
}

/// A state with the values that `eval` finds there.
struct Known {
    state: Vec<f64>,
    parameters: Vec<f64>,
    /// Values of all functions, in the order of the file; `None` where there is none.
    values: Vec<Vec<Option<f64>>>,
}

/// Numbers of a value of a report: one, a list, or none.
fn numbers(value: &Value) -> Vec<Option<f64>> {
    match value {
        Value::Array(all) => all.iter().map(|one| one.as_str().map(number)).collect(),
        Value::Null => Vec::new(),
        one => vec![one.as_str().map(number)],
    }
}

fn number(text: &str) -> f64 {
    let value: Rational = text.parse().unwrap_or_else(|error| panic!("{text}: {error}"));
    value.to_f64().0
}

fn known(case: &str, index: u64) -> Known {
    let text = liouville(&["eval", case, "--json", "--index", &index.to_string()]);
    let report: Value = serde_json::from_str(&text).expect("JSON");
    let listed = |key: &str| -> Vec<f64> {
        let groups = report[key].as_object().expect("an object").values();
        groups.flat_map(numbers).map(|x| x.expect("a number")).collect()
    };
    let mut parameters = listed("parameters");
    if report.get("antiderivatives").is_some() {
        parameters.extend(numbers(&report["antiderivatives"]).into_iter().flatten());
    }
    let field = report.get("field").or(report.get("image")).expect("a field");
    let level = report["level"].as_object().expect("an object");
    let mut values = vec![numbers(field), level.values().flat_map(numbers).collect()];
    for claim in report["claims"].as_object().expect("an object").values() {
        values.extend([numbers(&claim["value"]), numbers(&claim["residual"])]);
    }
    values.retain(|own| !own.is_empty());
    Known { state: listed("state"), parameters, values }
}

/// Compares values with those of `eval`.
fn compare(case: &str, known: &Known, found: &[Vec<f64>]) -> usize {
    assert_eq!(found.len(), known.values.len(), "{case}: number of functions");
    let mut compared = 0;
    for (own, values) in found.iter().zip(&known.values) {
        assert_eq!(own.len(), values.len(), "{case}: number of values");
        let scale = values.iter().flatten().fold(1f64, |a, b| a.max(b.abs()));
        for (x, value) in own.iter().zip(values) {
            let Some(value) = value else { continue };
            assert!((x - value).abs() < ROUNDING * scale, "{case}: {x} is not {value}");
            compared += 1;
        }
    }
    compared
}

/// Names of the exported functions, in the order of the file.
fn functions<'t>(code: &'t str, before: &str) -> Vec<&'t str> {
    let rest = code.lines().filter_map(|line| line.strip_prefix(before));
    rest.filter_map(|rest| rest.split(['(', '<']).next()).collect()
}

/// Compares the code that `driver` makes of an export with `eval` for some cases.
fn compare_all(
    cases: &[&str],
    language: &str,
    before: &str,
    driver: impl Fn(&Path, &str, &[&str], &[Known]) -> String,
) {
    let mut compared = 0;
    for case in cases {
        let folder = scratch(&format!("{language}-{}", case.replace('/', "-")));
        let code = liouville(&["export", case, "--to", language]);
        let all: Vec<Known> = (0..STATES).map(|index| known(case, index)).collect();
        let names: Vec<&str> = functions(&code, before);
        let names: Vec<&str> = names.into_iter().filter(|name| !HELPERS.contains(name)).collect();
        let text = driver(&folder, &code, &names, &all);
        let mut lines = text.lines().map(|line| {
            line.split_whitespace().map(|x| x.parse().expect("a number")).collect::<Vec<f64>>()
        });
        for known in &all {
            let found: Vec<Vec<f64>> = lines.by_ref().take(names.len()).collect();
            compared += compare(case, known, &found);
        }
    }
    println!("{language}: {compared} numbers compared");
    assert!(compared >= cases.len() * 20, "{compared} numbers");
}

fn list(values: &[f64], open: &str, close: &str) -> String {
    let all: Vec<String> = values.iter().map(|x| format!("{x:?}")).collect();
    format!("{open}{}{close}", all.join(", "))
}

#[test]
fn python_gives_the_numbers_of_eval() {
    if !is_there("python3") {
        return;
    }
    compare_all(&CASES, "python", "def ", |folder, code, names, all| {
        fs::write(folder.join("case.py"), code).expect("a file");
        let mut driver = String::from("import case\n");
        for known in all {
            let (state, parameters) =
                (list(&known.state, "[", "]"), list(&known.parameters, "[", "]"));
            for name in names {
                driver += &format!("print(*map(float, case.{name}({state}, {parameters})))\n");
            }
        }
        fs::write(folder.join("driver.py"), driver).expect("a file");
        run("python3", &["driver.py"], folder)
    });
}

#[test]
fn c_gives_the_numbers_of_eval() {
    if !is_there("cc") {
        return;
    }
    compare_all(&CASES, "c", "void ", |folder, code, names, all| {
        let mut driver = String::from("#include <stdio.h>\n#include \"case.c\"\n");
        driver += "int main(void) {\ndouble values[4096];\n";
        for known in all {
            let (state, parameters) =
                (list(&known.state, "{", "}"), list(&known.parameters, "{", "}"));
            driver += &format!("{{ const double x[] = {state};\n");
            driver += &format!("const double p[] = {};\n", parameters.replace("{}", "{0}"));
            for (name, values) in names.iter().zip(&known.values) {
                driver += &format!("{name}(x, p, values);\n");
                let count = values.len();
                driver += &format!(
                    "for (int i = 0; i < {count}; i++) printf(\"%.17g \", values[i]);\nputs(\"\");\n"
                );
            }
            driver += "}\n";
        }
        driver += "return 0;\n}\n";
        fs::write(folder.join("case.c"), code).expect("a file");
        fs::write(folder.join("driver.c"), driver).expect("a file");
        let flags = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-pedantic"];
        let files = ["driver.c", "-o", "driver", "-lm"];
        run("cc", &[&flags[..], &files[..]].concat(), folder);
        run("./driver", &[], folder)
    });
}

#[test]
fn rust_gives_the_numbers_of_eval() {
    if !is_there("rustc") {
        return;
    }
    compare_all(&CASES[2..6], "rust", "pub fn ", |folder, code, names, all| {
        let mut driver = String::from("#![deny(warnings)]\nmod case;\nfn main() {\n");
        for known in all {
            let (state, parameters) =
                (list(&known.state, "[", "]"), list(&known.parameters, "[", "]"));
            for name in names {
                driver += &format!(
                    "for x in case::{name}(&{state}, &{parameters}) {{ print!(\"{{x:?}} \"); }}\n\
                     println!();\n"
                );
            }
        }
        driver += "}\n";
        fs::write(folder.join("case.rs"), code).expect("a file");
        fs::write(folder.join("driver.rs"), driver).expect("a file");
        run("rustc", &["--edition", "2021", "driver.rs"], folder);
        run("./driver", &[], folder)
    });
}
