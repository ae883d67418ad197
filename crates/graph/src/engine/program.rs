//! Tapes in single-assignment form: every step has a name, and products that only a sum reads are
//! fused with it.
//!
//! ```text
//! a b + c,  a b - c,  c - a b      rounded once
//! ```
//!
//! A negated difference is the opposite one: 0 where the tape has -0, and no other change. The
//! choice of fused products depends on the tape alone, and an engine without such an instruction
//! computes the same correctly rounded value: all engines give the same bits. A fused sum has one
//! rounding less than the tape in the domain `Float`.

use std::cmp::Ordering;

use crate::graph::{Instruction, Tape};
use crate::number::{BinaryOperation, UnaryFunction};

/// Number of steps of each kind in a run; steps of other kinds are not counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StepCounts {
    /// Products, those fused with a sum included.
    pub products: usize,
    /// Sums and differences on their own.
    pub sums: usize,
    /// Divisions.
    pub divisions: usize,
    /// Square roots.
    pub roots: usize,
}

/// Operand of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Value {
    Input(u32),
    Constant(u32),
    /// Result of an earlier step.
    Step(u32),
}

/// Sum of a product and a third value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Sum {
    /// a b + c
    Plus,
    /// a b - c
    Minus,
    /// c - a b
    From,
}

/// Operation that no tape has, for bounds of errors.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum PairOperation {
    /// a / b
    Quotient,
    /// Bits that are set in both.
    And,
    /// Bits that are set in one of them.
    Or,
    /// All bits where a > b, else none.
    Greater,
    /// All bits, which make a NaN, unless a > b; else none.
    NotGreater,
    /// All bits, which make a NaN, unless a ≥ b; else none.
    NotAtLeast,
}

impl PairOperation {
    /// Returns the result, for one lane.
    pub(super) fn of(self, a: f64, b: f64) -> f64 {
        let mask = |is_set: bool| f64::from_bits(if is_set { u64::MAX } else { 0 });
        match self {
            PairOperation::Quotient => a / b,
            PairOperation::And => f64::from_bits(a.to_bits() & b.to_bits()),
            PairOperation::Or => f64::from_bits(a.to_bits() | b.to_bits()),
            PairOperation::Greater => mask(a > b),
            PairOperation::NotGreater => mask(!a.partial_cmp(&b).is_some_and(Ordering::is_gt)),
            PairOperation::NotAtLeast => mask(!a.partial_cmp(&b).is_some_and(Ordering::is_ge)),
        }
    }
}

/// One step of a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum ProgramStep {
    Unary(UnaryFunction, Value),
    Binary(BinaryOperation, Value, Value),
    Pair(PairOperation, Value, Value),
    Fused(Sum, [Value; 3]),
}

impl ProgramStep {
    /// Values that the step reads, in order.
    pub(super) fn arguments(&self) -> impl Iterator<Item = Value> {
        let arguments = match *self {
            ProgramStep::Unary(_, a) => [Some(a), None, None],
            ProgramStep::Binary(_, a, b) | ProgramStep::Pair(_, a, b) => [Some(a), Some(b), None],
            ProgramStep::Fused(_, arguments) => arguments.map(Some),
        };
        arguments.into_iter().flatten()
    }

    pub(super) fn with_arguments(self, renamed: impl Fn(Value) -> Value) -> Self {
        match self {
            ProgramStep::Unary(function, a) => ProgramStep::Unary(function, renamed(a)),
            ProgramStep::Binary(operation, a, b) => {
                ProgramStep::Binary(operation, renamed(a), renamed(b))
            }
            ProgramStep::Pair(operation, a, b) => {
                ProgramStep::Pair(operation, renamed(a), renamed(b))
            }
            ProgramStep::Fused(sum, arguments) => ProgramStep::Fused(sum, arguments.map(renamed)),
        }
    }
}

/// Steps that compute outputs from inputs.
#[derive(Clone, Debug)]
pub(super) struct StepProgram {
    pub(super) inputs: usize,
    pub(super) constants: Vec<f64>,
    pub(super) steps: Vec<ProgramStep>,
    pub(super) outputs: Vec<Value>,
}

impl StepProgram {
    /// Converts a tape to a program.
    pub(super) fn new(tape: &Tape) -> Self {
        let inputs = tape.inputs();
        let fixed = inputs + tape.constants().len();
        let mut held: Vec<Value> = (0..fixed)
            .map(|slot| match slot.checked_sub(inputs) {
                None => Value::Input(slot as u32),
                Some(constant) => Value::Constant(constant as u32),
            })
            .collect();
        let mut constants: Vec<f64> =
            tape.constants().iter().map(|value| value.to_f64().0).collect();
        let mut steps = Vec::with_capacity(tape.operations());
        for instruction in tape.instructions() {
            let at = |slot: u32| held[slot as usize];
            let (step, out) = match *instruction {
                Instruction::Unary { function, a, out } => {
                    (ProgramStep::Unary(function, at(a)), out)
                }
                Instruction::Binary { operation, a, b, out } => {
                    (ProgramStep::Binary(operation, at(a), at(b)), out)
                }
                Instruction::Power { a, exponent, out } => {
                    constants.push(tape.exponents()[exponent as usize].to_f64().0);
                    let exponent = Value::Constant(constants.len() as u32 - 1);
                    (ProgramStep::Binary(BinaryOperation::Pow, at(a), exponent), out)
                }
            };
            let out = out as usize;
            if held.len() <= out {
                held.resize(out + 1, Value::Input(0));
            }
            held[out] = Value::Step(steps.len() as u32);
            steps.push(step);
        }
        let outputs = tape.output_slots().iter().map(|slot| held[*slot as usize]).collect();
        Self { inputs, constants, steps, outputs }.fused().without_negations()
    }

    /// Number of steps of each kind.
    pub(super) fn counts(&self) -> StepCounts {
        let mut counts = StepCounts::default();
        for step in &self.steps {
            match step {
                ProgramStep::Fused(..) | ProgramStep::Binary(BinaryOperation::Mul, ..) => {
                    counts.products += 1;
                }
                ProgramStep::Binary(BinaryOperation::Add | BinaryOperation::Sub, ..) => {
                    counts.sums += 1;
                }
                ProgramStep::Unary(UnaryFunction::Recip, _)
                | ProgramStep::Pair(PairOperation::Quotient, ..) => counts.divisions += 1,
                ProgramStep::Unary(UnaryFunction::Sqrt, _) => counts.roots += 1,
                ProgramStep::Unary(..)
                | ProgramStep::Pair(..)
                | ProgramStep::Binary(BinaryOperation::Pow, ..) => {}
            }
        }
        counts
    }

    /// Steps that read each step's result, in order; a step that reads it twice occurs twice.
    pub(super) fn reads(&self) -> Vec<Vec<u32>> {
        let mut reads = vec![Vec::new(); self.steps.len()];
        for (index, step) in self.steps.iter().enumerate() {
            for argument in step.arguments() {
                if let Value::Step(step) = argument {
                    reads[step as usize].push(index as u32);
                }
            }
        }
        reads
    }

    /// Whether each step's result is an output.
    pub(super) fn is_output(&self) -> Vec<bool> {
        let mut is_output = vec![false; self.steps.len()];
        for output in &self.outputs {
            if let Value::Step(step) = *output {
                is_output[step as usize] = true;
            }
        }
        is_output
    }

    /// Fuses products that are read once, by a sum or a difference, with their reader.
    fn fused(mut self) -> Self {
        let (reads, is_output) = (self.reads(), self.is_output());
        let mut absorbed = vec![false; self.steps.len()];
        for index in 0..self.steps.len() {
            let ProgramStep::Binary(
                operation @ (BinaryOperation::Add | BinaryOperation::Sub),
                a,
                b,
            ) = self.steps[index]
            else {
                continue;
            };
            let product = |value: Value| match value {
                Value::Step(step) => match self.steps[step as usize] {
                    ProgramStep::Binary(BinaryOperation::Mul, x, y)
                        if reads[step as usize].len() == 1 && !is_output[step as usize] =>
                    {
                        Some((step as usize, x, y))
                    }
                    _ => None,
                },
                _ => None,
            };
            let (of_a, of_b) = (product(a), product(b));
            // Of two, the later: its factors are needed for a shorter time.
            let later = of_a.map(|found| found.0) < of_b.map(|found| found.0);
            let (step, sum, [x, y, z]) = match (of_a, of_b) {
                (_, Some((step, x, y))) if later => {
                    let sum = if operation == BinaryOperation::Add { Sum::Plus } else { Sum::From };
                    (step, sum, [x, y, a])
                }
                (Some((step, x, y)), _) => {
                    let sum =
                        if operation == BinaryOperation::Add { Sum::Plus } else { Sum::Minus };
                    (step, sum, [x, y, b])
                }
                _ => continue,
            };
            absorbed[step] = true;
            self.steps[index] = ProgramStep::Fused(sum, [x, y, z]);
        }
        self.without(&absorbed)
    }

    /// Replaces a difference that is only read to be negated by the opposite difference, and a multiple
    /// by the opposite one.
    fn without_negations(mut self) -> Self {
        let (reads, is_output) = (self.reads(), self.is_output());
        let mut absorbed = vec![false; self.steps.len()];
        for index in 0..self.steps.len() {
            let ProgramStep::Unary(UnaryFunction::Neg, Value::Step(negated)) = self.steps[index]
            else {
                continue;
            };
            let negated = negated as usize;
            if reads[negated].len() > 1 || is_output[negated] {
                continue;
            }
            self.steps[index] = match self.steps[negated] {
                ProgramStep::Binary(BinaryOperation::Sub, a, b) => {
                    ProgramStep::Binary(BinaryOperation::Sub, b, a)
                }
                ProgramStep::Fused(Sum::Minus, arguments) => {
                    ProgramStep::Fused(Sum::From, arguments)
                }
                ProgramStep::Fused(Sum::From, arguments) => {
                    ProgramStep::Fused(Sum::Minus, arguments)
                }
                ProgramStep::Binary(BinaryOperation::Mul, a, Value::Constant(constant))
                | ProgramStep::Binary(BinaryOperation::Mul, Value::Constant(constant), a) => {
                    self.constants.push(-self.constants[constant as usize]);
                    let opposite = Value::Constant(self.constants.len() as u32 - 1);
                    ProgramStep::Binary(BinaryOperation::Mul, a, opposite)
                }
                _ => continue,
            };
            absorbed[negated] = true;
        }
        self.without(&absorbed)
    }

    /// Removes the steps that no output needs.
    pub(super) fn without_unread(self) -> Self {
        let mut unread: Vec<bool> = self.is_output().iter().map(|is_output| !is_output).collect();
        for (index, step) in self.steps.iter().enumerate().rev() {
            for argument in step.arguments() {
                if let (Value::Step(read), false) = (argument, unread[index]) {
                    unread[read as usize] = false;
                }
            }
        }
        self.without(&unread)
    }

    /// Removes the steps marked, which are no longer read.
    fn without(self, left_out: &[bool]) -> Self {
        let mut place = Vec::with_capacity(left_out.len());
        let mut kept = 0;
        for left_out in left_out {
            place.push(Value::Step(kept));
            kept += u32::from(!left_out);
        }
        let renamed = |value: Value| match value {
            Value::Step(step) => place[step as usize],
            other => other,
        };
        let steps = self.steps.iter().zip(left_out).filter(|(_, left_out)| !**left_out);
        let steps = steps.map(|(step, _)| step.with_arguments(renamed)).collect();
        let outputs = self.outputs.iter().map(|output| renamed(*output)).collect();
        Self { steps, outputs, ..self }
    }
}
