//! Invariants of textbook bodies, found without any option.

use liouville::verdict::Verdict;
use liouville_search::{Ansatz, Effort, FoundKind, SearchReport, search};

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
    let integrals: Vec<&str> = report.formulas(FoundKind::Integral).collect();
    assert!(integrals.contains(&"(I*ω,r)"), "{integrals:?}");
    assert_eq!(integrals.len(), 2, "{integrals:?}");
    assert!(report.found.iter().all(|own| own.verdict == Verdict::Proved), "{:?}", report.found);
    let theorem = report.excluded.first().map(|own| own.theorem.as_str()).unwrap_or_default();
    assert!(theorem.contains("is a polynomial in the energy, "), "{theorem}");
}

#[test]
fn invariants_with_a_free_tensor_of_inertia_are_found() {
    // Veselova's system as a Lagrangian with a constraint.
    let text = "title = 'x'\nsystem = 'nonholonomic'\n[parameters]\nI = 'inertia(0.5..5)'\n[state]\n\
                w = 'vector(-1..1)'\ng = 'vector(-1..1)'\n[field]\n\"g'\" = 'g × w'\n[lagrangian]\n\
                kinetic = '(w,I*w)/2'\nquasi-velocities = ['w']\nalgebra = 'so(3)'\n\
                constraints = ['(w,g) = 0']\n[level]\nequations = ['(g,g) = 1']\n";
    let report = of(text, 2);
    let has = |kind: FoundKind| report.functions(kind).count() == 1;
    assert!(has(FoundKind::Integral) && has(FoundKind::Density), "{:?}", report.found);
    assert!(report.found.iter().all(|own| own.verdict == Verdict::Proved), "{:?}", report.found);
}

#[test]
fn integrals_are_found_without_terms() {
    let ball = "title='x'\nsystem='rubber-plane'\n[parameters]\nm='0.5..2'\nR='1..3'\n\
                I='inertia(0.5..5)'\n";
    let cases = [
        (format!("{ball}[body]\nshape='ball'\n"), 4),
        (
            "title='x'\nsystem='rubber-plane'\n[parameters]\nm=1.3\nR=3\nI=[2.6,1.2,1.8]\n\
             c=[0.7,-0.4,1.1]\n[body]\nshape='ball'\n"
                .to_string(),
            4,
        ),
        (format!("{ball}S='vector(-1..1)'\n[body]\nshape='ball'\ngyrostat='S'\n"), 4),
        (
            "title='x'\nsystem='rubber-plane'\n[parameters]\nm='0.5..2'\nB='diag(1..4)'\n\
             \"μ\"='1..2'\nI='m*B + μ*E'\n[body]\nshape='ellipsoid'\n"
                .to_string(),
            4,
        ),
        (
            "title='x'\nsystem='flat-base'\n[parameters]\nm='0.5..2'\nk='0.2..1'\nz=0\n\
             I='inertia(0.5..5)'\n[body]\nheight='z'\n"
                .to_string(),
            4,
        ),
        (
            "title='x'\nsystem='rubber-sphere'\n[parameters]\nm=1\nR=1\nk=-2\nI=[1.37,2.91,3.73]\n\
             [body]\nshape='ball'\n"
                .to_string(),
            8,
        ),
    ];
    for (text, positions) in cases {
        let ansatz = Ansatz { wanted: true, positions, ..Ansatz::default() };
        let effort = Effort { blind: true, ansatz, ..effort(2) };
        let report = search(&case(&text), &effort, &mut |_| {}).expect("it can be searched");
        let found: Vec<&str> = report.formulas(FoundKind::Integral).collect();
        assert_eq!(found.len(), 1, "{text}: {found:?} {:?} {:?}", report.remarks, report.excluded);
        let is_proved = report.found.iter().all(|own| own.verdict == Verdict::Proved);
        assert!(is_proved, "{text}");
    }
}
