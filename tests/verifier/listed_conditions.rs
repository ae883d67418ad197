//! Claims of all kinds with a power whose exponent is listed: each is judged as with the same number in the file, for its
//! side conditions, its sign and its remarks too.

use liouville::case::{Case, Setting};
use liouville::verdict::{CaseReport, DensitySign, Options, Verdict, judge};

const PLANE: &str = "x = '-2..2'\ny = '-2..2'";
const MOVING: &str = "\"x'\" = '1'\n\"y'\" = 'y'";

fn report(text: &str, settings: &[Setting]) -> CaseReport {
    let case = Case::parse(text, settings).unwrap_or_else(|error| panic!("{error}\n{text}"));
    judge(&case, &Options::default()).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn file(parameters: &str, state: &str, rates: &str, more: &str, claims: &[&str]) -> String {
    let claims: String =
        claims.iter().map(|own| format!("[[claim]]\n{own}\nexpect = 'open'\n")).collect();
    format!(
        "title = 't'\ncheck-weights = false\n[parameters]\n{parameters}\n[state]\n{state}\n[field]\n{rates}\n\
         {more}\n{claims}"
    )
}

fn verdicts(text: &str) -> Vec<Verdict> {
    report(text, &[]).claims.into_iter().map(|claim| claim.verdict).collect()
}

#[test]
fn side_conditions_are_those_of_each_number() {
    let still = "\"x'\" = '0'\n\"y'\" = '0'\n\"z'\" = '0'";
    let space = "x = '-2..2'\ny = '-2..2'\nz = '-2..2'";
    let bracket = "[variables]\nu = 'x*(b + sqrt(b^n))'\nv = 'y'\nw = 'z'\n[poisson]\n\
                   'u,v' = 'u^2*v*(sqrt(b^n) - b)'\n'u,w' = '-1'\n";
    for (list, expected) in [("one of 2", Verdict::Undecided), ("one of 2, 4", Verdict::Refuted)] {
        let parameters = format!("n = '{list}'\nb = '-1..1'");
        let text = file(&parameters, space, still, bracket, &["jacobi-identity = 'holds'"]);
        assert_eq!(verdicts(&text), [expected], "u = 0 for b < 0, and b² is not b");
    }
    // Two states have one image for n = 2.
    let doubling = |list: &str| {
        format!(
            "title = 't'\ncheck-weights = false\n[parameters]\nn = '{list}'\n[state]\nx = '-2..2'\ny = '-1..1'\n\
             [map]\nx = 'x^n'\ny = 'y/(n*x^(n - 1))'\n[[claim]]\ndensity = '1'\n"
        )
    };
    assert_eq!(verdicts(&doubling("one of 1, 2, 3")), [Verdict::Undecided]);
    assert_eq!(verdicts(&doubling("one of 1, 3")), [Verdict::Proved]);
    let found = report(
        &file(
            "a = 'one of 2'",
            PLANE,
            MOVING,
            "",
            &["symmetry = { y = 'y + sqrt(y^a)' }", "density = '1/y^(a/2)'"],
        ),
        &[],
    );
    let remarks: Vec<String> =
        found.claims.iter().map(|own| own.evidence.remark.clone().unwrap_or_default()).collect();
    assert!(remarks[0].contains("cannot be inverted"), "{remarks:?}");
    assert_eq!(found.claims[1].evidence.sign, Some(DensitySign::Changes), "1/y");
}

#[test]
fn functions_that_depend_on_each_other_for_positive_bases_alone_may_be_independent() {
    let claims = ["independent = ['x', 'y - sqrt(y^a)']"];
    let found = verdicts(&file("a = 'one of 2'", PLANE, MOVING, "", &claims));
    assert_ne!(found, [Verdict::Refuted], "y − |y| = 2y for y < 0");
}

/// Claims about the functions f and g of a field x' = 0, y' = 0, with B for a power that is also written as |y| or y.
const CLAIMS: [&str; 12] = [
    "identity = 'B = abs(y)'",
    "identity = 'B = y'",
    "integral = 'x + B'",
    "independent = ['x', 'x + B - y']",
    "independent = ['B - y', 'x']",
    "symmetry = { y = 'y + B' }",
    "symmetry-field = { x = 'B - y' }",
    "density = '1/(B*(1 + x^2))'",
    "density = 'B + y'",
    "density = 'B - 2*y'",
    "invariant-relation = 'B*x'\ncofactor = '0'",
    "lyapunov = 'x*(B - y)'",
];

/// Judges each claim for a list of exponents, and for each of them, and compares.
#[test]
fn a_list_says_what_each_number_says() {
    let still = "\"x'\" = '0'\n\"y'\" = '0'";
    let powers =
        ["sqrt(y^a)", "(y^a)^(1/2)", "y^(a/2)", "abs(y)^a/abs(y)^(a - 1)", "y^a/y^(a - 1)"];
    let (mut held, mut failed) = (0, 0);
    for (row, power) in powers.iter().enumerate() {
        for (list, numbers) in [("one of 2", vec!["2"]), ("one of 2, 4", vec!["2", "4"])] {
            let claims: Vec<String> = CLAIMS.iter().map(|own| own.replace('B', power)).collect();
            let claims: Vec<&str> = claims.iter().map(String::as_str).collect();
            let range = if row % 2 == 0 { PLANE } else { "x = '-1..1'\ny = '-1..2'" };
            let text = file(&format!("a = '{list}'"), range, still, "", &claims);
            let together = report(&text, &[]);
            for number in numbers {
                let setting = Setting { name: "a".to_string(), value: number.to_string() };
                let alone = report(&text, &[setting]);
                for (own, one) in together.claims.iter().zip(&alone.claims) {
                    let holds =
                        |verdict: Verdict| matches!(verdict, Verdict::Proved | Verdict::Confirmed);
                    held += usize::from(holds(own.verdict));
                    failed += usize::from(!holds(one.verdict));
                    assert!(
                        !holds(own.verdict) || holds(one.verdict),
                        "a = {number} of {list}: {} is {:?}, {:?} alone\n{text}",
                        own.name,
                        own.verdict,
                        one.verdict
                    );
                    assert!(
                        own.verdict != Verdict::Refuted
                            || list.contains(',')
                            || !holds(one.verdict),
                        "a = {number}: {} is refuted\n{text}",
                        own.name
                    );
                    if holds(own.verdict) && !list.contains(',') {
                        assert_eq!(own.evidence.sign, one.evidence.sign, "{}\n{text}", own.name);
                    }
                }
            }
        }
    }
    assert!(held > 20 && failed > 20, "{held} hold, {failed} do not");
}

#[test]
fn remarks_are_those_of_the_numbers() {
    let text = file(
        "a = 'one of 2, 4'",
        PLANE,
        MOVING,
        "",
        &["symmetry = { y = 'y*(1 + y^a)' }", "lyapunov = '-(y^a)'"],
    );
    for claim in report(&text, &[]).claims {
        let remark = claim.evidence.remark.unwrap_or_default();
        assert!(!remark.contains("nothing is said at"), "y < 0 counts: {remark}");
    }
}
