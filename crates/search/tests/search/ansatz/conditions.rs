//! Conditions on the parameters under which something exists or a claim holds.

use std::path::Path;

use liouville::case::Case;
use liouville_search::{ConditionTarget, Effort, Given, ParameterCondition, SearchReport, search};

use crate::ansatz::{case, effort, searched};

/// Conditions for integrals, and not for the density 1.
fn of_integrals(report: &SearchReport) -> impl Iterator<Item = &ParameterCondition> {
    report.conditions.iter().filter(|own| !own.of.starts_with("the density 1"))
}

#[test]
fn volumes_are_preserved_under_conditions() {
    let text = "title = 'x'\n[parameters]\na = '1..2'\nb = '1..2'\nc = '1..2'\n[state]\nx = '-1..1'\n\
                y = '-1..1'\nz = '-1..1'\n[field]\nx = '−a*x + y*z'\ny = 'b*y − x*z'\nz = '−c*z + x*y'\n";
    let case = Case::parse(text, &[]).expect("a case");
    let mut wanted = effort(0);
    (wanted.degree, wanted.conditions) = (1, Some(ConditionTarget::Existence));
    let report = search(&case, &wanted, &mut |_| {}).expect("searched");
    let own = report.conditions.iter().find(|own| own.of.starts_with("the density 1"));
    assert_eq!(own.expect("a condition").equations, ["a − b + c = 0"]);
}

#[test]
fn conditions_on_parameters_are_found() {
    let mut wanted = Effort { by_class: false, by_factors: false, ..effort(0) };
    wanted.conditions = Some(ConditionTarget::Existence);
    let ellipsoid = case(
        "title = 'x'\nsystem = 'rubber-plane'\n[parameters]\nm = '0.5..2'\nB = 'diag(1..3)'\n\
         I = 'inertia(0.5..5)'\n[body]\nshape = 'ellipsoid'\n",
    );
    let report = search(&ellipsoid, &wanted, &mut |_| {}).expect("it can be searched");
    // (3.8), expanded.
    let condition = "B11*I1*I2 − B11*I1*I3 − B22*I1*I2 + B22*I2*I3 + B33*I1*I3 − B33*I2*I3 − m*B11*B22*I1 + \
                     m*B11*B22*I2 + m*B11*B33*I1 − m*B11*B33*I3 − m*B22*B33*I2 + m*B22*B33*I3 = 0";
    let equations = &report.conditions[0].equations;
    assert!(equations.iter().any(|equation| equation == condition), "{equations:?}");

    let report = searched("sphere/unbalanced-ball", &wanted);
    let equations = &report.conditions[0].equations;
    assert!(equations.iter().any(|equation| equation == "1 − R*k = 0"), "{equations:?}");

    let flat = case(
        "title = 'x'\nsystem = 'flat-base'\n[parameters]\nm = '0.5..2'\nk = '0.2..1'\nz = '0.2..1'\n\
         I = 'inertia(0.5..5)'\n[body]\nheight = 'z'\n",
    );
    let report = search(&flat, &wanted, &mut |_| {}).expect("it can be searched");
    let mut equations = report.conditions[0].equations.clone();
    equations.sort();
    // For k = 0 the equations of motion have no values.
    assert_eq!(equations, ["I1 = I2", "m = 0", "z = 0"], "the base of (4.5)");
}

#[test]
#[ignore = "slow: values of the parameters of a particle, for more integrals of degree 2, are found below"]
fn values_of_the_curvature_for_more_integrals_are_found() {
    let mut wanted = Effort { by_class: false, by_factors: false, ..effort(0) };
    (wanted.degree, wanted.conditions) = (2, Some(ConditionTarget::Existence));
    let report = searched("sphere/balanced-ball", &wanted);
    let by_k =
        report.conditions.iter().find(|c| c.of == "more integrals of degree 2, by the value of k");
    let equations = &by_k.expect("there are two values").equations;
    // κ = 1/(1 + kR) = 1, a plane, and κ = −1
    assert_eq!(equations, &["k = 0", "k*R = -2"]);
}

#[test]
#[ignore = "slow: one condition is found for bodies above, and two at once for small fields below"]
fn conditions_of_codimension_two_are_met_in_small_fields() {
    let mut wanted = Effort { by_class: false, by_factors: false, ..effort(0) };
    wanted.conditions = Some(ConditionTarget::Existence);
    let ellipsoid = case(
        "title = 'x'\nsystem = 'rubber-sphere'\n[parameters]\nm = '0.5..2'\nk = '0.1..0.3'\n\
         B = 'diag(1..3)'\nI = 'inertia(0.5..5)'\n[body]\nshape = 'ellipsoid'\n",
    );
    let report = search(&ellipsoid, &wanted, &mut |_| {}).expect("it can be searched");
    let equations = &report.conditions[0].equations;
    // I = mB + μE, and the bodies of revolution
    let homogeneous = "I1 − I2 − m*B11 + m*B22 = 0 and I1 − I3 − m*B11 + m*B33 = 0";
    assert!(equations.iter().any(|equation| equation.contains(homogeneous)), "{equations:?}");
    assert!(equations.iter().any(|equation| equation == "B11 = B22 and I1 = I2"), "{equations:?}");
}

#[test]
fn a_claim_that_fails_in_general_is_given_its_condition() {
    let mut wanted = effort(0);
    wanted.conditions = Some(ConditionTarget::Claim("F2 of κ = −1".to_string()));
    let report = searched("sphere/balanced-ball", &wanted);
    assert_eq!(report.conditions[0].equations, ["2 + R*k = 0"]);
    wanted.conditions = Some(ConditionTarget::Claim("no such claim".to_string()));
    let path =
        Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../cases/sphere/balanced-ball.toml"));
    let read = Case::read(path, &[]).1.expect("a case of the catalogue");
    let error = search(&read, &wanted, &mut |_| {}).expect_err("there is none");
    assert!(error.to_string().contains("no such claim"), "{error}");
}

#[test]
fn parameters_that_are_equal_or_numbers_are_conditions() {
    let oscillator = |rate: &str| {
        format!(
            "title = 'x'\n[parameters]\na = '0.5..4'\nb = '0.5..4'\n[state]\nx = '-1..1'\ny = '-1..1'\n\
             p = '-1..1'\nq = '-1..1'\n[field]\n\"x'\" = 'p'\n\"y'\" = 'q'\n\"p'\" = '-a*x'\n\"q'\" = '{rate}'\n\
             [[claim]]\nname = 'area'\nintegral = 'x*q - y*p'\nexpect = 'fails'\n"
        )
    };
    let mut wanted = effort(0);
    wanted.conditions = Some(ConditionTarget::Claim("area".to_string()));
    let conditions = |rate| {
        let case = Case::parse(&oscillator(rate), &[]).expect("a case");
        let report = search(&case, &wanted, &mut |_| {}).expect("it can be searched");
        report.conditions[0].equations.clone()
    };
    assert_eq!(conditions("-b*y"), ["a − b = 0"]);
    assert_eq!(conditions("-3/2*y"), ["3 − 2*a = 0"]);
    assert_eq!(conditions("-(1+b²)*y"), ["1 − a + b² = 0"]);
}

#[test]
fn irrational_values_are_not_excluded() {
    // x y is an integral where a² = a b + b², b = 1 included.
    let golden = "title = 'golden'\n[parameters]\na = '1..2'\n[state]\nx = '1..2'\ny = '1..2'\n[field]\n\
                \"x'\" = '(a² − a − 1)*(x² + y³ + 1) + x*y'\n\"y'\" = '−y²'\n";
    let mut wanted = effort(2);
    wanted.conditions = Some(ConditionTarget::Existence);
    let ratio = golden
        .replace("a = '1..2'", "a = '1..2'\nb = '1..2'")
        .replace("a² − a − 1", "a² − a*b − b²");
    for (body, equation) in [(golden.to_string(), "a² − a − 1 = 0"), (ratio, "a² − a*b − b² = 0")]
    {
        let report = search(&case(&body), &wanted, &mut |_| {}).expect("it can be searched");
        let told: Vec<&String> = of_integrals(&report).flat_map(|own| &own.equations).collect();
        assert!(told.iter().any(|own| *own == equation), "{equation}: {told:?}");
    }
}

/// A field in x and y with the parameters a, b, c and the claim C.
fn with_claim(rates: [&str; 2], claim: &str) -> Case {
    case(&format!(
        "title = 'x'\n[parameters]\na = '-1..2'\nb = '-1..3'\nc = '1..2'\n[state]\nx = '-2..2'\ny = '-2..2'\n\
         [field]\n\"x'\" = '{}'\n\"y'\" = '{}'\n[[claim]]\nname = 'C'\nintegral = '{claim}'\n",
        rates[0], rates[1]
    ))
}

#[test]
fn values_of_several_parameters_that_belong_to_no_curve_are_found_and_proved() {
    let mut wanted = effort(0);
    wanted.conditions = Some(ConditionTarget::Claim("C".to_string()));
    let conditions = |rates, claim| {
        let report = search(&with_claim(rates, claim), &wanted, &mut |_| {}).expect("searched");
        let own = report.conditions.into_iter().next().expect("an answer");
        (own.equations, own.grounds)
    };
    let circle = "x² + y²";
    let (equations, grounds) = conditions(["a*y + b*x", "-x"], circle);
    assert_eq!(equations, ["a = 1 and b = 0"]);
    assert!(grounds.contains("no real values other than those reported"), "{grounds}");
    assert!(grounds.ends_with("proved where a = 1 and b = 0"), "{grounds}");
    let (equations, grounds) = conditions(["(a - 1)*y + (b - 2)*x + (c - a)*x*y", "0*x"], "x");
    assert_eq!(equations, ["a = 1 and b = 2 and c = 1"]);
    assert!(grounds.ends_with("proved where a = 1 and b = 2 and c = 1"), "{grounds}");
    // A curve, and a point beside it; one on it is left out.
    let (mut equations, grounds) =
        conditions(["(c - 1)*(a*y + y - b*x)", "(1 - c)*a*x"], "x² − y²");
    equations.sort();
    assert_eq!(equations, ["1 − c = 0", "a = -0.5 and b = 0"], "{grounds}");
    let (equations, _) = conditions(["(c - 1)*((c - 1)*y + b*x)", "0*x"], "x");
    assert_eq!(equations, ["1 − c = 0"]);
    // With poles, with irrational values, and for no values at all.
    let (equations, _) = conditions(["a*y/(b + y) + b*x", "-x/(b + y)"], circle);
    assert_eq!(equations, ["a = 1 and b = 0"]);
    let (equations, grounds) = conditions(["y + (a² - 2)*x² + (b - 3*a)*y", "-x"], circle);
    assert_eq!(equations, ["b = 3*a and b² − 18 = 0"]);
    assert!(grounds.ends_with("proved where b = 3*a and b² − 18 = 0"), "{grounds}");
    // Where only a = 5 and b = 0 are zeros of the numerators nothing has a value.
    let (equations, grounds) = conditions(["y*(1 + (a - 5)) + b*x²/(a - 5)", "-x"], circle);
    assert!(equations.is_empty(), "{equations:?} {grounds}");
    let (equations, _) =
        conditions(["(a - b)*(b - c)*x", "(b - c)*(c - a)*y + (a - b)*(c - a)*x"], circle);
    assert_eq!(equations, ["a = c and b = c"]);
    let (equations, grounds) = conditions(["a*y + 1", "-x"], circle);
    assert!(equations.is_empty(), "{equations:?}");
    assert!(grounds.ends_with("it holds for no real values of the parameters"));
}

#[test]
fn integrals_are_found_at_values_that_belong_to_no_curve() {
    let mut wanted = effort(0);
    wanted.degree = 2;
    wanted.conditions = Some(ConditionTarget::Existence);
    let rates = ["y + (a - 2)*x² + (b - 3)*y", "-x + (a*b - 6)*x*y² + (a - 2)*y"];
    let report = search(&with_claim(rates, "x"), &wanted, &mut |_| {}).expect("searched");
    let with = Given::Condition("a = 2 and b = 3".to_string());
    let found = |formula: &str| {
        report.found.iter().any(|own| own.text() == formula && own.with.contains(&with))
    };
    assert!(found("x² + y²"), "{:?}", report.found);
    let told = |text: &str| report.remarks.iter().any(|own| own.contains(text));
    assert!(told("no other real values of the parameters give more integrals of degree at most 2"));
    let equations: Vec<&String> = of_integrals(&report).flat_map(|own| &own.equations).collect();
    assert!(equations.contains(&&with.text().to_string()), "{equations:?}");
    assert!(equations.iter().all(|own| own.contains(" and ")), "{equations:?}");
}

/// Conditions for the claim that x is an integral, and their grounds.
fn of_x(rates: [&str; 2]) -> (Vec<String>, String) {
    let mut wanted = effort(0);
    wanted.conditions = Some(ConditionTarget::Claim("C".to_string()));
    let report = search(&with_claim(rates, "x"), &wanted, &mut |_| {}).expect("searched");
    let own = report.conditions.into_iter().next().expect("an answer");
    (own.equations, own.grounds)
}

#[test]
fn a_claim_without_equations_is_told_why() {
    let asked = |rate: &str, integral: &str| {
        let text = format!(
            "title = 'x'\n[parameters]\na = '0.5..2'\nb = '0.5..2'\n[state]\nx = '0.5..2'\ny = '0.5..2'\n\
             [field]\n\"x'\" = 'y'\n\"y'\" = '{rate}'\n[[claim]]\nname = 'C'\nintegral = '{integral}'\n"
        );
        let mut wanted = effort(0);
        wanted.conditions = Some(ConditionTarget::Claim("C".to_string()));
        let report = search(&case(&text), &wanted, &mut |_| {}).expect("searched");
        assert!(report.conditions.is_empty(), "{rate}: {:?}", report.conditions);
        report.remarks.into_iter().map(|own| own.text).collect::<Vec<_>>()
    };
    let always = asked("-a*x", "y² + a*x²");
    assert!(always.iter().any(|own| own == "C: no condition is needed"), "{always:?}");
    for (rate, integral) in [
        ("-a*sin(x)", "y²/2 - b*cos(x)"),
        ("-exp(a*x)", "y²/2 + exp(b*x)/b"),
        ("-x^a", "y²/2 + x^(b + 1)/(b + 1)"),
    ] {
        let open = asked(rate, integral);
        assert!(open.iter().any(|own| own.starts_with("no condition is stated")), "{open:?}");
        assert!(open.iter().all(|own| !own.contains("is needed")), "{open:?}");
    }
}

#[test]
fn real_zeros_of_sums_of_squares_are_told() {
    // Modulo primes that are 3 modulo 4 the first has one point alone.
    let all: [(&str, &[&str]); 7] = [
        ("(a - 1)² + (b - 2)²", &["a = 1 and b = 2"]),
        ("(a² - 2)² + (b - a)²", &["a = b and b² − 2 = 0"]),
        ("(a - b)*((a - 1)² + (b - 2)²)", &["a − b = 0", "a = 1 and b = 2"]),
        ("a² + b² + 1", &[]),
        ("a⁴ + b⁴ - 2*a²*b² + 1", &[]),
        // A circle around none of the points that are tried.
        ("(3*a - 1)² + (3*b - 2)² - 1/20", &["33 − 40*a − 80*b + 60*a² + 60*b² = 0"]),
        ("(3*a - 1)² + (3*b - 2)² + 1/20", &[]),
    ];
    for (factor, expected) in all {
        let (equations, grounds) = of_x([&format!("({factor})*x"), "y"]);
        assert_eq!(equations, expected, "{factor}: {grounds}");
        let is_empty = expected.is_empty();
        let says = if is_empty { "has no real zeros" } else { "it holds for no" };
        assert!(grounds.contains(says) && !grounds.contains("perhaps"), "{factor}: {grounds}");
    }
}

#[test]
fn sets_without_real_points_are_not_told() {
    // a³ = b, b³ = a has three real solutions among nine.
    let (mut equations, grounds) = of_x(["(a³ - b)*x + (b³ - a)*y", "0*x"]);
    equations.sort();
    assert_eq!(equations, ["a = -1 and b = -1", "a = 0 and b = 0", "a = 1 and b = 1"], "{grounds}");
    // Those with a b = −1 are not among them.
    let (equations, grounds) = of_x(["(a³ - b)*x + (b³ - a)*y + (a²*b² + 1 + 2*a*b)*x*y", "0*x"]);
    assert!(equations.is_empty(), "{equations:?} {grounds}");
    assert!(grounds.ends_with("it holds for no real values of the parameters"), "{grounds}");
    // On a line through the imaginary zeros, and in space.
    let (equations, grounds) = of_x(["(a² + b² + 1)*x + (a - b)*y", "0*x"]);
    assert!(equations.is_empty(), "{equations:?} {grounds}");
    let (equations, grounds) = of_x(["((a - c)² + (b - c)²)*x + (c - 1)*(c - 2)*y", "0*x"]);
    let mut sorted = equations.clone();
    sorted.sort();
    assert_eq!(sorted, ["a = 1 and b = 1 and c = 1", "a = 2 and b = 2 and c = 2"], "{grounds}");
}

#[test]
fn a_real_point_among_many_imaginary_ones_is_told() {
    // One of 25 solutions is real, near a = 1.08.
    let mut wanted = effort(0);
    wanted.conditions = Some(ConditionTarget::Claim("C".to_string()));
    let text = "title = 'x'\n[parameters]\na = '-1..2'\nb = '-1..3'\n[state]\nx = '-2..2'\ny = '-2..2'\n[field]\n\
                \"x'\" = '(a⁵ - b)*x + (b⁵ - a - 7)*y'\n\"y'\" = '0*x'\n[[claim]]\nname = 'C'\nintegral = 'x'\n";
    let report = search(&case(text), &wanted, &mut |_| {}).expect("searched");
    let own = &report.conditions[0];
    assert_eq!(own.equations, ["a⁵ − b = 0 and b⁵ − a − 7 = 0"], "{}", own.grounds);
}

#[test]
fn values_where_there_is_no_motion_are_not_told() {
    let linear = "(a - 1)*x + (b - 1)*y";
    for pole in ["x/(a - b)", "x + (a - b)/(a - b)*y", "x/(a + b - 2)", "x/(a³ - b²)"] {
        let (equations, grounds) = of_x([linear, pole]);
        assert!(equations.is_empty(), "{pole}: {equations:?} {grounds}");
        assert!(grounds.ends_with("it holds for no real values of the parameters"), "{grounds}");
    }
    assert_eq!(of_x([linear, "x/(a - 2*b)"]).0, ["a = 1 and b = 1"]);
    // On a whole line, and for two of four pairs of roots.
    assert!(of_x(["(a - b)*x", "y/(a - b)"]).0.is_empty());
    assert_eq!(of_x(["(a - b)*x", "y/(a + b)"]).0, ["a − b = 0"]);
    let (equations, grounds) = of_x(["(a² - 2)*x + (b² - 2)*y", "y/(a - b)"]);
    assert_eq!(equations, ["a + b = 0 and b² − 2 = 0"], "{grounds}");
    assert!(of_x(["((a - 1)² + (b - 2)²)*x", "y/(a - 1)"]).0.is_empty());
}

#[test]
fn integrals_are_found_at_real_zeros_of_sums_of_squares() {
    let mut wanted = effort(0);
    wanted.degree = 1;
    wanted.conditions = Some(ConditionTarget::Existence);
    let told = |rates: [&str; 2]| {
        let report = search(&with_claim(rates, "x"), &wanted, &mut |_| {}).expect("searched");
        let mut all: Vec<String> =
            of_integrals(&report).flat_map(|own| own.equations.clone()).collect();
        all.sort();
        all.dedup();
        (all, report)
    };
    let (equations, report) = told(["((a - 1)² + (b - 2)²)*(1 - x*y)", "y² + x"]);
    assert_eq!(equations, ["a = 1 and b = 2"]);
    let with = Given::Condition("a = 1 and b = 2".to_string());
    let is_found = report.found.iter().any(|own| own.text() == "x" && own.with.contains(&with));
    assert!(is_found, "{:?}", report.found);
    assert!(report.conditions.iter().all(|own| !own.grounds.contains("may give more")));
    assert!(told(["(a² + b² + 1)*(1 - x*y)", "y² + x"]).0.is_empty());
    let (equations, _) = told(["((a - 1)² + (b - 2)²)*(1 - x*y)", "y²/(a - 1) + x"]);
    assert!(equations.is_empty(), "{equations:?}: no motion");
}

#[test]
fn values_of_one_parameter_are_real() {
    let mut wanted = effort(0);
    wanted.degree = 1;
    wanted.conditions = Some(ConditionTarget::Existence);
    let told = |factor: &str| {
        let text = format!(
            "title = 'x'\n[parameters]\na = '1..2'\n[state]\nx = '1..2'\ny = '1..2'\n[field]\n\
             \"x'\" = '({factor})*(x² + y³ + 1)'\n\"y'\" = '1 + y²'\n"
        );
        let report = search(&case(&text), &wanted, &mut |_| {}).expect("searched");
        of_integrals(&report).flat_map(|own| own.equations.clone()).collect::<Vec<_>>()
    };
    assert_eq!(told("a² - a - 1"), ["a² − a − 1 = 0"]);
    assert!(told("a² - a + 1").is_empty());
}

/// Conditions of a particle in the plane, each with its equations and grounds, and the remarks.
fn of_a_particle(parameters: &str, potential: &str) -> (Vec<(Vec<String>, String)>, Vec<String>) {
    let particle = case(&format!(
        "title = 'x'\n[parameters]\n{parameters}\n[state]\nx = '-1..1'\ny = '-1..1'\n\"x'\" = '-1..1'\n\
         \"y'\" = '-1..1'\n[lagrangian]\nkinetic = \"(x'² + y'²)/2\"\npotential = '{potential}'\n"
    ));
    let mut wanted = effort(0);
    (wanted.degree, wanted.conditions) = (2, Some(ConditionTarget::Existence));
    let report = search(&particle, &wanted, &mut |_| {}).expect("it can be searched");
    let conditions = of_integrals(&report).cloned().map(|own| (own.equations, own.grounds));
    (conditions.collect(), report.remarks.into_iter().map(|own| own.text).collect())
}

#[test]
fn values_of_the_parameters_of_a_particle_are_those_of_its_potential() {
    let equations = |parameters: &str, potential: &str| -> Vec<String> {
        of_a_particle(parameters, potential).0.into_iter().flat_map(|(own, _)| own).collect()
    };
    // In x³ + x² + y² + c x y both coordinates separate for c = 0 alone.
    let a = "a = '1..2'";
    assert_eq!(equations(a, "(a − 3/2)*x*y + x² + y² + x³"), ["a = 1.5"]);
    assert_eq!(equations(a, "(a² − 5)*x*y + x² + y² + x³"), ["a² − 5 = 0"]);
    let sum = equations("a = '1..2'\nb = '1..2'", "(a + b)*x*y + x² + y² + x³");
    assert_eq!(sum, ["a/b = -1", "b/a = -1"], "no number that was drawn for the other one");
    let (conditions, _) = of_a_particle(a, "(a² + 7)*x*y + x² + y² + x³");
    assert!(
        matches!(&conditions[..], [(none, grounds)] if none.is_empty() && grounds.contains("not real")),
        "{conditions:?}"
    );
    for potential in ["exp(a)*x*y + x³ + y³", "cos(a)*x*y + x³ + y³"] {
        let (conditions, remarks) = of_a_particle(a, potential);
        assert!(conditions.is_empty(), "{potential}: {conditions:?}");
        assert!(remarks.iter().any(|own| own.contains("exponent or an angle")), "{remarks:?}");
    }
}

#[test]
fn values_that_no_prime_has_may_be_missing() {
    // Five roots, whose permutations are all of them: no prime is found that has all.
    let (conditions, remarks) = of_a_particle("a = '1..2'", "(a^5 − a + 3)*x*y + x² + y² + x³");
    let says_none = |(_, grounds): &(Vec<String>, String)| grounds.contains("no value has more");
    assert!(!conditions.iter().any(says_none), "{conditions:?}");
    assert!(remarks.iter().any(|own| own.contains("may be missing")), "{remarks:?}");
}
