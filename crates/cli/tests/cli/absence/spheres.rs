//! Absence in systems whose motion carries a unit vector along.

use liouville::verdict::Verdict;

use super::{absences, only};

fn top(tensor: &str, lagrangian: &str, claims: &str) -> String {
    format!(
        "title = 't'\nsystem = 'nonholonomic'\n[parameters]\nI = {tensor}\n[state]\nw = 'vector(-1..1)'\n\
         g = 'vector(-1..1)'\n[field]\n\"g'\" = 'g × w'\n[lagrangian]\nkinetic = '(w,I*w)/2'\n\
         quasi-velocities = ['w']\nalgebra = 'so(3)'\n{lagrangian}[level]\nequations = ['(g,g) = 1']\n\
         {claims}"
    )
}

fn absent(degree: u32) -> String {
    format!("[[claim]]\nno-integral = {{ degree = {degree} }}\n")
}

const AREA: &str = "[[claim]]\nintegral = '(I*w,g)'\n";

#[test]
fn a_heavy_top_has_further_integrals_in_the_known_cases_alone() {
    let any = "'inertia(0.5..5)'";
    let heavy = "potential = 'g1 + 2*g2 + 3*g3'\n";
    for (tensor, potential, degree, expected) in [
        (any, heavy, 2, Verdict::Proved),
        (any, "", 2, Verdict::Refuted),
        ("[1, 1, 3]", "potential = 'g3'\n", 1, Verdict::Refuted),
        ("[1, 1, 3]", "potential = 'g1'\n", 3, Verdict::Proved),
    ] {
        let report = only(&top(tensor, potential, &(AREA.to_string() + &absent(degree))));
        let what = format!("{tensor}, {potential}: {:?}", report.evidence);
        assert_eq!(report.verdict, expected, "{what}");
    }
    let report = only(&top(any, heavy, &absent(1)));
    assert_eq!(report.verdict, Verdict::Refuted, "the integral of areas: {:?}", report.evidence);
}

#[test]
fn constraints_on_a_body_are_counted_on_the_sphere() {
    let veselova = "constraints = ['(w,g) = 0']\n";
    let known = "[[claim]]\nintegral = '(I*w,I*w) − (I*w,g)²'\n";
    let claims = known.to_string() + &absent(2) + "[[claim]]\nno-density = { degree = 0 }\n";
    let verdicts: Vec<Verdict> = absences(&top("'inertia(0.5..5)'", veselova, &claims))
        .into_iter()
        .map(|own| own.verdict)
        .collect();
    assert_eq!(verdicts, [Verdict::Proved, Verdict::Refuted]);
    // The square of the sphere's equation is the sphere; a flat product is not seen to be it.
    for (typed, expected) in [
        ("((g,g) − 1)² = 0", Verdict::Refuted),
        ("((g,g) − 1)*(exp((g,g) − 1) − 1) = 0", Verdict::Undecided),
    ] {
        let other = top("'inertia(0.5..5)'", veselova, &absent(2)).replace("(g,g) = 1", typed);
        assert_eq!(only(&other).verdict, expected, "{typed}");
    }
}

#[test]
fn an_equation_with_other_zeros_is_no_unit_vector() {
    // The chart makes the sphere of radius 2, on which the body is free.
    let two = "title = 't'\nsystem = 'nonholonomic'\n[parameters]\ne = 'vector(1..2)'\nI1 = '1..2'\nI2 = '3..4'\nI3 = '5..6'\n\
        I = 'diag(I1, I2, I3)'\n[state]\nw = 'vector(-2..2)'\ng = 'vector(-3..3)'\n[field]\n\"g'\" = 'g × w'\n[lagrangian]\n\
        kinetic = '(w,I*w)/2'\nquasi-velocities = ['w']\nalgebra = 'so(3)'\npotential = '(e,g)*((g,g) - 4)'\n[level]\n\
        equations = ['((g,g) - 1)*((g,g) - 4) = 0']\n[level.chart]\n\
        inputs = { u = '-2..2', v = '-2..2', z = 'vector(-1..1)' }\n\
        g = '2*vec(2*u, 2*v, 1 - u^2 - v^2)/(1 + u^2 + v^2)'\nw = 'z'\n";
    let text = two.to_string() + AREA + &absent(2);
    assert_ne!(only(&text).verdict, Verdict::Proved, "(I*w,I*w) is an integral there");
}
