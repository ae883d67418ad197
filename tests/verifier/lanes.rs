//! One recorded computation in three number domains: f64, balls, exact rationals.
//!
//! The ball contains the exact value or is undefined, whatever the values: zero, the smallest and
//! the largest numbers, nearly cancelling ones, numbers that f64 cannot represent. Its midpoint is
//! the f64 result.

use std::cell::Cell;

use crate::common::{dyadic, exact, rational};
use crate::random::config;
use liouville::graph::{Evaluator, Expr, Tape, record};
use liouville::number::Domain;
use liouville::number::ball::{Ball, Balls};
use liouville::number::exact::Exact;
use liouville::number::float::Float;
use liouville::number::rational::Rational;
use liouville::scalar::Scalar;
use num_dual::DualNum;
use num_rational::BigRational;
use num_traits::Signed;
use proptest::prelude::*;
use proptest::test_runner::TestRunner;

const INPUTS: usize = 4;

/// One operation on existing values, each named by a number taken modulo their count.
#[derive(Clone, Debug)]
enum Step {
    Add(usize, usize),
    Sub(usize, usize),
    Mul(usize, usize),
    Div(usize, usize),
    /// √(x²) and |x|: rational roots.
    RootOfSquare(usize),
    Modulus(usize),
    Power(usize, i32),
    /// (x²)^(n/2)
    HalfPower(usize, i64),
    Constant(usize),
}

fn step() -> impl Strategy<Value = Step> {
    let one = || 0usize..64;
    prop_oneof![
        3 => (one(), one()).prop_map(|(a, b)| Step::Add(a, b)),
        3 => (one(), one()).prop_map(|(a, b)| Step::Sub(a, b)),
        3 => (one(), one()).prop_map(|(a, b)| Step::Mul(a, b)),
        2 => (one(), one()).prop_map(|(a, b)| Step::Div(a, b)),
        2 => one().prop_map(Step::RootOfSquare),
        1 => one().prop_map(Step::Modulus),
        2 => (one(), -3i32..=5).prop_map(|(a, n)| Step::Power(a, n)),
        1 => (one(), -3i64..=3).prop_map(|(a, n)| Step::HalfPower(a, n)),
        1 => one().prop_map(Step::Constant),
    ]
}

/// Numbers at the edges of f64, of its representable values, and of cancellation.
const EDGES: [&str; 24] = [
    "0",
    "1",
    "-1",
    "1/3",
    "-2/7",
    "0.1",
    "5e-324",
    "-5e-324",
    "3e-324",
    "2e-324",
    "1e-310",
    "2.2250738585072014e-308",
    "2.2250738585072011e-308",
    "1e-160",
    "-1e-155",
    "1e155",
    "-1e160",
    "1.7976931348623157e308",
    "1e308",
    "1e400",
    "1e-400",
    "9007199254740993",
    "9007199254740992",
    "-36028797018963967",
];

/// Draws numbers of every size, edges first.
fn edge() -> impl Strategy<Value = BigRational> {
    let ulp = || dyadic(f64::EPSILON);
    prop_oneof![
        4 => (0..EDGES.len()).prop_map(|i| exact(EDGES[i])),
        2 => (-8i64..8).prop_map(move |n| {
            BigRational::from_integer(1.into()) + BigRational::from_integer(n.into()) * ulp()
        }),
        2 => any::<f64>().prop_filter("finite", |x| x.is_finite()).prop_map(dyadic),
        2 => (-1000i64..1000, 1i64..1000).prop_map(|(a, b)| BigRational::new(a.into(), b.into())),
    ]
}

/// Carries out the steps; each value stays available to later ones.
fn run(inputs: &[Expr], steps: &[Step]) -> Vec<Expr> {
    let mut values = inputs.to_vec();
    for step in steps {
        let at = |index: &usize| values[index % values.len()];
        let next = match step {
            Step::Add(a, b) => at(a) + at(b),
            Step::Sub(a, b) => at(a) - at(b),
            Step::Mul(a, b) => at(a) * at(b),
            Step::Div(a, b) => at(a) / at(b),
            Step::RootOfSquare(a) => (at(a) * at(a)).sqrt(),
            Step::Modulus(a) => at(a).modulus(),
            Step::Power(a, n) => at(a).powi(*n),
            Step::HalfPower(a, n) => (at(a) * at(a)).power(&Rational::new(*n, 2)),
            Step::Constant(index) => Expr::rational(&rational(&exact(EDGES[index % EDGES.len()]))),
        };
        values.push(next);
    }
    values
}

/// Values in the three domains.
struct Lanes {
    float: Vec<f64>,
    ball: Vec<Balls<1>>,
    exact: Vec<Option<Rational>>,
}

fn lanes(inputs: &[Rational], build: impl FnOnce(&[Expr]) -> Vec<Expr>) -> Lanes {
    let (graph, outputs) = record(inputs.len(), build).expect("arithmetic records");
    let tape = Tape::new(&graph, &outputs);
    let mut float = Evaluator::new(&tape, Float::<1>);
    float.run(
        &inputs.iter().map(|x| Float::<1>.values(std::slice::from_ref(x))).collect::<Vec<_>>(),
    );
    let mut ball = Evaluator::new(&tape, Ball::<1>);
    ball.run(&inputs.iter().map(|x| Ball::<1>.values(std::slice::from_ref(x))).collect::<Vec<_>>());
    let mut exact = Evaluator::new(&tape, Exact);
    exact.run(&inputs.iter().cloned().map(Some).collect::<Vec<_>>());
    Lanes {
        float: float.outputs().map(|x| x[0]).collect(),
        ball: ball.outputs().cloned().collect(),
        exact: exact.outputs().cloned().collect(),
    }
}

/// Converts the library's number for computations here.
fn big(value: &Rational) -> BigRational {
    let (above, below) = value.parts();
    BigRational::new(above.clone(), below.clone())
}

/// Asserts that a defined ball contains the exact value; returns whether both exist.
fn assert_contained(lanes: &Lanes, index: usize) -> Result<bool, TestCaseError> {
    let ball = &lanes.ball[index];
    let (mid, radius) = (ball.mid[0], ball.rad[0]);
    if !ball.is_defined(0) {
        return Ok(false);
    }
    prop_assert!(radius >= 0.0, "value {index}: radius {radius}");
    // In the same order of operations, the midpoint is the f64 result.
    prop_assert_eq!(mid, lanes.float[index], "value {}: the midpoint", index);
    let Some(value) = &lanes.exact[index] else { return Ok(false) };
    let distance = (big(value) - dyadic(mid)).abs();
    prop_assert!(
        distance <= dyadic(radius),
        "value {index}: {mid:e} ± {radius:e} does not hold {value}, off by {}",
        num_traits::ToPrimitive::to_f64(&distance).unwrap_or(f64::NAN)
    );
    Ok(true)
}

/// Runs random computations on random inputs and checks every value; at least half of the values
/// must exist exactly and in balls, or too little would have been checked.
fn check(inputs: impl Strategy<Value = BigRational>, steps: std::ops::Range<usize>) {
    let strategy = (prop::collection::vec(inputs, INPUTS), prop::collection::vec(step(), steps));
    let (all, compared) = (Cell::new(0u32), Cell::new(0u32));
    let outcome = TestRunner::new(config(1000)).run(&strategy, |(values, steps)| {
        let inputs: Vec<Rational> = values.iter().map(rational).collect();
        let lanes = lanes(&inputs, |inputs| run(inputs, &steps));
        for index in INPUTS..lanes.ball.len() {
            all.set(all.get() + 1);
            compared.set(compared.get() + u32::from(assert_contained(&lanes, index)?));
        }
        Ok(())
    });
    outcome.unwrap_or_else(|failure| panic!("{failure}"));
    let (all, compared) = (all.get(), compared.get());
    assert!(2 * compared >= all, "only {compared} of {all} values could be compared");
}

#[test]
fn balls_hold_the_exact_values_at_the_edges_of_f64() {
    check(edge(), 1..4);
}

#[test]
fn balls_hold_the_exact_values_of_long_computations() {
    let small = (-200i64..200, 1i64..100);
    check(small.prop_map(|(a, b)| BigRational::new(a.into(), b.into())), 4..12);
}

proptest! {
    #![proptest_config(config(2000))]

    #[test]
    fn a_number_lies_in_its_own_ball(value in edge()) {
        assert_contained(&lanes(&[rational(&value)], <[Expr]>::to_vec), 0)?;
    }

    /// (1 + x)(1 - x) - 1 + x²: exact cancellation is not separated from 0, a perturbation is.
    #[test]
    fn cancellation_widens_the_ball_and_no_more(a in 1i64..1000, b in 1i64..1000) {
        let lanes = lanes(&[Rational::new(a, b)], |x| {
            let one = Expr::rational(&Rational::from(1));
            let zero = (one + x[0]) * (one - x[0]) - one + x[0] * x[0];
            vec![zero, zero + Expr::rational(&Rational::new(1, 1 << 20))]
        });
        prop_assert!(assert_contained(&lanes, 0)? && assert_contained(&lanes, 1)?);
        prop_assert!(!lanes.ball[0].excludes_zero(0), "it is 0: {:?}", lanes.ball[0]);
        // x has an error of at most εx, which enters through terms of slope below 4(1 + x) in all;
        // then seven roundings of terms below (1 + x)².
        let size = (1.0 + a as f64 / b as f64).powi(2);
        let bound = 8.0 * f64::EPSILON * size;
        prop_assert!(lanes.ball[0].rad[0] <= bound, "{:?} is wider than {bound:e}", lanes.ball[0]);
        let told = 4.0 * bound < 0.5f64.powi(20);
        prop_assert!(!told || lanes.ball[1].excludes_zero(0), "{:?}", lanes.ball[1]);
    }
}

#[test]
fn what_does_not_exist_is_undefined_in_balls() {
    let lanes = lanes(&[Rational::from(0), Rational::new(-1, 7)], |x| {
        let root = |x: Expr| x.power(&Rational::new(1, 2));
        vec![x[0].recip(), x[1] / x[0], x[0].powi(-2), x[1].sqrt(), root(x[1] - x[1] * x[1])]
    });
    for index in 0..lanes.ball.len() {
        assert_eq!(lanes.exact[index], None, "value {index} does not exist");
        assert!(!lanes.ball[index].is_defined(0), "value {index}: {:?}", lanes.ball[index]);
    }
}
