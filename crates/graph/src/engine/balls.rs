//! Tapes over balls in machine code: midpoints and radii as steps of one program.
//!
//! The formulas are those of the domain [`Ball`](crate::number::ball::Ball), operation by operation
//! and in the same order, so that every midpoint and radius has the same bits; only terms that are
//! zero because a constant is exact are left out. Nothing is fused.

use std::sync::Arc;

use rustc_hash::FxHashMap;

use super::machine::{MachineProgram, Memory};
use super::program::{PairOperation, ProgramStep, StepProgram, Value};
use super::{ROW_STATES, RowBlock};
use crate::graph::{Instruction, InstructionSet, Tape, widest};
use crate::number::ball::{TINY, UNIT, WIDER, about};
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};

/// Largest number of steps: longer code leaves the second-level cache, and an evaluator that reads
/// its instructions once for all lanes is faster.
const MOST_STEPS: usize = 1 << 14;

/// The largest number whose reciprocal overflows, 2⁻¹⁰²⁴.
const OVERFLOWING: f64 = f64::MIN_POSITIVE / 4.0;

/// Two tapes over balls, the second on the results of the first, in machine code; clones share it.
#[derive(Clone, Debug)]
pub struct BallEngine(Arc<BallCode>);

#[derive(Debug)]
struct BallCode {
    machine: MachineProgram,
    /// Whether each input is exact.
    exact: Vec<bool>,
    /// Number of outputs of the first tape that are outputs of the code.
    computed: usize,
}

impl BallEngine {
    /// Prepares two tapes; of each input it is said whether it is exact, so that its radius, which
    /// must be 0, is never read. The inputs of the second tape are the outputs of the first,
    /// followed by `further` numbers. `None` where their numbers differ, where the processor or the
    /// system allows no machine code, or a tape has functions that are not processor instructions or
    /// is too long.
    pub fn new(
        exact: Vec<bool>,
        first: &Tape,
        further: &[Rational],
        second: &Tape,
    ) -> Option<Self> {
        Self::with_vectors(exact, first, further, second, widest())
    }

    pub(super) fn with_vectors(
        exact: Vec<bool>,
        first: &Tape,
        further: &[Rational],
        second: &Tape,
        vectors: InstructionSet,
    ) -> Option<Self> {
        let (program, computed) = program(&exact, first, further, second)?;
        let machine = MachineProgram::new(&program, vectors)?;
        Some(Self(Arc::new(BallCode { machine, exact, computed })))
    }

    /// Number of outputs of the first tape that are computed, and not inputs or constants.
    pub fn computed(&self) -> usize {
        self.0.computed
    }

    /// Memory to run in, one for each thread.
    pub fn runner(&self) -> BallRunner {
        BallRunner {
            code: Arc::clone(&self.0),
            inputs: vec![[RowBlock([0.0; ROW_STATES]); 2]; self.0.exact.len()],
            memory: self.0.machine.memory(),
        }
    }
}

/// Memory in which a [`BallEngine`] runs.
#[derive(Debug)]
pub struct BallRunner {
    code: Arc<BallCode>,
    inputs: Vec<[RowBlock; 2]>,
    memory: Memory,
}

impl BallRunner {
    /// Midpoints and radii of the inputs that were not said to be exact.
    pub fn inexact(&self) -> impl Iterator<Item = &[RowBlock; 2]> {
        let inputs = self.inputs.iter().zip(&self.code.exact);
        inputs.filter(|(_, is_exact)| !**is_exact).map(|(input, _)| input)
    }

    /// Midpoints and radii of the inputs, to be filled.
    pub fn inputs_mut(&mut self) -> &mut [[RowBlock; 2]] {
        &mut self.inputs
    }

    /// Whether all inputs that were said to be exact are.
    pub fn is_exact(&self) -> bool {
        let exact = self.inputs.iter().zip(&self.code.exact).filter(|(_, is_exact)| **is_exact);
        // Without the sign no bit of 0 is set; sums of floats would wait for one another.
        let bits = |rad: &RowBlock| rad.0.iter().fold(0, |bits, one| bits | one.to_bits() << 1);
        exact.into_iter().all(|([_, rad], _)| bits(rad) == 0)
    }

    /// Computes the outputs. Inputs that were said to be exact must be.
    pub fn run(&mut self) {
        debug_assert!(self.is_exact(), "no radius is left out");
        self.code.machine.run(self.inputs.as_flattened(), &mut self.memory);
    }

    /// Midpoints and radii of an output: those that the first tape computes, and then those of the
    /// second.
    pub fn output(&self, index: usize) -> [&RowBlock; 2] {
        [self.memory.output(2 * index), self.memory.output(2 * index + 1)]
    }
}

/// Makes the program of two tapes, with the number of outputs of the first that are computed; `None`
/// for functions that are not instructions.
fn program(
    exact: &[bool],
    first: &Tape,
    further: &[Rational],
    second: &Tape,
) -> Option<(StepProgram, usize)> {
    let mut builder = Builder::default();
    let draws = (0..).zip(exact).map(|(input, is_exact)| BallValue {
        mid: Value::Input(2 * input),
        rad: (!is_exact).then_some(Value::Input(2 * input + 1)),
    });
    let made = builder.tape(first, draws.collect())?;
    let further: Vec<BallValue> = further.iter().map(|value| builder.enclosed(value)).collect();
    let results = builder.tape(second, [&made[..], &further].concat())?;
    let is_computed = |ball: &&BallValue| matches!(ball.mid, Value::Step(_));
    let computed: Vec<BallValue> = made.iter().filter(is_computed).copied().collect();
    let outputs = [&computed[..], &results].concat();
    let zero = builder.constant(0.0);
    let parts = |ball: &BallValue| [ball.mid, ball.rad.unwrap_or(zero)];
    let outputs = outputs.iter().flat_map(parts).collect();
    let Builder { steps, constants, .. } = builder;
    let program = StepProgram { inputs: 2 * first.inputs(), constants, steps, outputs };
    (program.steps.len() <= MOST_STEPS).then_some((program, computed.len()))
}

/// A ball under construction; the radius of an exact constant is 0.
#[derive(Clone, Copy, Debug)]
struct BallValue {
    mid: Value,
    rad: Option<Value>,
}

/// A program under construction; equal steps are one.
#[derive(Default)]
struct Builder {
    steps: Vec<ProgramStep>,
    known: FxHashMap<ProgramStep, u32>,
    constants: Vec<f64>,
    /// Places of constants by their bits.
    places: FxHashMap<u64, u32>,
}

impl Builder {
    /// Adds the steps of a tape with these inputs; returns its outputs.
    fn tape(&mut self, tape: &Tape, inputs: Vec<BallValue>) -> Option<Vec<BallValue>> {
        let mut held = inputs;
        if held.len() != tape.inputs() {
            return None;
        }
        held.extend(tape.constants().iter().map(|value| self.enclosed(value)));
        for instruction in tape.instructions() {
            let (value, out) = match *instruction {
                Instruction::Unary { function, a, out } => {
                    (self.unary(function, held[a as usize])?, out)
                }
                Instruction::Binary { operation, a, b, out } => {
                    (self.binary(operation, held[a as usize], held[b as usize])?, out)
                }
                Instruction::Power { .. } => return None,
            };
            match held.get_mut(out as usize) {
                Some(place) => *place = value,
                None => held.push(value),
            }
        }
        Some(tape.output_slots().iter().map(|slot| held[*slot as usize]).collect())
    }

    fn unary(&mut self, function: UnaryFunction, x: BallValue) -> Option<BallValue> {
        let of = |builder: &mut Self| builder.step(ProgramStep::Unary(function, x.mid));
        match function {
            UnaryFunction::Neg | UnaryFunction::Abs => Some(BallValue { mid: of(self), ..x }),
            UnaryFunction::Recip => {
                let (mid, size) = (of(self), self.size(x.mid));
                let Some(rad) = x.rad else {
                    let rounded = self.rounded(None, mid);
                    // The spread |z| 0/|a| is 0, but it has no value where z is infinite.
                    let least = self.constant(OVERFLOWING);
                    let beyond = self.pair(PairOperation::NotGreater, size, least);
                    return Some(BallValue {
                        mid,
                        rad: Some(self.pair(PairOperation::Or, rounded, beyond)),
                    });
                };
                let room = self.sum(BinaryOperation::Sub, size, rad);
                let (quotient, far) =
                    (self.pair(PairOperation::Quotient, rad, room), self.size(mid));
                let spread = self.product(far, quotient);
                let rounded = self.rounded(Some(spread), mid);
                let zero = self.constant(0.0);
                let beyond = self.pair(PairOperation::NotGreater, room, zero);
                Some(BallValue { mid, rad: Some(self.pair(PairOperation::Or, rounded, beyond)) })
            }
            UnaryFunction::Sqrt => {
                let (mid, zero) = (of(self), self.constant(0.0));
                let Some(rad) = x.rad else {
                    let error = self.unit_times(mid);
                    let widened = self.widened(error);
                    let below = self.pair(PairOperation::NotAtLeast, x.mid, zero);
                    return Some(BallValue {
                        mid,
                        rad: Some(self.pair(PairOperation::Or, widened, below)),
                    });
                };
                let quotient = self.pair(PairOperation::Quotient, rad, mid);
                let is_wide = self.pair(PairOperation::Greater, rad, zero);
                let spread = self.pair(PairOperation::And, quotient, is_wide);
                let error = self.unit_times(mid);
                let sum = self.sum(BinaryOperation::Add, spread, error);
                let widened = self.widened(sum);
                let below = self.pair(PairOperation::NotAtLeast, x.mid, rad);
                Some(BallValue { mid, rad: Some(self.pair(PairOperation::Or, widened, below)) })
            }
            UnaryFunction::Exp
            | UnaryFunction::Ln
            | UnaryFunction::Sin
            | UnaryFunction::Cos
            | UnaryFunction::Atan => None,
        }
    }

    fn binary(
        &mut self,
        operation: BinaryOperation,
        x: BallValue,
        y: BallValue,
    ) -> Option<BallValue> {
        let mid = match operation {
            BinaryOperation::Pow => return None,
            _ => self.step(ProgramStep::Binary(operation, x.mid, y.mid)),
        };
        let terms = match operation {
            BinaryOperation::Mul => {
                let (size_x, size_y) = (self.size(x.mid), self.size(y.mid));
                let of_y = y.rad.map(|rad| self.product(size_x, rad));
                let of_x = x.rad.map(|rad| self.product(size_y, rad));
                let both = x.rad.zip(y.rad).map(|(a, b)| self.product(a, b));
                [of_y, of_x, both]
            }
            _ => [x.rad, y.rad, None],
        };
        let spread = terms
            .into_iter()
            .flatten()
            .reduce(|sum, term| self.sum(BinaryOperation::Add, sum, term));
        Some(BallValue { mid, rad: Some(self.rounded(spread, mid)) })
    }

    /// Widens `spread + UNIT |z|`.
    fn rounded(&mut self, spread: Option<Value>, z: Value) -> Value {
        let size = self.size(z);
        let error = self.unit_times(size);
        let sum = spread.map_or(error, |spread| self.sum(BinaryOperation::Add, spread, error));
        self.widened(sum)
    }

    fn widened(&mut self, radius: Value) -> Value {
        let (factor, tiny) = (self.constant(WIDER), self.constant(TINY));
        let product = self.product(radius, factor);
        self.sum(BinaryOperation::Add, product, tiny)
    }

    fn unit_times(&mut self, x: Value) -> Value {
        let unit = self.constant(UNIT);
        self.product(unit, x)
    }

    fn size(&mut self, x: Value) -> Value {
        self.step(ProgramStep::Unary(UnaryFunction::Abs, x))
    }

    fn product(&mut self, x: Value, y: Value) -> Value {
        self.step(ProgramStep::Binary(BinaryOperation::Mul, x, y))
    }

    fn sum(&mut self, operation: BinaryOperation, x: Value, y: Value) -> Value {
        self.step(ProgramStep::Binary(operation, x, y))
    }

    fn pair(&mut self, operation: PairOperation, x: Value, y: Value) -> Value {
        self.step(ProgramStep::Pair(operation, x, y))
    }

    fn enclosed(&mut self, value: &Rational) -> BallValue {
        let (mid, rad) = about(value.to_f64());
        let rad = (rad != 0.0).then(|| self.constant(rad));
        BallValue { mid: self.constant(mid), rad }
    }

    fn constant(&mut self, value: f64) -> Value {
        let place = *self.places.entry(value.to_bits()).or_insert_with(|| {
            self.constants.push(value);
            self.constants.len() as u32 - 1
        });
        Value::Constant(place)
    }

    fn step(&mut self, step: ProgramStep) -> Value {
        let place = *self.known.entry(step).or_insert_with(|| {
            self.steps.push(step);
            self.steps.len() as u32 - 1
        });
        Value::Step(place)
    }
}
