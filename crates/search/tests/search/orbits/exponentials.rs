//! Fields with exponentials in several forms, with functions of the parameters, and with relations between
//! functions on which Darboux polynomials rest.

use liouville_search::{Effort, FoundKind};

use super::factors::cofactor;
use super::{field, searched};

#[test]
fn powers_of_exponentials_and_of_numbers_are_exponentials() {
    let fields = [
        ("a = '0.5..1'", ["y*exp(x)", "-exp(x)^a*exp(a*x)"]),
        ("", ["y*exp(x)", "-2^x*exp(x)"]),
        ("a = '2..3'", ["y", "-a^x"]),
        ("", ["y*2^x", "-3*4^x"]),
        ("", ["y", "-exp(x)^(1/2) - exp(x)"]),
        ("a = '2..3'", ["y*sin(a)", "-x*exp(a)"]),
        ("a = '2..3'", ["y*a^(1/3)", "-ln(a)*x²"]),
    ];
    for (parameters, rates) in fields {
        let report = searched(&field(parameters, &rates), &Effort::default());
        assert_eq!(
            report.formulas(FoundKind::Integral).count(),
            1,
            "{rates:?}: {:?}",
            report.found
        );
    }
}

#[test]
fn powers_with_variables_in_base_and_exponent_are_exponentials_of_logarithms() {
    // x^y is kept.
    let report = searched(&field("", &["-x*ln(x)*x^y", "y*x^y"]), &Effort::default());
    assert_eq!(report.formulas(FoundKind::Integral).count(), 1, "{:?}", report.found);
}

#[test]
fn functions_of_parameters_exclude_nothing() {
    // With a = b as a function: sin(a)² + cos(a)² = 1 is no relation that is known.
    let text = field("a = '0.5..1'", &["y*(sin(a)² + cos(a)² - 1) + 1", "0"]);
    let report = searched(&text, &Effort::default());
    assert!(
        report.excluded.iter().all(|own| !own.theorem.contains("P/Q")),
        "{:?}",
        report.excluded
    );
}

fn without_classes() -> Effort {
    Effort { by_class: false, ..Effort::default() }
}

#[test]
fn darboux_polynomials_may_rest_on_relations() {
    let effort = without_classes();
    let found = |rates: [&str; 2], polynomial: &str| {
        let report = searched(&field("", &rates), &effort);
        let own = cofactor(&report, polynomial).map(str::to_string);
        assert!(own.is_some(), "{rates:?}: {:?}", report.found);
    };
    // v(x − sin t) = x² − sin² t only where sin² + cos² = 1.
    found(["x² + cos(y) - 1 + cos(y)²", "1"], "x − sin(y)");
    // The same for a hyperbola, 1 = e^y e^(−y).
    found(["x² + exp(y) - exp(2*y)*exp(y)*exp(-y)", "1"], "x − exp(y)");
}

#[test]
#[ignore = "slow: as in two variables, and for 1/e^y as for e^y"]
fn darboux_polynomials_may_rest_on_other_relations() {
    let text = field("", &["x² + cos(z) - 1 + cos(z)²", "0*y", "1"]);
    let report = searched(&text, &without_classes());
    assert_eq!(cofactor(&report, "x − sin(z)"), Some("x + sin(z)"), "{:?}", report.found);
    let text = field("", &["x² + exp(-y)*(-1 - exp(-y)*(exp(y)*exp(-y))^2)", "1"]);
    let report = searched(&text, &without_classes());
    assert!(cofactor(&report, "x − exp(−y)").is_some(), "{:?}", report.found);
}

#[test]
fn exponentials_are_written_as_powers_of_their_bases() {
    let report = searched(&field("", &["y*exp(x)", "-2^x*exp(x)"]), &Effort::default());
    let own = report.formulas(FoundKind::Integral).next().unwrap_or_default();
    assert!(own.contains("2^x") && !own.contains("exp"), "{own}");
}

#[test]
fn radicands_that_are_odd_powers_are_roots_of_these() {
    let text = "title = 'x'\n[state]\nx = '0.5..1'\ny = '0.5..1'\nu = '0.5..1'\nv = '0.5..1'\n[field]\n\
                x = 'u'\ny = 'v'\nu = '-x/√((x² + y²)^3)'\nv = '-y/√((x² + y²)^3)'\n";
    let report = searched(text, &Effort::default());
    let energy = report
        .formulas(FoundKind::Integral)
        .find(|own| own.contains("v²") && !own.contains("x*v²"));
    assert!(energy.is_some_and(|own| own.contains("2/√(x² + y²)")), "{:?}", report.found);
}

#[test]
fn half_angles_do_not_repeat_what_was_found() {
    let report = searched(&field("", &["x² + cos(y) - 1 + cos(y)²", "1"]), &Effort::default());
    let told = report.found.iter().filter(|own| own.kind == FoundKind::DarbouxPolynomial);
    assert_eq!(told.count(), 1, "{:?}", report.found);
}
