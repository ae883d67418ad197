//! Levels that are solved by numbers: what is confirmed on them, and the witnesses found there.

use liouville::case::{Case, Setting};
use liouville::verdict::{ClaimReport, Options, Verdict, evaluate, judge, read_state};

fn text(parameters: &str, level: &str, claims: &[&str]) -> String {
    let claims: String =
        claims.iter().map(|own| format!("[[claim]]\n{own}\nexpect = \"open\"\n")).collect();
    format!(
        "title = \"t\"\n[parameters]\n{parameters}\n[state]\nx = \"-3..4\"\ny = \"-2..2\"\n\
         z = \"-2..2\"\n[field]\n\"x'\" = \"0\"\n\"y'\" = \"0\"\n\"z'\" = \"1\"\n\
         [level]\nequations = [\"{level} = 0\"]\n{claims}"
    )
}

fn judged(text: &str) -> Vec<ClaimReport> {
    let case = Case::parse(text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    judge(&case, &Options::default()).unwrap_or_else(|error| panic!("{error}\n{text}")).claims
}

#[test]
fn nothing_is_confirmed_beside_factors_without_slopes() {
    let curve = "(y^5 + y + x^5 + x − 1)";
    for flat in ["(x − y)^2", "x^2", "(1 − cos(x))", "(exp(2*y) − 2*exp(y) + 1)", "(x^2 + y^2)"]
    {
        let claims = ["identity = \"y^5 + y = 1 − x − x^5\"", "rate = \"z\"\nequals = \"1\""];
        let found = judged(&text("", &format!("{flat}*{curve}"), &claims));
        assert!(
            matches!(found[0].verdict, Verdict::Undecided | Verdict::Refuted),
            "{flat} is 0 where the claim fails: {:?}",
            found[0]
        );
        assert_eq!(found[1].verdict, Verdict::Proved, "{flat}: everywhere");
    }
    let found = judged(&text("", curve, &["identity = \"y^5 + y = 1 − x − x^5\""]));
    assert!(matches!(found[0].verdict, Verdict::Proved | Verdict::Confirmed), "{:?}", found[0]);
}

#[test]
fn nothing_is_confirmed_beside_factors_that_are_not_met() {
    let curve = "(y^5 + y + x^5 + x − 1)";
    let found = |factor: &str| {
        judged(&text("", &format!("{factor}*{curve}"), &["identity = \"y^5 + y = 1 − x − x^5\""]))
            .swap_remove(0)
    };
    for factor in [
        "(sqrt(1 + (x − sin(y))^2) − 1)",
        "(exp((x − sin(y))^2) − 1)",
        "sqrt(x − sin(y))",
        "acosh(1 + x − sin(y))",
        "(x − sin(y) − sin(x − sin(y)))",
    ] {
        assert_eq!(found(factor).verdict, Verdict::Undecided, "0 at x = sin y: {factor}");
    }
    for factor in ["(2 + x^2)", "exp(x)", "(x + 5)"] {
        assert_eq!(found(factor).verdict, Verdict::Confirmed, "nowhere 0: {factor}");
    }
}

#[test]
fn nothing_is_confirmed_that_fails_at_zeros_of_a_factor() {
    let curve = "(y^5 + y + x^5 + x + z − 1)";
    // Each f has zeros in the ranges, off the curve; each head is 0 where f is, and nearly all have no slope there.
    let zeros = ["(x − sin(y))", "(y*exp(x) − 1)", "(x + y − z)", "(z^2 − x)", "(x*y + z − 1/2)"];
    let heads = [
        "sqrt(F)",
        "F^(3/2)",
        "sqrt(sqrt(F))",
        "sqrt(F^2)",
        "abs(F)",
        "F*abs(F)",
        "(sqrt(4 + F^4) − 2)",
        "((8 + F^2)^(1/3) − 2)",
        "ln(1 + F^2)",
        "atan(F^2)",
        "(2^(F^2) − 1)",
        "F*sin(F)",
        "(F − atan(F))",
        "(exp(F) − 1 − F)",
        "asin(sqrt(F))",
        "(1 − 1/cosh(F))",
        "F*sqrt(F)*(2 + cos(F))",
        "(abs(1 + F^2) − 1)",
    ];
    for (turn, head) in heads.into_iter().enumerate() {
        let zero = zeros[turn % zeros.len()];
        let level = format!("{}*{curve}", head.replace('F', zero));
        let claims = ["identity = \"y^5 + y + z = 1 − x − x^5\""];
        // The field of `text` leaves this level.
        let all = text("", &level, &claims).replace("\"z'\" = \"1\"", "\"z'\" = \"0\"");
        let found = judged(&all).swap_remove(0);
        assert!(
            matches!(found.verdict, Verdict::Undecided | Verdict::Refuted),
            "{level}: {:?}",
            found.verdict
        );
    }
}

#[test]
fn printed_witnesses_are_on_the_level() {
    // Of most parameters that are drawn there is no state; others are drawn then.
    for (parameters, level) in [
        ("a = \"-30..3\"", "x^5 + x + y^4 + y + 1 − a*exp(x)"),
        ("a = \"one of 3, -1\"\nb = \"1..3\"", "a*exp(x) + b*exp(y)"),
    ] {
        let text = text(parameters, level, &["identity = \"x = 7\""]);
        let found = judged(&text);
        assert_eq!(found[0].verdict, Verdict::Refuted, "{level}");
        let witness = found[0].evidence.witness.as_ref().expect("a witness");
        let setting = |(name, value): (&String, &String)| Setting {
            name: name.clone(),
            value: value.clone(),
        };
        let settings: Vec<Setting> = witness.parameters.iter().map(setting).collect();
        let case = Case::parse(&text, &settings).expect("with these parameters");
        let state = read_state(&case, &witness.state).expect("a state");
        let point = evaluate(&case, Some(&state), 1, 0).expect("evaluated");
        let (off, error) = point.level[0].1.expect("a value");
        assert!(off.abs() <= 1e-9 + error, "{level}: off by {off} at {witness:?}");
    }
}
