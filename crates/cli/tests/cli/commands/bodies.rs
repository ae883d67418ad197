//! Tables of bodies: one case, a row of values for each body.

use std::fs;
use std::path::{Path, PathBuf};

use predicates::prelude::PredicateBooleanExt;
use predicates::str::contains;
use serde_json::Value;

use crate::commands::{folder, liouville};

/// An oscillator whose second claim holds for k = 1 alone.
const SPRING: &str = r#"
title = "a spring"
[parameters]
k = "0.5..2"
d = "0..1"
[state]
x = "-2..2"
v = "-2..2"
[field]
"x'" = "v"
"v'" = "−k*x"
[[claim]]
name = "energy"
integral = "v² + k*x²"
[[claim]]
name = "circle"
integral = "v² + x²"
[[claim]]
name = "inverse"
integral = "(v² + k*x²)/k"
"#;

fn home(name: &str, table: &str) -> PathBuf {
    folder(&format!("bodies-{name}"), &[("spring.toml", SPRING), ("bodies.csv", table)])
}

/// Runs the program in a folder; returns what it prints.
fn run(home: &Path, arguments: &str, code: i32) -> String {
    let words: Vec<&str> = arguments.split(' ').collect();
    let done = liouville(&words).current_dir(home).assert().code(code);
    String::from_utf8(done.get_output().stdout.clone()).expect("UTF-8")
}

#[test]
fn each_row_is_judged_as_set_does() {
    let home = home("rows", "k\n1\n3/2\n2.5\n");
    let told = run(&home, "check spring.toml --settings bodies.csv --json", 1);
    let told: Value = serde_json::from_str(&told).expect("JSON");
    let bodies = told["bodies"].as_array().expect("bodies");
    assert_eq!(bodies.len(), 3);
    for (body, k) in bodies.iter().zip(["1", "3/2", "2.5"]) {
        assert_eq!(body["settings"]["k"], k);
        let code = if k == "1" { 0 } else { 1 };
        let alone = run(&home, &format!("check spring.toml --set k={k} --json"), code);
        let alone: Value = serde_json::from_str(&alone).expect("JSON");
        for claim in alone["cases"][0]["claims"].as_array().expect("claims") {
            let name = claim["name"].as_str().expect("a name");
            assert_eq!(body["verdicts"][name], claim["verdict"], "{name} for k = {k}");
        }
        let against = body["disagreements"].as_array().expect("names").len();
        assert_eq!(against, usize::from(k != "1"));
    }
    assert_eq!(told["summary"]["disagreements"], 2);
    let text = run(&home, "check spring.toml --settings bodies.csv", 1);
    let expected = "a spring\n\
                    row  k    proved  refuted  undecided  disagreements\n\
                    1    1    3       0        0          0\n\
                    2    3/2  2       1        0          1\n\
                    3    2.5  2       1        0          1\n\
                    3 bodies: 7 proved, 2 refuted, 0 undecided, 2 disagreements\n";
    assert_eq!(text, expected);
    let csv = run(&home, "check spring.toml --settings bodies.csv --claim circle --format csv", 1);
    assert_eq!(csv.lines().nth(2), Some("2,3,3/2,0,0,1,0,1,refuted,,"), "{csv}");
    let lines = run(&home, "check spring.toml --settings bodies.csv --format jsonl", 1);
    assert_eq!(lines.lines().count(), 3);
    run(&home, "check spring.toml --settings bodies.csv --claim energy --quiet", 0);
}

#[test]
fn a_wrong_row_leaves_the_others() {
    let rows = "k,d\n1,0\nx,0\n1/0,0\n\n1\n1,\n\"[1,2]\",0\n# the last\n2,1/2\n";
    let home = home("wrong-rows", rows);
    let told = run(&home, "check spring.toml --settings bodies.csv --json", 2);
    let told: Value = serde_json::from_str(&told).expect("JSON");
    let bodies = told["bodies"].as_array().expect("bodies");
    let wrong = |body: &&Value| body.get("errors").is_some();
    let lines: Vec<u64> =
        bodies.iter().filter(wrong).map(|body| body["line"].as_u64().expect("a line")).collect();
    assert_eq!(lines, [3, 4, 6, 7, 8], "{told:#}");
    for body in bodies.iter().filter(wrong) {
        for error in body["errors"].as_array().expect("errors") {
            assert!(error["help"].is_string(), "{error}");
        }
    }
    assert_eq!(bodies[6]["row"], 7);
    assert_eq!(bodies[6]["settings"]["d"], "1/2");
    assert_eq!(bodies[6]["verdicts"]["energy"], "proved");
    let text = run(&home, "check spring.toml --settings bodies.csv", 2);
    assert!(text.contains("error: line 6: 1 value below 2 names\nhelp: "), "{text}");
    assert!(text.contains("2 bodies") && text.contains("; 5 rows without results"), "{text}");
    let csv = run(&home, "check spring.toml --settings bodies.csv --format csv", 2);
    let widths: Vec<usize> = csv.lines().map(|line| line.split(',').count()).collect();
    assert!(
        csv.lines().nth(4).is_some_and(|line| line.ends_with("1 value below 2 names")),
        "{csv}"
    );
    assert_eq!(widths[0], widths[1], "{csv}");
}

#[test]
fn mistakes_of_tables_have_remedies() {
    let tables = [
        ("", "the table is empty"),
        ("k,d\n", "the table has no rows"),
        ("k,k\n1,2\n", "there are two columns `k`"),
        ("k,,d\n1,2,3\n", "column 2 has no name"),
        ("k,q\n1,2\n", "there is no parameter `q` to set"),
        ("k\n\"1\n", "line 2: a quoted value has no end"),
    ];
    for (k, (table, message)) in tables.into_iter().enumerate() {
        let home = home(&format!("mistake-{k}"), table);
        for command in ["check", "report"] {
            let words = [command, "spring.toml", "--settings", "bodies.csv"];
            let done = liouville(&words).current_dir(&home).assert().code(2);
            done.stderr(contains(message).and(contains("bodies.csv")).and(contains("help: ")));
        }
    }
    let home = home("mistakes", "k\n1\n");
    let fails = |arguments: &str, message: &'static str| {
        let words: Vec<&str> = arguments.split(' ').collect();
        liouville(&words).current_dir(&home).assert().code(2).stderr(contains(message));
    };
    let check = "check spring.toml --settings bodies.csv";
    fails("check spring.toml --settings nothing.csv", "cannot read nothing.csv");
    fails(&format!("{check} --set k=1"), "`k` has a column, and --set gives it a value too");
    fails(&format!("{check} --mutants"), "cannot be used with");
    fails(&format!("{check} --format junit"), "junit is no format of a table of bodies");
    fails(&format!("{check} --out rows.txt"), "rows.txt is none of .csv, .json, .jsonl");
    fails(&format!("{check} --out bodies.csv"), "is a file that the command reads");
    fails(&format!("{check} --claim nothing"), "no claim has a name or source like `nothing`");
    fails("check spring.toml spring.toml --settings bodies.csv", "--settings is for one case");
    fails("check . --settings bodies.csv", "--settings is for one case");
    fails("check plane --settings bodies.csv", "--settings is for one case");
    fails("check spring.toml --out rows.csv", "--settings <FILE.csv>");
    fails("check spring.toml --format jsonl", "--format jsonl is for a table of bodies");
    fails("report spring.toml --part 1/2 --out parts", "--part is for a table of bodies");
    fails("report spring.toml --format csv", "--format csv is for a table of bodies");
    fails(
        "report spring.toml --settings bodies.csv --format html",
        "html is no format of a table of bodies",
    );
}

#[test]
fn parts_with_wrong_rows_are_merged_to_the_bytes_of_one_run() {
    let rows = "k,d\n1,0\nx,0\n3/2,0\n2,1\n1,\n1/3,1/3\n7,1\n";
    let home = home("parts", rows);
    for (command, code) in [("check", 2), ("report", 2)] {
        let job = format!("{command} spring.toml --settings bodies.csv");
        for ending in ["csv", "json", "jsonl"] {
            run(&home, &format!("{job} --out whole.{ending}"), code);
        }
        let whole = run(&home, &job, code);
        let parts = format!("{command}-parts");
        for (part, threads) in [("3/4", 1), ("1/4", 2), ("4/4", 2), ("2/4", 1)] {
            let more = format!("--part {part} --out {parts} --threads {threads}");
            let told = run(&home, &format!("{job} {more}"), 0);
            assert!(told.ends_with(" of 7 units\n"), "{told}");
            assert!(run(&home, &format!("{job} {more}"), 0).ends_with(": there\n"));
        }
        // the case and the table are not needed any more
        let kept = ["spring.toml", "bodies.csv"].map(|name| home.join(name));
        let away = kept.clone().map(|path| path.with_extension("away"));
        kept.iter().zip(&away).for_each(|(from, to)| fs::rename(from, to).expect("a file"));
        for ending in ["csv", "json", "jsonl"] {
            let told = run(&home, &format!("merge {parts} --out merged.{ending}"), code);
            assert_eq!(told, whole);
            let [one, other] = ["whole", "merged"]
                .map(|name| fs::read(home.join(format!("{name}.{ending}"))).expect("a file"));
            assert!(one == other, "{command} {ending}");
        }
        let json = run(&home, &format!("merge {parts} -- --json"), code);
        assert_eq!(json, fs::read_to_string(home.join("whole.json")).expect("a file"));
        away.iter().zip(&kept).for_each(|(from, to)| fs::rename(from, to).expect("a file"));
    }
}

#[test]
fn reports_on_bodies_name_their_invariants() {
    let table = "m,c,I\n1,\"[0,0,1/3]\",\"[1,1,2]\"\n5/4,\"[0,0,0]\",\"[1,2,3]\"\n";
    let home = home("report", table);
    let told = run(&home, "report plane/unbalanced-ball --settings bodies.csv --json", 0);
    let told: Value = serde_json::from_str(&told).expect("JSON");
    for body in told["bodies"].as_array().expect("bodies") {
        assert!(body["class"].as_str().is_some_and(|class| !class.is_empty()), "{body}");
        assert!(body["integrals"].is_array() && body["densities"].is_array());
    }
}

#[cfg(unix)]
#[test]
fn a_table_is_read_once() {
    let home = home("once", "k\n1\n3/2\n");
    let check = "check spring.toml --settings /dev/stdin --claim energy";
    for more in ["--quiet", "--part 1/1 --out parts"] {
        let arguments = format!("{check} {more}");
        let words: Vec<&str> = arguments.split(' ').collect();
        // a pipe gives its contents once
        let done = liouville(&words).current_dir(&home).write_stdin("k\n1\n3/2\n").assert();
        done.success();
    }
    let from_file = run(&home, "check spring.toml --settings bodies.csv --claim energy --json", 0);
    let merged = run(&home, "merge parts -- --json", 0);
    assert_eq!(merged, from_file);
}
