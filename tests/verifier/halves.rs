//! Equations that choose a half of the level, det Q = 1 where QᵀQ = E, and those that follow from such a frame.

use liouville::case::Case;
use liouville::verdict::{Options, Verdict, judge};

/// Verdicts on claims about Q' = Qω̃ with Euler's equations, where `state` declares Q and `level` holds.
fn verdicts(state: &str, level: &str, claims: &[&str]) -> Result<Vec<Verdict>, String> {
    let claims: String = claims.iter().map(|claim| format!("[[claim]]\n{claim}\n")).collect();
    let level = match level {
        "" => String::new(),
        own => format!("[level]\nequations = [{own}]\n"),
    };
    let text = format!(
        "title = 'x'\n[parameters]\nJ = 'inertia(0.5..3)'\n[state]\nQ = '{state}'\n'ω' = 'vector(-2..2)'\n\
         [field]\n\"Q'\" = 'Q*hat(ω)'\n\"ω'\" = 'J⁻¹*(J*ω × ω)'\n{level}{claims}"
    );
    let case = Case::parse(&text, &[]).map_err(|error| error.to_string())?;
    let found = judge(&case, &Options::default()).map_err(|error| error.to_string())?;
    Ok(found.claims.into_iter().map(|own| own.verdict).collect())
}

const CLAIMS: [&str; 6] = [
    "identity = 'det(Q) = 1'",
    "identity = 'det(Q) = −1'",
    "identity = 'Q[1] × Q[2] = Q[3]'",
    "identity = 'Q*(ω × [1, 0, 0]) = (Q*ω) × (Q*[1, 0, 0])'",
    "integral = 'Q*J*ω'",
    "identity = 'Q*Qᵀ = E'",
];

#[test]
fn a_determinant_chooses_rotations_or_reflections() {
    use Verdict::{Proved, Refuted};
    let right = [Proved, Refuted, Proved, Proved, Proved, Proved];
    let left = [Refuted, Proved, Refuted, Refuted, Proved, Proved];
    let both = [Refuted, Refuted, Refuted, Refuted, Proved, Proved];
    let any = "matrix(-1..1)";
    for (state, level, expected) in [
        (any, "'Qᵀ*Q = E', 'det(Q) = 1'", right),
        (any, "'det(Q) = 1', 'Qᵀ*Q = E'", right),
        (any, "'Q*Qᵀ = E', 'det(Q) = 1'", right),
        (any, "'Qᵀ*Q = E', 'Q*Qᵀ = E', 'det(Q) = 1'", right),
        (any, "'Qᵀ*Q = E', 'Q[1] × Q[2] = Q[3]'", right),
        ("rotation", "", right),
        (any, "'Qᵀ*Q = E', 'det(Q) = −1'", left),
        (any, "'Qᵀ*Q = E', 'Q[1] × Q[2] = −Q[3]'", left),
        (any, "'Qᵀ*Q = E'", both),
        (any, "'Qᵀ*Q = E', 'det(Q)^2 = 1'", both),
    ] {
        assert_eq!(verdicts(state, level, &CLAIMS).expect(level), expected, "{state} {level}");
    }
    let none = verdicts(any, "'Qᵀ*Q = E', 'det(Q) = 2'", &CLAIMS);
    assert!(none.is_err(), "{none:?}");
}

#[test]
fn a_map_to_the_other_half_is_no_symmetry() {
    let symmetry = "symmetry = { Q = '−Q' }";
    let of = |level: &str| verdicts("matrix(-1..1)", level, &[symmetry]).expect(level);
    assert_eq!(of("'Qᵀ*Q = E'"), [Verdict::Proved]);
    assert_eq!(of("'Qᵀ*Q = E', 'det(Q) = 1'"), [Verdict::Refuted]);
}

#[test]
fn constraints_make_a_rotation() {
    let text = |state: &str, constraints: &str| {
        format!(
            "title = 'x'\n[parameters]\nK = 'diag(1..2)'\n[state]\nQ = '{state}'\n\"Q'\" = 'matrix(-1..1)'\n\
             [lagrangian]\nkinetic = \"tr(Q'*K*Q'ᵀ)/2\"\n{constraints}\n[[claim]]\nintegral = 'energy'\n\
             [[claim]]\nidentity = 'det(Q) = 1'\n[[claim]]\nintegral = \"Q*K*Q'ᵀ − Q'*K*Qᵀ\"\n"
        )
    };
    for (state, constraints) in [
        ("matrix(-1..1)", "constraints = ['Qᵀ*Q = E', 'det(Q) = 1']"),
        ("rotation", "constraints = []"),
    ] {
        let text = text(state, constraints);
        let text = text.replacen("title = 'x'", "title = 'x'\nsystem = 'nonholonomic'", 1);
        let case = Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{constraints}: {error}"));
        let found = judge(&case, &Options::default()).expect("a report");
        let verdicts: Vec<Verdict> = found.claims.iter().map(|own| own.verdict).collect();
        assert_eq!(verdicts, [Verdict::Proved; 3], "{constraints}");
    }
}

#[test]
fn what_may_hold_on_a_part_of_the_other_half_chooses_none() {
    let any = "matrix(-1..1)";
    for level in [
        "'Qᵀ*Q = E', 'Q[1,1]*(det(Q) − 1) = 0'",
        "'Qᵀ*Q = E', '(det(Q) − 1)*max(Q[1,1], 0) = 0'",
        "'Qᵀ*Q = E', '(det(Q) − 1)*(det(Q) + 1 + Q[1,1]) = 0'",
        "'Qᵀ*Q = E', '(Q[1] × Q[2])[3] = Q[3,3]'",
        "'Qᵀ*Q = E', 'log(det(Q)) = 0'",
        "'Qᵀ*Q = E', '(det(Q) − 1)*√(Q[1,1]) = 0'",
        "'Qᵀ*Q = E', 'det(Q) + log(Q[1,1]) − log(Q[1,1]) = 1'",
    ] {
        let claims = ["identity = 'det(Q) = 1'", "identity = 'abs(Q[1,1]) = Q[1,1]'"];
        if let Ok(found) = verdicts(any, level, &claims) {
            assert!(!found.contains(&Verdict::Proved), "{level}: {found:?}");
        }
        let true_there = ["identity = 'Q*Qᵀ = E'", "identity = 'det(Q)^2 = 1'"];
        if let Ok(found) = verdicts(any, level, &true_there) {
            assert!(!found.contains(&Verdict::Refuted), "{level}: {found:?}");
        }
    }
}

#[test]
fn coefficients_that_may_be_0_choose_no_half() {
    for (parameter, factor) in [("one of 0, 1", "k"), ("-1..1", "max(k, 0)"), ("-1..1", "k")] {
        let text = format!(
            "title = 'x'\n[parameters]\nk = '{parameter}'\n[state]\nQ = 'matrix(-1..1)'\n[field]\n\
             \"Q'\" = 'zero(3,3)'\n[level]\nequations = ['Qᵀ*Q = E', '{factor}*(det(Q) − 1) = 0']\n\
             [[claim]]\nidentity = 'det(Q) = 1'\n"
        );
        let case = Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}"));
        if let Ok(found) = judge(&case, &Options::default()) {
            let verdict = found.claims[0].verdict;
            assert!(
                verdict != Verdict::Proved || factor == "k" && parameter == "-1..1",
                "{parameter}, {factor}: {verdict:?}"
            );
        }
    }
}

#[test]
fn the_place_of_the_other_equations_is_more_than_the_half() {
    let level = "'Qᵀ*Q = E', 'det(Q) = 1'";
    let claim = "identity = 'det(Q) = 1'\nwhere = 'Qᵀ*Q = E'";
    let found = verdicts("matrix(-1..1)", level, &[claim]);
    assert!(found.as_ref().is_err_and(|error| error.contains("not a place")), "{found:?}");
}

#[test]
fn a_chart_has_to_lead_to_the_half_of_the_file() {
    let of = |first: &str, claims: &[&str]| {
        let claims: String =
            claims.iter().map(|own| format!("[[claim]]\nidentity = '{own}'\n")).collect();
        let text = format!(
            "title = 'x'\n[state]\nQ = 'matrix(2, 2, -1..1)'\n[field]\n\"Q'\" = 'Q*[[0, −1], [1, 0]]'\n\
             [level]\nequations = ['Qᵀ*Q = E(2)', 'det(Q) = 1']\n[level.chart]\ninputs = {{ a = '-1..1' }}\n\
             Q = '[[{first}*cos(a), −{first}*sin(a)], [sin(a), cos(a)]]'\n{claims}"
        );
        let case = Case::parse(&text, &[]).map_err(|error| error.to_string())?;
        let found = judge(&case, &Options::default()).map_err(|error| error.to_string())?;
        Ok::<Vec<Verdict>, String>(found.claims.into_iter().map(|own| own.verdict).collect())
    };
    let claims = ["det(Q) = 1", "Q[1,1] = Q[2,2]", "Q = E(2)"];
    use Verdict::{Proved, Refuted};
    assert_eq!(of("1", &claims), Ok(vec![Proved, Proved, Refuted]));
    // Into the other half, and into both.
    for first in ["(−1)", "(a/|a|)"] {
        let found = of(first, &claims[..1]);
        assert!(found.as_ref().is_err_and(|own| own.contains("det(Q) = 1")), "{first}: {found:?}");
    }
}

#[test]
fn equations_that_choose_a_half_hold_also_beside_others() {
    use Verdict::{Proved, Refuted};
    let root = "'(a,a) = 1', '(b,b) = 4', '(c,c) = 2', '(a,b) = 1', '(b,c) = 0', '(a,c) = 0', '(a,b×c) = √6'";
    let text = format!(
        "title = 'x'\n[parameters]\nw = 'vector(-1..1)'\n[state]\na = 'vector(-2..2)'\nb = 'vector(-2..2)'\n\
         c = 'vector(-2..2)'\n[level]\nequations = [{root}]\n[field]\n\"a'\" = 'w×a'\n\"b'\" = 'w×b'\n\
         \"c'\" = 'w×c'\n[[claim]]\nidentity = 'a×b = √6/2*c'\n[[claim]]\nidentity = 'a×b = −√6/2*c'\n"
    );
    let case = Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}"));
    let found = judge(&case, &Options::default()).unwrap_or_else(|error| panic!("{error}"));
    let found: Vec<Verdict> = found.claims.into_iter().map(|own| own.verdict).collect();
    assert_eq!(found, [Proved, Refuted]);
    for (gram, determinant) in
        [("[[2, 1], [1, 1]]", "1"), ("[[2, 1], [1, 2]]", "√3"), ("[[2, 1], [1, 2]]", "−√3")]
    {
        let text = format!(
            "title = 'x'\n[state]\nR = 'matrix(2, 2, -2..2)'\n[level]\nequations = ['Rᵀ*R = {gram}', \
             'det(R) = {determinant}']\n[field]\n\"R'\" = '[[0, 1], [−1, 0]]*R'\n[[claim]]\n\
             identity = 'det(R) = {determinant}'\n[[claim]]\nidentity = 'det(R) = −({determinant})'\n"
        );
        let case = Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}"));
        let found = judge(&case, &Options::default()).unwrap_or_else(|error| panic!("{error}"));
        let found: Vec<Verdict> = found.claims.into_iter().map(|own| own.verdict).collect();
        assert_eq!(found, [Proved, Refuted], "{gram}, {determinant}");
    }
}
