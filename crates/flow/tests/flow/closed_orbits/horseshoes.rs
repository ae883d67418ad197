//! Horseshoes: proved at the saddle of figure 8, and not where there is none.

use std::path::Path;

use liouville::case::Case;
use liouville::verdict::{ClaimReport, Verdict};

use super::of_kind;

fn horseshoe(text: &str) -> ClaimReport {
    let case = Case::parse(text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    of_kind(case, "horseshoe").remove(0)
}

/// A pendulum's saddle and an oscillator that does not touch it: integrable, and the saddle's stable
/// and unstable curves are one.
const INTEGRABLE: &str = r#"
title = "a saddle and an oscillator"
[state]
x = "-2..2"
u = "-2..2"
y = "-2..2"
v = "-2..2"
[field]
"x'" = "u"
"u'" = "x − x³"
"y'" = "v"
"v'" = "−y"
[[claim]]
horseshoe = 6.2832
state = { x = "0", u = "0", y = "1", v = "0" }
integrals = ["(u² + v² − x² + y²)/2 + x^4/4"]
integral = "none"
"#;

/// Duffing's oscillator with a force of frequency 3.
const DUFFING: &str = r#"
title = "Duffing"
[state]
x = "-2..2"
p = "-2..2"
c = "-2..2"
s = "-2..2"
[level]
equations = ["c² + s² = 1"]
[field]
"x'" = "p"
"p'" = "x − x³ + c/10"
"c'" = "−3*s"
"s'" = "3*c"
[[claim]]
horseshoe = 2.0944
state = { x = "-0.0101", p = "0", c = "1", s = "0" }
integral = "none"
"#;

/// Hénon and Heiles' system at the energy 0.122.
const HENON_HEILES: &str = r#"
title = "Hénon and Heiles"
[state]
x = "-1..1"
y = "-1..1"
p = "-1..1"
q = "-1..1"
[hamiltonian]
function = "(p² + q² + x² + y²)/2 + x²*y − y³/3"
pairs    = [["x", "p"], ["y", "q"]]
[[claim]]
horseshoe = 6.90
state = { x = "0", y = "-0.1837024", p = "0.458202", q = "0" }
integral = "none"
"#;

fn of_figure(number: &str, saddle: &str) -> ClaimReport {
    let cases = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../cases/figures"));
    let path = cases.join(format!("fig-{number}.toml"));
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{error}"));
    let claimed = format!("{text}\n{saddle}");
    let case = Case::parse(&claimed, &[]).unwrap_or_else(|error| panic!("{number}: {error}"));
    of_kind(case, "horseshoe").remove(0)
}

fn has_a_horseshoe(figure: &str, least: &str) {
    let claim = of_figure(figure, "");
    assert_eq!(claim.verdict, Verdict::Proved, "{figure}: {:?}", claim.evidence);
    let theorem = claim.evidence.theorem.expect("stated");
    assert!(theorem.contains("real-analytic integral"), "{figure}: {theorem}");
    assert!(theorem.contains(least), "{figure}: {theorem}");
    assert!(theorem.ends_with("and all near them"), "{figure}: {theorem}");
}

#[test]
#[ignore = "slow: the certificate of Duffing's horseshoe in liouville-cli takes the same steps"]
fn the_saddle_of_figure_8_has_a_horseshoe() {
    has_a_horseshoe("8", "entropy ≥ 0.0184");
}

#[test]
#[ignore = "slow: as that of figure 8"]
fn the_saddle_of_figure_11_has_a_horseshoe() {
    has_a_horseshoe("11", "entropy ≥ 0.0049");
}

#[test]
#[ignore = "slow: as that of figure 8"]
fn the_saddle_of_figure_5_has_a_horseshoe() {
    has_a_horseshoe("5", "entropy ≥ 0.0086");
}

#[test]
#[ignore = "slow: as that of figure 8"]
fn the_saddle_of_figure_a1_c_has_a_horseshoe() {
    has_a_horseshoe("A1-c", "entropy ≥ 0.0199");
}

/// The nodes are those of the orbit that Newton's method finds: with those of the start and the period
/// as stated, the last segment would be off by the digits left out.
#[test]
fn the_digits_of_the_period_do_not_change_a_horseshoe() {
    let with =
        |period: &str, x: &str| horseshoe(&DUFFING.replace("2.0944", period).replace("-0.0101", x));
    let theorem = |claim: ClaimReport| {
        assert_eq!(claim.verdict, Verdict::Proved, "{:?}", claim.evidence);
        claim.evidence.theorem.expect("stated")
    };
    let found = theorem(with("2.09440", "-0.01010"));
    assert!(found.contains("near the saddle of period 2.094395"), "{found}");
    for (period, x) in [("2.0944", "-0.0101"), ("2.1", "-0.01"), ("2.09", "-0.0102")] {
        let other = theorem(with(period, x));
        let relations = |text: &str| {
            let before = text.split(" relations").next().unwrap_or_default();
            before.rsplit('(').next().map(str::to_string)
        };
        assert_eq!(relations(&other), relations(&found), "{period}, {x}: {other}");
    }
    let wrong = with("2.0954", "-0.0101");
    assert_eq!(wrong.verdict, Verdict::Refuted, "another period: {:?}", wrong.evidence);
}

/// Its motions come back less near to the saddle, and later, than those of figures.
#[test]
fn the_saddle_of_henon_and_heiles_has_a_horseshoe() {
    let claim = horseshoe(HENON_HEILES);
    assert_eq!(claim.verdict, Verdict::Proved, "{:?}", claim.evidence);
    let theorem = claim.evidence.theorem.expect("stated");
    assert!(theorem.contains("real-analytic integral"), "{theorem}");
    // Separable in x ± y: there are saddles, and no horseshoes.
    let other = horseshoe(&HENON_HEILES.replace("x²*y − y³/3", "x²*y + y³/3"));
    assert_eq!(other.verdict, Verdict::Undecided, "{:?}", other.evidence);
}

#[test]
fn the_saddle_of_an_integrable_figure_has_none() {
    has_none("3", "4.6597349369");
}

#[test]
#[ignore = "slow: as that of figure 3, whose period is a quarter"]
fn the_saddle_of_another_integrable_figure_has_none() {
    has_none("4", "17.716785086");
}

/// Claims a horseshoe at the saddle of a figure, which has none.
fn has_none(figure: &str, period: &str) {
    let saddle = format!("[[claim]]\nhorseshoe = {period}\nstart = [0, 0]\nintegral = \"none\"\n");
    let claim = of_figure(figure, &saddle);
    assert_eq!(claim.verdict, Verdict::Undecided, "{figure}: {:?}", claim.evidence);
    let reason = claim.evidence.reason.expect("a reason");
    assert!(reason.contains("returns to it"), "{figure}: {reason}");
}

#[test]
fn no_horseshoe_is_proved_where_there_is_none() {
    let with = |from: &str, to: &str| {
        assert!(INTEGRABLE.contains(from), "{from}");
        horseshoe(&INTEGRABLE.replace(from, to))
    };
    let both = "integrals = [\"(u² − x²)/2 + x^4/4\", \"v² + y²\"]";
    let one = "integrals = [\"(u² + v² − x² + y²)/2 + x^4/4\"]";
    for (name, claim, reason) in [
        ("curves that are one", horseshoe(INTEGRABLE), "homoclinic orbit are not proved"),
        ("a centre", with("x = \"0\"", "x = \"1\""), "no saddle"),
        // the first is critical on the saddle, and is left out
        ("both integrals known", with(one, both), "homoclinic orbit are not proved"),
        ("no integral known", with(one, ""), "leave 3 dimensions, not 4"),
        ("no integral", with("x^4/4", "x^4/5"), "not proved that the motion keeps"),
        ("a rest", with("y = \"1\"", "y = \"0\""), "leave 3 dimensions, not 4"),
    ] {
        assert_eq!(claim.verdict, Verdict::Undecided, "{name}: {:?}", claim.evidence);
        let found = claim.evidence.reason.clone().expect("a reason");
        assert!(found.contains(reason), "{name}: {found}");
    }
}

#[test]
fn mistakes_in_horseshoes_have_a_place() {
    for (from, to, expected) in [
        ("6.2832", "-1", "does not have the period -1"),
        ("integral = \"none\"", "integral = \"x\"", "is not a value of"),
        ("integrals = [", "density = \"none\"\nintegrals = [", "makes 2 statements"),
    ] {
        let text = INTEGRABLE.replace(from, to);
        let error = Case::parse(&text, &[]).expect_err(to).to_string();
        assert!(error.contains(expected), "{to}: {error}");
    }
}
