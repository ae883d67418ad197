//! Mistakes: each told once, with what to write instead.

use liouville::case::Case;

use crate::language::error;

#[test]
fn every_mistake_is_told_once() {
    let told = error(
        r#"titel = "x"
system = "rubber-plane"
[parameters]
m = "1..2"
R = "2..1"
I = [1, 2, 2.5]
k = "a + b"
[body]
shape = "bal"
potentail = "m*h"
[let]
Z = "2m"
[[claim]]
integral = "energgy"
[[claim]]
intergal = "energy"
[[claim]]
integral = "R*(γ,γ) + Z + k"
[[claim]]
density = "exists"
[[claim]]
integral = "(γ,γ"
"#,
    );
    let lines: Vec<usize> = told.iter().map(|(line, _, _)| *line).collect();
    assert_eq!(lines, [1, 5, 7, 9, 10, 12, 14, 16, 20, 22], "{told:#?}");
    assert!(!told.iter().any(|(_, message, _)| message.contains("`R`")), "R is known to be wrong");
    assert_eq!(told[0].2, "did you mean `title`?", "a title that is misspelt is not missing");
    assert!(told[8].2.contains("analytic-density"), "{}", told[8].2);
}

#[test]
fn first_errors_say_what_to_write() {
    let told = error("title = 't'\n[state]\nx' = y\nx = -2..2\n[[claim]]\nintegral = energy\n");
    let help: Vec<&str> = told.iter().map(|(_, _, help)| help.as_str()).collect();
    let quoted = [
        "quote both: \"x'\" = \"y\"",
        "quote the value: x = \"-2..2\"",
        "quote the value: integral = \"energy\"",
    ];
    assert_eq!(help, quoted, "{told:#?}");
    let claim = |text: &str| {
        let head = "title = 't'\n[state]\nx = '0..1'\n[field]\n\"x'\" = '1'\n[[claim]]\n";
        error(&format!("{head}{text}\n")).remove(0)
    };
    let names = "the names here are x, x'; others are declared in [parameters] or [let]";
    assert_eq!(claim("integral = 'w*x'").2, names);
    assert_eq!(claim("integral = 'xdot'").2, "the rate of `x` is written `x'`");
    assert_eq!(claim("integral = 'cot(x)'").2, "write `1/tan(x)`");
    let place = claim("integral = 'x'\nwhere = 'x = 0'").2;
    assert_eq!(place, "write \"everywhere\": this case has no level set");
    assert_eq!(claim("measure = '1'").2, "did you mean `density`?");
    let params =
        error("title = 't'\n[params]\na = 1\n[state]\nx = '0..1'\n[field]\n\"x'\" = 'a'\n");
    assert_eq!(params.len(), 1, "what the table declares is not missed: {params:#?}");
    assert_eq!(params[0].2, "did you mean `parameters`?");
    let bare = error("title = 't'\nsystem = 'nonholonomic'\n[state]\nx = '0..1'\n");
    assert_eq!((bare[0].0, bare[0].1.as_str()), (2, "the file has no `lagrangian`"));
}

#[test]
fn what_could_harm_a_terminal_or_a_run_is_refused() {
    let head =
        |title: &str| format!("title = \"{title}\"\n[state]\nx = '0..1'\n[field]\n\"x'\" = '1'\n");
    for escape in ["\\u001b[2J", "\\u202e", "\\u009b"] {
        let told = error(&head(escape));
        assert!(told[0].1.contains("control character U+"), "{told:?}");
    }
    let claim = "[[claim]]\nlimit-cycle = 9223372036854775807\ncrossings = 8\nstart = [1, 0.1]\n";
    let told = error(&format!("{}{claim}", head("t")));
    assert!(told[0].1.contains("is too large"), "{told:?}");
    let told = error(&format!("{}{} = 1\n", head("t"), "k".repeat(100_000)));
    assert!(told[0].1.len() < 200, "long keys are cut");
}

#[test]
fn names_that_mislead_are_warned_of() {
    let warnings = |parameters: &str| {
        let text = format!(
            "title = 't'\n[parameters]\n{parameters}\n[state]\nx = '0..1'\n[field]\n\"x'\" = '1'\n"
        );
        Case::parse(&text, &[]).expect("a case").warnings
    };
    let own = |name: &str| {
        let meaning = if name == "e" { "Euler's number" } else { "a function" };
        vec![format!(
            "`{name}` already has a meaning here ({meaning}), and this file gives it another"
        )]
    };
    for name in ["exp", "sqrt", "e", "sum", "max"] {
        assert_eq!(
            warnings(&format!("{name} = 2")),
            own(name),
            "{name} is a function, or a number"
        );
    }
    assert_eq!(warnings("e = [0, 0, 1]"), Vec::<String>::new(), "a vector is not taken for e");
    assert_eq!(warnings("x2 = 1"), Vec::<String>::new(), "x is a number");
    let hidden = "`x2` already has a meaning here, and this file gives it another: write x[2] for the \
                  component";
    let vector = |tables: &str, more: &str| {
        let text = format!(
            "title = 't'\n{tables}[state]\nx = 'vector(2, 0..1)'\n{more}[field]\n\"x'\" = '[x2, x1]'\n"
        );
        Case::parse(&text, &[]).expect("a case").warnings
    };
    assert_eq!(vector("[let]\nx2 = 7\n", ""), [hidden], "an abbreviation");
    assert_eq!(vector("[parameters]\nx2 = 7\n", ""), [hidden], "a parameter");
    assert_eq!(vector("[let]\nx3 = 7\n", ""), Vec::<String>::new(), "x has no third component");
    let alike = "`ω` and `ѡ` look alike, but are different names";
    assert_eq!(warnings("\"ω\" = 1\n\"ѡ\" = 2"), [alike], "Greek and Cyrillic");
    let twice = error(
        "title = 't'\n[parameters]\n\"é\" = 1\n\"e\u{301}\" = 2\n[state]\nx = '0..1'\n[field]\n\"x'\" = '1'\n",
    );
    assert!(twice[0].1.contains("declared twice"), "one name, composed or not: {twice:?}");
}

#[test]
fn sizes_are_bounded_and_say_so() {
    let state = |range: &str| {
        error(&format!("title = 't'\n[state]\nx = '{range}'\n[field]\n\"x'\" = 'x'\n")).remove(0)
    };
    let message = "a vector of length 2000 is too large: there are at most 1024 components";
    assert_eq!(state("vector(2000, 0..1)").1, message);
    assert_eq!(state("vector(0, 0..1)").1, "a size is positive, this is 0");
    assert_eq!(state("vector(n, 0..1)").1, "unknown name `n`");
    assert_eq!(state("matrix(4, 0..1)").1, "a matrix has two sizes: matrix(4, 4, a..b)");
    assert!(state("spherical(4, 0..1)").1.contains("depend on each other"), "not a state");
}

#[test]
fn claims_are_named_in_lists_of_integrals() {
    let text = "title = 't'\n[state]\nx = '-1..1'\ny = '-1..1'\n[field]\nx = 'y'\ny = '-x'\n\
                [[claim]]\nname = 'H'\nintegral = 'x² + y²'\n\
                [[claim]]\nclosed-orbit = 6.283\nstate = { x = 1, y = 0 }\nintegrals = ['H']\n";
    let case = Case::parse(text, &[]).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(case.motions.len(), 1);
    let unknown = Case::parse(&text.replace("['H']", "['K']"), &[]).expect_err("no claim");
    assert!(unknown.to_string().contains("unknown name `K`"), "{unknown}");
}

#[test]
fn state_variables_without_dimensions_are_told() {
    let text = "title = 't'\n[dimensions]\nl = 'L'\n[parameters]\nl = '1..2'\n[state]\nq = '-1..1'\n\
                p = '-1..1'\n[field]\nq = 'p/l'\np = '-l*q'\n[[claim]]\nintegral = 'p²/l + l*q²'\n";
    let remarks = |text: &str| -> Vec<String> {
        let case = Case::parse(text, &[]).unwrap_or_else(|error| panic!("{error}"));
        case.remarks.iter().map(ToString::to_string).collect()
    };
    assert!(remarks(text).iter().any(|own| own.contains("says nothing of `q`, `p`")));
    let whole = text.replace("l = 'L'\n[", "l = 'L'\nq = '1'\np = 'L'\n[");
    assert!(!remarks(&whole).iter().any(|own| own.contains("says nothing")));
}
