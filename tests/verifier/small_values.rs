//! Claims on values that are 0 in f64, or of a few digits only, at all states that are drawn.

use liouville::case::Case;
use liouville::verdict::{Options, Verdict, judge};

/// Judges claims on x' = x, y' = y near 0.
fn judged(claims: &[&str]) -> Vec<Verdict> {
    let claims: String =
        claims.iter().map(|own| format!("[[claim]]\n{own}\nexpect = \"open\"\n")).collect();
    let text = format!(
        "title = \"t\"\n[state]\nx = \"0.001..0.01\"\ny = \"0.001..0.01\"\n[field]\n\"x'\" = \"x\"\n\
         \"y'\" = \"y\"\n{claims}"
    );
    let case = Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let found = judge(&case, &Options::default()).unwrap_or_else(|error| panic!("{error}\n{text}"));
    found.claims.into_iter().map(|own| own.verdict).collect()
}

#[test]
fn values_below_all_f64_are_not_0() {
    let refuted = [
        "identity = \"x^400 = 0\"",
        "identity = \"x^400 = y^400\"",
        "identity = \"exp(-1/x^2) = exp(-1/y^2)\"",
        "identity = \"exp(-1000000/x) = 0\"",
        "integral = \"x^400*exp(-1/y^2)\"",
        "integral = \"atan(x^400)\"",
        "lyapunov = \"x^400\"",
        "lyapunov = \"exp(-1/x^2)\"",
        "density = \"exp(-1/x^2)\"",
        "rate = \"x^400\"\nequals = \"401*x^400\"",
    ];
    for (claim, verdict) in refuted.iter().zip(judged(&refuted)) {
        assert_eq!(verdict, Verdict::Refuted, "{claim}");
    }
    let proved = [
        "integral = \"x^400/y^400\"",
        "integral = \"ln(x^400) - ln(y^400)\"",
        "lyapunov = \"-x^400\"",
        "lyapunov = \"-exp(-1/x^2)\"",
        "density = \"x^400/(y^400*x*y)\"",
        "identity = \"sqrt(x^800) = x^400\"",
        "identity = \"exp(-1/x^2)*exp(1/x^2) = 1\"",
        "rate = \"x^400\"\nequals = \"400*x^400\"",
    ];
    for (claim, verdict) in proved.iter().zip(judged(&proved)) {
        assert_eq!(verdict, Verdict::Proved, "{claim}");
    }
    // Beyond the numbers of many digits nothing is known.
    let open = [
        "identity = \"exp(-exp(1/x)) = 0\"",
        "integral = \"exp(-exp(1/x))\"",
        "identity = \"sin(exp(-1/x^2)) = 0\"",
        "lyapunov = \"exp(-exp(1/x))\"",
    ];
    for (claim, verdict) in open.iter().zip(judged(&open)) {
        let is_claimed = matches!(verdict, Verdict::Proved | Verdict::Confirmed);
        assert!(!is_claimed, "{claim}: {verdict:?}");
    }
}
