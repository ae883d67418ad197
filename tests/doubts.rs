//! What must not pass for a verdict: charts off the level, formulas without a value, quadratures
//! of something else, places that the motion leaves.

use liouville::case::Case;
use liouville::verdict::{
    CaseReport, ClaimReport, Independence, JudgeError, Options, Sign, Verdict, evaluate, judge,
};

fn judged(text: &str) -> Result<CaseReport, JudgeError> {
    let case = Case::parse(text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    judge(&case, &Options::default())
}

fn claims(text: &str) -> Vec<ClaimReport> {
    judged(text).expect("it can be judged").claims
}

/// A rotation about e₃ on the unit sphere, with a chart.
fn on_sphere(chart: &str, rest: &str) -> String {
    format!(
        "title = 'x'\n[state]\nx = 'vector(-1..1)'\n[field]\n\"x'\" = '[0,0,1] × x'\n[level]\n\
         equations = ['(x,x) = 1']\n[level.chart]\n{chart}\n{rest}"
    )
}

#[test]
fn a_chart_has_to_lie_on_the_level_and_to_fill_it() {
    let inputs = "inputs = { u = '-2..2', v = '-2..2' }";
    let good = format!("{inputs}\nx = 'vec(2*u, 2*v, 1 − u² − v²)/(1 + u² + v²)'");
    let off = format!("{inputs}\nx = 'vec(2*u, 2*v, 1 − u² − v²)/(2 + u² + v²)'");
    let part = "inputs = { u = '-2..2' }\nx = 'vec(2*u, 0, 1 − u²)/(1 + u²)'";
    let claim = "[[claim]]\nintegral = 'x3'\n";
    assert!(judged(&on_sphere(&good, claim)).is_ok(), "the stereographic chart is one");
    assert!(matches!(judged(&on_sphere(&off, claim)), Err(JudgeError::OffLevel { .. })));
    let partial = judged(&on_sphere(part, claim));
    assert!(matches!(partial, Err(JudgeError::PartialChart { found: 1, dimension: 2 })));
}

#[test]
fn dependent_level_equations_are_told() {
    for second in ["x = 1", "2*x = 2", "0*x = 0"] {
        let text = format!(
            "title = 'x'\n[state]\nx = '-2..2'\ny = '-2..2'\n[field]\n\"x'\" = '0*x'\n\"y'\" = 'x'\n\
             [level]\nequations = ['x = 1', '{second}']\n"
        );
        assert!(matches!(judged(&text), Err(JudgeError::Dependent(_))), "{second}");
    }
}

/// x' = 1, y' = w, w' = y.
fn drift(rest: &str) -> String {
    format!(
        "title = 'x'\n[state]\nx = '-2..2'\ny = '-2..2'\nw = '-2..2'\n[field]\n\"x'\" = '1'\n\"y'\" = 'w'\n\
         \"w'\" = 'y'\n{rest}"
    )
}

#[test]
fn a_quadrature_that_does_not_exist_proves_nothing() {
    let found = claims(&drift(
        "[[claim]]\nintegral = 'y − ∫(w, x)'\nexpect = 'open'\n\
         [[claim]]\ndensity = 'exp(∫(w, x) − y)'\nexpect = 'open'\n",
    ));
    for claim in found {
        assert_eq!(claim.verdict, Verdict::Undecided, "{}: w is no function of x", claim.name);
    }
}

#[test]
fn a_quadrature_is_looked_at_in_wider_places_too() {
    let text = "title = 'x'\nsystem = 'rubber-plane'\n[parameters]\nm = 1\nR = 2\nI = [1, 2, 2.5]\n[body]\n\
                shape = 'ball'\n[[claim]]\nintegral = '∫(γ1*(γ,γ), γ1) − ½*γ1²*(γ,γ)'\n";
    let holds = &claims(text)[0].evidence.holds;
    assert!(
        !holds.contains(&"everywhere".to_string()),
        "off |γ| = 1 there is no such ∫: {holds:?}"
    );
}

#[test]
fn a_formula_without_a_value_is_no_claim() {
    for density in ["0", "√(−1 − x²)", "√(−1)", "x − x"] {
        let text = drift(&format!("[[claim]]\ndensity = '{density}'\nexpect = 'open'\n"));
        assert_eq!(claims(&text)[0].verdict, Verdict::Undecided, "{density}");
    }
    let text = drift("[[claim]]\nintegral = 'x + √(−1 − x²)'\nexpect = 'open'\n");
    assert_eq!(claims(&text)[0].verdict, Verdict::Undecided, "nowhere real");
}

#[test]
fn a_place_that_the_motion_leaves_is_no_place() {
    let text = |claim: &str| {
        format!(
            "title = 'x'\n[state]\nx = '-2..2'\ny = '-2..2'\nz = '-2..2'\n[field]\n\"x'\" = 'y'\n\"y'\" = 'x'\n\
             \"z'\" = 'x'\n[level]\nequations = ['x = 0', 'y = 0']\n[[claim]]\nintegral = 'z'\n{claim}"
        )
    };
    let left = judged(&text("where = 'x = 0'\n"));
    assert!(matches!(left, Err(JudgeError::NotInvariant { .. })), "x' = y there");
    let only = judged(&text("where = 'level only'\n")).expect("the level is kept");
    assert!(only.claims[0].agrees, "x = 0 is no wider place: {:?}", only.claims[0].evidence.holds);
}

#[test]
fn small_parts_of_an_integral_count() {
    let text = "title = 'x'\nsystem = 'rubber-plane'\n[parameters]\nm = '0.5..2'\nR = '1..3'\nI = 'inertia(0.5..5)'\n\
                [body]\nshape = 'ball'\n[[claim]]\nintegral = 'energy + 1e-9*|J*ω × γ|²'\n";
    let claim = &claims(text)[0];
    assert_eq!(claim.evidence.independence, Some(Independence::Independent));
}

#[test]
fn the_sign_of_a_density_is_looked_for_at_all_states() {
    let text = "title = 'x'\n[state]\nx = '-2..2'\ny = '-2..2'\n[field]\n\"x'\" = 'y'\n\"y'\" = '−x'\n\
                [[claim]]\ndensity = '7.5 − x² − y²'\n";
    let case = Case::parse(text, &[]).expect("a case");
    let many = Options { states: 6400, ..Options::default() };
    let report = judge(&case, &many).expect("it can be judged");
    assert_eq!(report.claims[0].evidence.sign, Some(Sign::Changes), "negative in the corners");
}

#[test]
fn an_unused_parameter_changes_nothing() {
    let text = |unused: &str| {
        format!(
            "title = 'x'\nsystem = 'rubber-plane'\n[parameters]\nm = 1\nI = [1, 2, 3]\n{unused}[body]\n\
             support = '1.9 + 0.1*√(1.01 − (γ,γ))'\n"
        )
    };
    let state = ["3/7", "0", "-1/7", "2/7", "3/7", "6/7"].map(|x| x.parse().expect("a number"));
    let energy = |unused: &str| {
        let case = Case::parse(&text(unused), &[]).expect("a case");
        evaluate(&case, Some(&state), 1, 0).expect("regular").energy.flatten().expect("a value").0
    };
    assert!((energy("") - energy("q = 'rotation'\n")).abs() < 1e-12, "h is meant on the sphere");
    // A ball of radius 1.91: ½(ω,(I + mR²E)ω) = ½(12 + 10·1.91²)/49.
    assert!((energy("") - (12.0 + 10.0 * 1.91 * 1.91) / 98.0).abs() < 1e-12, "and is right");
}

#[test]
fn an_inertia_tensor_is_symmetric() {
    let text = "title = 'x'\nsystem = 'rubber-plane'\n[parameters]\nm = 1\nR = 2\n\
                I = [[1, 0.5, 0], [0, 2, 0], [0, 0, 2.5]]\n[body]\nshape = 'ball'\n";
    assert!(matches!(judged(text), Err(JudgeError::AsymmetricInertia)));
}

#[test]
fn a_constant_cannot_be_chosen_for_the_primes() {
    // The product of four primes between 2⁶⁰ and 2⁶¹ that one seed once gave to every claim.
    let product = "3794879169967486888276628507938376681881088323365498439445561909460045101";
    let found = claims(&drift(&format!(
        "[[claim]]\nidentity = '(x+y)² + {product}*1e-120*x = x²+2*x*y+y²'\nexpect = 'fails'\n\
         [[claim]]\nidentity = '(x+y)*(x−y) + {product}e-120 = x²−y²'\nexpect = 'fails'\n"
    )));
    for claim in found {
        assert_eq!(claim.verdict, Verdict::Refuted, "{}: off by 4e-48", claim.name);
    }
}

/// x' = 0 for x in a range, and a claim about x.
fn still(range: &str, claim: &str) -> Verdict {
    let text = format!(
        "title = 'x'\n[state]\nx = '{range}'\n[field]\n\"x'\" = '0*x'\n[[claim]]\n{claim}\nexpect = 'open'\n"
    );
    claims(&text)[0].verdict
}

#[test]
fn a_sign_at_all_states_that_were_tried_is_none_at_all() {
    for (range, claim) in [
        ("-2..2", "identity = '|x − 1.9985| = 1.9985 − x'"),
        ("-2..2", "identity = '√((x − 1.99)²) = 1.99 − x'"),
        ("-0.001..1", "identity = '|x| = x'"),
        ("-0.001..1", "identity = '√(x²) = x'"),
        // x^1000000 is beyond f64 wherever it is above 1.
        ("0..2", "identity = '|1 − x^1000000| = 1 − x^1000000'"),
        ("0..2", "identity = '√((1 − x^1000000)²) = 1 − x^1000000'"),
        // An antiderivative has a free constant.
        ("-2..-1", "identity = '|∫(x, x)| = ∫(x, x)'"),
        ("-2..-1", "identity = '√(∫(x³, x)²) = ∫(x³, x)'"),
    ] {
        assert_ne!(still(range, claim), Verdict::Proved, "{claim} on {range}");
    }
    for (range, claim) in [
        ("-2..2", "identity = '|x − 2.5| = 2.5 − x'"),
        ("-2..2", "identity = '√((x² − x + 1)²) = x² − x + 1'"),
        ("0..1", "identity = '|x| = x'"),
    ] {
        assert_eq!(still(range, claim), Verdict::Proved, "{claim} on {range}");
    }
}

#[test]
fn a_range_that_nobody_asked_for_stands_for_all_numbers() {
    let text = "title = 'x'\nsystem = 'rubber-plane'\n[parameters]\nm = 1\nR = 2\nI = [1, 2, 2.5]\n[body]\n\
                shape = 'ball'\n[[claim]]\nidentity = '|γ3 + 0.9| = γ3 + 0.9'\nexpect = 'open'\n\
                [[claim]]\nidentity = '|ω1 − 100| = 100 − ω1'\nexpect = 'open'\n";
    for claim in claims(text) {
        assert_ne!(claim.verdict, Verdict::Proved, "{}: γ3 = −1, or ω1 = 101", claim.name);
    }
}
