//! Functions whose rate is an integral, and factors on whose zeros the motion has integrals of its own.

use liouville_search::{FoundKind, SearchReport};

use super::{Effort, field, searched};

#[test]
fn functions_whose_rate_is_an_integral_are_found() {
    let text = "
title = 'a free particle in the field of a centre'
[state]
x = '0.5..2'
p = '-1..1'
[hamiltonian]
function = 'p²/2 + 1/x²'
pairs = [['x', 'p']]
";
    let found = searched(text, &Effort::default());
    let own = found.found.iter().find(|own| own.kind == FoundKind::ConstantRate);
    let own = own.expect("(xp)' = 2H");
    assert_eq!(own.text(), "x*p");
    assert_eq!(own.with.len(), 1);
    assert!(own.with[0].text().contains("2*"), "{:?}", own.with);
}

fn darboux(report: &SearchReport) -> usize {
    report.found.iter().filter(|own| own.kind == FoundKind::DarbouxPolynomial).count()
}

#[test]
fn signs_are_no_integrals() {
    let text = "
title = 'a ball on a floor that is a mirror'
[state]
x = '-2..2'
y = '-2..2'
[field]
\"x'\" = 'y'
\"y'\" = '-|x|/x'
";
    let found = searched(text, &Effort::default());
    let own: Vec<&str> = found.found.iter().map(|own| own.text()).collect();
    assert!(!own.iter().any(|own| *own == "x/|x|" || *own == "|x|/x"), "{own:?}");
}

#[test]
fn factors_with_integrals_on_their_zeros_are_found() {
    // Chazy: the discriminant, of degree 4, vanishes along rational curves.
    let chazy = searched(&field("", &["y", "z", "2*x*z - 3*y²"]), &Effort::default());
    assert_eq!(darboux(&chazy), 1);
    assert_eq!(chazy.formulas(FoundKind::Density).count(), 1);
    // The relativistic chain of Toda, of three particles: five factors, one of them an exponential's.
    let text = "
title = 'relativistic chain'
[state]
d = 'vector(3, 0.5..2)'
c = 'vector(2, 0.5..2)'
[field]
\"d[1]'\" = 'd1*c1'
\"d[2]'\" = 'd2*(c2 − c1)'
\"d[3]'\" = '−d3*c2'
\"c[1]'\" = 'c1*(d2 + c2 − d1)'
\"c[2]'\" = 'c2*(d3 − d2 − c1)'
";
    let toda = searched(text, &Effort::default());
    assert_eq!(darboux(&toda), 5);
    assert_eq!(toda.formulas(FoundKind::Density).count(), 1);
}

#[test]
fn an_oscillator_of_four_degrees_takes_few_steps() {
    let text = "
title = 'isotropic oscillator'
[state]
u = 'vector(4, -1..1)'
p = 'vector(4, -1..1)'
[hamiltonian]
function = '(p,p)/2 + (u,u)/2'
pairs = [['u', 'p']]
";
    let found = searched(text, &Effort { blind: true, ..Effort::default() });
    assert_eq!(found.formulas(FoundKind::Integral).count(), 6, "besides the energy");
}

#[test]
fn the_third_integral_of_the_half_plane_is_told() {
    let text = "
title = 'geodesics of the half-plane'
[state]
x = '-1..1'
y = '0.5..2'
p = '-1..1'
q = '-1..1'
[hamiltonian]
function = 'y²*(p² + q²)/2'
pairs = [['x', 'p'], ['y', 'q']]
";
    let found = searched(text, &Effort::default());
    let own = found.found.iter().find(|own| own.kind == FoundKind::FurtherIntegral);
    let own = own.expect("it is a function of the others, and no polynomial in them");
    assert!(own.text().contains("2*x*y*q") && own.with.is_empty(), "{own:?}");
}

#[test]
fn rates_may_be_integrals_of_factors_and_angles() {
    let cases = [
        (["x²*y", "-x*y²", "0"], "ln(y)", "x*y"),
        (["-y*(1 + z)", "x*(1 + z)", "0"], "atan(x/y)", "z"),
        (["x*(y + z)", "y*z", "-y*z"], "ln(", "y + z"),
    ];
    for (rates, function, rate) in cases {
        let found = searched(&field("", &rates), &Effort::default());
        let mut own = found.found.iter().filter(|own| own.kind == FoundKind::ConstantRate);
        let is_wanted =
            own.any(|own| own.text().contains(function) && own.with[0].text().contains(rate));
        assert!(is_wanted, "{function}");
    }
}

#[test]
fn roots_of_constant_rate_and_fields_on_a_line_are_told() {
    let line = |parameters: &str, rate: &str| {
        let found = searched(&field(parameters, &[rate]), &Effort::default());
        let own = found.found.into_iter().filter(|own| own.kind == FoundKind::ConstantRate);
        let own: Vec<String> = own.map(|own| own.text().to_string()).collect();
        assert_eq!(own.len(), 1, "{rate}: {own:?}");
        own
    };
    assert_eq!(line("k = '0.5..1'", "-k*√x"), ["√x"], "Torricelli");
    let growth = "a = '2..3'\nb = '0.5..1'";
    line(growth, "a*x^(2/3) - b*x");
    line("", "3*x^(1/3) - 3*x");
    line(growth, "a*x*(1 - (x/9)^b)");
}

#[test]
fn densities_have_numbers_as_exponents() {
    let parameters = "a = '0.5..2'\nb = '0.5..2'\nc = '0.5..2'\nd = '0.5..2'";
    let found = searched(&field(parameters, &["x*(a - b*y)", "y*(c*x - d)"]), &Effort::default());
    assert_eq!(found.formulas(FoundKind::Density).collect::<Vec<_>>(), ["1/(y*x)"]);
}
