//! Counts of integrals polynomial in the velocities, with those that are found along orbits.

use liouville_search::{Effort, Remark};

use super::searched;

fn lagrangian(potential: &str) -> String {
    format!(
        "title = 'x'\nsystem = 'nonholonomic'\n[state]\nx = '0.5..2'\ny = '0.5..2'\n\"x'\" = '-1..1'\n\
         \"y'\" = '-1..1'\n[lagrangian]\nkinetic = \"(x'² + y'²)/2\"\npotential = '{potential}'\n"
    )
}

#[test]
fn a_count_is_explained_by_what_an_orbit_shows() {
    // The quartic integral of the third integrable case of Hénon and Heiles.
    let potential = "(x² + 16*y²)/2 + x²*y + 16/3*y³";
    let report = searched(&lagrangian(potential), &Effort::default());
    let last = report.counts.last().expect("counts");
    assert_eq!((last.degree, last.dimension, last.known), (4, 4, 4), "1, E, E², F");
    let theorem = report.excluded.iter().find(|own| own.theorem.contains("degree at most 4"));
    let theorem = &theorem.expect("all integrals of degree 4").theorem;
    assert!(theorem.contains(" in the energy and "), "{theorem}");
    let counted = |remark: &&Remark| remark.contains("are counted than known");
    assert_eq!(report.remarks.iter().find(counted), None);
}

#[test]
fn further_integrals_are_known_to_a_count() {
    // One component of Laplace's vector is a function of the other, the area and the energy.
    let report = searched(&lagrangian("−1/√(x² + y²)"), &Effort::default());
    let two = report.counts.iter().find(|count| count.degree == 2).expect("a count");
    assert_eq!((two.dimension, two.known), (6, 6), "1, L, L², E, A_y, and A_x");
    let theorem = report.excluded.iter().find(|own| own.theorem.contains("degree at most 4"));
    let theorem = &theorem.expect("of degree 4").theorem;
    assert_eq!(theorem.matches("√(x² + y²)").count(), 2, "both components: {theorem}");
}

#[test]
fn what_an_orbit_does_not_show_is_left_open() {
    // Laplace's vector is not one formula for all listed values, and not written.
    let text = lagrangian("−k/√(x² + y²)");
    let text = text.replace("[state]", "[parameters]\nk = 'one of 1, 2'\n[state]");
    let report = searched(&text, &Effort::default());
    let two = report.counts.iter().find(|count| count.degree == 2).expect("a count");
    assert_eq!((two.dimension, two.known), (6, 4), "1, L, L², E, and A_y, A_x");
    let theorem = report.excluded.iter().find(|own| own.theorem.contains("degree at most"));
    let theorem = &theorem.expect("of degree 1").theorem;
    assert!(theorem.contains("degree at most 1"), "no integral of degree 2: {theorem}");
    let counted = report.remarks.iter().find(|remark| remark.contains("are counted than known"));
    assert!(counted.expect("a remark").contains("degree 2"), "the first degree");
}

#[test]
fn what_whole_angles_show_is_not_lost_to_their_halves() {
    // sin x sin y is an integral of degree 2, and of degree 4 in the functions of x/2 and y/2.
    let text = "title = 'x'\n[state]\nx = '0.5..2'\ny = '0.5..2'\nz = '0.5..2'\n[field]\n\
                \"x'\" = 'sin(x)*cos(y)'\n\"y'\" = '−cos(x)*sin(y)'\n\"z'\" = 'z² + x'\n";
    let report = searched(text, &Effort { by_factors: false, ..Effort::default() });
    let last = report.orbits.last().expect("an orbit");
    let names = ["x", "y", "z", "sin(x)", "cos(x)", "sin(y)", "cos(y)"];
    assert!(last.integrals == 1 && last.variables.len() == 7, "{last:?}");
    assert!(names.iter().all(|own| last.variables.iter().any(|name| name == own)), "{last:?}");
    let sentence = last.sentence();
    assert!(sentence.contains(" in x, y, z, "), "the variables are named: {sentence}");
}
