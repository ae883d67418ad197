//! Vectors whose products are given: all of them are states, and others are not taken for such.

use liouville::verdict::Verdict;

use crate::doubts::judged;

/// Writes vectors that do not move, on a level.
fn still(names: &[&str], size: usize, equations: &str, claims: &[(&str, &str)]) -> String {
    let state: String =
        names.iter().map(|name| format!("{name} = 'vector({size}, -3..3)'\n")).collect();
    let field: String = names.iter().map(|name| format!("\"{name}'\" = '0*{name}'\n")).collect();
    let claims: String = claims
        .iter()
        .map(|(identity, expect)| {
            format!("[[claim]]\nidentity = '{identity}'\nexpect = '{expect}'\n")
        })
        .collect();
    format!(
        "title = 'x'\n[state]\n{state}[level]\nequations = [{equations}]\n[field]\n{field}{claims}"
    )
}

/// Asserts that each claim has the verdict of its expectation, by a proof or a witness.
#[track_caller]
fn settled(text: &str) {
    for claim in judged(text).unwrap_or_else(|error| panic!("{error}\n{text}")).claims {
        let is_settled = matches!(claim.verdict, Verdict::Proved | Verdict::Refuted);
        assert!(is_settled && claim.agrees, "{} came out {}", claim.name, claim.verdict.word());
    }
}

/// Asserts that no false claim is proved or confirmed; all claims are false.
#[track_caller]
fn never_holds(text: &str) {
    let Ok(report) = judged(text) else { return };
    for claim in report.claims {
        let holds = matches!(claim.verdict, Verdict::Proved | Verdict::Confirmed);
        assert!(!holds, "{} came out {}", claim.name, claim.verdict.word());
    }
}

#[test]
fn both_orientations_are_states() {
    for size in 2..=8 {
        let text = format!(
            "title = 'x'\n[parameters]\nA = 'skew({size}, -1..1)'\n[state]\n\
             R = 'matrix({size}, {size}, -1..1)'\n[level]\nequations = ['Rᵀ*R = E({size})']\n[field]\n\
             \"R'\" = 'R*A'\n[[claim]]\nidentity = 'R*Rᵀ = E({size})'\n[[claim]]\n\
             identity = 'det(R)² = 1'\n[[claim]]\nidentity = 'det(R) = 1'\nexpect = 'fails'\n[[claim]]\n\
             identity = 'det(R) = −1'\nexpect = 'fails'\n[[claim]]\nintegral = 'R*A*Rᵀ'\n[[claim]]\n\
             integral = 'R[1,2]'\nexpect = 'fails'\n"
        );
        settled(&text);
    }
}

#[test]
fn free_bodies_keep_their_momentum_in_space() {
    let text = "title = 'x'\n[parameters]\nJ = 'vector(6, 0.5..2)'\n[state]\nR = 'matrix(6, 6, -1..1)'\n\
                M = 'skew(6, -1..1)'\n[level]\nequations = ['Rᵀ*R = E(6)']\n[let]\n\
                \"Ω\" = 'matrix(i, 1..6, j, 1..6, M[i,j]/(J[i] + J[j]))'\n[field]\n\"R'\" = 'R*Ω'\n\
                \"M'\" = 'M*Ω − Ω*M'\n[[claim]]\nintegral = 'R*M*Rᵀ'\n[[claim]]\n\
                integral = 'Rᵀ*M*R'\nexpect = 'fails'\n[[claim]]\ndensity = '1'\n";
    settled(text);
}

#[test]
fn fewer_vectors_than_dimensions_are_connected() {
    let equations = "'(x,x) = 1', '(y,y) = 1', '(x,y) = 0'";
    let claims = [
        ("|x × y| = 1", "holds"),
        ("x × y = [0, 0, 1]", "fails"),
        ("x[3] = 1", "fails"),
        ("x[1]² + y[1]² = 1 − (x × y)[1]²", "holds"),
        ("x[1]² + y[1]² = 1 + (x × y)[1]²", "fails"),
    ];
    settled(&still(&["x", "y"], 3, equations, &claims));
    let third = "'(z,z) = 1', '(x,z) = 0', '(y,z) = 0'";
    let claims = [("z = x × y", "fails"), ("z = y × x", "fails"), ("z[1]² = (x × y)[1]²", "holds")];
    settled(&still(&["x", "y", "z"], 3, &format!("{equations}, {third}"), &claims));
}

#[test]
fn lengths_and_angles_may_be_any_numbers() {
    let equations = "'(x,x) = 4', '(x,y) = 1', '(y,y) = 2', '(z,x) = 0', '(z,y) = −1', '(z,z) = 3'";
    let claims = [
        ("(x,x)*(y,y) − (x,y)² = 7", "holds"),
        ("|x − y|² = 4", "holds"),
        ("|y + z| = √3", "holds"),
        ("|y − z| = √3", "fails"),
        ("det(mat(x, y, z, [0, 0, 0, 1])) = 0", "fails"),
    ];
    settled(&still(&["x", "y", "z"], 4, equations, &claims));
}

#[test]
fn the_ranges_choose_one_of_two() {
    let text = "title = 'x'\n[state]\na = '-1..1'\nb = '0..1'\nc = '-1..1'\nd = '0..1'\n[level]\n\
                equations = ['a² + b² = 1', 'c² + d² = 1', 'a*c + b*d = 0']\n[field]\n\"a'\" = '0'\n\
                \"b'\" = '0'\n\"c'\" = '0'\n\"d'\" = '0'\n[[claim]]\nidentity = 'a = −c'\nexpect = 'fails'\n\
                [[claim]]\nidentity = 'a² = d²'\n[[claim]]\nidentity = 'a*d = b*c'\nexpect = 'fails'\n";
    settled(text);
}

#[test]
fn other_products_make_no_frame() {
    let unit = "'(x,x) = 1', '(y,y) = 1', '(z,z) = 1'";
    // One product with a sign, one in another order, and one that is missing.
    let orders = [
        "'x[1]*y[1] + x[2]*y[2] − x[3]*y[3] = 0', '(x,z) = 0', '(y,z) = 0'",
        "'(x,y) = 0', 'x[1]*z[2] + x[2]*z[1] + x[3]*z[3] = 0', '(y,z) = 0'",
        "'(x,y) = 0', '(x,z) = 0', 'y[1]*z[1] + 2*y[2]*z[2] + y[3]*z[3] = 0'",
        "'(x,y) = 0', '(x,z) = 0'",
    ];
    for order in orders {
        let claims = [("det(mat(x, y, z))² = 1", "fails"), ("z[1]² = (x × y)[1]²", "fails")];
        never_holds(&still(&["x", "y", "z"], 3, &format!("{unit}, {order}"), &claims));
    }
    // The same order in all three products, though not that of the components.
    let turned = "'(x,y) = 0', 'x[1]*z[2] + x[2]*z[1] + x[3]*z[3] = 0', \
                  'y[1]*z[2] + y[2]*z[1] + y[3]*z[3] = 0'";
    let claims = [("det(mat(x, y, z))² = 1", "fails"), ("z[2]² = (x × y)[1]²", "holds")];
    settled(&still(&["x", "y", "z"], 3, &format!("{unit}, {turned}"), &claims));
}

#[test]
fn a_frame_that_no_vectors_have_has_no_states() {
    for equations in
        ["'(x,x) = 1', '(y,y) = 1', '(x,y) = 2'", "'(x,x) = 1', '(y,y) = −1', '(x,y) = 0'"]
    {
        never_holds(&still(&["x", "y"], 3, equations, &[("x[1] = y[1]", "fails")]));
    }
    // Along the line x = ±y the equations depend on each other.
    let parallel = "'(x,x) = 1', '(y,y) = 1', '(x,y) = 1'";
    never_holds(&still(&["x", "y"], 3, parallel, &[("x[1] = 0", "fails")]));
}

#[test]
fn further_equations_of_a_frame_are_kept() {
    let equations = "'(x,x) = 1', '(y,y) = 1', '(x,y) = 0', 'x[1] = y[1]'";
    let claims = [("x[1] = 0", "fails"), ("x[2]*y[2] = −x[1]² − x[3]*y[3]", "holds")];
    let Ok(report) = judged(&still(&["x", "y"], 3, equations, &claims)) else {
        panic!("two vectors with a condition");
    };
    assert_eq!(report.claims[0].verdict, Verdict::Refuted, "x₁ is any number");
    assert_ne!(report.claims[1].verdict, Verdict::Refuted, "(x,y) = 0");
}

#[test]
fn a_pole_that_reflections_miss_may_carry_more() {
    // At y = e₃, which no reflection makes, both v and w are free, and the part has as many
    // dimensions as the other: v = 0, w = 0.
    let text = "title = 'x'\n[state]\nx = 'vector(3, -1..1)'\ny = 'vector(3, -1..1)'\nu = '-2..2'\n\
                v = '-2..2'\nw = '-2..2'\n[level]\nequations = ['(x,x) = 1', '(y,y) = 1', '(x,y) = 0', \
                '(1 − x[3])*u = x[1]*v*w', '(1 − x[3])*v = x[2]*w', '(1 − x[3])*w = x[1]*u']\n\
                [field]\n\"x'\" = '0*x'\n\"y'\" = '0*y'\n\"u'\" = '0'\n\"v'\" = '0'\n\"w'\" = '0'\n\
                [[claim]]\nidentity = 'u = 0'\nexpect = 'fails'\n[[claim]]\nidentity = 'w = 0'\n\
                expect = 'fails'\n";
    never_holds(text);
}
