//! Certificates of proofs: the checker accepts all, and refuses those that were tampered with.

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};

const TOP: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

fn scratch(name: &str) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("certificates").join(name);
    let _ = fs::remove_dir_all(&path);
    path
}

fn run(program: &str, arguments: &[&str]) -> Output {
    let mut command = Command::new(program);
    command.args(arguments).current_dir(TOP).output().expect("it starts")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// Writes the certificates of some cases.
fn certified(folder: &str, cases: &[&str]) -> (PathBuf, Vec<String>) {
    let path = scratch(folder);
    let shown = path.display().to_string();
    let arguments = [&["check", "-q", "--certificate", &shown], cases].concat();
    let output = run(env!("CARGO_BIN_EXE_liouville"), &arguments);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let entries = fs::read_dir(&path).expect("a folder").flatten();
    let mut files: Vec<String> = entries.map(|own| own.path().display().to_string()).collect();
    files.sort();
    let told = text(&output.stderr);
    assert!(told.contains(&format!("{} certificates in {shown}", files.len())), "{told}");
    (path, files)
}

/// Whether there is a Python; says so if not.
fn is_there() -> bool {
    let found = Command::new("python3").arg("--version").output().is_ok();
    if !found {
        println!("not run: there is no python3 on this machine");
    }
    found
}

#[test]
fn all_certificates_of_the_catalogue_pass() {
    let (_, files) = certified("all", &["cases"]);
    assert!(files.len() > 2400, "{} certificates", files.len());
    if !is_there() {
        return;
    }
    let files: Vec<&str> = files.iter().map(String::as_str).collect();
    let output = run("python3", &[&["docs/certificates/check.py"], &files[..]].concat());
    let told = text(&output.stdout);
    let last = told.lines().last().unwrap_or_default();
    println!("{last}");
    assert!(output.status.success() && last.ends_with(" 0 refused"), "{told}");
    let from_text = told.lines().filter(|line| line.starts_with("text ")).count();
    assert!(from_text > 240, "{from_text} are proved from the text of their case");
}

#[test]
fn certificates_that_were_tampered_with_are_refused() {
    let cases = [
        "cases/classical/planar",
        "cases/classical/fluid",
        "cases/classical/maps",
        "cases/plane/balanced-ball.toml",
    ];
    let (folder, _) = certified("tampered", &cases);
    if !is_there() {
        return;
    }
    let script = "crates/cli/tests/certificates/tamper.py";
    let output = run("python3", &[script, "docs/certificates", &folder.display().to_string()]);
    let told = text(&output.stdout);
    println!("{told}");
    assert!(output.status.success(), "{told}{}", text(&output.stderr));
    let words: Vec<&str> = told.lines().last().unwrap_or_default().split_whitespace().collect();
    let tampered: usize = words[2].parse().expect("a number");
    assert!(tampered >= 200 && words[4] == "0", "{tampered} tampered");
}

#[test]
fn what_cannot_be_certified_is_told() {
    let folder = scratch("none").display().to_string();
    let program = env!("CARGO_BIN_EXE_liouville");
    let output =
        run(program, &["check", "-q", "classical/lattices/toda-open-2", "--certificate", &folder]);
    let told = text(&output.stderr);
    assert!(output.status.success() && told.contains("moduli or functions"), "{told}");
    let output = run(program, &["check", "plane/balanced-ball", "--certificate", "README.md"]);
    let told = text(&output.stderr);
    assert!(output.status.code() == Some(2) && told.contains("cannot make the folder"), "{told}");
}
