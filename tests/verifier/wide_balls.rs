//! Wide balls: every operation encloses the results for each number in its arguments' balls.
//!
//! The number lies on the edge of its ball, where too small a bound shows first; operations are
//! tried at arguments with rational results.

use std::cell::Cell;

use crate::common::dyadic;
use crate::random::config;
use liouville::graph::{Evaluator, Expr, Tape, record};
use liouville::number::ball::{Ball, Balls};
use liouville::number::rational::Rational;
use liouville::scalar::Scalar;
use num_dual::DualNum;
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive};
use proptest::prelude::*;
use proptest::test_runner::TestRunner;

type Recorded = fn(&[Expr]) -> Expr;

/// An operation on (t, t², t³, s, n), and its exact result from t, s and n.
type Operation = (&'static str, Recorded, fn(&BigRational, &BigRational, i32) -> BigRational);

const OPERATIONS: [Operation; 9] = [
    ("t + s", |x| x[0] + x[3], |t, s, _| t + s),
    ("t - s", |x| x[0] - x[3], |t, s, _| t - s),
    ("t s", |x| x[0] * x[3], |t, s, _| t * s),
    ("1/t", |x| x[0].recip(), |t, _, _| t.recip()),
    ("|t|", |x| x[0].modulus(), |t, _, _| t.abs()),
    ("√(t²)", |x| x[1].sqrt(), |t, _, _| t.clone()),
    ("(t³)^(2/3)", |x| x[2].power(&Rational::new(2, 3)), |t, _, _| t * t),
    ("(t³)^(-1/3)", |x| x[2].power(&Rational::new(-1, 3)), |t, _, _| t.recip()),
    ("tⁿ", |x| x[0].power_of(x[4]), |t, _, n| t.pow(n)),
];

/// Makes a ball around `x` moved aside by a fraction `shift` of it, with `x` on its edge.
fn beside(x: &BigRational, shift: f64) -> Balls<1> {
    let mid = x.to_f64().expect("a finite number") * (1.0 + shift);
    let distance = (dyadic(mid) - x).abs().to_f64().expect("a finite number");
    Balls::new([mid], [distance * (1.0 + 2.0 * f64::EPSILON) + f64::MIN_POSITIVE])
}

/// Draws shifts of every size, most of them visible.
fn shift() -> impl Strategy<Value = f64> {
    (0..50i32, -1.0..1.0f64).prop_map(|(e, x)| 2.0 * x * 0.5f64.powi(e / 2))
}

#[test]
fn every_operation_holds_what_comes_of_the_edges_of_its_arguments() {
    let (graph, outputs) = record(5, |x| OPERATIONS.map(|(_, operation, _)| operation(x)))
        .expect("arithmetic records");
    let tape = Tape::new(&graph, &outputs);
    let wide = OPERATIONS.map(|_| Cell::new(0u32));
    let numbers = ((1i64..2000, 1i64..100), (-500i64..500, 1i64..100), -4i32..=4);
    let shifts = prop::collection::vec(shift(), 5);
    let outcome = TestRunner::new(config(4000)).run(&(numbers, shifts), |(numbers, shifts)| {
        let ((a, b), (c, d), n) = numbers;
        let t = BigRational::new(a.into(), b.into());
        let s = BigRational::new(c.into(), d.into());
        let exponent = BigRational::from_integer(n.into());
        let arguments = [t.clone(), &t * &t, &t * &t * &t, s.clone(), exponent];
        let balls: Vec<_> =
            arguments.iter().zip(&shifts).map(|(x, shift)| beside(x, *shift)).collect();
        let mut evaluator = Evaluator::new(&tape, Ball::<1>);
        evaluator.run(&balls);
        for ((name, _, exact), (ball, wide)) in
            OPERATIONS.iter().zip(evaluator.outputs().zip(&wide))
        {
            if !ball.is_defined(0) {
                continue;
            }
            let (mid, radius) = (ball.mid[0], ball.rad[0]);
            let distance = (exact(&t, &s, n) - dyadic(mid)).abs();
            prop_assert!(
                distance <= dyadic(radius),
                "{name} at t = {t}, s = {s}, n = {n}: {mid:e} ± {radius:e} misses it; {balls:?}"
            );
            wide.set(wide.get() + u32::from(radius > 0.01 * mid.abs()));
        }
        Ok(())
    });
    outcome.unwrap_or_else(|failure| panic!("{failure}"));
    for ((name, ..), wide) in OPERATIONS.iter().zip(&wide) {
        assert!(wide.get() > 400, "{name}: only {} wide balls were tried", wide.get());
    }
}

#[test]
fn a_ball_that_reaches_a_singular_point_has_no_image() {
    let (graph, outputs) = record(1, |x| {
        [x[0].recip(), x[0].powi(-2), x[0].ln(), x[0].sqrt(), x[0].power(&Rational::new(1, 3))]
    })
    .expect("arithmetic records");
    let tape = Tape::new(&graph, &outputs);
    let mut evaluator = Evaluator::new(&tape, Ball::<1>);
    evaluator.run(&[Balls::new([0.5], [0.75])]);
    for (index, ball) in evaluator.outputs().enumerate() {
        assert!(!ball.is_defined(0), "function {index} of 0.5 ± 0.75 is {ball:?}");
    }
}
