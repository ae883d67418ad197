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
