//! Signs that ranges give: of a root by which a level is solved, of sums, of the order of numbers.

use super::claims;
use liouville::verdict::Verdict;

/// Judges identities on a level in x and y with these ranges; an empty level is the whole plane.
fn verdicts(level: &str, ranges: [&str; 2], identities: &[&str]) -> Vec<Verdict> {
    let [x, y] = ranges;
    let mut text = format!(
        "title = 't'\n[parameters]\nk = '1..2'\n[state]\nx = '{x}'\ny = '{y}'\nz = '-2..2'\n[field]\n\
         \"x'\" = '0'\n\"y'\" = '0'\n\"z'\" = '0'\n"
    );
    if !level.is_empty() {
        text += &format!("[level]\nequations = ['{level}']\n");
    }
    for identity in identities {
        text += &format!("[[claim]]\nidentity = '{identity}'\nexpect = 'open'\n");
    }
    claims(&text).into_iter().map(|report| report.verdict).collect()
}

/// Levels with two values of y for each x, the larger one last.
const TWO_SHEETS: [(&str, &str); 7] = [
    ("x² + y² = 2", "√(2 − x²)"),
    ("x² + y² = k²", "√(k² − x²)"),
    ("k²*x² + y² = 4", "√(4 − k²*x²)"),
    ("y² = 2 + x³", "√(2 + x³)"),
    ("y² = 3 + k*x", "√(3 + k*x)"),
    ("y² = 1 + k²*x²", "√(1 + k²*x²)"),
    ("x^4 + y² = 3", "√(3 − x^4)"),
];

#[test]
fn a_range_tells_the_sheet_of_a_level() {
    for (level, root) in TWO_SHEETS {
        let (above, below) = (format!("y = {root}"), format!("y = −{root}"));
        let both = format!("|y| = {root}");
        let asked = [above.as_str(), &below, &both];
        let own = |y: &str| verdicts(level, ["-1..1", y], &asked);
        let (yes, no) = (Verdict::Proved, Verdict::Refuted);
        assert_eq!(own("0.1..3"), [yes, no, yes], "{level} with y > 0");
        assert_eq!(own("-3..-0.1"), [no, yes, yes], "{level} with y < 0");
        assert_eq!(own("-3..3"), [no, no, yes], "{level} with both signs of y");
    }
}

#[test]
fn what_is_0_for_the_sign_of_the_range_is_not_independent() {
    let text = "title = 't'\n[state]\nx = '-1..1'\ny = '0.1..3'\n[field]\n\"x'\" = 'y'\n\"y'\" = '-x'\n\
         [level]\nequations = ['x² + y² = 2']\n[[claim]]\nindependent = ['y − √(2 − x²)']\nexpect = 'open'\n\
         [[claim]]\nrate = '√(2 − x²)'\nequals = '−x'\n";
    let found: Vec<Verdict> = claims(text).into_iter().map(|report| report.verdict).collect();
    assert_eq!(found, [Verdict::Refuted, Verdict::Proved]);
}

#[test]
fn both_branches_of_a_hyperbola_are_seen() {
    let own = |ranges, identity| verdicts("x² − y² = 1", ranges, &[identity]).remove(0);
    let transcendental = "sin(x)² + |x| + cos(x)² = x + 1";
    assert_eq!(own(["-3..3", "-2..2"], transcendental), Verdict::Refuted, "x < 0 is a branch");
    assert_eq!(own(["0..3", "-2..2"], "|x| = x"), Verdict::Proved, "x > 0 alone");
    assert_eq!(own(["-3..3", "-2..2"], "x = √(1 + y²)"), Verdict::Refuted);
}

#[test]
fn three_numbers_have_an_order() {
    let all = verdicts(
        "",
        ["-2..2", "-2..2"],
        &[
            "max(max(x,y),z) = max(x,max(y,z))",
            "min(max(x,y),z) = max(min(x,z),min(y,z))",
            "sign(x−y)*sign(y−z) + sign(y−z)*sign(z−x) + sign(z−x)*sign(x−y) = −1",
            "|x−y| + |y−z| + |z−x| = 2*(max(x,max(y,z)) − min(x,min(y,z)))",
            "min(max(x,y),z) = max(min(x,z),min(y,x))",
            "sign(x−y)*sign(y−z)*sign(z−x) = 1",
            // x > y, y > z and 2z > x + y − 1 have common states.
            "|x−y| + |y−z| + |2*z−x−y+1| = 1 + |x−y| + |y−z| + z − x",
        ],
    );
    let (yes, no) = (Verdict::Proved, Verdict::Refuted);
    assert_eq!(all, [yes, yes, yes, yes, no, no, no]);
}

#[test]
fn sums_of_squares_have_a_sign_however_they_are_written() {
    let all = verdicts(
        "",
        ["-1..2", "0.5..2"],
        &[
            "√(y^4 + 2*y²*(k−x)² + (k−x)^4) = y² + (k−x)²",
            "√(x^4 + 2*x²*(k−y)² + (k−y)^4) = x² + (k−y)²",
            "|x² + k² − 2*k*y + y²| = x² + (k−y)²",
            "√(x^4 − 2*x²*(k−y)² + (k−y)^4) = x² − (k−y)²",
            "|x² + k² − 2*k*y + y² − 1| = x² + (k−y)² − 1",
        ],
    );
    let (yes, no) = (Verdict::Proved, Verdict::Refuted);
    assert_eq!(all, [yes, yes, yes, no, no]);
}

#[test]
fn maps_that_take_two_states_to_one_may_keep_more_measures() {
    let text = |range: &str, map: &str, density: &str| {
        format!(
            "title = 't'\n[state]\nx = '{range}'\n[map]\nx = '{map}'\n[[claim]]\ndensity = '{density}'\n\
             expect = 'open'\n"
        )
    };
    let own = |map, density| claims(&text("-3..3", map, density)).remove(0).verdict;
    // Boole: the lengths of two intervals add up to that of their image.
    assert_eq!(own("x − 1/x", "1"), Verdict::Undecided);
    assert_eq!(own("x³ + x", "1"), Verdict::Refuted, "this one takes no two states to one");
    assert_eq!(own("x + 1", "1"), Verdict::Proved);
    // The other state need not lie in the ranges.
    let within = |range, map| claims(&text(range, map, "1")).remove(0).verdict;
    assert_eq!(within("1..2", "x − 1/x"), Verdict::Undecided);
    assert_eq!(within("0..1/2", "4*x*(1 − x)"), Verdict::Undecided);
    assert_eq!(within("1..2", "x − 1/(x − 1000000)"), Verdict::Undecided, "it is far away");
    assert_eq!(within("1..2", "x³ + x"), Verdict::Refuted);
}

#[test]
fn maps_of_a_level_that_take_two_states_to_one_are_seen() {
    let own = |map: [&str; 3], level: &str, density: &str| {
        let [x, y, z] = map;
        let text = format!(
            "title = 't'\n[state]\nx = '-1..1'\ny = '-1..1'\nz = '-1..1'\n\
             [map]\nx = '{x}'\ny = '{y}'\nz = '{z}'\n[level]\nequations = [{level}]\n\
             [[claim]]\ndensity = '{density}'\nexpect = 'open'\n"
        );
        let report = claims(&text).remove(0);
        (report.verdict, report.evidence.reason.unwrap_or_default())
    };
    let (circle, sphere) = ("'x² + y² = 1', 'z = 0'", "'x² + y² + z² = 1'");
    for (map, level, density) in [
        (["|x|", "y", "z"], circle, "1"),
        (["|x|", "y", "z"], circle, "1/|y|"),
        (["|x|", "y", "|z|"], sphere, "1"),
        (["|x|", "y", "z"], "'z = x²'", "1"),
        // The angle is doubled, and lengths add up.
        (["x² − y²", "2*x*y", "z"], circle, "1"),
        // So it is by a map that goes along the radius to the circle.
        (["(x² − y²)/(x² + y²)", "2*x*y/(x² + y²)", "z"], circle, "1"),
        // One part of the level is laid on the other.
        (["x + y", "0", "z"], "'x*y = 0'", "1"),
        (["x + y", "0", "z + x"], "'x*y = 0'", "x + y"),
        (["x", "0", "z"], "'y*(y − x) = 0'", "1"),
    ] {
        let (verdict, reason) = own(map, level, density);
        assert_eq!(verdict, Verdict::Undecided, "{map:?} on {level}");
        assert!(reason.contains("to one state"), "{map:?} on {level}: {reason}");
    }
    let turned = ["3/5*x − 4/5*y", "4/5*x + 3/5*y", "z"];
    assert_eq!(own(turned, circle, "1").0, Verdict::Proved);
    assert_eq!(own(turned, sphere, "1").0, Verdict::Proved);
    assert_eq!(own(turned, sphere, "2 + x").0, Verdict::Refuted);
    assert_eq!(own(["−x", "−y", "−z"], sphere, "1").0, Verdict::Proved);
}
