//! Roots that are written by others, and their signs.

use num_dual::DualNum;

use super::{is_proved, prove};
use liouville::graph::Expr;
use liouville::scalar::Scalar;

/// Computes a + b + c ± 2√(ab) ± 2√(bc) ± 2√(ac) with given signs.
fn triple(x: &[Expr], signs: [f64; 3]) -> Expr {
    let products = [x[0] * x[1], x[1] * x[2], x[0] * x[2]];
    let roots = products.iter().zip(signs).map(|(product, sign)| product.sqrt() * (2.0 * sign));
    roots.fold(x[0] + x[1] + x[2], |sum, root| sum + root)
}

/// Computes √a ± √b ± √c.
fn sum(x: &[Expr], signs: [f64; 2]) -> Expr {
    x[0].sqrt() + x[1].sqrt() * signs[0] + x[2].sqrt() * signs[1]
}

#[test]
fn roots_of_sums_of_three_numbers_are_sums_of_three_roots() {
    let all = [false, false, false];
    let outcome = prove(&all, |x| triple(x, [1.0, 1.0, 1.0]).sqrt() - sum(x, [1.0, 1.0]));
    assert!(is_proved(&outcome), "√a + √b + √c: {outcome:?}");
    let outcome = prove(&all, |x| triple(x, [1.0, -1.0, -1.0]).sqrt() - sum(x, [1.0, -1.0]));
    assert!(is_proved(&outcome), "√a + √b − √c is positive in 1..2: {outcome:?}");
    let outcome =
        prove(&all, |x| triple(x, [1.0, -1.0, -1.0]).sqrt() - sum(x, [1.0, -1.0]).modulus());
    assert!(is_proved(&outcome), "|√a + √b − √c|: {outcome:?}");
    let outcome = prove(&all, |x| triple(x, [1.0, 1.0, -1.0]).sqrt() - sum(x, [1.0, 1.0]));
    assert!(!is_proved(&outcome), "no square");
    let outcome = prove(&all, |x| triple(x, [1.0, 1.0, 1.0]).sqrt() - sum(x, [1.0, -1.0]));
    assert!(outcome.is_nonzero(), "another sign: {outcome:?}");
}

#[test]
fn a_root_of_a_difference_of_squares_is_written_by_another() {
    // With e = √(1 − y²), y in 1/4..1/2.
    let parts = |x: &[Expr]| {
        let y = x[0] / 4.0;
        let e = (-(y * y) + 1.0).sqrt();
        (y, (e + 1.0).sqrt(), (-e + 1.0).sqrt())
    };
    let outcome = prove(&[false], |x| {
        let (y, more, less) = parts(x);
        (y * 2.0 + 2.0).sqrt() - more - less
    });
    assert!(is_proved(&outcome), "√(2 + 2y) = √(1 + e) + √(1 − e): {outcome:?}");
    let outcome = prove(&[false], |x| {
        let (y, more, less) = parts(x);
        more - less - (-(y * 2.0) + 2.0).sqrt()
    });
    assert!(is_proved(&outcome), "√(1 + e) − √(1 − e) = √(2 − 2y): {outcome:?}");
    let outcome = prove(&[false], |x| {
        let (y, more, less) = parts(x);
        more * less - y
    });
    assert!(is_proved(&outcome), "√(1 + e) √(1 − e) = y: {outcome:?}");
    let outcome = prove(&[false], |x| {
        let (y, more, less) = parts(x);
        (y * 2.0 + 2.0).sqrt() - more + less
    });
    assert!(outcome.is_nonzero(), "another sign: {outcome:?}");
}
