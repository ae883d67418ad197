//! Parameters near those of a case: what is proved at the case's own holds for them only where the
//! field as written is analytic about the orbit at all of them.

use liouville::verdict::Verdict;

use super::{judged, of_figure};

/// The cycle on the unit circle, with a further term in x' and a value of b.
fn circle(term: &str, b: &str) -> String {
    format!(
        "title = \"circle\"\n[parameters]\nb = {b}\nc = [0, 1]\nJ = [[1, 0], [0, 1]]\n\
         k = \"2*b\"\n[state]\nx = \"-2..2\"\ny = \"-2..2\"\n\
         [field]\n\"x'\" = \"−y + x*(1 − x² − y²) + ({term})\"\n\"y'\" = \"x + y*(1 − x² − y²)\"\n\
         [[claim]]\nclosed-orbit = 6.283185307\nstate = {{ x = \"1\" }}\ndensity = \"none\"\n"
    )
}

/// Theorem about that cycle.
fn theorem(term: &str, b: &str) -> String {
    let claim = judged(&circle(term, b));
    assert_eq!(claim.verdict, Verdict::Proved, "{term}, b = {b}: {:?}", claim.evidence);
    claim.evidence.theorem.expect("stated")
}

#[test]
fn nothing_is_said_of_parameters_for_which_the_field_has_no_value() {
    for (term, b) in [
        ("x^b − 1", "0"),
        ("x^(b/3) − 1", "0"),
        ("(x²)^b − 1", "0"),
        ("0*x^b", "2"),
        ("0*x^b", "1"),
        ("x^b*0", "3"),
        ("(−1)^b − 1", "0"),
        ("(x − 3)^b − 1", "0"),
        ("x^k − 1", "0"),
        ("x^(c[1]) − 1", "0"),
        ("x^(J[1,2]) − 1", "0"),
        ("(x + 3)^b − x^b", "0"),
    ] {
        let theorem = theorem(term, b);
        assert!(theorem.ends_with("on it, for these parameters"), "{term}, b = {b}: {theorem}");
    }
}

#[test]
fn where_it_has_values_the_orbit_persists() {
    for (term, b) in [
        ("b*x", "0"),
        ("k*x", "0"),
        ("(x + 3)^b − 1", "0"),
        ("0*(x + 3)^b", "2"),
        ("(2 + x + b)^(1/2)*b", "0"),
        ("b*ln(x + 3 + b) + 0*c[1]*J[1,2]", "0"),
        ("b/(2 + x*y*b)", "0"),
        ("0/b", "2"),
    ] {
        let theorem = theorem(term, b);
        assert!(theorem.ends_with("for these parameters and all near them"), "{term}: {theorem}");
    }
    let theorem = of_figure(6)[0].evidence.theorem.as_ref().expect("stated");
    assert!(theorem.contains("near them for which the motion keeps"), "{theorem}");
}
