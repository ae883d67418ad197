//! Claims that presuppose values.

use num_dual::DualNum;

use liouville::graph::{Expr, literally, record};
use liouville::number::UnaryFunction;
use liouville::number::rational::Rational;
use liouville::proof::ProofRng;
use liouville::proof::{Extent, Group, GroupOutcome, Prover};

/// The outcome for a value that is 0 and presupposes another one, over inputs in -2..2.
fn outcome(required: bool, build: impl FnOnce(&[Expr]) -> Expr) -> GroupOutcome {
    let (graph, group) = record(2, |x| {
        let presence = vec![literally(|| build(x))];
        let zero = square(x[0] + 1.0) - square(x[0]) - x[0] * 2.0 - 1.0;
        let required = if required { presence.clone() } else { Vec::new() };
        Group { outputs: vec![zero * x[1]], required, presence, ..Group::default() }
    })
    .expect("records");
    let extents = vec![Extent::between(&Rational::from(-2), &Rational::from(2)); 2];
    let prover = Prover { sources: &[], extents: &extents, seed: 1 };
    prover.prove(&graph, &[group]).expect("within bounds").remove(0)
}

fn square(value: Expr) -> Expr {
    value * value
}

fn abs(value: Expr) -> Expr {
    value.apply(UnaryFunction::Abs)
}

/// 0, in a form that is not folded.
fn hidden_zero(value: Expr) -> Expr {
    square(value + 1.0) - square(value) - value * 2.0 - 1.0
}

fn is_zero(outcome: &GroupOutcome) -> bool {
    matches!(outcome, GroupOutcome::Zero(_))
}

/// A value that exists wherever `v` does.
fn wrapped(kind: u64, v: Expr, x: &[Expr]) -> Expr {
    match kind % 8 {
        0 => v.sin() * x[1],
        1 => (v * 0.25).exp(),
        2 => (square(v) + 1.0).recip(),
        3 => (square(v) + x[0] * x[0] + 0.5).sqrt(),
        4 => (square(v) + 2.0).ln(),
        5 => abs(v) * 0.0 + 1.0,
        6 => (abs(v) + 1.0).powd(x[1]),
        _ => v * v.atan() * 0.0,
    }
}

/// A value without one on an open set of inputs.
fn broken(kind: u64, v: Expr, x: &[Expr]) -> Expr {
    match kind % 8 {
        0 => hidden_zero(v).recip(),
        1 => v / (abs(x[0]) - x[0]),
        2 => (-square(v) - 1.0).ln(),
        3 => (-abs(v) - 1.0).sqrt(),
        4 => x[0].ln(),
        5 => hidden_zero(x[1]).powd(x[0]) + v,
        6 => (x[0] + x[1]).sqrt() * 0.0,
        _ => (abs(x[0] + x[1]) + x[0] + x[1]).recip() * v,
    }
}

#[test]
fn a_value_that_does_not_exist_is_never_overlooked() {
    for seed in 0..96u64 {
        let mut rng = ProofRng::new(seed, 41);
        let mut draw = move || (0..3).fold(0, |n, _| 2 * n + u64::from(rng.coin()));
        let steps: Vec<u64> = (0..4).map(|_| draw()).collect();
        let (at, kind) = (draw() % 4, draw());
        let of = |is_broken: bool| {
            outcome(false, |x| {
                let mut v = x[0] * x[1] + x[0];
                for (place, step) in steps.iter().enumerate() {
                    if is_broken && place as u64 == at {
                        v = broken(kind, v, x);
                    }
                    v = wrapped(*step, v, x);
                }
                v
            })
        };
        assert!(is_zero(&of(false)), "seed {seed}: {steps:?}: {:?}", of(false));
        assert!(!is_zero(&of(true)), "seed {seed}: {kind} at {at} of {steps:?}");
    }
}

#[test]
fn what_is_required_anyway_need_not_exist_everywhere() {
    let root = |x: &[Expr]| (x[0] + x[1]).sqrt().exp() / x[0];
    assert!(is_zero(&outcome(true, root)), "where it has a value");
    assert!(!is_zero(&outcome(false, root)), "and elsewhere");
}
