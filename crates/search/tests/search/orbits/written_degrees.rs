//! Absence of integrals in the functions that a field contains, whose degree counts as they are written.

use liouville::case::Case;
use liouville::verdict::{Options, Verdict};

fn verdict(rates: [&str; 2], degree: u32) -> (Verdict, String) {
    let text = format!(
        "title = 't'\ncheck-weights = false\n[state]\nx = '-1..1'\ny = '-1..1'\n[field]\n\"x'\" = '{}'\n\
         \"y'\" = '{}'\n[[claim]]\nno-integral = {{ degree = {degree} }}\nexpect = 'open'\n",
        rates[0], rates[1]
    );
    let case = Case::parse(&text, &[]).expect("a case");
    let report = liouville_search::judge(&case, &Options::default()).expect("judged");
    let claim = &report.claims[0];
    (claim.verdict, format!("{:?}", claim.evidence))
}

#[test]
fn an_integral_of_degree_one_as_written_is_not_excluded() {
    // y + G is an integral of x' = h, y' = −G'h.
    let functions = [
        ("exp(x)", "exp(x)"),
        ("exp(-x)", "-exp(-x)"),
        ("exp(2*x)", "2*exp(2*x)"),
        ("exp(3*x)", "3*exp(3*x)"),
        ("sin(x)", "cos(x)"),
        ("cos(2*x)", "-2*sin(2*x)"),
        ("sin(3*x)", "3*cos(3*x)"),
        ("cosh(x)", "sinh(x)"),
    ];
    let factors = ["1 + y*exp(-x)", "1 + y*exp(2*x)", "2 + y*sin(x)", "1 + y*sin(x/2)"];
    let mut refuted = 0;
    for (turn, (function, slope)) in functions.into_iter().enumerate() {
        // Each function with two of the factors.
        for factor in [factors[turn % 4], factors[(turn + 1 + turn / 4) % 4]] {
            let rate = format!("-({slope})*({factor})");
            let (found, evidence) = verdict([factor, &rate], 1);
            assert_ne!(found, Verdict::Proved, "y + {function} with x' = {factor}: {evidence}");
            refuted += usize::from(found == Verdict::Refuted);
        }
    }
    assert!(refuted >= 8, "{refuted} integrals are exhibited");
}

#[test]
fn equal_fields_get_the_same_verdict() {
    // 15y + 10y² + 11y e^x + 9e^x + 3e^(2x) is an integral.
    let rate = "11*y*exp(2*x) + 6*exp(3*x) + 9*exp(2*x)";
    for first in ["(-20*y - 11*exp(x) - 15)*exp(x)", "exp(-x)*(-20*y - 11*exp(x) - 15)*exp(2*x)"] {
        let (found, evidence) = verdict([first, rate], 2);
        assert_eq!(found, Verdict::Refuted, "{first}: {evidence}");
    }
}

#[test]
fn what_has_no_integral_is_proved_to_have_none() {
    let fields = [
        (["y", "-sin(x) - y/2"], 3),
        (["y", "-sin(2*x) - y/2"], 2),
        (["y", "exp(-2*x) - exp(x) - y"], 2),
        (["y", "-sinh(x) - y"], 2),
    ];
    for (rates, degree) in fields {
        let (found, evidence) = verdict(rates, degree);
        assert_eq!(found, Verdict::Proved, "{rates:?}: {evidence}");
    }
}
