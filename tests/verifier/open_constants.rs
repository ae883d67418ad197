//! Claims whose residual contains an ∫: refuted where it vanishes for no constant, and undecided where it may for one,
//! however far away.

use liouville::case::Case;
use liouville::verdict::{Options, Verdict, judge};

fn verdict(state: &str, claim: &str) -> Verdict {
    let text = format!("title = 't'\n[parameters]\nk = '1..2'\n{state}\n[[claim]]\n{claim}\n");
    let case = Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    judge(&case, &Options::default()).unwrap_or_else(|error| panic!("{error}\n{text}")).claims[0]
        .verdict
}

const RUNNING: &str = "[state]\nx = '1/2..2'\n[field]\n\"x'\" = '1'";
const FREE: &str = "[state]\nx = '-1/4..1/4'\nv = '-1/4..1/4'\n[field]\n\"x'\" = 'v'\n\"v'\" = '0'";

#[test]
fn what_may_hold_for_a_constant_is_not_refuted() {
    for number in ["5", "10^5", "10^15", "10^30"] {
        for sign in ["+", "-"] {
            let claim = format!("integral = 'x*(∫(0,x) {sign} {number})'");
            assert_eq!(verdict(RUNNING, &claim), Verdict::Undecided, "{claim}");
        }
    }
    for function in [
        "x*(3000 − abs(∫(0,x) − 1000) − abs(∫(0,x) + 1000))",
        "x*(exp(∫(0,x)) − 10^20)",
        "x*(1 − 1/(1 + (∫(0,x) − 10^9)²))",
        "x*sin(∫(0,x))",
    ] {
        let claim = format!("integral = '{function}'");
        assert_eq!(verdict(RUNNING, &claim), Verdict::Undecided, "{claim}");
    }
    assert_eq!(verdict(FREE, "integral = 'x*(∫(0,v)/299792458² + 1)'"), Verdict::Undecided);
}

#[test]
fn what_holds_for_no_constant_is_refuted() {
    for function in
        ["x*exp(∫(0,x))", "x*exp(k*∫(0,x) + x)", "x + ∫(0,x)", "x*∫(0,x) − ∫(0,x)*x + x"]
    {
        let claim = format!("integral = '{function}'");
        assert_eq!(verdict(RUNNING, &claim), Verdict::Refuted, "{claim}");
    }
}

#[test]
fn states_without_a_value_refute_nothing_of_an_open_constant() {
    // For the constant 0 the second part holds; the first does where √y has a value.
    let claim = |first: &str| {
        format!("rate = '[{first}, x*∫(0,x)]'\nequals = '[{first} + x*(abs(y) - y), y*∫(0,x)]'")
    };
    let plane = "[state]\nx = '-1..1'\ny = '-1..1'\n[field]\n\"x'\" = '0'\n\"y'\" = '0'\n";
    assert_eq!(verdict(plane, &claim("0*log(y)")), Verdict::Undecided);
    assert_eq!(verdict(plane, &claim("0*x")), Verdict::Refuted, "|y| is not y for y < 0");
}

#[test]
fn an_integrand_that_may_depend_on_more_proves_nothing_of_motions() {
    // The divergence is not 0 for y > 0.9999.
    let state = "[state]\nx = '0..1'\ny = '0..1'\n[field]\nx = '1'\n\
                 y = '∫(exp(x*(y - 9999/10000 + |y - 9999/10000|)), x)'";
    assert_eq!(verdict(state, "density = '1'"), Verdict::Undecided);
    assert_eq!(verdict(state, "identity = '(x + y)^2 = x^2 + 2*x*y + y^2'"), Verdict::Proved);
    let state = "[state]\nx = '0..1'\ny = '0..1'\n\"x'\" = '-1..1'\n\"y'\" = '-1..1'\n[lagrangian]\n\
                 kinetic = \"(x'^2 + y'^2)/2\"\n\
                 potential = '∫(exp(x*(y - 9999/10000 + |y - 9999/10000|)), x)'";
    for claim in ["identity = \"y'' = 0\"", "rate = \"y'\"\nequals = '0'"] {
        assert_eq!(verdict(state, claim), Verdict::Undecided, "{claim}");
    }
    // |M| = M is not known of Motzkin's polynomial: that is no mistake of the file.
    let state = "[state]\nx = '-2..2'\ny = '-2..2'\n[let]\n\
                 M = 'x^4*y^2 + x^2*y^4 - 3*x^2*y^2 + 1'\n[field]\nx = '1'\n\
                 y = '∫(x + |M| - M, x)'";
    assert_eq!(verdict(state, "density = '1'"), Verdict::Undecided);
    let state = "[state]\nx = '0..1'\ny = '0..1'\n[field]\nx = '1'\ny = '∫(x*exp(x), x)'";
    assert_eq!(verdict(state, "density = '1'"), Verdict::Proved);
}
