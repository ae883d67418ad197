//! Levels given by equations between vectors or matrices.

use liouville::case::Case;
use liouville::verdict::{Options, judge};

use super::settled;

/// Writes two vectors of ℝ⁴ that do not move, on a level.
fn pair(parameters: &str, equations: &str, claims: &str) -> String {
    format!(
        "title = 'x'\n[parameters]\n{parameters}\n[state]\nx = 'vector(4, -1..1)'\ny = 'vector(4, -1..1)'\n\
         [level]\nequations = [{equations}]\n[field]\n\"x'\" = '0*x'\n\"y'\" = '0*y'\n{claims}"
    )
}

/// Writes a matrix that does not move, on a level.
fn square(size: usize, equations: &str, claims: &str) -> String {
    format!(
        "title = 'x'\n[state]\nQ = 'matrix({size}, {size}, -1..1)'\n[let]\nS = 'Qᵀ*Q'\n\
         [level]\nequations = [{equations}]\n[field]\n\"Q'\" = '0*Q'\n{claims}"
    )
}

fn claim(identity: &str, holds: bool) -> String {
    let expect = if holds { "holds" } else { "fails" };
    format!("[[claim]]\nidentity = '{identity}'\nexpect = '{expect}'\n")
}

fn parts(text: &str) -> (Vec<String>, bool) {
    let case = Case::parse(text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let equations = case.model.level.iter().map(|equation| equation.text.clone()).collect();
    let report = judge(&case, &Options::default()).expect("it can be judged");
    (equations, report.warnings.iter().any(|warning| warning.contains("may fall apart")))
}

#[test]
fn orthogonal_matrices_are_a_level() {
    let claims = [claim("Q*Qᵀ = E", true), claim("det(Q)² = 1", true), claim("det(Q) = 1", false)];
    for equation in ["'Qᵀ*Q = E'", "'S = E'", "'E = Qᵀ*Q'"] {
        let text = square(3, equation, &claims.concat());
        settled(&text);
        assert_eq!(parts(&text).0.len(), 6, "{equation}: the entries on the diagonal and above");
    }
    settled(&square(
        2,
        "'Q*Qᵀ = E(2)/4'",
        &(claim("Qᵀ*Q = E(2)/4", true) + &claim("Q = Qᵀ", false)),
    ));
}

#[test]
fn entries_that_say_nothing_new_are_left_out() {
    let entries = |equation: &str| parts(&square(3, equation, "")).0;
    let skew = entries("'Q + Qᵀ = 0'");
    assert_eq!(skew.len(), 6, "{skew:?}");
    assert_eq!(skew[0], "Q + Qᵀ = 0, entry 1,1");
    let symmetric = entries("'Q = Qᵀ'");
    assert_eq!(symmetric.len(), 3, "no diagonal: {symmetric:?}");
    assert_eq!(symmetric[0], "Q = Qᵀ, entry 1,2");
    settled(&square(3, "'Q = Qᵀ'", &(claim("Q = Qᵀ", true) + &claim("Q = E", false))));
    let vector = pair("", "'x = 2*y'", &(claim("(x,x) = 4*(y,y)", true) + &claim("x = y", false)));
    settled(&vector);
    assert_eq!(parts(&vector).0[3], "x = 2*y, entry 4");
}

#[test]
fn sides_of_different_sizes_are_refused_with_their_place() {
    for equation in ["'x = 1'", "'x = [1,2]'", "'E(4)*x = E(4)'"] {
        let text = pair("", equation, "");
        let error = Case::parse(&text, &[]).expect_err(equation).to_string();
        assert!(error.starts_with("8:"), "{error}");
    }
}

#[test]
fn a_level_with_a_regular_gram_matrix_misses_nothing() {
    let on = |parameters: &str, [a, b, c]: [&str; 3]| {
        let equations = format!("'(x,x) = {a}', '(y,y) = {b}', '(x,y) = {c}'");
        let claims = claim(&format!("(x,x)*(y,y) − (x,y)² = {a}*{b} − {c}²"), true);
        parts(&pair(parameters, &equations, &claims)).1
    };
    assert!(!on("", ["1", "1", "0"]), "orthonormal vectors");
    assert!(!on("r = '1..2'\ns = '1..2'", ["r²", "s", "0"]), "of other lengths");
    assert!(!on("c = '-1/2..1/2'", ["1", "1", "c²"]), "at an angle");
    assert!(!on("c = '-2..2'", ["1", "1", "c"]), "any c is that of two vectors");
    assert!(on("r = '-1..1'", ["r²", "1", "0"]), "x may be 0");
}
