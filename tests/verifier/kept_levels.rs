//! Nothing is proved of motions on a level that they leave, or may leave, at few of its states.

use liouville::case::Case;
use liouville::verdict::{ClaimReport, Options, Verdict, judge};

/// Reports on claims about x' = y(|z| − z), w' = x, where z is negative at few states.
fn reports(z: &str, level: &str, claims: &[&str]) -> Result<Vec<ClaimReport>, String> {
    let claims: String = claims.iter().map(|claim| format!("[[claim]]\n{claim}\n")).collect();
    let text = format!(
        "title = 'x'\n[state]\nx = '-1..1'\ny = '-1..1'\nz = '{z}'\nw = '-1..1'\n[field]\n\"x'\" = 'y*(|z| - z)'\n\
         \"y'\" = '0'\n\"z'\" = '0'\n\"w'\" = 'x'\n[level]\nequations = [{level}]\n{claims}"
    );
    let case = Case::parse(&text, &[]).expect("a case");
    judge(&case, &Options::default()).map(|found| found.claims).map_err(|error| error.to_string())
}

#[test]
fn a_level_that_the_motion_leaves_at_few_states_is_an_error() {
    let claims = ["form = { 'y,w' = '1' }", "density = '1'", "integral = 'w'"];
    for z in ["-0.0005..1", "-1..1"] {
        let error = reports(z, "'x = 0'", &claims).expect_err(z);
        assert!(error.contains("leaves `x = 0`"), "{error}");
    }
    let kept = reports("0.5..1", "'x = 0'", &claims).expect("z is positive");
    assert!(kept.iter().all(|claim| claim.verdict == Verdict::Proved));
}

#[test]
fn a_wider_place_that_the_motion_leaves_is_not_named() {
    let holds = |z: &str| {
        let found = reports(z, "'x = 0', 'y = 0'", &["integral = 'w'"]).expect("a report");
        assert_eq!(found[0].verdict, Verdict::Proved, "{z}");
        found[0].evidence.holds.iter().map(ToString::to_string).collect::<Vec<_>>()
    };
    assert_eq!(
        holds("-0.001..1"),
        ["level"],
        "from x = 0, y = 1 with z < 0 the motion leaves x = 0"
    );
    assert_eq!(holds("0.5..1"), ["x = 0"]);
    let there = reports("-0.001..1", "'x = 0', 'y = 0'", &["integral = 'w'\nwhere = 'x = 0'"]);
    assert_eq!(there.expect("a report")[0].verdict, Verdict::Undecided);
}

#[test]
fn slopes_are_asked_on_parts_of_which_no_state_is_found() {
    // The part u = 0, of which no drawn state is near, has the slope 0, and the motion leaves it.
    let verdict = |factor: &str, size: &str| {
        let text = format!(
            "title = 'x'\n[state]\nx = '-1..1'\ny = '-1..1'\nz = '-1..1'\nv = '-1..1'\nw = '-1..1'\n[field]\n\
             \"x'\" = '1'\n\"y'\" = '0'\n\"z'\" = '0'\n\"v'\" = '0'\n\"w'\" = 'y*u'\n[let]\n\
             u = 'x - {size}*(z*exp(v) + v*exp(2*z) - z^3*v + sin(z - v^2) - 1/3)'\n[level]\n\
             equations = ['y*u*{factor} = 0']\n[[claim]]\nintegral = 'w'\n"
        );
        let case = Case::parse(&text, &[]).expect("a case");
        judge(&case, &Options::default()).expect("a report").claims[0].verdict
    };
    assert_eq!(verdict("(exp(u) - 1)", "1"), Verdict::Undecided);
}

fn verdicts(text: &str) -> Vec<Verdict> {
    let case = Case::parse(text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let found = judge(&case, &Options::default()).unwrap_or_else(|error| panic!("{error}\n{text}"));
    found.claims.into_iter().map(|claim| claim.verdict).collect()
}

#[test]
fn what_is_mapped_to_where_the_level_has_no_value_is_not_on_it() {
    let state =
        "title = 'x'\n[parameters]\na = '-1..1'\n[state]\nx = '-3..3'\ny = '-1..1'\nz = '-1..1'\n";
    let level = |root: &str| format!("[level]\nequations = ['y*exp(√({root})) = 0']\n");
    let point = "[[claim]]\nfixed-point = { x = '-2 - a', y = '0' }\n";
    let rests = format!("{state}[field]\nx = 'y'\ny = '0'\nz = '0'\n{}{point}", level("x + 2"));
    assert_eq!(verdicts(&rests), [Verdict::Undecided], "for a > 0 the point is not on the level");
    let wide = format!("{state}[field]\nx = 'y'\ny = '0'\nz = '0'\n{}{point}", level("x + 4"));
    assert_eq!(verdicts(&wide), [Verdict::Proved]);
    let claims =
        "[[claim]]\nsymmetry = { x = '-x' }\n[[claim]]\nreversor = { x = '-x', z = '-z' }\n";
    let turned = format!("{state}[field]\nx = '0'\ny = '0'\nz = '1'\n{}{claims}", level("x + 2"));
    assert_eq!(verdicts(&turned), [Verdict::Undecided; 2], "5/2 goes to −5/2");
    let wide = format!("{state}[field]\nx = '0'\ny = '0'\nz = '1'\n{}{claims}", level("x + 4"));
    assert_eq!(verdicts(&wide), [Verdict::Proved; 2]);
    let map = |root: &str| {
        format!(
            "{state}[map]\nx = '-x'\ny = 'y'\nz = 'z + y'\n{}[[claim]]\nintegral = 'z'\n",
            level(root)
        )
    };
    assert!(verdicts(&map("x + 2")) != [Verdict::Proved], "5/2 goes to −5/2");
    assert_eq!(verdicts(&map("x + 4")), [Verdict::Proved]);
}

#[test]
fn slopes_are_asked_on_parts_of_which_no_state_is_drawn() {
    // On u = 0 the slope is 0, and the motion leaves that part.
    for size in ["1", "10^4", "10^12"] {
        let text = format!(
            "title = 'x'\n[state]\nx = '-1..1'\ny = '-1..1'\nz = '-1..1'\nv = '-1..1'\nw = '-1..1'\n\
             [field]\nx = '1'\ny = '0'\nz = '0'\nv = '0'\nw = 'y*u'\n[let]\n\
             u = 'x - {size}*(z*exp(v) + v*exp(2*z) - z^3*v + sin(z - v^2) - 1/3)'\n\
             [level]\nequations = ['y*u*(exp(u) - 1) = 0']\n[[claim]]\nintegral = 'w'\n"
        );
        assert_eq!(verdicts(&text), [Verdict::Undecided], "{size}");
    }
}

#[test]
fn a_part_on_which_the_field_as_written_has_no_value_is_left_by_no_motion() {
    let of = |rate: &str| {
        let text = format!(
            "title = 't'\n[state]\nx = '-2..2'\ny = '-2..2'\n[field]\n\"x'\" = '{rate}'\n\"y'\" = '0'\n\
             [level]\nequations = ['x*y = 0']\n[[claim]]\nidentity = 'y = 0'\n"
        );
        let case = Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}"));
        judge(&case, &Options::default()).map(|report| report.claims[0].verdict)
    };
    for rate in ["1 + 0/x", "x/x", "1 + y/x"] {
        assert!(of(rate).is_ok_and(|own| own != Verdict::Refuted), "{rate}");
    }
    assert!(of("1").is_err(), "motions leave x = 0");
    assert!(of("1 + 0/(x - 5)").is_err(), "motions leave x = 0");
}
