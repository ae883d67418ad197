//! States at which a claim says nothing, since a formula of it has no value there: the report says how many.

use super::level_parts::Draws;
use liouville::case::Case;
use liouville::verdict::{ClaimReport, Options, Verdict, evaluate, judge};

/// Judges claims about x' = y' = 0, on a level if one is given.
fn judged(level: Option<&str>, claims: &[String]) -> Vec<ClaimReport> {
    let level = level.map_or(String::new(), |own| format!("[level]\nequations = [\"{own}\"]\n"));
    let claims: String =
        claims.iter().map(|own| format!("[[claim]]\n{own}\nexpect = \"open\"\n")).collect();
    let text = format!(
        "title = \"t\"\n[parameters]\n\"ε\" = \"-1..1\"\n[state]\nx = \"-2..2\"\ny = \"-2..2\"\n\
         [field]\n\"x'\" = \"0*ε\"\n\"y'\" = \"0\"\n{level}{claims}"
    );
    let case = Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    judge(&case, &Options::default()).unwrap_or_else(|error| panic!("{error}\n{text}")).claims
}

/// Reads the numbers of a remark that nothing is said at some states.
fn silent(report: &ClaimReport) -> Option<(f64, f64)> {
    let remark = report.evidence.remark.as_ref()?;
    let (_, rest) = remark.split_once("nothing is said at ")?;
    let mut words = rest.split(' ');
    let mut number = || words.find_map(|word| word.parse().ok());
    Some((number()?, number()?))
}

/// A curve on which x takes all values, and that is not divided.
const CURVE: &str = "x^5 + x + y^5 + y = 1/2";

#[test]
fn the_share_of_states_without_a_value_is_told() {
    for index in 0..12 {
        let mut draws = Draws(300 + index);
        // The root has a value for x > c.
        let c = 0.25 * (draws.below(5) as f64) - 1.0;
        let k = 1 + draws.below(3);
        let level = (draws.below(2) == 0).then_some(CURVE);
        let root = format!("√(x − ({c}))");
        let claims = [
            format!(
                "identity = \"({root} + {k}*y)^2 = x − ({c}) + {}*y*{root} + {}*y^2\"",
                2 * k,
                k * k
            ),
            format!("identity = \"(y + {k}*x)^2 = y^2 + {}*x*y + {}*x^2\"", 2 * k, k * k),
        ];
        let found = judged(level, &claims);
        for own in &found {
            assert!(matches!(own.verdict, Verdict::Proved | Verdict::Confirmed), "{own:?}");
        }
        let (count, all) = silent(&found[0]).unwrap_or_else(|| panic!("{:?}", found[0]));
        let share = (c + 2.0) / 4.0;
        let is_near = level.is_some() || (count / all - share).abs() < 0.2;
        assert!(is_near, "{count} of {all}, with the share {share}");
        assert!(all > 40.0 && 0.0 < count && count < all, "{count} of {all}");
        assert_eq!(silent(&found[1]), None, "everything has a value");
    }
}

#[test]
fn a_branch_on_which_nothing_is_judged_is_not_confirmed() {
    // y = 0 is a branch, on which ε/(ε + y²) is 1 for each ε ≠ 0, and 1/y has no value.
    let level = format!("y*({}) = 0", "x^5 + x + y^5 + y − 1/2");
    let claims = [
        "limit = \"ε/(ε + y^2)\"\nparameter = \"ε\"\nequals = \"0\"".to_string(),
        "identity = \"y*(1/y)*(x^5 + x + y^5 + y) = 1/2\"".to_string(),
        "identity = \"(√(y) + x)^2 = y + 2*x*√(y) + x^2\"".to_string(),
    ];
    let found = judged(Some(&level), &claims);
    for own in &found {
        assert!(own.verdict != Verdict::Refuted, "{own:?}");
        let is_told = own.verdict == Verdict::Undecided || own.evidence.remark.is_some();
        assert!(is_told, "{own:?}");
    }
    assert_eq!(found[0].verdict, Verdict::Undecided, "{:?}", found[0]);
}

#[test]
fn a_part_where_the_claim_has_no_value_is_named() {
    // Each claim holds wherever it has a value, as it contains the equation. On y = 1 it has none; where that is
    // not divided off, balls do not show it.
    for (level, claim, told) in [
        ("x*(y − 1) = 0", "x*(y − 1)*√(−x^2) = 0", "nothing is said on a part of the level"),
        (
            "(y − 1)*(y − exp(x)) = 0",
            "(y − 1)*(y − exp(x))/(y − 1 + |y − 1|) = 0",
            "states it is not known whether a formula has a value",
        ),
    ] {
        let found = judged(Some(level), &[format!("identity = \"{claim}\"")]);
        assert_eq!(found[0].verdict, Verdict::Proved, "{claim}");
        let remark = found[0].evidence.remark.clone().unwrap_or_default();
        assert!(remark.contains(told), "{claim}: {remark}");
    }
    let found = judged(Some("x*(y − 1) = 0"), &["identity = \"x*(y − 1)*√(1 + x^2) = 0\"".into()]);
    assert_eq!(found[0].evidence.remark, None, "it has a value on both");
}

#[test]
fn states_at_which_an_equation_has_no_value_are_not_drawn() {
    let text = "title = \"t\"\n[state]\nx = \"-2..2\"\ny = \"-2..2\"\nz = \"-2..2\"\n\
                [field]\n\"x'\" = \"0\"\n\"y'\" = \"0\"\n\"z'\" = \"0\"\n\
                [level]\nequations = [\"y*(y − 1) = 0\", \"x/y = 0\"]\n\
                [[claim]]\nidentity = \"z = 7*y\"\nexpect = \"open\"\n";
    let case = Case::parse(text, &[]).expect("a case");
    for index in 0..8 {
        let point = evaluate(&case, None, 1, index).expect("evaluated");
        let y = point.state.iter().find(|(name, _)| name == "y").map(|(_, value)| value.concat());
        assert_eq!(y.as_deref(), Some("1"), "state {index}");
    }
    let found = judge(&case, &Options::default()).expect("judged").claims;
    let witness = found[0].evidence.witness.as_ref().expect("a witness");
    let index = witness.index.expect("a state that was drawn");
    let point = evaluate(&case, None, 1, index).expect("evaluated");
    let own = |name: &str| point.state.iter().find(|own| own.0 == name).map(|own| own.1.concat());
    let z = format!("z={}", own("z").expect("z"));
    assert!(witness.state.split(' ').any(|part| part == z), "state {index}: {z}, {witness:?}");
}
