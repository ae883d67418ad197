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

/// Writes the free body of four dimensions, with six variables.
fn body(rate: &str, claims: &str) -> String {
    format!(
        "title = 'x'\n[parameters]\nJ = 'vector(4, 0.5..2)'\n[state]\nM = 'skew(4, -1..1)'\n[let]\n\
         \"Ω\" = 'matrix(i, 1..4, j, 1..4, M[i,j]/(J[i] + J[j]))'\n[field]\n\"M'\" = \"{rate}\"\n{claims}"
    )
}

#[test]
fn skew_matrices_are_vectors_of_the_state() {
    let claims = "[[claim]]\nintegral = '[tr(M*M), det(M), −tr(M*Ω)/4]'\n[[claim]]\ndensity = '1'\n[[claim]]\n\
                  identity = \"M' = M*Ω − Ω*M\"\n[[claim]]\nidentity = 'M12 = −M[2,1]'\n[[claim]]\n\
                  identity = 'M[1,2] = M_[1]'\n[[claim]]\nidentity = 'M[3,4] = M_[6]'\n[[claim]]\n\
                  integral = 'M'\nexpect = 'fails'\n[[claim]]\nidentity = 'M12 = M[2,1]'\n\
                  expect = 'fails'\n[[claim]]\nidentity = '∂(tr(M*M))/∂M_ = −4*M_'\n";
    let text = body("M*Ω − Ω*M", claims);
    settled(&text);
    let case = Case::parse(&text, &[]).expect("a case");
    assert_eq!(case.model.dimension(), 6, "the entries above the diagonal");
    // By entries and by rows, as for other matrices; the entries below are compared.
    let entries = body("M*Ω − Ω*M", claims).replace(
        "\"M'\" = \"M*Ω − Ω*M\"",
        "\"M[i,j]'\" = 'sum(k, 1..4, M[i,k]*Ω[k,j] − Ω[i,k]*M[k,j])'",
    );
    settled(&entries);
}

#[test]
fn symmetric_matrices_are_vectors_of_the_state() {
    let flow = |rate: &str, claims: &str| {
        format!(
            "title = 'x'\n[parameters]\nN = 'diag(3, 1..3)'\nA = 'symmetric(3, -1..1)'\nW = [[0,1,2],[-1,0,3],\
             [-2,-3,0]]\n[state]\nS = 'symmetric(3, -1..1)'\n[field]\n\"S'\" = \"{rate}\"\n{claims}"
        )
    };
    let claims = "[[claim]]\nintegral = 'vector(k, 1..3, tr(S^k))'\n[[claim]]\nidentity = 'S = Sᵀ'\n[[claim]]\n\
                  integral = 'S[1,1]'\nexpect = 'fails'\n";
    for with in ["N", "A"] {
        settled(&flow(&format!("S*(S*{with} − {with}*S) − (S*{with} − {with}*S)*S"), claims));
    }
    settled(&flow("S*W − W*S", claims));
    for rate in ["S*N − N*S", "S*A", "W", "S*W"] {
        let told = super::error(&flow(rate, ""));
        assert_eq!(told.len(), 1, "{rate}: {told:?}");
        assert_eq!(told[0].1, "the rate of the symmetric matrix `S` is not known to be symmetric");
    }
    let told = super::error(&body("M*M", ""));
    assert_eq!(told[0].1, "the rate of the skew matrix `M` is not known to be skew");
    let told = super::error("title = 'x'\n[state]\nM = 'skew(1, -1..1)'\n[field]\n\"M'\" = 'M'\n");
    assert!(told[0].1.contains("no entry that is not 0"), "{told:?}");
    let told = super::error(&body("M", "").replace("[let]", "[let]\nM_ = '1'"));
    assert!(told.iter().any(|(_, message, _)| message.contains("M_")), "{told:?}");
    let told = super::error(&body("M", "").replace("[let]", "[let]\nM = '1'"));
    assert!(told.iter().any(|(_, message, _)| message.contains('M')), "{told:?}");
}

#[test]
fn symmetric_coordinates_have_symmetric_velocities() {
    settled(
        "title = 'x'\nsystem = 'nonholonomic'\n[state]\nS = 'symmetric(2, 1..2)'\n\
         \"S'\" = 'symmetric(2, -1..1)'\n[lagrangian]\nkinetic = \"tr(S'*S')/2\"\npotential = 'tr(S*S)/2'\n\
         [[claim]]\nintegral = 'energy'\n[[claim]]\nintegral = \"S*S' − S'*S\"\n[[claim]]\n\
         integral = \"S\"\nexpect = 'fails'\n",
    );
}

#[test]
fn a_matrix_stands_right_of_solve() {
    let text = square(
        3,
        "'Q = Qᵀ'",
        &(claim("solve(E + Q*Q, Q) = inverse(E + Q*Q)*Q", true)
            + &claim("(E + Q*Q)*solve(E + Q*Q, Q) = Q", true)
            + &claim("solve(E + Q*Q, Q)[1] = Q[1]", false)
            + &claim(
                "solve(E + Q*Q, mat([1,2],[3,4],[5,6]))[1,2] = solve(E + Q*Q, [2,4,6])[1]",
                true,
            )),
    );
    settled(&text);
}
