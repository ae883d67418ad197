//! Partial derivatives in case files.

use super::{error, settled};

/// Kirchhoff's equations for any Hamiltonian, typed as in the books.
const KIRCHHOFF: &str = r#"
title = "Kirchhoff's equations"
[parameters]
A = "vector(3, 0.5..2)"
B = "vector(3, 0.5..2)"
[state]
M = "vector(3, -1..1)"
p = "vector(3, -1..1)"
[let]
T = "(M, diag(A)*M)/2"
H = "T + (p, diag(B)*p)/2"
[field]
"M'" = "M × ∂H/∂M + p × ∂H/∂p"
"p'" = "p × ∂H/∂M"
[[claim]]
integral = "H"
[[claim]]
integral = "(M,p)"
[[claim]]
density = "1"
[[claim]]
identity = "∂T/∂M = diag(A)*M"
[[claim]]
identity = "∂(∂H/∂M)/∂M = diag(A)"
[[claim]]
identity = "sum(i, 1..3, M[i]*∂T/∂M[i]) = 2*T"
[[claim]]
identity = "∂H/∂p1 = B1*p1 + p2"
expect = "fails"
[[claim]]
identity = "∂H/∂M = ∂H/∂p"
expect = "fails"
"#;

#[test]
fn a_gradient_is_typed_as_in_the_books() {
    settled(KIRCHHOFF);
}

#[test]
fn a_wrong_sign_is_refuted() {
    settled(
        &KIRCHHOFF
            .replace("+ p × ∂H/∂p", "− p × ∂H/∂p")
            .replace("integral = \"H\"", "integral = \"H\"\nexpect = \"fails\""),
    );
}

#[test]
fn a_claim_holds_where_the_function_is_defined() {
    // |z| = z wherever √z has a value, and nowhere else
    settled(
        r#"
title = "A derivative with a domain"
[state]
y = "-1..1"
z = "-1..1"
[field]
"y'" = "z"
"z'" = "0"
[[claim]]
identity = "∂(y + √z)/∂y + |z| = 1 + z"
[[claim]]
identity = "∂(y + z)/∂y + |z| = 1 + z"
expect = "fails"
"#,
    );
}

#[test]
fn mistakes_have_a_place() {
    let file = KIRCHHOFF.replace("∂H/∂p1 = B1", "∂H/∂A1 = B1");
    assert_ne!(file, KIRCHHOFF, "the claim is there");
    let [(line, message, help)] = &error(&file)[..] else { panic!("one mistake") };
    assert_eq!((*line, message.as_str()), (28, "`A1` is not a state variable"));
    assert!(help.contains("a state variable or a component of one"), "{help}");
    let file = KIRCHHOFF.replace("T = \"(M", "T = \"∂H/∂M1*(M");
    assert!(!error(&file).is_empty(), "abbreviations that use each other");
}
