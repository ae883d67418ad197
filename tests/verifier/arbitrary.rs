//! Degrees of the polynomials that stand for arbitrary shapes and potentials.

use liouville::case::Case;

fn case(claim: &str) -> Case {
    let text = format!(
        "title = 'x'\nsystem = 'rubber-plane'\n[parameters]\nm = 1\nI = [1, 2, 2.5]\n[body]\n\
         support = 'arbitrary'\npotential = 'arbitrary'\n[[claim]]\n{claim}"
    );
    Case::parse(&text, &[]).expect("a case")
}

#[test]
fn degrees_are_those_of_the_jets_that_claims_contain() {
    let count = |claim: &str, prefix: &str| {
        let model = case(claim).model;
        model.parameters.iter().filter(|p| p.name.starts_with(prefix)).count()
    };
    // (n + 1)² polynomials of degree n on the sphere, (n + 1)(n + 2)(n + 3)/6 in space.
    let (one, two) = ("integral = 'energy'", "reversor = { 'ω' = '−ω' }");
    let twice = "density-in-variables = '1'\n[variables]\nM = 'ω'\n'γ' = 'γ'\n";
    assert_eq!([count(one, "h["), count(one, "U[")], [16, 10], "degrees 3 and 2");
    assert_eq!([count(twice, "h["), count(twice, "U[")], [25, 20], "degrees 4 and 3");
    assert_eq!([count(two, "h["), count(two, "U[")], [49, 35], "degrees 6 and 4");
    let asked = case(one).ask(&format!("[[claim]]\n{two}"));
    assert!(asked.is_err_and(|e| e.to_string().contains("too low a degree")), "of one point");
    assert!(case(two).ask(&format!("[[claim]]\n{two}")).is_ok(), "of two");
}
