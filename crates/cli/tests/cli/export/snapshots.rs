//! Code in languages that the machine may not run, as it is printed; wrong requests.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

/// A field with all operations, names that languages reserve, and names that look alike in ASCII.
const CASE: &str = "\
title  = \"all operations\"
source = \"none\"
[parameters]
I  = \"1..2\"
gamma = \"1/3..2/3\"
c  = \"1/10\"
J  = \"I^2 + c\"
[state]
E  = \"1..2\"
L  = \"vector(2, 1..2)\"
[field]
\"E'\" = \"γ*sin(E) - J/E\"
\"L'\" = \"[exp(-γ*E)*L1, abs(L2)^(1/3) + atan(L1)]\"
[[claim]]
name     = \"ln E, 1st\"
integral = \"ln(E) + E^γ*sqrt(L1)\"
expect   = \"fails\"
[[claim]]
name     = \"ln E 1st\"
integral = \"J*cos(E)/L2^3\"
expect   = \"fails\"
";

/// Returns the folder of the case, which is written once: tests run at the same time.
fn folder() -> &'static Path {
    static FOLDER: OnceLock<PathBuf> = OnceLock::new();
    FOLDER.get_or_init(|| {
        let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("export");
        fs::create_dir_all(&path).expect("a scratch folder");
        fs::write(path.join("all.toml"), CASE).expect("a file");
        path
    })
}

fn export(arguments: &[&str]) -> (Option<i32>, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_liouville"));
    let output = command.arg("export").args(arguments).current_dir(folder()).output();
    let output = output.expect("it runs");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("text");
    (output.status.code(), text(output.stdout), text(output.stderr))
}

#[test]
fn code_is_printed_as_before() {
    for language in
        ["python", "sympy", "julia", "matlab", "mathematica", "maple", "c", "rust", "latex"]
    {
        let (code, text, problem) = export(&["all.toml", "--to", language]);
        assert_eq!(code, Some(0), "{language}: {problem}");
        let version = concat!("liouville ", env!("CARGO_PKG_VERSION"));
        let text = text.replace(version, "liouville VERSION");
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/export/printed");
        let path = PathBuf::from(path).join(format!("{language}.txt"));
        if std::env::var_os("LIOUVILLE_ACCEPT").is_some() {
            fs::write(&path, &text).expect("the file is written");
        }
        let printed = fs::read_to_string(&path).expect("the file is there");
        assert_eq!(text, printed, "{language}: set LIOUVILLE_ACCEPT=1 if this is meant");
    }
}

#[test]
fn names_differ_and_are_not_reserved() {
    let (_, text, _) = export(&["all.toml", "--to", "mathematica"]);
    assert!(text.contains("vI = parameters[[1]]"), "I is the imaginary unit: {text}");
    let (_, text, _) = export(&["all.toml", "--to", "maple"]);
    assert!(text.contains("gamma_2 := parameters[2]"), "gamma is a constant: {text}");
    let (_, text, _) = export(&["all.toml", "--to", "python"]);
    for name in ["def residual_ln_E_1st(", "def residual_ln_E_1st_2("] {
        assert!(text.contains(name), "two claims of one spelling: {text}");
    }
    assert!(!text.contains('∫') && text.contains("math.pow("), "no complex powers: {text}");
}

#[test]
fn numbers_are_exact_where_the_language_has_exact_ones() {
    for (language, number) in [
        ("sympy", "sympy.Rational(1, 10)"),
        ("maple", "1/10"),
        ("mathematica", "1/10"),
        ("python", "0.1"),
        ("c", "0.1"),
    ] {
        let (_, text, _) = export(&["all.toml", "--to", language]);
        assert!(text.contains(number), "{language}: {number}");
    }
}

#[test]
fn wrong_requests_are_explained() {
    for (arguments, words) in [
        (&["all.toml", "--to", "cobol"][..], "possible values: python, sympy, julia"),
        (&["all.toml"][..], "--to <TO>"),
        (&["nothing.toml", "--to", "c"][..], "cannot read"),
        (&["all.toml", "--to", "c", "--claim", "Q*"][..], "no claim has a name or source like"),
        (&["all.toml", "--to", "c", "--out", "no/such/folder.c"][..], "in a folder that exists"),
        (&["all.toml", "--to", "c", "--set", "k=1"][..], "k"),
    ] {
        let (code, text, problem) = export(arguments);
        assert_eq!(code, Some(2), "{arguments:?}");
        assert!(text.is_empty() && problem.contains(words), "{arguments:?}: {problem}");
    }
    let (code, _, _) = export(&["all.toml", "--to", "c", "--claim", "ln*", "--out", "all.c"]);
    assert_eq!(code, Some(0), "a file is written");
    let text = fs::read_to_string(folder().join("all.c")).expect("the file is there");
    assert!(text.contains("void residual_ln_E_1st_2("), "both claims match");
}
