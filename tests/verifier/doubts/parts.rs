//! Independence of functions that are given by several formulas, and densities of maps that take
//! several states to one.

use super::claims;
use liouville::verdict::Verdict;

fn remark_on_independence(functions: &str) -> String {
    let text = format!(
        "title = 't'\n[state]\nx = '-1..1'\ny = '-1..1'\n[field]\n\"x'\" = '0*x'\n\"y'\" = '0*y'\n\
         [[claim]]\nindependent = [{functions}]\n"
    );
    let report = claims(&text).remove(0);
    assert_eq!(report.verdict, Verdict::Proved, "{functions}");
    report.evidence.remark.unwrap_or_default()
}

#[test]
fn independence_on_a_part_of_the_states_is_said_to_be_that() {
    for functions in [
        "'x + |x|', 'y'",
        "'x + √(x²)', 'y'",
        "'x + y + √(x² + 2*x*y + y²)', 'y'",
        "'√(1 + x)*√(1 − x) − √(1 − x²) + x + |x|', 'y'",
        "'x + y*(atan(x) + atan(1/x) − 2*atan(1))', 'x'",
        "'x + exp(ln(x²)/2)', 'y'",
    ] {
        let own = remark_on_independence(functions);
        assert!(own.contains("on a part of the states only"), "{functions}: {own}");
    }
}

#[test]
fn independence_on_all_cells_is_not_said_to_be_on_a_part() {
    for functions in [
        "'x', 'y'",
        "'2*x + |x|', 'y'",
        "'x', '|y|*y'",
        "'√(1 + x²)', 'y'",
        "'√(1 + x)*√(1 − x) + √(1 − x²)', 'y'",
        "'exp(x)', 'x + y³'",
        "'ln(2 + x)', 'y*√(1 − y)'",
        "'exp(1/x)*sin(y)', 'y'",
    ] {
        let own = remark_on_independence(functions);
        assert!(!own.contains("part of the states"), "{functions}: {own}");
    }
}

/// The claim of a density of (x, y) ↦ (x², y/x), with these ranges.
fn squaring(range: &str, density: &str) -> (Verdict, String) {
    let text = format!(
        "title = 't'\n[state]\nx = '{range}'\ny = '{range}'\n[map]\nx = 'x²'\ny = 'y/x'\n\
         [[claim]]\ndensity = '{density}'\nexpect = 'open'\n"
    );
    let report = claims(&text).remove(0);
    (report.verdict, report.evidence.reason.unwrap_or_default())
}

#[test]
fn a_density_of_a_map_needs_one_preimage() {
    let density = "1/(x*y*ln(x²))";
    let (verdict, reason) = squaring("-3..3", density);
    assert_eq!(verdict, Verdict::Undecided, "(x, y) and (−x, −y) have one image");
    assert!(reason.contains("to one state"), "{reason}");
    assert_eq!(squaring("1.5..3", density).0, Verdict::Proved, "one-to-one for x > 0");
    // |ρ∘Φ det DΦ| is 2|ρ|, and two states have one image: the measure is kept.
    assert_eq!(squaring("-3..3", "1/(x*y)").0, Verdict::Undecided, "each state has half of it");
    // The measure of a set is that of all states whose images lie in it, in the ranges or not.
    assert_eq!(squaring("1.5..3", "1/(x*y)").0, Verdict::Undecided, "(−x, −y) counts as well");
    let (verdict, reason) = squaring("1.5..3", "1/(x*y) + 0*√x");
    assert_eq!(verdict, Verdict::Undecided, "it has no value there");
    assert!(reason.contains("not proved"), "{reason}");
    let only_there = "1/(x*y*ln(x²)) + 0*√x";
    assert_eq!(squaring("-3..3", only_there).0, Verdict::Proved, "x < 0 does not count");
}
