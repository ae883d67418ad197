//! Orbits through quotients that have limits where their divisors are 0.

use std::f64::consts::PI;

use liouville::case::Case;
use liouville::verdict::Verdict;

use super::{assert_known, assert_same, judged, of_kind, proved, replayed};

/// The unit circle, run through with the speed (e^u − 1)/u, u = k (x − s).
fn circle(quotient: &str, claim: &str) -> String {
    format!(
        "title = \"circle\"\n[state]\nx = \"-2..2\"\ny = \"-2..2\"\n[let]\nr = \"1 - x^2 - y^2\"\n\
         g = \"{quotient}\"\n[field]\n\"x'\" = \"g*(-y + x*r)\"\n\"y'\" = \"g*(x + y*r)\"\n\
         [[claim]]\n{claim}\nstate = {{ x = \"1\", y = \"0\" }}\n"
    )
}

/// ∮ dθ/g(cos θ), to rounding: the trapezoidal rule converges as a power.
fn period(inverse: impl Fn(f64) -> f64) -> f64 {
    let count = 400;
    (0..count).map(|k| inverse((2.0 * PI * (f64::from(k) + 0.3) / 400.0).cos())).sum::<f64>()
        * 2.0
        * PI
        / f64::from(count)
}

#[test]
fn orbits_pass_quotients_with_limits() {
    type Inverse = fn(f64) -> f64;
    let cases: [(&str, Inverse); 4] = [
        ("(exp(x) - 1)/x", |x| x / x.exp_m1()),
        ("(x - 1/2)/(1 - exp(-3*(x - 1/2)))", |x| -(-3.0 * (x - 0.5)).exp_m1() / (x - 0.5)),
        ("sin(2*x)/x", |x| x / (2.0 * x).sin()),
        ("(1 - cos(x))/x^2", |x| x * x / (2.0 * (x / 2.0).sin().powi(2))),
    ];
    for (quotient, inverse) in cases {
        let truth = period(inverse);
        let claim =
            format!("closed-orbit = {truth:.8}\nperiod = \"least\"\ndivergence = \"negative\"");
        let found = judged(&circle(quotient, &claim));
        assert_eq!(found.verdict, Verdict::Proved, "{quotient}: {:?}", found.evidence);
        assert_known(&found, "period", truth, 1e-12);
    }
}

#[test]
fn proofs_through_limits_are_replayed() {
    let truth = period(|x| x / x.exp_m1());
    let (case, found) = proved(&circle("(exp(x) - 1)/x", &format!("closed-orbit = {truth:.8}")));
    let again = replayed(&case, &found.data).expect("proved again");
    assert_same(again.period, found.period, "period");
    assert_same(again.volume, found.volume, "∮ div v dt");
}

#[test]
fn what_is_written_next_to_a_quotient_has_to_have_a_value() {
    let claim = |further: &str| {
        let text = format!(
            "title = \"x\"\n[state]\nx = \"-2..2\"\ny = \"-2..2\"\n[field]\n\"x'\" = \"-1\"\n\
             \"y'\" = \"sin(x)/x{further}\"\n[[claim]]\nreaches = \"y\"\nabove = \"1.8921661407343\"\n\
             below = \"1.8921661407344\"\nstate = {{ x = \"1\", y = \"0\" }}\ntime = \"2\"\n"
        );
        of_kind(Case::parse(&text, &[]).expect("a case"), "reaches").remove(0).verdict
    };
    // 2 Si(1)
    assert_eq!(claim(""), Verdict::Proved);
    assert_ne!(claim(" + 0*(1/x)"), Verdict::Proved, "0/0 is no quotient with a limit");
}

#[test]
fn quotients_without_limits_are_not_passed() {
    for quotient in ["x^2/x + 2", "(exp(x) - 1 - x/1000000)/(x - 1/1000000)"] {
        let found = judged(&circle(quotient, "closed-orbit = 6.28"));
        assert_ne!(found.verdict, Verdict::Proved, "{quotient}: {:?}", found.evidence);
    }
}
