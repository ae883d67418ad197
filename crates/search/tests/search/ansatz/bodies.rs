//! Invariants of textbook bodies, found without any option.

use liouville::verdict::Verdict;
use liouville_search::{SearchReport, search};

use super::{case, effort};

fn of(text: &str, degree: u32) -> SearchReport {
    search(&case(text), &effort(degree), &mut |_| {}).expect("it can be searched")
}

#[test]
fn the_integrals_of_a_ball_with_its_centre_of_mass_on_its_axis_are_all() {
    // Jellett's and Routh's, with gravity.
    let text = "title = 'x'\nsystem = 'rolling-plane'\n[parameters]\nm = '0.5..2'\nR = '1..3'\n\
                I = 'axisymmetric(0.5..5)'\nc = [0, 0, 0.3]\na_g = '1..10'\n[body]\nshape = 'ball'\n\
                potential = 'm*a_g*h'\n";
    let report = of(text, 2);
    let integrals: Vec<&str> = report.formulas("integral").collect();
    assert!(integrals.contains(&"(I*ω,r)"), "{integrals:?}");
    assert_eq!(integrals.len(), 2, "{integrals:?}");
    assert!(report.found.iter().all(|own| own.verdict == Verdict::Proved), "{:?}", report.found);
    let theorem = report.excluded.first().map(|own| own.theorem.as_str()).unwrap_or_default();
    assert!(theorem.contains("is a polynomial in energy and"), "{theorem}");
}

#[test]
fn invariants_with_a_free_tensor_of_inertia_are_found() {
    // Veselova's system as a Lagrangian with a constraint.
    let text = "title = 'x'\nsystem = 'nonholonomic'\n[parameters]\nI = 'inertia(0.5..5)'\n[state]\n\
                w = 'vector(-1..1)'\ng = 'vector(-1..1)'\n[field]\n\"g'\" = 'g × w'\n[lagrangian]\n\
                kinetic = '(w,I*w)/2'\nquasi-velocities = ['w']\nalgebra = 'so(3)'\n\
                constraints = ['(w,g) = 0']\n[level]\nequations = ['(g,g) = 1']\n";
    let report = of(text, 2);
    let has = |kind: &str| report.functions(kind).count() == 1;
    assert!(has("integral") && has("density"), "{:?}", report.found);
    assert!(report.found.iter().all(|own| own.verdict == Verdict::Proved), "{:?}", report.found);
}
