//! Functions, densities and fields that jump: what holds on both sides says nothing of a motion
//! that crosses.

use super::claims;
use liouville::verdict::Verdict;

fn remark(field: [&str; 2], claim: &str) -> String {
    let [first, second] = field;
    let text = format!(
        "title = 't'\n[state]\nx = '-3..3'\ny = '-3..3'\n[field]\n\"x'\" = '{first}'\n\
         \"y'\" = '{second}'\n[[claim]]\n{claim}\n"
    );
    let report = claims(&text).remove(0);
    assert_eq!(report.verdict, Verdict::Proved, "{claim}");
    report.evidence.remark.unwrap_or_default()
}

const TURN: [&str; 2] = ["y", "-x"];
const FRICTION: [&str; 2] = ["y", "-x - y/|y|"];
const GROWTH: [&str; 2] = ["x", "2*y"];

#[test]
fn jumps_are_told() {
    for (field, claim) in [
        (TURN, "integral = 'x/|x|*(x² + y²)'"),
        (TURN, "integral = '√(x²)/x*(x² + y²)'"),
        (TURN, "integral = '√(x²*(1 + y²))/√(1 + y²)/x'"),
        (TURN, "integral = 'exp(ln(x²)/2)/x*(x² + y²)'"),
        (TURN, "integral = '(x²)^(3/2)/x³*(x² + y²)'"),
        (TURN, "density = '2 + x/|x|'"),
        (TURN, "lyapunov = 'y/|y|'"),
        (FRICTION, "integral = 'x² + y² + 2*x*y/|y|'"),
    ] {
        let own = remark(field, claim);
        assert!(own.contains("F jumps") || own.contains("ρ jumps"), "{claim}: {own}");
    }
    for claim in [
        "lax = { L = '[[y/|y|, 0], [0, 1]]', A = '[[0, 0], [0, 0]]' }",
        "divergence = '0'\nvolume = '2 + y/|y|'",
        "map = { A = 'x*y/|y|', B = 'y' }\nfield = { A = '|B|', B = '-A*|B|/B' }",
    ] {
        let own = remark(TURN, claim);
        assert!(own.contains("y = 0 ") && own.contains(" jumps"), "{claim}: {own}");
    }
    let own = remark(FRICTION, "density = '1'");
    assert!(own.contains("y = 0 the field jumps"), "{own}");
}

#[test]
fn what_is_continuous_or_has_a_pole_does_not_jump() {
    for claim in [
        "integral = '|x|*x/y'",
        "integral = 'ln(|x|) − ln(|y|)/2'",
        "integral = '√(|y|)/|x|'",
        "integral = 'exp(ln(y²)/2)/exp(ln(x²))'",
        "integral = 'atan(y/x²)'",
        "integral = 'exp(−y²/x⁴)'",
        "density = '1/|x*y|'",
    ] {
        let own = remark(GROWTH, claim);
        assert!(!own.contains("jumps"), "{claim}: {own}");
    }
}

/// A sum over all pairs contains |qᵢ − qᵢ|, which is constant, although |x| has no slope at 0.
#[test]
fn a_modulus_of_nothing_has_the_slope_0() {
    let energy = "sum(i, 1..n, sum(j, 1..n, p[i]*p[j]*exp(−abs(q[i] − q[j]))))/2";
    for n in [2, 10] {
        let text = format!(
            "title = 't'\n[parameters]\nn = {n}\n[state]\nq = 'vector({n}, -3..3)'\n\
             p = 'vector({n}, 1..2)'\n[hamiltonian]\nfunction = '{energy}'\n\
             pairs = [['q', 'p']]\n[[claim]]\nintegral = 'sum(i, 1..n, p[i])'\n"
        );
        assert_eq!(claims(&text)[0].verdict, Verdict::Proved, "{n} peakons");
    }
}
