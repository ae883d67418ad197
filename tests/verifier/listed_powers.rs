//! Powers with exponents from lists, some of them whole numbers, which take any base.

use liouville::case::Case;
use liouville::verdict::{Options, Verdict, judge};

fn verdict(exponents: &str, x: &str, level: &str, claim: &str) -> Verdict {
    let text = format!(
        "title = \"t\"\n[parameters]\na = \"one of {exponents}\"\n[state]\nx = \"{x}\"\ny = \"-2..2\"\n\
         [field]\n\"x'\" = \"x\"\n\"y'\" = \"a*y\"\n{level}\n[[claim]]\n{claim}\nexpect = \"open\"\n"
    );
    let case = Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let report = judge(&case, &Options::default()).unwrap_or_else(|error| panic!("{error}"));
    report.claims[0].verdict
}

#[test]
fn what_holds_for_positive_bases_alone_is_not_proved() {
    let level = "[level]\nequations = [\"y = x^a\"]";
    let even = "identity = \"x = abs(x)\"";
    for exponents in ["2, 4", "2", "1/2, 4", "-2, 1/3"] {
        let found = verdict(exponents, "-2..2", level, even);
        assert_ne!(found, Verdict::Proved, "x < 0 is on the level for a of {exponents}");
    }
    let odd = "identity = \"x^a*abs(x) = x^(a + 1)\"";
    assert_ne!(verdict("2, 3", "-2..2", "", odd), Verdict::Proved);
    assert_ne!(verdict("2, 3", "-2..2", "", "lyapunov = \"-x^a\""), Verdict::Proved);
}

#[test]
fn positive_bases_and_fractions_lose_nothing() {
    let odd = "identity = \"x^a*abs(x) = x^(a + 1)\"";
    assert_eq!(verdict("2, 3", "1..2", "", odd), Verdict::Proved, "x > 0");
    assert_eq!(verdict("1/3, 4/3", "-2..2", "", odd), Verdict::Proved, "only x > 0 has a power");
    let integral = "integral = \"y/x^a\"";
    assert_eq!(verdict("2, 1/2", "1/2..2", "", integral), Verdict::Proved);
    assert_eq!(verdict("2, 3", "-2..2", "", "identity = \"x^a = 2*x^a\""), Verdict::Refuted);
}
