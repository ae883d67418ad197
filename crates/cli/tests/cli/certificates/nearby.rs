//! Certificates of closed orbits of fields with an operation that is left out at the case's numbers.

use std::fs;

use super::{run, scratch, text};

/// Proves the cycle on the unit circle, with a further term in x', and verifies its certificate.
fn verified(name: &str, term: &str) -> String {
    let folder = scratch(name);
    fs::create_dir_all(&folder).expect("a folder");
    let [case, proofs] = ["case.toml", "proofs"].map(|own| folder.join(own).display().to_string());
    let claim = "[[claim]]\nname = \"cycle\"\nclosed-orbit = 6.283185307\n\
                 state = { x = \"1\" }\ndensity = \"none\"\n";
    let body = format!(
        "title = \"circle\"\n[parameters]\nb = 0\n[state]\nx = \"-2..2\"\ny = \"-2..2\"\n[field]\n\
         \"x'\" = \"−y + x*(1 − x² − y²) + ({term})\"\n\"y'\" = \"x + y*(1 − x² − y²)\"\n{claim}"
    );
    fs::write(&case, body).expect("written");
    let program = env!("CARGO_BIN_EXE_liouville");
    let output = run(program, &["check", "-q", "--motion", "--certificate", &proofs, &case]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let files = fs::read_dir(&proofs).expect("certificates").flatten();
    let files: Vec<String> = files.map(|own| own.path().display().to_string()).collect();
    let named: Vec<&str> = files.iter().map(String::as_str).collect();
    let output = run(program, &[&["verify"], &named[..]].concat());
    let told = text(&output.stdout);
    assert!(output.status.success(), "{term}: {told}{}", text(&output.stderr));
    assert!(told.ends_with("1 certificate: 1 proved, 0 refused\n"), "{term}: {told}");
    told
}

#[test]
fn what_a_certificate_says_of_parameters_nearby() {
    let alone = verified("alone", "x^b − 1");
    assert!(alone.contains("for these parameters") && !alone.contains("near them"), "{alone}");
    let near = verified("near", "0*ln(x + 3) + (x + 3)^b − 1");
    assert!(near.contains("for these parameters and all near them"), "{near}");
}

#[test]
fn the_format_of_a_certificate_is_the_value_of_its_key() {
    let path = scratch("by-points").with_extension("json");
    let title = "no liouville motion certificate 1";
    let own = format!(
        "{{\"format\": \"liouville certificate 1\", \"statement\": {{\"title\": \"{title}\"}}}}"
    );
    fs::write(&path, own).expect("written");
    let output = run(env!("CARGO_BIN_EXE_liouville"), &["verify", &path.display().to_string()]);
    let told = text(&output.stdout);
    assert!(told.contains("a proof by points, which"), "{told}");
}
