//! Darboux polynomials that are products of others, and fields with many roots.

use liouville_search::{Effort, FoundKind};

use super::factors::cofactor;
use super::{field, searched};

#[test]
fn products_of_conjugates_are_divided() {
    // 9 + 41y² + 32y⁴ = (1 + y²)(9 + 32y²), whose four complex zeros have one form.
    let rates = ["160*x*y^3 + 68*x*y", "-64*y^4 - 82*y^2 - 18"];
    let report = searched(&field("", &rates), &Effort::default());
    for own in ["1 + y²", "9 + 32*y²"] {
        assert!(cofactor(&report, own).is_some(), "{own}: {:?}", report.found);
    }
    assert!(report.found.iter().any(|own| own.kind == FoundKind::Integral), "{:?}", report.found);
    let report = searched(&field("", &["1", "(y^2 + 1)*(y^2 + 2)"]), &Effort::default());
    let rates = report.found.iter().filter(|own| own.kind == FoundKind::ConstantRate);
    assert!(
        rates.into_iter().any(|own| own.text().matches("atan").count() == 2),
        "{:?}",
        report.found
    );
}

#[test]
fn denominators_of_integrals_are_divided() {
    // Modified Emden: 2v² + 3kx²v + k²x⁴ = (v + kx²)(2v + kx²), with y for v.
    let rates = ["y", "-3*k*x*y - k^2*x^3"];
    let report = searched(&field("k = '0.5..2'", &rates), &Effort::default());
    for (own, expected) in [("k*x² + y", "−k*x"), ("k*x² + 2*y", "−2*k*x")] {
        assert_eq!(cofactor(&report, own), Some(expected), "{:?}", report.found);
    }
}

#[test]
fn three_bodies_in_space_have_their_integrals() {
    let text = "title = 'x'\n[parameters]\nn = 3\nm = 'vector(n, 0.5..2)'\n[state]\nq = 'matrix(n, 3, -1..1)'\n\
                v = 'matrix(n, 3, -1..1)'\n[field]\n\"q[i]'\" = 'v[i]'\n\
                \"v[i]'\" = 'sum(j, 1..n, j ≠ i, m[j]*(q[j] - q[i])/|q[j] - q[i]|^3)'\n";
    let report = searched(text, &Effort::default());
    let integrals = report.found.iter().filter(|own| own.kind == FoundKind::Integral);
    // Momenta, angular momenta, the energy, and two of the moments of the centre of mass.
    assert!(integrals.count() >= 7, "{:?}", report.found);
}

#[test]
fn an_integral_is_found_rather_than_its_square() {
    let text = "title = 'x'\n[parameters]\nI = [1, 2, 2.5]\n[state]\nw = 'vector(-2..2)'\n[field]\n\
                \"w'\" = 'solve(I, I*w × w)'\n";
    let report = searched(text, &Effort::default());
    let integrals: Vec<&str> = report
        .found
        .iter()
        .filter(|own| own.kind.name().contains("integral"))
        .map(|own| own.text())
        .collect();
    assert_eq!(integrals, ["(I*w,w)", "(I*w,I*w)"]);
}
