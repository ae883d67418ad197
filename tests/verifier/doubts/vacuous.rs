//! Claims that hold and say nothing.

use super::claims;
use liouville::verdict::Verdict;

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
        ("lyapunov = '3'", "F is a constant"),
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
}
