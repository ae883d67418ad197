//! Rests and permanent rotations of bodies that may spin, near which no density exists.

use liouville::case::Case;
use liouville::number::rational::Rational;
use liouville::verdict::{ClaimReport, Options, Verdict, evaluate, judge};

use crate::common::case;

const UNBALANCED: &str = "R = \"1..3\"\nc = \"vector(-0.5..0.5)\"\nI = \"full(0.5..5)\"";
const ELLIPSOID: &str = "B = \"diag(1..4)\"\nI = \"inertia(0.5..5)\"";
const WEIGHT: &str = "potential = \"m*a_g*h\"";

/// Writes a case of a body that may spin, with both questions about densities that depend on ω.
fn body(parameters: &str, body: &str) -> Case {
    let claim = |kind: &str| format!("[[claim]]\n{kind} = \"exists\"\nexpect = \"open\"\n");
    case(&format!(
        "title = \"body\"\nsystem = \"rolling-plane\"\n[parameters]\nm = \"0.5..2\"\n{parameters}\n\
         a_g = \"1..10\"\n[body]\n{body}\n{}{}",
        claim("analytic-density"),
        claim("smooth-density")
    ))
}

/// Judges both questions.
fn judged(case: &Case) -> [ClaimReport; 2] {
    let report = judge(case, &Options::default()).expect("judged");
    report.claims.try_into().expect("two claims")
}

/// Reads the number that follows a word.
fn number_after(text: &str, word: &str) -> f64 {
    let (_, rest) = text.split_once(word).unwrap_or_else(|| panic!("no `{word}` in {text}"));
    let end = |c: char| !(c.is_ascii_digit() || matches!(c, '-' | '.' | 'e'));
    let digits = rest.split(end).next().unwrap_or_default();
    digits.parse().unwrap_or_else(|_| panic!("`{digits}` in {text}"))
}

/// Reads Ω of a remark.
fn speed(remark: &str) -> f64 {
    match remark.contains("ω = γ") {
        true => 1.0,
        false if remark.contains("ω = −γ") => -1.0,
        false => number_after(remark, "ω = "),
    }
}

/// Asserts that the body is steady at the place of the remark, and that C₁ is the stated number.
fn assert_steady(case: &Case, speed: f64, remark: &str) {
    let (_, list) = remark.split_once('[').expect("a normal");
    let (list, _) = list.split_once(']').expect("a normal");
    let normal: Vec<f64> = list.split(", ").map(|x| x.parse().expect("a number")).collect();
    let turning = normal.iter().map(|x| speed * x);
    let state: Vec<Rational> = turning
        .chain(normal.iter().copied())
        .map(|x| format!("{x:.9}").parse().expect("a decimal"))
        .collect();
    let index = number_after(remark, "of state ") as u64;
    let found = evaluate(case, Some(&state), 1, index).expect("evaluated");
    for (k, rate) in found.field.iter().enumerate() {
        let (value, _) = rate.expect("a rate");
        assert!(value.abs() < 1e-3, "component {k} moves by {value:e}: {remark}");
    }
    let [along, _] = found.conditions.expect("C₁ and C₂");
    let (along, _) = along.expect("C₁");
    let stated = number_after(remark, "C₁ = ");
    assert!((along - stated).abs() < 1e-3 * stated.abs() + 1e-6, "{along:e} at {remark}");
    let (divergence, _) = found.divergence.expect("div v");
    assert!((divergence - speed * along).abs() < 1e-5, "div v = ΩC₁: {divergence:e} at {remark}");
}

#[test]
fn an_unbalanced_ball_with_weight_has_no_smooth_density() {
    let case = body(UNBALANCED, &format!("shape = \"ball\"\n{WEIGHT}"));
    let [analytic, smooth] = judged(&case);
    assert_eq!(analytic.verdict, Verdict::Undecided, "C₁ is 0 at both rests");
    assert_eq!(smooth.verdict, Verdict::Refuted, "near a permanent rotation");
    let remark = smooth.evidence.remark.expect("the rotation");
    assert_steady(&case, speed(&remark), &remark);
}

#[test]
fn a_rotor_leaves_permanent_rotations() {
    let rotor = format!("{UNBALANCED}\nS = \"vector(-1..1)\"");
    let case = body(&rotor, &format!("shape = \"ball\"\ngyrostat = \"S\"\n{WEIGHT}"));
    let [_, smooth] = judged(&case);
    assert_eq!(smooth.verdict, Verdict::Refuted, "near a permanent rotation");
    let remark = smooth.evidence.remark.expect("the rotation");
    assert_steady(&case, speed(&remark), &remark);
}

#[test]
fn a_rest_on_no_axis_is_found() {
    let offset = "B = \"diag(1..4)\"\nc = \"vector(-0.5..0.5)\"\nI = \"full(0.5..5)\"";
    let case = body(offset, &format!("shape = \"ellipsoid\"\n{WEIGHT}"));
    let [analytic, smooth] = judged(&case);
    assert_eq!([analytic.verdict, smooth.verdict], [Verdict::Refuted; 2], "near a rest");
    assert_eq!(analytic.evidence.remark, smooth.evidence.remark, "the same rest");
    assert_steady(&case, 0.0, &analytic.evidence.remark.expect("the rest"));
}

#[test]
fn nothing_is_found_where_nothing_excludes_densities() {
    let aligned = body(ELLIPSOID, &format!("shape = \"ellipsoid\"\n{WEIGHT}"));
    let verdicts = judged(&aligned).map(|claim| claim.verdict);
    assert_eq!(verdicts, [Verdict::Undecided; 2], "C₁ is 0 at every steady motion");
    let balanced = body("R = 1\nI = \"inertia(0.5..5)\"", &format!("shape = \"ball\"\n{WEIGHT}"));
    let verdicts = judged(&balanced).map(|claim| claim.verdict);
    assert_eq!(verdicts, [Verdict::Proved; 2], "Chaplygin's ball has a density");
    // K is not orthogonal to γ: two of its components vanish where the body does not turn steadily.
    let driven = body(UNBALANCED, "shape = \"ball\"\nmoment = \"a_g*γ + c × γ\"");
    let verdicts = judged(&driven).map(|claim| claim.verdict);
    assert_eq!(verdicts, [Verdict::Undecided; 2], "a moment along the normal");
}
