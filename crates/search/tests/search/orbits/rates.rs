//! Functions whose rate is an integral, and factors on whose zeros the motion has integrals of its own.

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
    let own = found.found.iter().find(|own| own.kind == "function-of-constant-rate");
    let own = own.expect("(xp)' = 2H");
    assert_eq!(own.formula, "x*p");
    assert_eq!(own.with.len(), 1);
    assert!(own.with[0].1.contains("2*"), "{:?}", own.with);
}

#[test]
fn factors_with_integrals_on_their_zeros_are_found() {
    // Chazy: the discriminant, of degree 4, vanishes along rational curves.
    let chazy = searched(&field("", &["y", "z", "2*x*z - 3*y²"]), &Effort::default());
    assert_eq!(chazy.formulas("darboux-polynomial").count(), 1);
    assert_eq!(chazy.formulas("density").count(), 1);
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
    assert_eq!(toda.formulas("darboux-polynomial").count(), 5);
    assert_eq!(toda.formulas("density").count(), 1);
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
    assert_eq!(found.formulas("integral").count(), 6, "besides the energy");
}
