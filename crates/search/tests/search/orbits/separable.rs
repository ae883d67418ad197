//! Separable Hamiltonians: integrals in one coordinate and its momentum, beside the energy.

use liouville_search::{Effort, FoundKind};

use super::searched;

/// Geodesics of Kerr's metric, with a further term in the numerator.
fn kerr(term: &str) -> String {
    format!(
        "title = 'x'\n[parameters]\nM = '0.5..1'\na = '0.1..0.4'\nE = '0.5..1'\nL = '-1..1'\n[state]\nr = '4..8'\n\
         \"θ\" = '0.5..2.5'\npr = '-1..1'\nq = '-1..1'\n[let]\nS = 'r² + a²*cos(θ)²'\nD = 'r² − 2*M*r + a²'\n\
         [hamiltonian]\nfunction = '(D*pr² + q² − ((r² + a²)*E − a*L)²/D + (L − a*E*sin(θ)²)²/sin(θ)²{term})/(2*S)'\n\
         pairs = [['r', 'pr'], ['θ', 'q']]\n"
    )
}

#[test]
fn carters_integral_is_found_for_all_parameters() {
    let report = searched(&kerr(""), &Effort::default());
    let integrals: Vec<&str> = report.formulas(FoundKind::Integral).collect();
    let [carter] = integrals[..] else { panic!("{integrals:?}") };
    assert!(carter.contains("energy") && carter.contains("q²"), "{carter}");
    assert!(!carter.contains("pr"), "in one coordinate alone: {carter}");
    // A term in both coordinates.
    let report = searched(&kerr(" + r*cos(θ)"), &Effort::default());
    assert_eq!(report.formulas(FoundKind::Integral).count(), 0, "{:?}", report.found);
}
