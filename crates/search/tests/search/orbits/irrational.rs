//! Fields and maps with roots of numbers and of parameters as coefficients.

use liouville::case::Case;
use liouville_search::{Ansatz, Effort, FoundKind, Remark, SearchReport, search};

use super::factors::cofactor;
use super::maps::map;
use super::{field, searched};

fn integral(report: &SearchReport) -> Option<&str> {
    report.formulas(FoundKind::Integral).next()
}

/// Whether a theorem excludes Darboux polynomials, or integrals P/Q.
fn excludes(report: &SearchReport) -> bool {
    report.excluded.iter().any(|own| own.theorem.contains("Darboux") || own.theorem.contains("P/Q"))
}

#[test]
fn darboux_polynomials_with_roots_of_numbers_and_parameters_are_found() {
    let fields = [
        ("", ["x*(1 - y)", "-√2*y*(1 - x)"], "2*x + √2*y − √2*ln(y) − 2*ln(x)"),
        ("", ["√2*x", "-y"], "√2*ln(x) + 2*ln(y)"),
        ("", ["(1 + √5)/2*x", "-y/((1 + √5)/2)"], "(√5 − 3)*ln(x) − 2*ln(y)"),
        ("", ["x*(1 - √11*y)", "-√11*y*(1 - x)"], "11*x + 11*y − √11*ln(y) − 11*ln(x)"),
        ("", ["x*(1 - √2*y)", "-√3*y*(1 - x)"], "√3*x + √2*y − ln(y) − √3*ln(x)"),
        ("", ["√2*x*(1 - y)", "-√3*y*(1 - x)"], "3*x + √3*√2*y − √3*√2*ln(y) − 3*ln(x)"),
        ("a = '1..2'", ["x*(1 - y)", "-√a*y*(1 - x)"], "a*x + √a*y − √a*ln(y) − a*ln(x)"),
    ];
    for (parameters, rates, expected) in fields {
        let report = searched(&field(parameters, &rates), &Effort::default());
        assert!(cofactor(&report, "x").is_some(), "{rates:?}: {:?}", report.found);
        assert!(cofactor(&report, "y").is_some(), "{rates:?}: {:?}", report.found);
        assert_eq!(integral(&report), Some(expected), "{rates:?}");
        assert!(!excludes(&report), "{rates:?}: {:?}", report.excluded);
    }
}

#[test]
fn products_of_roots_are_coefficients() {
    let fields = [
        ("", ["√2*x*(1 + √3 - y)", "-(√3 + √2)*y*(1 - x)"]),
        ("a = '1..2'\nb = '1..2'", ["√a*x*(1 - y)", "-√b*y*(1 - x)"]),
    ];
    for (parameters, rates) in fields {
        let report = searched(&field(parameters, &rates), &Effort::default());
        assert!(integral(&report).is_some(), "{rates:?}: {:?} {:?}", report.found, report.remarks);
    }
    // x² − √6 x y + y² is kept.
    let rotation = searched(&map("", &["y", "-x + √2*√3*y"]), &Effort::default());
    assert!(integral(&rotation).is_some(), "{:?}", rotation.remarks);
}

#[test]
#[ignore = "slow: as those of two roots above"]
fn products_of_more_roots_are_coefficients() {
    let fields = [
        ("", ["√2*x*(1 - √5*y)", "-√3*y*(1 - √7*x)"]),
        ("a = '1..2'", ["√a*x*(1 - √2*y)", "-√3*y*(1 - x)"]),
    ];
    for (parameters, rates) in fields {
        let report = searched(&field(parameters, &rates), &Effort::default());
        assert!(integral(&report).is_some(), "{rates:?}: {:?} {:?}", report.found, report.remarks);
    }
}

#[test]
fn factors_with_irrational_coefficients_are_written() {
    // (x + √2 y)' = (x + √2 y)(1 + y)
    let rates = ["(x + √2*y)*(1 + y) - √2*y*(x - 3)", "y*(x - 3)"];
    let report = searched(&field("", &rates), &Effort::default());
    assert_eq!(cofactor(&report, "√2*x + 2*y"), Some("1 + y"), "{:?}", report.found);
    // Conjugate over the Gaussian numbers.
    let report = searched(&field("", &["√2*x - y", "x + √2*y"]), &Effort::default());
    assert_eq!(cofactor(&report, "x² + y²"), Some("2*√2"), "{:?}", report.found);
    assert_eq!(report.formulas(FoundKind::Density).next(), Some("1/(x² + y²)"));
    assert!(integral(&report).is_some_and(|own| own.contains("atan")), "{:?}", report.found);
}

#[test]
fn fields_with_roots_and_no_factor_exclude_nothing() {
    let report = searched(&field("", &["y", "√2*x - x³ + x²*y"]), &Effort::default());
    assert_eq!(report.formulas(FoundKind::Density).count(), 0);
    assert!(!excludes(&report), "{:?}", report.excluded);
}

#[test]
fn integrals_of_maps_have_roots_as_coefficients() {
    let rotation = searched(&map("", &["y", "-x + √3*y"]), &Effort::default());
    assert_eq!(integral(&rotation), Some("x² + y² − √3*x*y"));
    let other = searched(&map("", &["y", "-x + (1 + √5)/3*y"]), &Effort::default());
    assert!(integral(&other).is_some_and(|own| own.contains("√5")), "{:?}", other.found);
    let own = searched(&map("a = '0.5..1'", &["y", "-x + √a*y"]), &Effort::default());
    assert_eq!(integral(&own), Some("x² + y² − √a*x*y"), "{:?}", own.remarks);
    for report in [&rotation, &other, &own] {
        let is_false = |own: &Remark| own.contains("neither fractions nor");
        assert!(!report.remarks.iter().any(is_false), "{:?}", report.remarks);
    }
}

#[test]
fn an_ansatz_for_a_lagrangian_has_roots_as_coefficients() {
    let text = "title = 'x'\n[state]\nx = '0.5..1'\ny = '0.2..1'\n\"x'\" = '0.2..1'\n\"y'\" = '0.2..1'\n\
                [lagrangian]\nkinetic = \"(x'² + y'²)/2\"\npotential = '√2*x*y + x²'\n";
    let case = Case::parse(text, &[]).expect("a case");
    let ansatz = Ansatz { wanted: true, ..Ansatz::default() };
    let effort = Effort { ansatz, ..Effort::default() };
    let report = search(&case, &effort, &mut |_| {}).expect("it can be searched");
    assert_eq!(report.formulas(FoundKind::Integral).count(), 1, "{:?}", report.found);
    assert!(report.remarks.iter().all(|own| !own.contains("neither")), "{:?}", report.remarks);
    let theorems: Vec<&String> = report.excluded.iter().map(|own| &own.theorem).collect();
    assert!(theorems.iter().all(|own| !own.contains("not known")), "{theorems:?}");
}

#[test]
fn logarithms_of_a_part_do_not_hide_integrals_of_the_whole() {
    // x and y alone have an integral with logarithms, and x² + a y + z is kept too.
    for (parameters, a) in [("a = '1..2'", "a"), ("", "√5")] {
        let rates = [format!("{a}*x − 1"), "y − 2*x²".to_string(), format!("2*x − {a}*y")];
        let report =
            searched(&field(parameters, &rates.each_ref().map(String::as_str)), &Effort::default());
        let found: Vec<&str> = report.formulas(FoundKind::Integral).collect();
        assert_eq!(found.len(), 2, "{found:?}");
        assert!(found.iter().any(|own| own.contains("x²") && !own.contains("ln")), "{found:?}");
    }
}
