//! Elementary functions in balls: enclosures never contradict a functional equation.
//!
//! Neither side of these equations is rational, so that no exact value is available; the ball of
//! the difference must contain 0 or be undefined, for arguments of every size.

use std::cell::Cell;

use crate::common::{dyadic, rational};
use crate::random::config;
use liouville::graph::{Evaluator, Expr, Tape, record};
use liouville::number::Domain;
use liouville::number::ball::{Ball, Balls};
use liouville::number::rational::Rational;
use liouville::scalar::Scalar;
use num_dual::DualNum;
use num_traits::{One, Zero};
use proptest::prelude::*;
use proptest::test_runner::TestRunner;

/// An equation between x and y: its name, and the difference of its sides.
type Equation = (&'static str, fn(Expr, Expr) -> Expr);

/// Differences that vanish for every x and y > 0.
const EQUATIONS: [Equation; 12] = [
    ("eˣ e^-x = 1", |x, _| x.exp() * (-x).exp() - Expr::one()),
    ("e^(x+y) = eˣ eʸ", |x, y| (x + y).exp() - x.exp() * y.exp()),
    ("ln xy = ln x + ln y", |x, y| (x * y).ln() - x.ln() - y.ln()),
    ("ln 1/x = -ln x", |x, _| x.recip().ln() + x.ln()),
    ("sin² + cos² = 1", |x, _| x.sin() * x.sin() + x.cos() * x.cos() - Expr::one()),
    ("sin(x+y)", |x, y| (x + y).sin() - x.sin() * y.cos() - x.cos() * y.sin()),
    ("cos 2x = 1 - 2 sin² x", |x, _| (x + x).cos() - Expr::one() + (x.sin() * x.sin()) * 2.0),
    ("atan x + atan 1/x = 2 atan 1", |x, _| x.atan() + x.recip().atan() - Expr::one().atan() * 2.0),
    ("(x³)^(1/3) = x", |x, _| x.powi(3).power(&Rational::new(1, 3)) - x),
    ("x^(2/3) x^(1/3) = x", |x, _| {
        x.power(&Rational::new(2, 3)) * x.power(&Rational::new(1, 3)) - x
    }),
    ("x^y x^-y = 1", |x, y| x.power_of(y) * x.power_of(-y) - Expr::one()),
    ("x^y = e^(y ln x)", |x, y| x.power_of(y) - (y * x.ln()).exp()),
];

/// Draws positive numbers of every size: 2^e (1 + m), with exponents near 0 in half of the cases.
fn positive() -> impl Strategy<Value = f64> {
    let exponent = prop_oneof![-4..4i32, -1073..1023i32];
    (exponent, 0.0..1.0f64).prop_map(|(e, m)| 2f64.powi(e) * (1.0 + m))
}

#[test]
fn functional_equations_hold_in_balls() {
    let (graph, outputs) =
        record(2, |inputs| EQUATIONS.map(|(_, difference)| difference(inputs[0], inputs[1])))
            .expect("elementary functions record");
    let tape = Tape::new(&graph, &outputs);
    let counts = EQUATIONS.map(|_| Cell::new(0u32));
    let outcome = TestRunner::new(config(10_000)).run(&(positive(), positive()), |(x, y)| {
        let mut evaluator = Evaluator::new(&tape, Ball::<1>);
        evaluator.run(&[x, y].map(|value| Ball::<1>.values(&[rational(&dyadic(value))])));
        for ((equation, _), (ball, count)) in EQUATIONS.iter().zip(evaluator.outputs().zip(&counts))
        {
            let Balls { mid, rad } = ball;
            prop_assert!(
                !ball.excludes_zero(0),
                "{equation} at {x:e}, {y:e}: {:e} ± {:e} excludes 0",
                mid[0],
                rad[0]
            );
            // A ball counts if it would have shown an error of a millionth.
            count.set(count.get() + u32::from(ball.is_defined(0) && rad[0] < 1e-6 * x.min(1.0)));
        }
        Ok(())
    });
    outcome.unwrap_or_else(|failure| panic!("{failure}"));
    for ((equation, _), count) in EQUATIONS.iter().zip(&counts) {
        assert!(count.get() > 2000, "{equation} was tested by {} narrow balls only", count.get());
    }
}

#[test]
fn inverse_functions_and_zeros_fold_exactly() {
    let (graph, values) = record(1, |x| {
        [x[0].exp().ln() - x[0], Expr::zero().sin(), Expr::zero().exp() - Expr::one()]
    })
    .expect("elementary functions record");
    for value in values {
        let constant = graph.constant_value(value);
        assert_eq!(constant, Some(&Rational::from(0)), "folded while it is recorded");
    }
}
