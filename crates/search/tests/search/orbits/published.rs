//! Finds as one would publish them.

use liouville_search::{Effort, SearchReport};

use super::maps::map;
use super::{field, searched};

fn told<'r>(report: &'r SearchReport, kind: &'static str) -> Vec<&'r str> {
    report.formulas(kind).collect()
}

/// Functions of constant rate with their rates.
fn rates(report: &SearchReport) -> Vec<(&str, &str)> {
    let own = report.found.iter().filter(|own| own.kind == "function-of-constant-rate");
    own.map(|own| (own.formula.as_str(), own.with[0].1.as_str())).collect()
}

#[test]
fn products_are_written_as_products() {
    // Lyness: the constant that makes it a product is not part of what is found.
    let report = searched(&map("a = '0.5..2'", &["y", "(a + y)/x"]), &Effort::default());
    assert_eq!(told(&report, "integral"), ["(1 + x)*(1 + y)*(a + x + y)/(x*y)"]);
    assert_eq!(told(&report, "density"), ["1/(x*y)"]);
}

#[test]
fn functions_are_those_of_the_file() {
    let report = searched(&field("", &["y", "−y²*tanh(x) − x"]), &Effort::default());
    let all = told(&report, "integral");
    assert!(all.len() == 1 && !all[0].contains("exp") && all[0].contains("cosh(2*x)"), "{all:?}");
    assert_eq!(told(&report, "density"), ["1 + cosh(2*x)"]);
}

#[test]
fn rates_carry_the_factors() {
    let report = searched(&field("", &["x", "√(2)*y", "π*z"]), &Effort::default());
    assert_eq!(rates(&report), [("ln(x)", "1"), ("ln(y)", "√2"), ("ln(z)", "π")]);
    // y times an integral says no more than y.
    let report = searched(&field("a = '1..2'", &["exp(y)", "a", "x*exp(−y)"]), &Effort::default());
    assert_eq!(rates(&report), [("y", "a")]);
}

#[test]
fn distances_are_sums_of_squares() {
    let rate = |sign: &str, u: &str, k: usize, other: usize| {
        format!("\"{u}\" = '{sign}G{other}*(v{k} − v{other})/((x1 − x2)^2 + (y1 − y2)^2)'\n")
    };
    let rates: String = [(1, 2), (2, 1)]
        .into_iter()
        .flat_map(|(k, other)| {
            [
                rate("−", &format!("x{k}'"), k, other).replace('v', "y"),
                rate("", &format!("y{k}'"), k, other).replace('v', "x"),
            ]
        })
        .collect();
    let text = format!(
        "title = 'x'\n[parameters]\nG1 = '1..2'\nG2 = '1..2'\n[state]\nx1 = '-1..1'\nx2 = '-1..1'\n\
         y1 = '-1..1'\ny2 = '-1..1'\n[field]\n{rates}"
    );
    let report = searched(&text, &Effort::default());
    let long: Vec<&str> =
        report.found.iter().map(|own| own.formula.as_str()).filter(|own| own.len() > 90).collect();
    assert!(long.is_empty(), "{long:?}");
}
