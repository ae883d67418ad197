//! Certificates of the catalogue are checked by the script.

use super::{certified, is_there, run, text};

#[test]
fn certificates_of_the_catalogue_pass() {
    one_certificate_in(
        7,
        &["cases/surface", "cases/classical/planar", "cases/classical/fluid"],
        300,
    );
}

#[test]
#[ignore = "slow: those of the catalogue, of which those of three folders are checked above, one in seven"]
fn all_certificates_of_the_catalogue_pass() {
    one_certificate_in(1, &["cases"], 2400);
}

/// Checks one certificate in this many of some folders, which have more than `least`.
fn one_certificate_in(step: usize, folders: &[&str], least: usize) {
    let (_, files) = certified(&format!("one in {step}"), folders);
    assert!(files.len() > least, "{} certificates", files.len());
    if !is_there() {
        return;
    }
    let files: Vec<&str> = files.iter().step_by(step).map(String::as_str).collect();
    let output = run("python3", &[&["docs/certificates/check.py"], &files[..]].concat());
    let told = text(&output.stdout);
    let last = told.lines().last().unwrap_or_default();
    println!("{last}");
    assert!(output.status.success() && last.ends_with(" 0 refused"), "{told}");
    let from_text = told.lines().filter(|line| line.starts_with("text ")).count();
    assert!(from_text * step * 12 > least, "{from_text} are proved from the text of their case");
}
