//! Tests of lower bounds of radii against the radii, and of extents against results at random.

use super::super::program::{ProgramStep, StepProgram, Sum};
use super::extents::Extent;
use super::*;
use crate::graph::{Expr, literally, record};
use crate::number::{BinaryOperation, UnaryFunction};
use crate::scalar::Scalar;
use num_dual::DualNum;

struct Sequence(u64);

impl Sequence {
    fn next(&mut self, below: usize) -> usize {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 33) as usize % below
    }

    fn within(&mut self, [low, high]: [f64; 2]) -> f64 {
        low + (high - low) * (self.next(1 << 30) as f64 / (1 << 30) as f64)
    }
}

/// Tape of random operations that are defined for inputs in a half and more.
fn defined_tape(sequence: &mut Sequence, inputs: usize, length: usize) -> Tape {
    let (graph, values) = record(inputs, |x| {
        let mut values: Vec<Expr> = x.to_vec();
        values.push(Expr::rational(&Rational::new(2, 7)));
        let one = Expr::rational(&Rational::from(1));
        for _ in 0..length {
            let mut pick = || values[sequence.next(values.len())];
            let (a, b) = (pick(), pick());
            let zero = Expr::rational(&Rational::from(0));
            values.push(match sequence.next(13) {
                // Zeros that are written out.
                7 => literally(|| a * zero),
                8 => literally(|| zero - a),
                9 => literally(|| a + zero * zero),
                0 => a.apply(UnaryFunction::Neg),
                1 => (one + a.apply(UnaryFunction::Abs)).recip(),
                2 => (one + a * a).apply(UnaryFunction::Sqrt),
                3 => x[sequence.next(x.len())].recip(),
                4 | 5 => a + b,
                6 => a - b,
                _ => a * b,
            });
        }
        values.split_off(values.len() - 5)
    })
    .expect("records");
    Tape::new(&graph, &values)
}

#[test]
fn lower_bounds_are_below_the_radii_and_midpoints_the_same() {
    let mut sequence = Sequence(5);
    let (mut compared, mut positive, mut close) = (0, 0, 0);
    for turn in 0..60 {
        // Numbers near the least and the greatest f64, too.
        let scale = [1.0, 1.0, 1e-160, 1e100][turn % 4];
        let extents: Vec<InputExtent> = (0..4)
            .map(|_| {
                let low = 0.5 + sequence.within([0.0, 1.0]);
                let radius = [0.0, 1e-17, 1e-3][sequence.next(3)] * scale;
                InputExtent { ends: [low * scale, (low + 1.0) * scale], radius }
            })
            .collect();
        let length = 1 + sequence.next(25);
        let first = defined_tape(&mut sequence, 4, length);
        let second = defined_tape(&mut sequence, 6, 20);
        let further = [Rational::new(7, 5)];
        let tested = [4, 0, 2];
        for vectors in [InstructionSet::Avx2, InstructionSet::Avx512] {
            let code = (&second, &tested[..]);
            let engine = BallEngine::with_vectors(&extents, &first, &further, code, vectors);
            let Some(engine) = engine else { continue };
            let mut runner = engine.runner();
            for (input, extent) in runner.inputs_mut().iter_mut().zip(&extents) {
                input[0].0 = std::array::from_fn(|_| sequence.within(extent.ends));
                input[1].0 = std::array::from_fn(|_| sequence.within([0.0, extent.radius]));
            }
            runner.run();
            if !runner.run_lower() {
                continue;
            }
            for (place, index) in tested.iter().enumerate() {
                let [mid, rad] = runner.output(engine.computed() + index);
                let [own, low] = runner.lower(place).expect("computed");
                for lane in 0..ROW_STATES {
                    let (rad, low) = (rad.0[lane], low.0[lane] * (f64::EPSILON / 2.0));
                    let place = format!("tape {turn}, output {index}, lane {lane}");
                    assert!(mid.0[lane] == own.0[lane], "{place}");
                    assert!(mid.0[lane].is_finite() && rad.is_finite(), "{place}: known to be");
                    assert!(low <= rad, "{place}: {low:e} is above {rad:e}");
                    compared += 1;
                    positive += usize::from(low > 0.0);
                    close += usize::from(2.0 * low > rad);
                }
            }
        }
    }
    if crate::graph::widest() == InstructionSet::Avx512 {
        let counts = [compared, positive, close];
        assert!(counts.iter().all(|count| *count > 1000), "bounds that say much: {counts:?}");
    }
}

#[test]
fn nothing_is_known_where_a_number_may_have_no_value() {
    let is_known = |ends: [f64; 2], radius: f64, value: &dyn Fn(Expr) -> Expr| {
        let (graph, value) = record(1, |x| value(x[0])).expect("records");
        let tape = Tape::new(&graph, &[value]);
        let (identity, x) = record(1, |x| x[0]).expect("records");
        let extents = [InputExtent { ends, radius }];
        let first = Tape::new(&identity, &[x]);
        BallEngine::new(&extents, &first, &[], &tape, &[0])
            .map(|engine| engine.runner().run_lower())
    };
    let known = |expected: bool| move |found: Option<bool>| found.is_none_or(|is| is == expected);
    let (is, is_not) = (known(true), known(false));
    let unbounded = [f64::NEG_INFINITY, f64::INFINITY];
    assert!(is(is_known([1.0, 2.0], 0.0, &|x| x.recip())));
    assert!(is_not(is_known([0.0, 2.0], 0.0, &|x| x.recip())), "1/0");
    assert!(is_not(is_known([-1.0, 2.0], 0.0, &|x| x.recip())), "1/0 between");
    assert!(is_not(is_known([1.0, 2.0], 1.0, &|x| x.recip())), "a ball about 0");
    assert!(is(is_known([1.0, 2.0], 0.5, &|x| x.recip())));
    assert!(is(is_known([0.0, 2.0], 0.0, &|x| x.apply(UnaryFunction::Sqrt))));
    assert!(is_not(is_known([-1e-9, 2.0], 0.0, &|x| x.apply(UnaryFunction::Sqrt))));
    assert!(is_not(is_known([0.5, 2.0], 0.6, &|x| x.apply(UnaryFunction::Sqrt))));
    assert!(is(is_known([-1.0, 2.0], 0.0, &|x| (x * x).apply(UnaryFunction::Abs) + x)));
    assert!(is_not(is_known([1.0, 1e200], 0.0, &|x| x * x)), "overflow");
    // The bound is 0.75 x + 0.25 x + x, in units of the roundoff.
    let shares = |x| x * 0.75 + x * 0.25;
    assert!(is(is_known([1.0, 8e307], 0.0, &shares)));
    assert!(is_not(is_known([1.0, 1.6e308], 0.0, &shares)), "overflow of the bound alone");
    assert!(is_not(is_known(unbounded, 0.0, &|x| x + x)), "no range");
}

/// Result of a step that no engine fuses.
fn value(step: &ProgramStep, at: impl Fn(Value) -> f64) -> f64 {
    match *step {
        ProgramStep::Unary(UnaryFunction::Neg, a) => -at(a),
        ProgramStep::Unary(UnaryFunction::Abs, a) => at(a).abs(),
        ProgramStep::Unary(UnaryFunction::Recip, a) => 1.0 / at(a),
        ProgramStep::Unary(_, a) => at(a).sqrt(),
        ProgramStep::Binary(BinaryOperation::Add, a, b) => at(a) + at(b),
        ProgramStep::Binary(BinaryOperation::Sub, a, b) => at(a) - at(b),
        ProgramStep::Binary(_, a, b) => at(a) * at(b),
        ProgramStep::Pair(operation, a, b) => operation.of(at(a), at(b)),
        ProgramStep::Fused(Sum::Plus, [a, b, c]) => at(a).mul_add(at(b), at(c)),
        ProgramStep::Fused(Sum::Minus, [a, b, c]) => at(a).mul_add(at(b), -at(c)),
        ProgramStep::Fused(Sum::From, [a, b, c]) => (-at(a)).mul_add(at(b), at(c)),
    }
}

#[test]
fn results_are_within_their_extents() {
    let mut sequence = Sequence(9);
    let mut known = 0;
    for turn in 0..400 {
        // Midpoint and radius of two balls, or four numbers of a program with fused sums.
        let ends = [(); 4].map(|_| {
            let [a, b] = [(); 2].map(|_| sequence.within([-2.0, 2.0]));
            [a.min(b), a.max(b)]
        });
        let is_fused = turn % 2 == 0;
        let (graph, result) = record(if is_fused { 4 } else { 2 }, |x| {
            let mut values: Vec<Expr> = x.to_vec();
            for _ in 0..6 {
                let mut pick = || values[sequence.next(values.len())];
                let (a, b) = (pick(), pick());
                values.push(match sequence.next(8) {
                    0 => a.recip(),
                    1 => a.apply(UnaryFunction::Sqrt),
                    2 => a.apply(UnaryFunction::Abs),
                    3 => a - b,
                    4 => a * b - x[0],
                    5 => x[1] - a * b,
                    6 => a * b + b,
                    _ => a * b,
                });
            }
            values[values.len() - 1]
        })
        .expect("records");
        let tape = Tape::new(&graph, &[result]);
        let ends = match is_fused {
            true => ends,
            false => [ends[0], [0.0, 1e-9], ends[1], [0.0, 0.1]],
        };
        let program = match is_fused {
            true => StepProgram::new(&tape),
            false => {
                let (identity, x) = record(2, |x| x.to_vec()).expect("records");
                let first = Tape::new(&identity, &x);
                program(&[false; 2], &first, &[], &tape).expect("instructions alone").0
            }
        };
        let Some(found) = extents::found(&program, &ends) else { continue };
        known += 1;
        for _ in 0..50 {
            let inputs = ends.map(|ends| sequence.within(ends));
            let mut values: Vec<f64> = Vec::new();
            for (step, extent) in program.steps.iter().zip(&found) {
                let value = value(step, |value| match value {
                    Value::Input(input) => inputs[input as usize],
                    Value::Constant(constant) => program.constants[constant as usize],
                    Value::Step(step) => values[step as usize],
                });
                match extent {
                    Extent::Within([low, high]) => {
                        assert!(*low <= value && value <= *high, "{step:?}: {value} in {extent:?}");
                    }
                    Extent::Clear => assert_eq!(value.to_bits(), 0, "{step:?}"),
                    Extent::Mask => {}
                }
                values.push(value);
            }
        }
    }
    assert!(known > 50, "{known} programs without undefined values");
}
