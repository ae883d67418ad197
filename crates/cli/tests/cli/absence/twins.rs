//! Systems that have what is said to be absent, each next to one that has not: what differs is a
//! sign, a number, a root that is a number, or the degree.

use liouville::verdict::Verdict;

use super::absences;

/// Verdicts on claims of absence about the rates of x, y and z.
fn verdicts(parameters: &str, rates: [&str; 3], claims: &[&str]) -> Vec<Verdict> {
    let [x, y, z] = rates;
    let claims: String = claims.iter().map(|claim| format!("[[claim]]\n{claim}\n")).collect();
    let text = format!(
        "title = 'x'\n[parameters]\n{parameters}\n[state]\nx = '1..2'\ny = '1..2'\nz = '1..2'\n[field]\n\
         \"x'\" = '{x}'\n\"y'\" = '{y}'\n\"z'\" = '{z}'\n{claims}"
    );
    absences(&text).into_iter().map(|claim| claim.verdict).collect()
}

use Verdict::{Proved, Refuted};

const INTEGRALS: [&str; 2] = ["no-integral = { degree = 2 }", "no-integral = { degree = 3 }"];

#[test]
fn exponents_that_are_one_by_a_formula_are_one() {
    let free = "b = '1..2'\nc = '√(b²)/b'\nd = 'b/(2*b)'";
    assert_eq!(verdicts(free, ["x", "−b*y", "3*z"], &INTEGRALS), [Proved, Proved]);
    // √(b²)/b = 1, and 2d = 1: x*y is kept.
    assert_eq!(verdicts(free, ["x", "−c*y", "3*z"], &INTEGRALS), [Refuted, Refuted]);
    assert_eq!(verdicts(free, ["x", "−2*d*y", "3*z"], &INTEGRALS), [Refuted, Refuted]);
    // A modulus has no branch modulo a prime: nothing is proved with it.
    let modulus = "b = '1..2'\nc = '|b|/b'";
    let found = verdicts(modulus, ["x", "−c*y", "3*z"], &INTEGRALS);
    assert!(!found.contains(&Proved), "{found:?}");
}

#[test]
fn the_degree_decides() {
    let rates = ["x", "√2*y", "−(1 + √2)*z"];
    assert_eq!(verdicts("", rates, &INTEGRALS), [Proved, Refuted], "x*y*z");
    let densities = [
        "no-density = { degree = 0 }",
        "no-density = { degree = 1 }",
        "no-density = { degree = 2 }",
    ];
    assert_eq!(verdicts("", rates, &densities), [Refuted, Refuted, Refuted], "1");
    let grown = ["2*x", "2*y", "−3*z"];
    assert_eq!(verdicts("", grown, &densities[..1]), [Proved], "the divergence is 1");
    assert_eq!(verdicts("", grown, &densities[2..]), [Refuted], "a product of powers");
}

#[test]
fn functions_hide_no_integral() {
    let claims = ["no-integral = { degree = 1 }", "no-integral = { degree = 2 }"];
    let found = verdicts("", ["exp(x)", "−y*exp(x)", "z"], &claims);
    assert_eq!(found[1], Refuted, "y*exp(x)");
    let found = verdicts("", ["√(x²)", "−y*|x|/x", "z"], &claims);
    assert_eq!(found[1], Refuted, "x*y for x > 0");
}
