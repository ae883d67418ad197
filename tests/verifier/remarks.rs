//! Remarks on what a file may say by mistake.

use liouville::case::Case;

fn remarks(more: &str) -> Vec<String> {
    let text = format!("title = 't'\n{more}");
    let case = Case::parse(&text, &[]).expect("a case");
    case.remarks.iter().map(ToString::to_string).collect()
}

const FLOW: &str = "[state]\nx = '1..2'\n[field]\n\"x'\" = 'k*x'\n";
const CLAIM: &str = "[[claim]]\nrate = 'x'\nequals = 'k*x'\n";

#[test]
fn slips_that_are_no_mistakes_are_remarked() {
    let told = |parameters: &str, more: &str, wanted: &str| {
        let all = remarks(&format!("[parameters]\n{parameters}\n{FLOW}{CLAIM}{more}"));
        assert_eq!(all.len(), usize::from(!wanted.is_empty()), "{all:?}");
        assert!(all.iter().all(|text| text.contains(wanted)), "{all:?}");
    };
    told("k = 1", "", "");
    told("k = 1\nspare = 2", "", "`spare` stands in no formula");
    told("k = 1\nspare = 'spare2'\nspare2 = 1", "", "`spare` stands in no formula");
    told("k = '1-3'", "", "`k = \"1-3\"` is the number -2; a range is written \"1..3\"");
    told("k = '3 − 1'", "", "is the number 2");
    told("k = 1", "[body]\nshape = 'ball'\n", "[body] is not read");
    told("k = 1", "[section]\ng0 = 'pi'\nenergy = 1\n", "[section] is not read");
    told("k = 1", "[[claim]]\ndensity = '0'\nexpect = 'open'\n", "of a measure must be positive");
    told("k = 1", "[[claim]]\ndensity = -1\nexpect = 'open'\n", "of a measure must be positive");
    told("k = 1", "[[claim]]\ndensity = '1/x'\nexpect = 'open'\n", "");
    told("k = 'A1'\nA = [1, 2]\nA1 = 3", "[let]\nB = 'A'\n", "hides that component of `A`");
    let all = remarks(&format!("[parameters]\nk = 1\n{FLOW}"));
    assert!(all.len() == 1 && all[0].contains("there are no claims"), "{all:?}");
}

#[test]
fn a_field_that_jumps_is_named_under_its_symmetries() {
    use liouville::case::Case;
    use liouville::verdict::{Flaw, Options, Verdict, judge};
    let found = |rate: &str| {
        let text = format!(
            "title = 'x'\n[state]\nx = '-1..1'\nv = '-1..1'\n[field]\n\"x'\" = 'v'\n\"v'\" = '{rate}'\n[[claim]]\n\
             symmetry-field = {{ x = '1' }}\n"
        );
        let case = Case::parse(&text, &[]).expect("a case");
        judge(&case, &Options::default()).expect("a report").claims.remove(0)
    };
    let jumping = found("-x/|x|");
    assert_eq!(jumping.verdict, Verdict::Proved);
    assert_eq!(jumping.evidence.flaws, [Flaw::Jumps]);
    let smooth = found("-v");
    assert_eq!((smooth.verdict, smooth.evidence.flaws.len()), (Verdict::Proved, 0));
}

#[test]
fn what_comes_back_from_infinity_with_the_other_sign_does_not_fall_along_motions() {
    use liouville::case::Case;
    use liouville::verdict::{Flaw, Independence, Options, Verdict, judge};
    let found = |claim: &str| {
        let text = format!(
            "title = 'x'\n[state]\nx = '-2..2'\ny = '-2..2'\n[field]\n\"x'\" = '1 + x²'\n\"y'\" = '0'\n\
             [[claim]]\n{claim}\n"
        );
        let case = Case::parse(&text, &[]).expect("a case");
        judge(&case, &Options::default()).expect("a report").claims.remove(0)
    };
    for (function, jumps) in [("1/x", true), ("-tan(x)", true), ("1/(x - 5)", false), ("-x", false)]
    {
        let one = found(&format!("lyapunov = '{function}'"));
        assert_eq!(one.verdict, Verdict::Proved, "{function}");
        assert_eq!(one.evidence.flaws.contains(&Flaw::Jumps), jumps, "{function}");
    }
    // A function of two values is no constant.
    for (function, mark) in [("sign(y)", None), ("y - y + 1", Some(Independence::Constant))] {
        let one = found(&format!("integral = '{function}'"));
        assert_eq!((one.verdict, one.evidence.independence), (Verdict::Proved, mark), "{function}");
    }
}

#[test]
fn densities_that_are_smaller_than_any_double_have_their_sign() {
    use liouville::case::Case;
    use liouville::verdict::{DensitySign, Options, Verdict, judge};
    for (density, expected) in [
        ("exp(-1000 - x^2)", DensitySign::Positive),
        ("-exp(-1000 - x^2)", DensitySign::Negative),
        ("exp(-1000*x^2)", DensitySign::Positive),
    ] {
        let text = format!(
            "title = 'x'\n[state]\nx = '-2..2'\ny = '-2..2'\n[field]\n\"x'\" = '0'\n\"y'\" = 'x'\n\
             [[claim]]\ndensity = '{density}'\n[[claim]]\nintegral = 'max(x, 0)'\n"
        );
        let case = Case::parse(&text, &[]).expect("a case");
        let found = judge(&case, &Options::default()).expect("a report").claims.remove(0);
        assert_eq!(found.verdict, Verdict::Proved, "{density}");
        assert_eq!(found.evidence.sign, Some(expected), "{density}");
    }
}
