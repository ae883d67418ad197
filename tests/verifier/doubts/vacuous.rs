//! Claims that hold and say nothing.

use super::claims;
use liouville::case::Case;
use liouville::verdict::{Options, Verdict, judge};

fn remark(claim: &str) -> String {
    let text = format!(
        "title = 't'\n[state]\nx = '-2..2'\ny = '-2..2'\n[field]\n\"x'\" = 'y'\n\"y'\" = '-x'\n\
         [[claim]]\n{claim}\n"
    );
    let report = claims(&text).remove(0);
    assert_eq!(report.verdict, Verdict::Proved, "{claim}");
    report.evidence.remark.unwrap_or_default()
}

#[test]
fn claims_that_say_nothing_are_told() {
    for (claim, wanted) in [
        ("invariant-relation = 'x − x'\ncofactor = '0'", "F is 0 identically"),
        ("invariant-relation = '(x + y)² − x² − 2*x*y − y²'\ncofactor = '1'", "F is 0 identically"),
        ("invariant-relation = 'x² + y² + 1'\ncofactor = '0'", "contains no state"),
        ("invariant-relation = 'x² + y² − 100'\ncofactor = '0'", "contains no state"),
        ("symmetry-field = { x = '0', y = '0' }", "a multiple of the field"),
        ("symmetry-field = { x = '(x²+y²)*y', y = '−(x²+y²)*x' }", "a multiple of the field"),
        ("lyapunov = '3'", "the slope of F is 0"),
        ("form = { x = '0' }", "the form is 0"),
        ("lax = { L = '[[1,0],[0,2]]', A = '[[0,0],[0,0]]' }", "tr Lᵏ is constant"),
        ("lax = { L = '[[0,0,0],[x,0,0],[y,0,0]]', A = '[[0,0,0],[0,0,−1],[0,1,0]]' }", "tr Lᵏ"),
    ] {
        let own = remark(claim);
        assert!(own.contains(wanted), "{claim}: {own}");
    }
}

#[test]
fn claims_that_say_something_are_not() {
    for claim in [
        "invariant-relation = 'x² + y² − 1'\ncofactor = '0'",
        "symmetry-field = { x = 'x', y = 'y' }",
        "lyapunov = 'x² + y²'",
        "form = { x = 'x', y = 'y' }",
        "lax = { L = '[[y,x],[x,−y]]', A = '[[0,½],[−½,0]]' }",
    ] {
        assert_eq!(remark(claim), "", "{claim}");
    }
}

#[test]
fn listed_values_for_which_a_formula_has_no_value_are_named() {
    let text = |a: &str, claim: &str| {
        format!(
            "title = 't'\n[parameters]\na = 'one of {a}'\n[state]\nx = '-1..1'\ny = '-1..1'\n[field]\n\
             \"x'\" = 'y'\n\"y'\" = '−x'\n[[claim]]\n{claim}\n"
        )
    };
    for claim in [
        "integral = '(x² + y²)*a/a'",
        "lyapunov = 'x² + y²'\nequals = '0*a/a'",
        "rate = 'x²'\nequals = '2*x*y*a/a'",
        "identity = 'x*a/a = x'",
        "density = '1 + 0/a'",
    ] {
        let remark = |a: &str| {
            let report = claims(&text(a, claim)).remove(0);
            assert_eq!(report.verdict, Verdict::Proved, "{claim}");
            report.evidence.remark.unwrap_or_default()
        };
        assert!(
            remark("0, 1").contains("nothing is said for a = 0,"),
            "{claim}: {}",
            remark("0, 1")
        );
        assert!(!remark("1, 2").contains("nothing is said"), "{claim}: {}", remark("1, 2"));
    }
    let field = "title = 't'\n[parameters]\na = 'one of 0, 1'\n[state]\nx = '-1..1'\ny = '-1..1'\n[field]\n\
                 \"x'\" = 'y/a'\n\"y'\" = '−x/a'\n[[claim]]\nintegral = 'x² + y²'\n";
    let remark = claims(field).remove(0).evidence.remark.unwrap_or_default();
    assert!(remark.contains("nothing is said for a = 0,"), "the field: {remark}");
}

#[test]
fn a_claim_with_a_value_at_single_states_says_nothing() {
    // x ≤ 1 on the circle, and x = 1 at u = 1.
    for seed in [1, 944_288] {
        let text = "title = 't'\n[state]\nx = '-1..1'\ny = '-1..1'\nz = '-1..1'\n[field]\n\"x'\" = '0'\n\
                    \"y'\" = '0'\n\"z'\" = '0'\n[level]\nequations = ['x² + y² = 1']\n[level.chart]\n\
                    inputs = { u = '1/2..2', v = '-1/2..2' }\nx = '2*u/(1 + u²)'\n\
                    y = '(1 - u²)/(1 + u²)'\nz = 'v'\n[[claim]]\nidentity = '0*√(x − 1) = 0'\n\
                    [[claim]]\nidentity = '0*√(1 − x) = 0'\n[[claim]]\nidentity = '√(x² + y² − 1) = 0'\n";
        let case = Case::parse(text, &[]).expect("a case");
        let report = judge(&case, &Options { seed, ..Options::default() }).expect("judged");
        let verdicts: Vec<Verdict> = report.claims.iter().map(|claim| claim.verdict).collect();
        assert_eq!(verdicts, [Verdict::Undecided, Verdict::Proved, Verdict::Proved], "{seed}");
    }
}
