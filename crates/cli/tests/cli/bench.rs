//! Reports of `liouville measure bench`: their form, and errors in the order that theory predicts. Times
//! are reported, never tested.

use std::collections::BTreeSet;
use std::fs;
use std::path::PathBuf;

use assert_cmd::Command;
use liouville_lab::bench::{
    BenchOptions, ClaimMeasurements, DifferentiationMethod, NATIVE, PlainCode, measure_item,
    work_items,
};
use predicates::str::contains;
use serde_json::Value;

const QUICK: [&str; 4] = ["--states", "64", "--rounds", "1"];

fn bench(arguments: &[&str]) -> Command {
    let mut command = Command::cargo_bin("liouville").expect("the binary is built");
    // paths are given from the top of the tree
    command.current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
    command.arg("bench").args(QUICK).args(arguments);
    command
}

fn json(arguments: &[&str], code: i32) -> Value {
    let output = bench(arguments).output().expect("it runs");
    assert_eq!(output.status.code(), Some(code), "exit code of {arguments:?}");
    serde_json::from_slice(&output.stdout).expect("JSON on standard output")
}

fn scratch(name: &str) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_file(&path);
    path
}

fn measured() -> Vec<ClaimMeasurements> {
    let options = BenchOptions { blocks: 2, rounds: 1, ..BenchOptions::default() };
    let items = work_items().expect("the work items are cases");
    items.iter().flat_map(|item| measure_item(item, &options, &|_| ()).expect("measured")).collect()
}

fn error(measured: &ClaimMeasurements, method: DifferentiationMethod, domain: &str) -> f64 {
    let row = measured.row(method, domain).unwrap_or_else(|| panic!("{method:?} in {domain}"));
    assert_eq!(row.states, 128, "{}: {method:?} in {domain} has a value everywhere", measured.item);
    row.max_error.expect("an error")
}

#[test]
fn errors_are_in_the_order_that_theory_gives() {
    for measured in &measured() {
        let name = &measured.item;
        let tape = error(measured, DifferentiationMethod::Tape, "f64");
        assert!(tape > 0.0 && tape <= 1e-11, "{name}: f64 rounds: {tape:e}");
        assert_eq!(
            tape,
            error(measured, DifferentiationMethod::Tape, "ball, f64"),
            "{name}: the same midpoints"
        );
        let double = error(measured, DifferentiationMethod::Tape, "ball, double-double");
        assert!(double < 1e-25, "{name}: double-double has 32 digits: {double:e}");
        for (domain, bits) in [("ball, 128 bits", 128), ("ball, 256 bits", 256)] {
            let (found, most) =
                (error(measured, DifferentiationMethod::Tape, domain), 2f64.powi(16 - bits));
            assert!(found > 0.0 && found < most, "{name}, {domain}: {found:e}, {most:e} allowed");
        }
        let differences = error(measured, DifferentiationMethod::CentralDifference, "f64");
        assert!(
            differences > 100.0 * tape,
            "{name}: {differences:e} by differences, tape {tape:e}"
        );
        assert!(differences < 1e-5, "{name}: but differences work: {differences:e}");
        for (method, domain) in [
            (DifferentiationMethod::ComplexStep, "complex f64"),
            (DifferentiationMethod::MergedTape, "f64"),
            (DifferentiationMethod::NumDualByHand, "f64"),
            (DifferentiationMethod::NumDualClosedForm, "f64"),
        ] {
            if method == DifferentiationMethod::NumDualClosedForm
                && measured.row(method, domain).is_none()
            {
                continue;
            }
            let found = error(measured, method, domain);
            assert!(found <= 100.0 * tape, "{name}, {method:?}: {found:e} against {tape:e}");
        }
        let merged = error(measured, DifferentiationMethod::MergedTape, "f64");
        let interpreted = error(measured, DifferentiationMethod::MergedTape, "f64, interpreter");
        assert!(interpreted <= 2.0 * merged, "{name}: fused sums round less: {interpreted:e}");
        if measured.row(DifferentiationMethod::MergedTape, "f64, machine code").is_some() {
            let compiled = error(measured, DifferentiationMethod::MergedTape, "f64, machine code");
            assert_eq!(compiled, interpreted, "{name}: the same bits by machine code");
        }
        for row in measured.rows.iter().filter(|row| row.method != DifferentiationMethod::Floor) {
            let (bound, worst) = (row.max_bound, row.max_error.expect("an error"));
            assert!(bound.is_none_or(|bound| bound >= worst), "{name}: a bound bounds: {row:?}");
            assert!(row.median_error.expect("an error") <= worst, "{name}: {row:?}");
        }
    }
}

#[test]
fn json_has_the_documented_form() {
    let report = json(&["--json"], 0);
    assert_eq!(report["seed"], 1, "the seed is printed");
    assert_eq!(report["states"], 64, "with the states and rounds");
    assert_eq!(report["rounds"], 1);
    assert!(report["machine"]["features"].is_array(), "and what the times depend on");
    let items = report["items"].as_array().expect("items");
    let names: Vec<&Value> = items.iter().map(|item| &item["name"]).collect();
    assert_eq!(names, ["W1", "W2", "W3"], "the work items");
    for item in items {
        for key in ["ns_per_state", "num_dual_ns_per_state", "num_dual_native_ns_per_state"] {
            assert!(item[key].as_f64().is_some_and(|time| time > 0.0), "{key} in {item}");
        }
        assert!(item["operations"].is_u64() && item["max_error"].is_f64(), "{item}");
    }
    let rows = report["rows"].as_array().expect("rows");
    for row in rows {
        for key in ["item", "claim", "method", "domain"] {
            assert!(row[key].is_string(), "a row has `{key}`: {row}");
        }
        let is_floor = row["method"] == "floor";
        for key in ["ns_per_state", "setup_us", "max_error", "median_error"] {
            // The floor computes nothing.
            assert!(!is_floor || key.ends_with("error") || row[key].is_f64(), "{row}");
            if is_floor {
                continue;
            }
            assert!(row[key].is_f64(), "a row has `{key}`: {row}");
        }
    }
    let methods: BTreeSet<&str> = rows.iter().filter_map(|row| row["method"].as_str()).collect();
    // There is a floor where there is machine code.
    let expected = DifferentiationMethod::ALL
        .iter()
        .filter(|m| **m != DifferentiationMethod::Floor || methods.contains("floor"));
    assert_eq!(methods.len(), expected.count(), "every method is there: {methods:?}");
    assert!(report.get("errors").is_none(), "and no errors");
}

#[test]
fn values_of_the_engine_are_those_of_code_by_hand() {
    let report = json(&["--json", "--engines", "--values"], 0);
    let rows = report["rows"].as_array().expect("rows");
    let methods: BTreeSet<&str> = rows.iter().filter_map(|row| row["method"].as_str()).collect();
    assert!(!methods.contains("tape"), "engines and code by hand alone: {methods:?}");
    let values = report["values"].as_array().expect("values");
    assert_eq!(values.len(), 3 * 64, "one for each state of each item");
    for item in work_items().expect("cases") {
        let own = values.iter().filter(|value| value["item"] == item.name.as_str());
        for entry in own {
            let number = |value: &Value| value.as_f64().expect("a number");
            let state: Vec<f64> =
                entry["state"].as_array().expect("a state").iter().map(number).collect();
            let (found, scale) = (number(&entry["value"]), number(&entry["scale"]));
            let by_hand = |code: &PlainCode| {
                let mut result = [f64::NAN];
                (code.residual)(std::slice::from_ref(&state), &mut result);
                result[0]
            };
            for both in item.by_hand.chunks(2) {
                let (code, value) = (&both[0], by_hand(&both[0]));
                let error = (found - value).abs() / scale;
                assert!(error < 1e-14, "{}, {code:?}: {error:e} of the scale", item.name);
                let native = by_hand(&both[1]);
                assert_eq!((both[1].method, both[1].domain), (code.method, NATIVE));
                assert_eq!(native.to_bits(), value.to_bits(), "{code:?}: the same bits natively");
            }
        }
    }
    bench(&["--values"]).assert().code(2).stderr(contains("--json"));
}

#[test]
fn errors_do_not_depend_on_the_run() {
    let errors = |report: &Value| -> Vec<Value> {
        let rows = report["rows"].as_array().expect("rows").iter();
        rows.map(|row| row["max_error"].clone()).collect()
    };
    assert_eq!(errors(&json(&["--json"], 0)), errors(&json(&["--json"], 0)), "same seed");
    let other = json(&["--json", "--seed", "2"], 0);
    assert_ne!(errors(&json(&["--json"], 0)), errors(&other), "another seed, other states");
}

#[test]
fn cases_are_measured_claim_by_claim_and_what_cannot_be_is_named() {
    // A contact map that is not homogeneous does not conserve its level: densities there need more.
    let path = scratch("bench-contact.toml");
    let text = "title = 'contact'\nsystem = 'rubber-sphere'\n[parameters]\nm = 1.25\nk = 0.375\n\
        I = [2.5, 3, 3.5]\n[body]\n\
        contact = '[(γ3²/5 − 2)*γ1, (γ3²/5 − 2)*γ2, γ3³/5 − 12*γ3/5 − 1/4]'\n\
        [[claim]]\nname = 'ρ'\ndensity = '1 + γ3²'\nexpect = 'fails'\n\
        [[claim]]\nname = 'F'\nintegral = '(ω,ω)*γ3'\nexpect = 'fails'\n";
    fs::write(&path, text).expect("a scratch file");
    let report = json(&["--json", path.to_str().expect("UTF-8")], 0);
    let items = report["items"].as_array().expect("items");
    assert_eq!(items.len(), 2, "one for each claim");
    let skipped = report["skipped"].as_array().expect("a list");
    assert_eq!(skipped.len(), 2, "both differences of the density: {skipped:?}");
    for entry in skipped {
        assert_eq!(entry["claim"], "ρ", "the density");
        assert!(entry["reason"].as_str().is_some_and(|reason| reason.contains("level")), "{entry}");
    }
    let rows = report["rows"].as_array().expect("rows");
    let of_integral = rows.iter().filter(|row| row["claim"] == "F");
    assert!(of_integral.clone().any(|row| row["method"] == "complex step"), "the integral has all");
    assert!(of_integral.clone().all(|row| row["method"] != "num-dual by hand"), "nobody wrote it");
}

#[test]
fn a_flat_base_and_a_sphere_have_the_same_criterion_by_every_method() {
    for path in ["cases/flat-base/base.toml", "cases/sphere/ellipsoid.toml"] {
        let report = json(&["--json", path], 0);
        let rows = report["rows"].as_array().expect("rows");
        assert!(!rows.is_empty(), "{path} is measured");
        for row in rows {
            let Some(error) = row["max_error"].as_f64() else { continue };
            let most = if row["method"] == "central difference" { 1e-4 } else { 1e-9 };
            assert!(error <= most, "{path}: {row}");
        }
    }
}

#[test]
fn the_diagram_is_well_formed_and_shows_every_row() {
    let path = scratch("bench.svg");
    let shown = path.to_str().expect("UTF-8");
    let report = json(&["--json", "--svg", shown], 0);
    let svg = fs::read_to_string(&path).expect("the diagram was written");
    assert!(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"), "one element");
    assert!(svg.contains("prefers-color-scheme: dark"), "for both backgrounds");
    assert!(!svg.contains("NaN") && !svg.contains("inf"), "every coordinate is a number");
    for tag in ["svg", "style", "title", "text"] {
        let count = |start: &str| svg.matches(&format!("{start}{tag}")).count();
        assert_eq!(count("<"), count("</"), "<{tag}> is closed");
    }
    let rows = report["rows"].as_array().expect("rows");
    let tapes = rows.iter().filter(|row| row["method"] == "tape").count();
    assert_eq!(svg.matches("<circle").count(), tapes + 1, "a circle a tape, one in the legend");
    for row in rows {
        let domain = row["domain"].as_str().expect("text");
        assert!(svg.contains(&format!(">{domain}</text>")), "{domain} is in the legend");
    }
}

#[test]
fn wrong_input_is_refused_with_a_remedy() {
    bench(&["no-such-folder"]).assert().code(2).stderr(contains("give case files, folders"));
    bench(&["--svg", "no-such-folder/a.svg"])
        .assert()
        .code(2)
        .stderr(contains("a folder that exists"));
    bench(&["Cargo.toml"]).assert().code(2).stderr(contains("error"));
    let report = json(&["--json", "cases/plane/unbalanced-ball.toml", "no-such-file.toml"], 2);
    assert!(
        report["items"].as_array().is_some_and(|items| !items.is_empty()),
        "the rest is measured"
    );
    assert_eq!(report["errors"][0]["path"], "no-such-file.toml", "and the error is named");
    bench(&["--rounds", "0"]).assert().code(2);
}
