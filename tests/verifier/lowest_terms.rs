//! Claims about maps and brackets of textbooks that need a quotient in lowest terms, or a slope of an abbreviation.

use liouville::case::Case;
use liouville::verdict::{Options, Verdict, judge};

fn verdicts(text: &str) -> Vec<Verdict> {
    let case = Case::parse(text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let report = judge(&case, &Options::default()).unwrap_or_else(|error| panic!("{error}"));
    report.claims.iter().map(|claim| claim.verdict).collect()
}

#[test]
fn common_factors_are_cancelled_before_bounds() {
    // det DΦ = 1/R at x = K.
    let map = |rate: &str| {
        format!(
            "title = 't'\nsystem = 'map'\n[parameters]\nR = '1.1..3'\nK = '1..2'\n[state]\nx = '0.1..3'\n[map]\n\
             x = '{rate}'\n[[claim]]\nno-density-near = {{ x = 'K' }}\nexpect = 'open'\n"
        )
    };
    assert_eq!(verdicts(&map("R*x/(1 + (R - 1)*x/K)")), [Verdict::Proved]);
    // det DΦ = R > 1.
    assert_eq!(verdicts(&map("K + R*(x - K)")), [Verdict::Undecided]);
}

#[test]
fn brackets_may_contain_slopes_of_abbreviations() {
    let nambu = |sign: &str| {
        format!(
            "title = 't'\n[state]\nx = 'vector(-2..2)'\n[let]\nH = '(x1^2 + x2^2)/2'\nG = 'x3 + x1*x2'\n[field]\n\
             x = '∂H/∂x×∂G/∂x'\n[poisson]\n\"x,x\" = 'hat({sign}∂G/∂x)'\n[[claim]]\njacobi-identity = 'holds'\n\
             [[claim]]\ncasimir = 'G'\n[[claim]]\ncasimir = 'H'\nexpect = 'open'\n[[claim]]\nhamiltonian = 'H'\n\
             expect = 'open'\n[[claim]]\nhamiltonian = '-H'\nexpect = 'open'\n"
        )
    };
    let (proved, refuted) = (Verdict::Proved, Verdict::Refuted);
    let own = verdicts(&nambu("-"));
    assert_eq!(own[..3], [proved, proved, refuted]);
    let other = verdicts(&nambu(""));
    assert_eq!(other[..3], [proved, proved, refuted]);
    // One sign of H goes with one sign of the bracket.
    assert_eq!([own[3], own[4]], [other[4], other[3]]);
    assert!(own[3] != own[4] && [own[3], own[4]].contains(&proved), "{own:?}");
}
