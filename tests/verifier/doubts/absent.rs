//! Formulas that have no value because of a part that cancels.

use super::claims;
use liouville::verdict::Verdict;

fn verdict(range: &str, identity: &str) -> Verdict {
    let text = format!(
        "title = 't'\n[parameters]\na = 3\n[state]\nx = '{range}'\n[field]\n\"x'\" = '0'\n\
         [[claim]]\nidentity = '{identity}'\nexpect = 'open'\n"
    );
    claims(&text).remove(0).verdict
}

/// Identities whose parts under a root cancel, with a value for x > 0 alone.
const FOR_POSITIVE: [&str; 8] = [
    "1 = √(1 + 0*√x)",
    "1 = √(√x*0 + 1)",
    "√(√(x − √x*√x) + 1) = 1",
    "√(3 + 0*ln(x)) = √3",
    "√(√x*0 + a) = √a",
    "|x| = √(x*(x + 0*√x))",
    "√(1 + x² + 0*√x) = √(1 + x²)",
    "√(4 + 0*√(2 + 0*√x)) = 2",
];

#[test]
fn a_root_requires_what_cancels_under_it() {
    for identity in FOR_POSITIVE {
        assert_eq!(verdict("1..2", identity), Verdict::Proved, "{identity} for x > 0");
        assert_eq!(
            verdict("-1..2", identity),
            Verdict::Proved,
            "{identity} for x > 0 among others"
        );
        assert_eq!(verdict("-2..-1", identity), Verdict::Undecided, "{identity} has no value");
    }
}

#[test]
fn roots_whose_factors_come_later_are_left() {
    let text = "title = 't'\n[state]\nx = '-2..2'\ny = '-20..20'\nz = '-20..20'\n[field]\n\"x'\" = '0'\n\
         \"y'\" = '0'\n\"z'\" = '0'\n[level]\nequations = ['(z/1)^(1/4) + y^2 + 1 = x + 1']\n\
         [[claim]]\nintegral = 'sqrt(z/2) + (z^(1/4) + y^2) - (sqrt(sqrt(sqrt(z)^2)^2/2) + x)'\n";
    assert_eq!(claims(text).remove(0).verdict, Verdict::Proved, "√(√(√z²)²/2) is √(z/2)");
}
