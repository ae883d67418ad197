//! `check --watch`, annotations of workflows, and colours.

use std::fs;
use std::io::{BufRead, BufReader};
use std::process::{Command, Stdio};

use predicates::str::contains;

use crate::commands::{GOOD, folder, liouville};

#[test]
fn a_file_is_judged_again_when_it_changes() {
    let path = folder("watch", &[("good.toml", GOOD)]).join("good.toml");
    let mut program = Command::new(env!("CARGO_BIN_EXE_liouville"))
        .args(["check", "--quiet", "--watch", &path.display().to_string()])
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .expect("it starts");
    let mut lines = BufReader::new(program.stdout.take().expect("a pipe")).lines();
    let mut next = || loop {
        let line = lines.next().expect("the program goes on").expect("a line");
        if line.contains("against expectation") {
            return line;
        }
    };
    assert!(next().contains(" 0 against expectation"), "as it is");
    // The new text has another length: times of files may be coarse.
    fs::write(&path, GOOD.replace("expect = \"fails\"", "expect = \"holds\" ")).expect("written");
    assert!(next().contains(" 1 against expectation"), "with a wrong expectation");
    program.kill().expect("it ends");
    program.wait().expect("it has ended");
    liouville(&["check", "--watch", "-"]).assert().code(2).stderr(contains("does not change"));
}

#[test]
fn workflows_get_annotations_with_lines() {
    let wrong = GOOD.replace("expect = \"fails\"", "expect = \"holds\"");
    let open = "title = 'x'\n[state]\nx = '1..2'\n[field]\n\"x'\" = 'y'\n";
    let path = folder("annotations", &[("a.toml", &wrong), ("b.toml", open), ("c.toml", GOOD)]);
    let output = liouville(&["check", "--format", "github", &path.display().to_string()])
        .output()
        .expect("it runs");
    let told = String::from_utf8(output.stdout).expect("UTF-8");
    let lines: Vec<&str> = told.lines().collect();
    assert_eq!(lines.len(), 3, "an error for each of two files, and the counts:\n{told}");
    let line = wrong.lines().position(|line| line.starts_with("density")).expect("it is there") + 1;
    let of = |file: &str| format!("::error file={}/{file},line=", path.display());
    let refuted = format!("{}{line},title=density without the root::refuted", of("a.toml"));
    assert!(lines[0].starts_with(&refuted), "{told}");
    assert!(lines[1].starts_with(&format!("{}5,col=", of("b.toml"))), "{told}");
    assert!(lines[2].contains("against expectation: 1, files not judged: 1"), "{told}");
    assert_eq!(output.status.code(), Some(2), "a file could not be judged");
}

#[test]
fn colours_are_a_choice() {
    let path = folder("colours", &[("good.toml", GOOD)]).join("good.toml");
    let path = path.display().to_string();
    let printed = |when: &str| {
        let output = liouville(&["check", &path, "--color", when]).output().expect("it runs");
        output.stdout.contains(&0x1b)
    };
    assert!(printed("always"), "also where there is no terminal");
    assert!(!printed("never") && !printed("auto"), "no terminal here");
}
