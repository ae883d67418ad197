//! Integrals that are brackets of others, or their derivatives along symmetry fields.

use liouville::case::Case;
use liouville::claim::Claim;
use liouville::verdict::{Options, Verdict};
use liouville_search::{Effort, FoundKind, SearchReport};

use super::searched;

/// A Hamiltonian system in canonical pairs.
fn hamiltonian(parameters: &str, pairs: &[[&str; 2]], function: &str) -> String {
    let state: String = pairs.iter().flatten().map(|own| format!("{own} = '0.5..1'\n")).collect();
    format!(
        "title = 'x'\n[parameters]\n{parameters}\n[state]\n{state}[hamiltonian]\nfunction = '{function}'\n\
         pairs = {pairs:?}\n"
    )
}

/// Further integrals, each with words on how it comes from others.
fn further(report: &SearchReport) -> Vec<(&str, &str)> {
    let own = report.found.iter().filter(|found| found.kind == FoundKind::FurtherIntegral);
    own.map(|found| (found.text(), found.with[0].name())).collect()
}

/// Whether integrals are linearly independent of 1, of others and of their products by pairs.
fn are_new(text: &str, report: &SearchReport) {
    let case = Case::parse(text, &[]).expect("a case");
    let all: Vec<_> = report.functions(FoundKind::Integral).cloned().collect();
    let found = report.found.iter().filter(|found| found.kind == FoundKind::FurtherIntegral);
    for one in found.filter_map(|found| found.function().cloned()) {
        let functions = all.iter().cloned().chain([one.clone()]).collect();
        let claims = [Claim::integral(&one), Claim::independent(functions)];
        let judged = case.judge(&claims, &Options::default()).expect("judged").claims;
        assert_eq!(judged[0].verdict, Verdict::Proved, "{}", one.text());
    }
}

const PLANE: [[&str; 2]; 2] = [["x", "p"], ["y", "q"]];
const SPACE: [[&str; 2]; 3] = [["x", "p"], ["y", "q"], ["z", "r"]];

#[test]
fn laplaces_vector_is_found_as_a_whole() {
    let plane = hamiltonian("k = '1..2'", &PLANE, "(p² + q²)/2 - k/√(x² + y²)");
    let report = searched(&plane, &Effort::default());
    assert_eq!(report.formulas(FoundKind::Integral).count(), 2, "{:?}", report.found);
    assert_eq!(further(&report).len(), 1, "{:?}", report.found);
    are_new(&plane, &report);
    let space = hamiltonian("", &SPACE, "(p² + q² + r²)/2 - 1/√(x² + y² + z²)");
    let report = searched(&space, &Effort::default());
    assert_eq!(report.formulas(FoundKind::Integral).count(), 4, "{:?}", report.found);
    assert_eq!(further(&report).len(), 2, "{:?}", report.found);
    are_new(&space, &report);
}

#[test]
fn fields_and_lagrangians_have_the_second_component_too() {
    let field = "title = 'x'\n[state]\nx = '0.5..1'\ny = '0.5..1'\nu = '0.5..1'\nv = '0.5..1'\n[field]\n\
                 x = 'u'\ny = 'v'\nu = '-x/(x² + y²)^(3/2)'\nv = '-y/(x² + y²)^(3/2)'\n";
    let lagrangian = "title = 'x'\n[state]\nx = '0.5..1'\ny = '0.5..1'\n\"x'\" = '0.5..1'\n\
                      \"y'\" = '0.5..1'\n[lagrangian]\nkinetic = \"(x'² + y'²)/2\"\n\
                      potential = '-1/√(x² + y²)'\n";
    for text in [field, lagrangian] {
        let report = searched(text, &Effort::default());
        assert_eq!(further(&report).len(), 1, "{:?}", report.found);
        are_new(text, &report);
    }
    // All integrals of degree 2 are then polynomials in these.
    let report = searched(lagrangian, &Effort::default());
    let degree_2 = report.counts.iter().find(|own| own.degree == 2).expect("counted");
    assert_eq!(degree_2.known, degree_2.dimension, "{:?}", report.counts);
}

#[test]
fn brackets_complete_the_algebra_of_an_oscillator() {
    // x² + p², y² + q², x y + p q and x q − y p.
    let text = hamiltonian("", &PLANE, "(p² + q² + x² + y²)/2");
    let report = searched(&text, &Effort::default());
    assert_eq!(
        report.formulas(FoundKind::Integral).count() + further(&report).len(),
        3,
        "with the energy"
    );
    are_new(&text, &report);
}

#[test]
fn integrals_in_involution_have_no_further_ones() {
    let toda = hamiltonian("", &SPACE, "(p² + q² + r²)/2 + exp(x - y) + exp(y - z)");
    let report = searched(&toda, &Effort::default());
    assert!(report.formulas(FoundKind::Integral).count() >= 2, "{:?}", report.found);
    assert_eq!(further(&report), [], "{:?}", report.found);
    // Products, and functions of higher degree, are not told.
    let free = hamiltonian("", &PLANE, "(p² + q²)/2");
    let report = searched(&free, &Effort::default());
    assert_eq!(report.formulas(FoundKind::Integral).count(), 2, "{:?}", report.found);
    for (formula, _) in further(&report) {
        assert!(!formula.contains("p²") && !formula.contains("p*q"), "{formula}");
    }
}

#[test]
fn a_bracket_that_the_field_does_not_keep_gives_nothing() {
    // x' = u and y' = v with a friction: angular momentum over the density is none.
    let text = "title = 'x'\n[state]\nx = '0.5..1'\ny = '0.5..1'\nu = '0.5..1'\nv = '0.5..1'\n[field]\n\
                x = 'u'\ny = 'v'\nu = '-u'\nv = '-v'\n";
    let report = searched(text, &Effort::default());
    are_new(text, &report);
    assert!(
        report.formulas(FoundKind::Integral).count() >= 3,
        "x + u, y + v and a ratio: {:?}",
        report.found
    );
}

#[test]
fn a_function_of_one_integral_is_nothing_further() {
    // Two vortices in a disk: H is a sum of logarithms, and e^(−H) is rational.
    let energy = "ln(1 − x² − p²) + ln(1 − y² − q²) − ln((x − y)² + (p − q)²) + \
                  ln(1 − 2*(x*y + p*q) + (x² + p²)*(y² + q²))";
    let text = hamiltonian("", &PLANE, energy).replace("0.5..1", "0.1..0.5");
    let report = searched(&text, &Effort::default());
    assert!(further(&report).is_empty(), "{:?}", further(&report));
    assert_eq!(report.formulas(FoundKind::Integral).count(), 1, "{:?}", report.found);
}
