//! Tests of all engines against each other, bit for bit, and against the tape's evaluator.

use num_dual::DualNum;

use super::program::Value;
use super::*;
use crate::graph::{Evaluator, Expr, record};
use crate::number::ball::{Ball, Balls};
use crate::number::float::Float;
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};
use crate::scalar::Scalar;

/// Numbers at which operations differ most: zeros, infinities, NaN, tiny and huge ones.
const CORNERS: [f64; 16] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::NAN,
    f64::MIN_POSITIVE,
    -f64::MIN_POSITIVE,
    5e-324,
    f64::MAX,
    -f64::MAX,
    0.1,
    -1.0 / 3.0,
    1e200,
    1e-200,
];

/// Fixed sequence of pseudorandom numbers.
struct Sequence(u64);

impl Sequence {
    fn next(&mut self, below: usize) -> usize {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 33) as usize % below
    }

    fn number(&mut self) -> f64 {
        match self.next(4) {
            0 => CORNERS[self.next(CORNERS.len())],
            _ => self.next(2000) as f64 / 700.0 - 1.4,
        }
    }
}

/// Engines for all ways to run a tape on this machine.
fn engines(tape: &Tape) -> Vec<Engine> {
    let all = [InstructionSet::Baseline, InstructionSet::Avx2, InstructionSet::Avx512];
    let pairs = all.iter().flat_map(|vectors| {
        [Backend::Interpreter, Backend::Quickest]
            .map(|means| Engine::with_vectors(tape, means, *vectors))
    });
    pairs.collect()
}

/// Bits of all outputs; every NaN counts as the same.
fn bits(engine: &Engine, inputs: &[RowBlock], outputs: usize) -> Vec<[u64; ROW_STATES]> {
    let mut runner = engine.runner();
    runner.inputs().copy_from_slice(inputs);
    // A second run must not see the first.
    runner.run();
    runner.run();
    let bits = |x: f64| if x.is_nan() { u64::MAX } else { x.to_bits() };
    (0..outputs).map(|index| runner.output(index).0.map(bits)).collect()
}

fn assert_all_equal(tape: &Tape, inputs: &[RowBlock], what: &str) {
    let engines = engines(tape);
    let outputs = tape.outputs();
    let reference = bits(&engines[0], inputs, outputs);
    for engine in &engines[1..] {
        let (vectors, is_code) = (engine.0.vectors, engine.is_machine_code());
        let found = bits(engine, inputs, outputs);
        assert!(found == reference, "{what}: {vectors:?}, machine code: {is_code}");
    }
}

const FUNCTIONS: [UnaryFunction; 9] = [
    UnaryFunction::Neg,
    UnaryFunction::Recip,
    UnaryFunction::Sqrt,
    UnaryFunction::Abs,
    UnaryFunction::Exp,
    UnaryFunction::Ln,
    UnaryFunction::Sin,
    UnaryFunction::Cos,
    UnaryFunction::Atan,
];
const OPERATIONS: [BinaryOperation; 4] =
    [BinaryOperation::Add, BinaryOperation::Sub, BinaryOperation::Mul, BinaryOperation::Pow];

#[test]
fn every_operation_has_the_bits_of_the_domain() {
    let (graph, values) = record(2, |x| {
        let mut all: Vec<Expr> = FUNCTIONS.iter().map(|f| x[0].apply(*f)).collect();
        all.extend(OPERATIONS.iter().map(|operation| x[0].combine(*operation, x[1])));
        all.push(x[1].combine(BinaryOperation::Sub, x[0]));
        all.push(x[0].power(&Rational::new(5, 3)));
        all.push(x[0]);
        all.push(Expr::rational(&Rational::new(1, 3)));
        all
    })
    .expect("records");
    // One by one, so that instructions become machine code; and all in one.
    let single = values.iter().map(|value| Tape::new(&graph, &[*value]));
    for (index, tape) in single.chain([Tape::new(&graph, &values)]).enumerate() {
        for turn in 0..CORNERS.len() / 4 {
            let x = RowBlock(std::array::from_fn(|lane| CORNERS[lane % 16]));
            let y = RowBlock(std::array::from_fn(|lane| CORNERS[4 * turn + lane / 16]));
            assert_all_equal(&tape, &[x, y], &format!("operation {index}"));
            let mut domain = Evaluator::new(&tape, Float::<ROW_STATES>);
            domain.run(&[x.0, y.0]);
            let engine = Engine::new(&tape, Backend::Interpreter);
            for (output, found) in bits(&engine, &[x, y], tape.outputs()).iter().enumerate() {
                let expected = domain.output(output);
                let same = (0..ROW_STATES).all(|lane| match expected[lane] {
                    value if value.is_nan() => found[lane] == u64::MAX,
                    // The sign of 0 may differ: a negated difference is the opposite one.
                    0.0 => f64::from_bits(found[lane]) == 0.0,
                    value => found[lane] == value.to_bits(),
                });
                assert!(same, "operation {index}, output {output}");
            }
        }
    }
}

/// Tape of random operations on a few inputs, with `live` live values.
fn random_tape(sequence: &mut Sequence, length: usize, live: usize) -> Tape {
    let (graph, values) = record(5, |x| {
        let mut values: Vec<Expr> = x.to_vec();
        values.push(Expr::rational(&Rational::new(2, 7)));
        for _ in 0..length {
            let first = values.len().saturating_sub(live);
            let mut pick = || values[first + sequence.next(values.len() - first)];
            let (a, b, c) = (pick(), pick(), pick());
            values.push(match sequence.next(12) {
                0 => a.apply(UnaryFunction::Neg),
                1 => a.apply(UnaryFunction::Abs),
                2 => a.apply(UnaryFunction::Sqrt),
                3 => a.apply(UnaryFunction::Recip),
                4 => a + b,
                5 => a - b,
                6 | 7 => a * b,
                8 => a * b + c,
                9 => c - a * b,
                10 => a * a - b,
                _ => a * b - b * c,
            });
        }
        let count = values.len();
        [values[count - 1], values[count - 2], values[count / 2], values[count / 3], values[2]]
            .to_vec()
    })
    .expect("records");
    Tape::new(&graph, &values)
}

#[test]
fn random_tapes_have_the_same_bits_in_all_engines() {
    let mut sequence = Sequence(1);
    for turn in 0..300 {
        let length = 1 + sequence.next(if turn % 10 == 0 { 1500 } else { 120 });
        // Up to ten times as many values as there are registers.
        let live = 2 + sequence.next(if turn % 3 == 0 { 320 } else { 30 });
        let tape = random_tape(&mut sequence, length, live);
        let inputs = [(); 5].map(|_| RowBlock(std::array::from_fn(|_| sequence.number())));
        assert_all_equal(&tape, &inputs, &format!("tape {turn}"));
    }
}

#[test]
fn a_sum_of_products_is_rounded_once() {
    let (graph, value) = record(2, |x| x[0] * x[0] - x[1]).expect("records");
    let tape = Tape::new(&graph, &[value]);
    let x = 1.0 + f64::EPSILON;
    for engine in engines(&tape) {
        assert_eq!(engine.steps(), 1, "the product is a part of the difference");
        let mut runner = engine.runner();
        runner
            .inputs()
            .copy_from_slice(&[RowBlock([x; ROW_STATES]), RowBlock([x * x; ROW_STATES])]);
        runner.run();
        let left = runner.output(0).0[ROW_STATES - 1];
        assert_eq!(left, f64::EPSILON * f64::EPSILON, "what rounding took from x²");
    }
}

#[test]
fn machine_code_is_made_where_it_can_be() {
    let (graph, [plain, other]) =
        record(1, |x| [x[0] * x[0], x[0].apply(UnaryFunction::Sin)]).expect("records");
    let is_code =
        |value| Engine::new(&Tape::new(&graph, &[value]), Backend::Quickest).is_machine_code();
    let expected = widest() != InstructionSet::Baseline;
    assert_eq!(is_code(plain), expected, "a product is an instruction");
    assert!(!is_code(other), "a sine is none");
}

/// Outputs of a tape that are neither inputs nor constants.
fn computed_outputs(tape: &Tape) -> Vec<usize> {
    let program = StepProgram::new(tape);
    let is_step = |index: &usize| matches!(program.outputs[*index], Value::Step(_));
    (0..program.outputs.len()).filter(is_step).collect()
}

/// Whether two balls are the same, or none has a value.
fn same_ball([mid, rad]: [f64; 2], [other_mid, other_rad]: [f64; 2]) -> bool {
    match (mid.is_finite() && rad.is_finite(), other_mid.is_finite() && other_rad.is_finite()) {
        (true, true) => {
            mid.to_bits() == other_mid.to_bits() && rad.to_bits() == other_rad.to_bits()
        }
        (a, b) => a == b,
    }
}

#[test]
fn balls_have_the_bits_of_the_domain() {
    let mut sequence = Sequence(2);
    let mut compared = [0, 0];
    for turn in 0..200 {
        let length = 1 + sequence.next(if turn % 10 == 0 { 400 } else { 60 });
        let first = random_tape(&mut sequence, length, 20);
        let second = random_tape(&mut sequence, 40, 20);
        // Some inputs are exact, and said to be.
        let exact: Vec<bool> = (0..5).map(|_| turn % 2 == 0 && sequence.next(2) == 0).collect();
        let inputs: Vec<Balls<ROW_STATES>> =
            exact
                .iter()
                .map(|is_exact| {
                    let mid: [f64; ROW_STATES] = std::array::from_fn(|_| {
                        let number = sequence.number();
                        if *is_exact && !number.is_finite() { 1.5 } else { number }
                    });
                    let rad: [f64; ROW_STATES] = std::array::from_fn(|_| match sequence.next(3) {
                        _ if *is_exact => 0.0,
                        0 => 0.0,
                        1 => 1e-16,
                        _ => sequence.next(1000) as f64 / 2000.0,
                    });
                    // As of states: an undefined number has no radius.
                    let rad = std::array::from_fn(|lane| {
                        if mid[lane].is_finite() { rad[lane] } else { f64::NAN }
                    });
                    Balls::new(mid, rad)
                })
                .collect();
        let extent = |is_exact: &bool| InputExtent {
            ends: [f64::NEG_INFINITY, f64::INFINITY],
            radius: if *is_exact { 0.0 } else { 1.0 },
        };
        let extents: Vec<InputExtent> = exact.iter().map(extent).collect();
        let mut evaluators = [&first, &second].map(|tape| Evaluator::new(tape, Ball::<ROW_STATES>));
        evaluators[0].run(&inputs);
        let states: Vec<Balls<ROW_STATES>> = evaluators[0].outputs().cloned().collect();
        evaluators[1].run(&states);
        let expected: Vec<&Balls<ROW_STATES>> =
            states.iter().chain(evaluators[1].outputs()).collect();
        for vectors in [InstructionSet::Avx2, InstructionSet::Avx512] {
            let engine = BallEngine::with_vectors(&extents, &first, &[], (&second, &[]), vectors);
            assert!(engine.is_some() || widest() != InstructionSet::Avx512, "there is code");
            let Some(engine) = engine else { continue };
            let (mut runner, computed) = (engine.runner(), engine.computed());
            for (input, ball) in runner.inputs_mut().iter_mut().zip(&inputs) {
                *input = [RowBlock(ball.mid), RowBlock(ball.rad)];
            }
            assert!(runner.is_exact(), "radii that are left out are 0");
            runner.run();
            if let Some(index) = exact.iter().position(|is_exact| *is_exact) {
                runner.inputs_mut()[index][1].0[63] = 1e-300;
                assert!(!runner.is_exact(), "others are not left out");
            }
            let results = expected[states.len()..].iter().copied();
            let made = computed_outputs(&first).into_iter().map(|place| expected[place]);
            assert_eq!(made.len(), computed, "states that are steps");
            for (index, expected) in made.chain(results).enumerate() {
                let [mid, rad] = runner.output(index);
                for lane in 0..ROW_STATES {
                    let found = [mid.0[lane], rad.0[lane]];
                    let own = [expected.mid[lane], expected.rad[lane]];
                    compared[usize::from(expected.is_defined(lane))] += 1;
                    assert!(
                        same_ball(found, own),
                        "tape {turn}, output {index}, lane {lane}: {found:?}, not {own:?}"
                    );
                }
            }
        }
    }
    assert!(
        compared.iter().all(|count| *count > 1000) || widest() == InstructionSet::Baseline,
        "balls with and without a value: {compared:?}"
    );
}

#[test]
fn exact_reciprocals_and_roots_have_the_bits_of_the_domain() {
    let (graph, values) = record(1, |inputs| {
        let [x] = [inputs[0]];
        // A product reads the radius of a result without a value.
        vec![x.recip(), x.sqrt(), x.recip() * x.recip(), x.recip().recip()]
    })
    .expect("nothing is asked of the values");
    let first = Tape::new(&graph, &values);
    let (graph, values) = record(4, |inputs| inputs.to_vec()).expect("nothing is asked");
    let second = Tape::new(&graph, &values);
    let least = f64::MIN_POSITIVE / 4.0;
    let numbers = [0.0, -0.0, least, -least, least.next_up(), least.next_down(), f64::MIN_POSITIVE]
        .into_iter()
        .chain([f64::from_bits(1), -1.0, 3.0, f64::MAX, -f64::MAX, 1e300, 0.1]);
    let mut numbers = numbers.cycle();
    let mid = std::array::from_fn(|_| numbers.next().unwrap_or(1.0));
    let input = Balls::<ROW_STATES>::new(mid, [0.0; ROW_STATES]);
    let mut evaluator = Evaluator::new(&first, Ball::<ROW_STATES>);
    evaluator.run(std::slice::from_ref(&input));
    for vectors in [InstructionSet::Avx2, InstructionSet::Avx512] {
        let extent = InputExtent { ends: [f64::MIN, f64::MAX], radius: 0.0 };
        let Some(engine) =
            BallEngine::with_vectors(&[extent], &first, &[], (&second, &[]), vectors)
        else {
            continue;
        };
        let mut runner = engine.runner();
        runner.inputs_mut()[0] = [RowBlock(input.mid), RowBlock(input.rad)];
        runner.run();
        for (index, expected) in evaluator.outputs().enumerate() {
            let [mid, rad] = runner.output(engine.computed() + index);
            for lane in 0..ROW_STATES {
                let found = [mid.0[lane], rad.0[lane]];
                let own = [expected.mid[lane], expected.rad[lane]];
                let x = input.mid[lane];
                assert!(same_ball(found, own), "output {index} at {x}: {found:?}, not {own:?}");
            }
        }
    }
}
