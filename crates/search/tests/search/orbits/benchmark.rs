//! Systems of the benchmark whose integrals need one part of the search each.

use std::path::Path;

use liouville::case::Case;
use liouville::verdict::Verdict;
use liouville_search::{Effort, FoundKind, SearchReport, search};

/// Searches a held-back system without its claims.
fn held(name: &str) -> SearchReport {
    searched(&format!("held-back/{name}"))
}

fn searched(name: &str) -> SearchReport {
    searched_with(name, Effort::default())
}

fn searched_with(name: &str, effort: Effort) -> SearchReport {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("benchmark");
    let path = folder.join(format!("{name}.toml"));
    let case = Case::read(&path, &[]).1.expect("a case");
    let effort = Effort { blind: true, ..effort };
    let report = search(&case, &effort, &mut |_| {}).expect("it can be searched");
    let open = report.found.iter().find(|found| found.verdict != Verdict::Proved);
    assert!(open.is_none(), "{name}: all is proved: {open:?}");
    report
}

fn has(report: &SearchReport, part: &str) -> bool {
    report.formulas(FoundKind::Integral).any(|own| own.contains(part))
}

#[test]
fn polynomials_of_higher_degree_are_found_class_by_class() {
    found_class_by_class(&[("manakov-so5", 6), ("four-wave", 4)]);
}

#[test]
#[ignore = "slow: an integral of degree six, found like those of degree four above"]
fn polynomials_of_degree_six_are_found_class_by_class() {
    found_class_by_class(&[("toda-g2", 3)]);
}

/// Searches these systems, and compares the numbers of integrals.
fn found_class_by_class(systems: &[(&str, usize)]) {
    for (name, count) in systems {
        let effort = Effort { by_factors: false, ..Effort::default() };
        let report = searched_with(&format!("held-back/{name}"), effort);
        assert_eq!(
            report.formulas(FoundKind::Integral).count(),
            *count,
            "{name}: {:?}",
            report.found
        );
    }
}

#[test]
fn classes_exist_on_levels_too() {
    let report = held("smorodinsky-sphere");
    assert_eq!(report.formulas(FoundKind::Integral).count(), 3, "{:?}", report.found);
}

#[test]
fn polynomial_integrals_of_maps_are_found_beside_others() {
    for (name, count) in [("mcmillan-vector", 2), ("dlv-4", 2)] {
        let report = held(name);
        assert_eq!(
            report.formulas(FoundKind::Integral).count(),
            count,
            "{name}: {:?}",
            report.found
        );
    }
    // The leading monomials of the relations decide whether a fraction is seen.
    let report = held("kahan-clebsch");
    assert!(report.formulas(FoundKind::Integral).count() >= 1, "{:?}", report.found);
}

#[test]
fn entries_of_skew_matrices_are_coefficients() {
    let report = held("volterra-4-skew");
    let factors = report.found.iter().filter(|own| own.kind == FoundKind::DarbouxPolynomial);
    assert_eq!(factors.count(), 4, "{:?}", report.found);
    assert!(has(&report, "b1*ln(x1)"), "{:?}", report.found);
    let report = held("zero-sum-replicator-5");
    assert!(has(&report, "ln(x5)"), "{:?}", report.found);
}

#[test]
fn angles_of_denominators_and_radicands_are_found() {
    assert!(has(&held("vortex-source-pair"), "atan(y/x)"));
    assert!(has(&held("kepler-drag-inverse-square"), "a*atan(y/x)"));
}

#[test]
fn factors_of_a_large_denominator_give_logarithms() {
    assert!(has(&held("vortices-2-disk"), "ln("));
}

#[test]
fn moduli_are_functions_of_the_state() {
    let report = held("peakons-2-modulus");
    assert!(has(&report, "exp(−|x − y|)"), "{:?}", report.found);
}

#[test]
fn parts_of_fractions_are_divided_by_what_is_known() {
    let found = |name: &str| -> Vec<String> {
        let report = searched(&format!("pegasus/{name}"));
        let own = report.found.iter().filter(|own| own.kind == FoundKind::DarbouxPolynomial);
        own.map(|own| own.text().to_string()).collect()
    };
    let squares = found("065-alongi-nelson-ex-4-1-9-page-143");
    assert!(squares.contains(&"y1".to_string()), "(y1² + y2²)/y1²: {squares:?}");
    let products = found("088-gorbuzov-pranevich-2012-example-1-1");
    assert!(products.contains(&"y1 + y3".to_string()), "{products:?}");
}
