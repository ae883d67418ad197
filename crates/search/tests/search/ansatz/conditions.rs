//! Conditions on the parameters under which something exists or a claim holds.

use std::path::Path;

use liouville::case::Case;
use liouville_search::{ConditionTarget, search};

use crate::ansatz::{case, effort, searched};

#[test]
fn conditions_on_parameters_are_found() {
    let mut wanted = effort(0);
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
    assert_eq!(equations, ["I1 = I2", "k = 0", "m = 0", "z = 0"], "the base of (4.5)");

    wanted.degree = 2;
    let report = searched("sphere/balanced-ball", &wanted);
    let by_k =
        report.conditions.iter().find(|c| c.of == "more integrals of degree 2, by the value of k");
    let equations = &by_k.expect("there are two values").equations;
    // κ = 1/(1 + kR) = 1, a plane, and κ = −1
    assert_eq!(equations, &["k = 0", "k*R = -2"]);
}

#[test]
fn conditions_of_codimension_two_are_met_in_small_fields() {
    let mut wanted = effort(0);
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
        let told: Vec<&String> = report.conditions.iter().flat_map(|own| &own.equations).collect();
        assert!(told.iter().any(|own| *own == equation), "{equation}: {told:?}");
    }
}
