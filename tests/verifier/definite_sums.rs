//! Equations that are sums of values of one sign: each of these is 0.

use liouville::case::Case;
use liouville::verdict::{Options, Verdict, judge};

fn case(parameters: &str, state: &str, field: &str, levels: &[&str], claims: &[&str]) -> Case {
    let claims: String =
        claims.iter().map(|own| format!("[[claim]]\n{own}\nexpect = \"open\"\n")).collect();
    let levels: Vec<String> = levels.iter().map(|own| format!("\"{own} = 0\"")).collect();
    let text = format!(
        "title = \"t\"\n[parameters]\n{parameters}\n[state]\n{state}\n[field]\n{field}\n\
         [level]\nequations = [{}]\n{claims}",
        levels.join(", ")
    );
    Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

const SPACE: &str = "x = \"-2..2\"\ny = \"-2..2\"\nz = \"-2..2\"";
const ALONG: &str = "\"x'\" = \"1\"\n\"y'\" = \"1\"\n\"z'\" = \"1\"";
const TURNS: &str = "\"x'\" = \"y\"\n\"y'\" = \"−x\"\n\"z'\" = \"0\"";
const PARAMETERS: &str = "a = \"0.5..2\"\nb = \"-1..2\"\nc = \"-3..-1\"";

fn verdicts(case: &Case) -> Vec<Verdict> {
    let report = judge(case, &Options::default()).unwrap_or_else(|error| panic!("{error}"));
    report.claims.into_iter().map(|claim| claim.verdict).collect()
}

fn is_replaced(level: &str) -> bool {
    let case = case(PARAMETERS, SPACE, ALONG, &[level], &["identity = \"x = y\""]);
    case.remarks.iter().any(|remark| remark.to_string().contains("nowhere negative"))
}

#[test]
fn sums_say_what_their_terms_do() {
    let claims = ["identity = \"x = z\"", "integral = \"x − y\"", "integral = \"x\""];
    let simple = verdicts(&case(PARAMETERS, SPACE, ALONG, &["x − y", "x − z"], &claims));
    assert_eq!(simple, [Verdict::Proved, Verdict::Proved, Verdict::Refuted]);
    for level in [
        "a*(x − y)^2 + (y − z)^2",
        "(x − y)^2 + exp(z)*(x − z)^2",
        "c*(x − y)^2 − a*|x − z|/2",
        "(x − y)^4/(1 + z^2) + 3*(x − z)^2*(x − z)^4",
        "sqrt((x − y)^2 + (x − z)^2)",
    ] {
        let own = case(PARAMETERS, SPACE, ALONG, &[level], &claims);
        assert_eq!(verdicts(&own), simple, "{level}");
    }
    let claims = ["integral = \"x\"", "identity = \"x^2 + y^2 = 1\"", "identity = \"z = 0\""];
    for level in ["(x^2 + y^2 − 1)^2 + z^2", "|x^2 + y^2 − 1| + 2*|z|"] {
        let own = case(PARAMETERS, SPACE, TURNS, &[level], &claims);
        let expected = [Verdict::Refuted, Verdict::Proved, Verdict::Proved];
        assert_eq!(verdicts(&own), expected, "{level}");
    }
}

#[test]
fn sums_of_vectors_and_matrices_are_those_of_their_entries() {
    let (state, field) = ("q = \"vector(3, -2..2)\"", "\"q'\" = \"q\"");
    let claims = ["identity = \"q1 = q2\"", "identity = \"q2 = q3\"", "integral = \"q1\""];
    for level in ["(q − [q1, q1, q1])²", "|q × [1, 1, 1]|"] {
        let found = verdicts(&case("", state, field, &[level], &claims));
        assert_eq!(found, [Verdict::Proved, Verdict::Proved, Verdict::Refuted], "{level}");
    }
    let (state, field) = (
        "p = \"vector(3, -2..2)\"\nq = \"vector(3, -2..2)\"",
        "\"q'\" = \"p × q\"\n\"p'\" = \"[0, 0, 0]\"",
    );
    let claims = ["integral = \"(p,p)\"", "identity = \"(q,q) = 1\"", "integral = \"q1\""];
    let found = verdicts(&case("", state, field, &["((q,q) − 1)^2 + (p,q)^2"], &claims));
    assert_eq!(found, [Verdict::Proved, Verdict::Proved, Verdict::Refuted]);
    let (state, field) = ("A = \"matrix(2, 2, -2..2)\"", "\"A'\" = \"A*[[0, 1], [−1, 0]]\"");
    let level = "tr((Aᵀ*A − E(2))*(Aᵀ*A − E(2)))";
    let claims = ["identity = \"tr(Aᵀ*A) = 2\"", "identity = \"A[1,1] = 1\""];
    let found = verdicts(&case("", state, field, &[level], &claims));
    assert_eq!(found, [Verdict::Proved, Verdict::Refuted]);
}

#[test]
fn other_sums_are_left_as_they_are() {
    for level in [
        // of both signs, for some values of a parameter
        "b*(x − y)^2 + (y − z)^2",
        "(x − y)^2 − (y − z)^2",
        "a*(x − y)^2 + c*(y − z)^2",
        "(x − y)^3 + (y − z)^2",
        // what would be left out has no value at some points
        "(x − y)^2 + exp(ln(z))*(x − z)^2",
        "(x − y)^2 + (x − z)^2/z^2",
        "(x − y)^2 + exp(1/x)*(y + z)^2",
        // nowhere 0
        "a*(x − y)^2 + exp(z)",
    ] {
        assert!(!is_replaced(level), "{level}");
    }
    for level in ["a*(x − y)^2 + (y − z)^2", "a*(x − y)^2 − c*(y*y − z)^2", "|x*y| + sqrt(z)"]
    {
        assert!(is_replaced(level), "{level}");
    }
}

#[test]
fn double_factors_are_seen_through_sines_and_roots() {
    let field = "\"x'\" = \"cos(y)\"\n\"y'\" = \"1\"\n\"z'\" = \"0\"";
    let claims = ["identity = \"x = sin(y)\"", "rate = \"x\"\nequals = \"sqrt(1 − x^2)\""];
    let found = verdicts(&case("", SPACE, field, &["x^2 − 2*x*sin(y) + 1 − cos(y)^2"], &claims));
    assert_eq!(found[0], Verdict::Proved);
    assert_ne!(found[1], Verdict::Proved, "for cos y > 0 alone");
    let state = "x = \"0..2\"\ny = \"-2..2\"";
    let field = "\"x'\" = \"2*y\"\n\"y'\" = \"1\"";
    let claims = ["identity = \"y = sqrt(x)\"", "rate = \"x\"\nequals = \"2*sqrt(x)\""];
    let found = verdicts(&case("", state, field, &["x − 2*sqrt(x)*y + y^2"], &claims));
    assert_eq!(found, [Verdict::Proved, Verdict::Proved]);
    // The motion leaves y = √(x + 2).
    let (state, field) = ("x = \"-1..2\"\ny = \"-2..2\"", "\"x'\" = \"0\"\n\"y'\" = \"y\"");
    let left = case(
        "",
        state,
        field,
        &["(x + 2) − 2*sqrt(x + 2)*y + y^2"],
        &["identity = \"y^2 = x + 2\""],
    );
    assert!(judge(&left, &Options::default()).is_err(), "the motion leaves the level");
}

#[test]
fn powers_with_exponent_0_keep_their_bases() {
    // (√x)⁰ has a value for x ≥ 0 alone.
    let state = "x = \"-2..2\"\ny = \"-2..2\"\nz = \"-2..2\"\nq = \"-3..3\"";
    let field = "\"x'\" = \"0\"\n\"y'\" = \"0\"\n\"z'\" = \"1\"\n\"q'\" = \"0\"";
    let claims = ["identity = \"x = abs(x)\"", "integral = \"(x − abs(x))*z\""];
    for level in [
        "(y − sqrt(x)^0)^2 + q^2",
        "(y − 1)^2 + q^2*sqrt(x)^0",
        "(y − log(x)^0)^2 + q^2",
        "q^2 − 2*q*sqrt(x)^0 + 1",
        "q^2*y^2 − sqrt(x)^0*y^2",
    ] {
        let found = verdicts(&case("", state, field, &[level], &claims));
        assert!(!found.contains(&Verdict::Refuted), "{level}: {found:?}");
    }
    let total = verdicts(&case("", state, field, &["(y − x^0)^2 + q^2"], &claims));
    assert_eq!(total, [Verdict::Refuted; 2], "x⁰ has a value everywhere");
}
