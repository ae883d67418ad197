//! Tests of zeros for free symbols.

use num_dual::DualNum;
use num_traits::One;

use super::*;

fn is_special(step: Step<'_>) -> bool {
    let is_function = matches!(step, Step::Unary(..)) && step.need().is_none();
    let is_neg = matches!(step, Step::Unary(UnaryFunction::Neg, _));
    half_power(step).is_some() || (is_function && !is_neg)
}

/// Whether a function of two inputs is proved to be zero.
fn is_zero(build: impl FnOnce(&[Expr]) -> Expr) -> bool {
    let (graph, value) = record(2, build).expect("records");
    let special: Vec<usize> =
        (0..graph.len()).filter(|place| is_special(graph.step(*place))).collect();
    let digest = SeedDigest::of(1, &graph, &[vec![value]]);
    let (groups, required) = (vec![std::slice::from_ref(&value)], &[][..]);
    let question = Question { graph: &graph, groups, special: &special, required };
    let found = zeros_for_free_symbols(&question, &|_| Ok(false), 2, digest);
    matches!(found.expect("records")[..], [Some(_)])
}

#[test]
fn zeros_need_no_relation_of_roots() {
    let cancels = |x: &[Expr]| {
        let (a, b) = ((x[0] * x[0] + x[1]).sqrt(), (x[1] + x[0]).sqrt());
        (a + b) * x[0] / b - a * (x[0] / b) - x[0]
    };
    assert!(is_zero(cancels), "(a + b) x/b = a x/b + x");
    let depends = |x: &[Expr]| x[0].sqrt() * x[1].sqrt() - (x[0] * x[1]).sqrt();
    assert!(!is_zero(depends), "√x √y = √(xy) needs a relation");
    let near = |x: &[Expr]| {
        let a = (x[0] * x[0] + x[1]).sqrt();
        (a + x[0]) * (a - x[0]) - a * a + x[0] * x[0] * x[1].sqrt()
    };
    assert!(!is_zero(near), "x² is not x² √y");
}

#[test]
fn a_radicand_is_the_square_of_its_root() {
    let radicand = |x: &[Expr]| x[0] * x[0] + x[1];
    let squares = |x: &[Expr]| {
        let (a, b) = (radicand(x).sqrt(), (x[1] + x[0]).sqrt());
        (a + b) * (a - b) - radicand(x) + (x[1] + x[0])
    };
    assert!(is_zero(squares), "(a + b)(a − b) = A − B");
    let powers = |x: &[Expr]| {
        let a = radicand(x);
        (x[0] + x[1]) * a.power(&Rational::new(-1, 2)) - (x[0] * (a.sqrt() / a) + x[1] / a.sqrt())
    };
    assert!(is_zero(powers), "(x + y) A^(−1/2) = x √A/A + y/√A");
    let opened = |x: &[Expr]| {
        let a = radicand(x);
        a.sqrt() * a.sqrt() - x[0] * x[0] - x[1] + (x[0] - x[0] * x[1].sqrt())
    };
    assert!(!is_zero(opened), "x is not x √y");
    // Without the root's relation the divisor is not zero.
    let hidden = |x: &[Expr]| {
        let a = radicand(x);
        let gap = a - x[0] * x[0] - x[1];
        (x[0] + x[1]) * gap.recip() - x[0] * gap.recip() - x[1] * gap.recip() + a.sqrt() - a.sqrt()
    };
    assert!(!is_zero(hidden), "1/(A − x² − y)");
}

#[test]
fn moduli_and_functions_are_symbols_too() {
    let force = |x: &[Expr]| {
        let gap = x[0] - x[1];
        let size = gap.modulus();
        // e^−|x − y| (x − y)/|x − y|, once for each of two bodies.
        let pull = |gap: Expr| (-size).exp() * gap / size;
        pull(gap) + pull(-gap)
    };
    assert!(is_zero(force), "action and reaction");
    let depends = |x: &[Expr]| x[0].modulus() * x[1].modulus() - (x[0] * x[1]).modulus();
    assert!(!is_zero(depends), "|x||y| = |xy| needs a relation");
    let sum = |x: &[Expr]| (x[0] + x[1]).exp() - x[0].exp() * x[1].exp();
    assert!(!is_zero(sum), "e^(x + y) = e^x e^y needs a relation");
    let circle = |x: &[Expr]| x[0].sin() * x[0].sin() + x[0].cos() * x[0].cos() - Expr::one();
    assert!(!is_zero(circle), "sin² + cos² = 1 needs a relation");
    // |x| + x is 0 for x < 0, where its inverse has no value.
    let hidden = |x: &[Expr]| {
        let inverse = (x[0].modulus() + x[0]).recip();
        (x[0] + x[1]) * inverse - x[0] * inverse - x[1] * inverse
    };
    assert!(!is_zero(hidden), "1/(|x| + x)");
    let nowhere = |x: &[Expr]| {
        let root = (x[0].modulus() - x[0]).sqrt();
        (x[0] + x[1]) * root - x[0] * root - x[1] * root
    };
    assert!(!is_zero(nowhere), "a root of which it is not known that it exists");
    let logarithm = |x: &[Expr]| (x[0] + x[1]) * x[0].ln() - x[0] * x[0].ln() - x[1] * x[0].ln();
    assert!(!is_zero(logarithm), "a logarithm of which it is not known that it exists");
}

#[test]
fn hundreds_of_roots_are_no_obstacle() {
    let sum = |x: &[Expr]| {
        let terms = (1..=300).map(|k| {
            let radicand = x[0] * x[0] + x[1] * Expr::rational(&Rational::from(k));
            x[0] * (radicand.sqrt() / radicand)
        });
        let terms: Vec<Expr> = terms.collect();
        let sum = |by: Expr| terms.iter().fold(by, |sum, term| sum + *term * by);
        sum(x[1] + x[0]) - sum(x[1]) - sum(x[0])
    };
    assert!(is_zero(sum), "(x + y)(1 + Σ) = x(1 + Σ) + y(1 + Σ)");
}

#[test]
fn what_may_have_no_value_is_left_out() {
    let divides = |x: &[Expr]| {
        let gap = x[0].sqrt() * x[1].sqrt() - (x[0] * x[1]).sqrt();
        (x[0] + x[1]) * gap.recip() - x[0] * gap.recip() - x[1] * gap.recip()
    };
    assert!(!is_zero(divides), "1/(√x √y − √(xy)) has no value for x, y > 0");
    let zero = |x: &[Expr]| {
        let a = ((x[0] + x[1]) * (x[0] - x[1]) - x[0] * x[0] + x[1] * x[1]).sqrt();
        (x[0] + x[1]) * a.recip() - x[0] * a.recip() - x[1] * a.recip()
    };
    assert!(!is_zero(zero), "1/√0");
    let nested = |x: &[Expr]| {
        let a = (x[0].sqrt() + x[1]).sqrt();
        (a + x[0]) * (a - x[0]) - a * a + x[0] * x[0]
    };
    assert!(!is_zero(nested), "a root within a root");
    let products = |x: &[Expr]| {
        let a = (x[0] * x[0] + x[1]).sqrt();
        (a * x[0]).recip() * (x[0] + x[1]) - a.recip() - (a * x[0]).recip() * x[1]
    };
    assert!(is_zero(products), "(x + y)/(a x) = 1/a + y/(a x)");
}
