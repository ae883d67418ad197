//! Several brackets in one file, and brackets of the state variables themselves.

use super::{error, settled};

/// Toda's chain of three in Flaschka's variables, with its first two brackets.
const TODA: &str = r#"
title = "Toda's two brackets"
[state]
a = "vector(2, 0.5..2)"
b = "vector(3, -2..2)"
[field]
"a'" = "[a1*(b2 − b1), a2*(b3 − b2)]"
"b'" = "[2*a1², 2*(a2² − a1²), −2*a2²]"

[poisson.linear]
"a,b" = "[[−a1, a1, 0], [0, −a2, a2]]"
[poisson.quadratic]
"a,a" = "[[0, a1*a2/2], [−a1*a2/2, 0]]"
"a,b" = "[[−a1*b1, a1*b2, 0], [0, −a2*b2, a2*b3]]"
"b,b" = "[[0, 2*a1², 0], [−2*a1², 0, 2*a2²], [0, −2*a2², 0]]"

[[claim]]
hamiltonian = "(b,b)/2 + (a,a)"
poisson = "linear"
[[claim]]
hamiltonian = "b1 + b2 + b3"
poisson = "quadratic"
[[claim]]
jacobi-identity = "holds"
poisson = "linear"
[[claim]]
jacobi-identity = "holds"
poisson = "quadratic"
[[claim]]
compatible = ["linear", "quadratic"]
[[claim]]
casimir = "b1 + b2 + b3"
poisson = "linear"
[[claim]]
casimir = "b1 + b2 + b3"
poisson = "quadratic"
expect = "fails"
[[claim]]
bracket = ["b1 + b2 + b3", "(b,b)/2 + (a,a)"]
poisson = "quadratic"
[[claim]]
bracket = ["a1", "b1"]
equals = "−a1*b1"
poisson = "quadratic"
[[claim]]
bracket = ["a1", "b1"]
equals = "−a1*b1"
poisson = "linear"
expect = "fails"
[[claim]]
hamiltonian = "(b,b)/2 + (a,a)"
poisson = "quadratic"
expect = "fails"
"#;

#[test]
fn a_chain_has_two_compatible_brackets() {
    settled(TODA);
}

#[test]
fn a_wrong_bracket_is_refuted() {
    let (head, _) = TODA.split_once("[[claim]]").expect("claims");
    let wrong = head.replace("a1*b2, 0]", "2*a1*b2, 0]");
    assert_ne!(wrong, head, "the entry is there");
    let claims = [
        "jacobi-identity = \"holds\"\npoisson = \"quadratic\"",
        "compatible = [\"linear\", \"quadratic\"]",
        "compatible = [\"quadratic\", \"quadratic\"]",
    ];
    for claim in claims {
        settled(&format!("{wrong}[[claim]]\n{claim}\nexpect = \"fails\"\n"));
        settled(&format!("{head}[[claim]]\n{claim}\n"));
    }
}

#[test]
fn the_state_has_a_bracket_without_new_variables() {
    settled(
        r#"
title = "Euler's top"
[parameters]
A = "vector(3, 0.5..2)"
[state]
M = "vector(3, -1..1)"
[let]
H = "(M, diag(A)*M)/2"
[field]
"M'" = "M × ∂H/∂M"
[poisson]
structure = "so(3)"
[[claim]]
hamiltonian = "H"
[[claim]]
hamiltonian = "2*H"
expect = "fails"
[[claim]]
casimir = "(M,M)"
[[claim]]
jacobi-identity = "holds"
"#,
    );
    settled(
        r#"
title = "Oscillator with a second bracket"
[hamiltonian]
function = "(p² + x²)/2"
pairs = [["x", "p"]]
[state]
x = "-1..1"
p = "-1..1"
[poisson.scaled]
"x,p" = "1 + x²"
[[claim]]
bracket = ["x", "p"]
equals = "1"
poisson = "hamiltonian"
[[claim]]
bracket = ["x", "p"]
equals = "1 + x²"
poisson = "scaled"
[[claim]]
compatible = ["hamiltonian", "scaled"]
"#,
    );
}

#[test]
fn a_bracket_is_chosen_by_name() {
    let [(_, message, help)] = &error(&TODA.replacen("poisson = \"linear\"\n", "", 1))[..] else {
        panic!("one mistake")
    };
    assert_eq!(message, "the case has the brackets `linear`, `quadratic`");
    assert_eq!(help, "choose one: poisson = \"linear\"");
    let wrong = error(&TODA.replacen("poisson = \"linear\"", "poisson = \"cubic\"", 1));
    assert_eq!(wrong[0].1, "there is no bracket `cubic`");
    let three = TODA.replace("[\"linear\", \"quadratic\"]", "[\"linear\"]");
    assert_eq!(error(&three)[0].1, "a claim of compatibility needs two brackets, and 1 are given");
    let mixed =
        TODA.replace("[poisson.linear]", "[poisson]\n\"a,a\" = \"0*hat(b)\"\n[poisson.linear]");
    assert_eq!(error(&mixed)[0].1, "blocks cannot be mixed with named brackets");
    let empty = TODA.replace("[poisson.quadratic]", "[poisson.none]\n[poisson.quadratic]");
    assert_eq!(error(&empty)[0].1, "the bracket `none` has no block");
}
