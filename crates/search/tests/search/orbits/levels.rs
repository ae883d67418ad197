//! Darboux polynomials, and what follows from them, on spheres and affine spaces.

use super::{Effort, SearchReport, searched};
use liouville_search::FoundKind;

/// A field in a vector x, with components in a range, on a level.
fn on_level(rates: &[&str], (range, level): (&str, &str)) -> SearchReport {
    let count = rates.len();
    let text = format!(
        "title = 'x'\n[parameters]\na = '0.1..0.9'\nb = '1..2'\n[state]\nx = 'vector({count}, {range})'\n[field]\n\
         \"x'\" = '[{}]'\n[level]\nequations = ['{level}']\n",
        rates.join(", ")
    );
    searched(&text, &Effort::default())
}

fn all(report: &SearchReport, kind: FoundKind) -> Vec<&str> {
    report.found.iter().filter(|own| own.kind == kind).map(|own| own.text()).collect()
}

const SPHERE: (&str, &str) = ("-1..1", "(x,x) = 1");
const SIMPLEX: (&str, &str) = ("0.1..0.5", "x1 + x2 + x3 = 1");

#[test]
fn logarithms_and_densities_are_found_on_spheres() {
    // A spin with damping: m' = −m × h − a m × (m × h), h = b e₃.
    let own = ["-b*x2 - a*b*x1*x3", "b*x1 - a*b*x2*x3", "a*b*(1 - x3²)"];
    let found = on_level(&own, SPHERE);
    let angle = "ln(|1 − x3|) − ln(1 + x3) + 2*a*atan(x2/x1)";
    assert_eq!(all(&found, FoundKind::Integral), [angle]);
    assert_eq!(all(&found, FoundKind::Density), ["1/((1 − x3)*(1 + x3))"]);
    assert_eq!(all(&found, FoundKind::ConstantRate).len(), 1);
    // Oja's flow.
    let q = "(a*x1² + b*x2² + 3*x3²)";
    let own = [format!("x1*(a - {q})"), format!("x2*(b - {q})"), format!("x3*(3 - {q})")];
    let found = on_level(&own.each_ref().map(String::as_str), SPHERE);
    assert_eq!(all(&found, FoundKind::Integral).len(), 1);
    assert_eq!(all(&found, FoundKind::Density), ["1/(x1*x2*x3)"]);
    // Heights on a sphere of four dimensions grow.
    let found = on_level(&["1 - x1*x1", "-x1*x2", "-x1*x3", "-x1*x4"], SPHERE);
    assert_eq!(all(&found, FoundKind::Integral).len(), 2);
    assert_eq!(all(&found, FoundKind::ConstantRate).len(), 1);
}

#[test]
fn logarithms_and_densities_are_found_on_simplices() {
    let q = "(a*x1 + b*x2 + 3*x3)";
    let own = [format!("x1*(a - {q})"), format!("x2*(b - {q})"), format!("x3*(3 - {q})")];
    let found = on_level(&own.each_ref().map(String::as_str), SIMPLEX);
    assert_eq!(all(&found, FoundKind::Integral).len(), 1);
    assert_eq!(all(&found, FoundKind::Density), ["1/(x1*x2*x3)"]);
    assert_eq!(all(&found, FoundKind::ConstantRate).len(), 1);
    assert_eq!(all(&found, FoundKind::DarbouxPolynomial).len(), 3);
}
