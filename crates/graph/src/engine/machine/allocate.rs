//! Register allocation for the vectors of a program, by one scan over their steps.
//!
//! Inputs and constants stay in memory: one operand of an instruction may be there, at no cost as
//! long as there are two loads for two instructions. A result is given a register; where none is
//! free, the one whose next use is furthest goes to the frame, and is read from there.

use super::super::ROW_STATES;
use super::super::program::{PairOperation, ProgramStep, StepProgram, Sum, Value};
use super::constants::Constants;
use super::encode::{Area, Assembler, Assembly, VectorLocation};
use super::interleave::Interleaved;
use crate::assembler::{Comparison, OperandOrder, PairInstruction, Register, SumSigns, Width};
use crate::number::{BinaryOperation, UnaryFunction};

/// Assembles a program; also returns the constants at the beginning of its frame. `None` where the
/// program has a function that is not an instruction.
pub(super) fn assemble(program: &StepProgram, width: Width) -> Option<(Assembly, Vec<f64>)> {
    let in_row = ROW_STATES / width.numbers();
    // Sixteen registers are too few for two vectors.
    let vectors = if width == Width::Eight { in_row } else { 1 };
    let interleaved = Interleaved::new(program, vectors);
    let mut scan = Scan::new(&interleaved, Constants::new(program, width), width);
    scan.keep_constants();
    for (index, (copy, step)) in interleaved.steps.iter().enumerate() {
        scan.copy = *copy;
        scan.step(index, step)?;
    }
    for (copy, outputs) in interleaved.outputs.iter().enumerate() {
        scan.copy = copy;
        for (index, output) in outputs.iter().enumerate() {
            if !matches!(output, Value::Step(_)) {
                // After the last step all registers but those of constants are free.
                scan.assembler.load(0, scan.place(*output));
                scan.assembler.store(Area::Outputs, scan.in_row(index as u32), 0);
            }
        }
    }
    Some((scan.assembler.finish(interleaved.copies), scan.constants.values))
}

/// State of the scan.
struct Scan {
    assembler: Assembler,
    constants: Constants,
    vectors_in_row: u32,
    /// Vector of the present step.
    copy: usize,
    /// Steps that read each result.
    reads: Vec<Vec<u32>>,
    /// Outputs equal to each result.
    outputs: Vec<Vec<u32>>,
    /// Place of each result made so far.
    places: Vec<VectorLocation>,
    /// Result in each register.
    held: Vec<Option<u32>>,
    /// Next free vector of the frame.
    spills: u32,
    free_spills: Vec<u32>,
}

impl Scan {
    fn new(program: &Interleaved, constants: Constants, width: Width) -> Self {
        let steps = program.steps.len();
        let mut outputs = vec![Vec::new(); steps];
        for (index, output) in program.outputs.iter().flat_map(|one| one.iter().enumerate()) {
            if let Value::Step(step) = *output {
                outputs[step as usize].push(index as u32);
            }
        }
        Self {
            assembler: Assembler::new(width),
            spills: constants.values.len() as u32,
            vectors_in_row: (ROW_STATES / width.numbers()) as u32,
            copy: 0,
            reads: program.reads(),
            outputs,
            places: vec![VectorLocation::Register(0); steps],
            held: vec![None; width.registers() - constants.kept.len()],
            constants,
            free_spills: Vec::new(),
        }
    }

    fn step(&mut self, index: usize, step: &ProgramStep) -> Option<()> {
        let target = match *step {
            ProgramStep::Unary(function, a) => match (function, self.constants.of(function)) {
                (UnaryFunction::Neg, Some(sign)) => self.pair(index, PairInstruction::Xor, a, sign),
                (UnaryFunction::Abs, Some(rest)) => self.pair(index, PairInstruction::And, a, rest),
                (UnaryFunction::Recip, Some(one)) => self.pair(index, PairInstruction::Div, one, a),
                (UnaryFunction::Sqrt, _) => {
                    let source = self.place(a);
                    self.release(index, &[a]);
                    let target = self.take(index, &[]);
                    self.assembler.square_root(target, source);
                    target
                }
                _ => return None,
            },
            ProgramStep::Binary(operation, a, b) => match operation {
                BinaryOperation::Add => self.pair(index, PairInstruction::Add, a, b),
                BinaryOperation::Sub => self.pair(index, PairInstruction::Sub, a, b),
                BinaryOperation::Mul => self.pair(index, PairInstruction::Mul, a, b),
                BinaryOperation::Pow => return None,
            },
            ProgramStep::Pair(operation, a, b) => {
                let pair = match operation {
                    PairOperation::Quotient => PairInstruction::Div,
                    PairOperation::And => PairInstruction::And,
                    PairOperation::Or => PairInstruction::Or,
                    PairOperation::Greater => PairInstruction::Compare(Comparison::Greater),
                    PairOperation::NotGreater => PairInstruction::Compare(Comparison::NotGreater),
                    PairOperation::NotAtLeast => PairInstruction::Compare(Comparison::NotAtLeast),
                };
                self.pair(index, pair, a, b)
            }
            ProgramStep::Fused(sum, arguments) => self.fused(index, sum, arguments),
        };
        // Not before the instruction: it may read a slot that would otherwise be reused.
        self.release_spills(index, step);
        self.places[index] = VectorLocation::Register(target);
        for output in &self.outputs[index] {
            let place = self.in_row(*output);
            self.assembler.store(Area::Outputs, place, target);
        }
        self.held[target as usize] = (!self.reads[index].is_empty()).then_some(index as u32);
        Some(())
    }

    /// Emits `a op b` into a register.
    fn pair(&mut self, index: usize, pair: PairInstruction, a: Value, b: Value) -> Register {
        let (mut x, mut y) = (self.place(a), self.place(b));
        let commutes = !matches!(
            pair,
            PairInstruction::Sub | PairInstruction::Div | PairInstruction::Compare(_)
        );
        if commutes && matches!((x, y), (VectorLocation::Memory(..), VectorLocation::Register(_))) {
            (x, y) = (y, x);
        }
        if let VectorLocation::Register(first) = x {
            self.release(index, &[a, b]);
            let target = self.take(index, &[]);
            self.assembler.pair(pair, target, first, y);
            return target;
        }
        let target = self.take(index, &[y]);
        self.release(index, &[a, b]);
        self.assembler.load(target, x);
        self.assembler.pair(pair, target, target, y);
        target
    }

    /// Emits `a b ± c` into a register, replacing one of its sources.
    fn fused(&mut self, index: usize, sum: Sum, arguments: [Value; 3]) -> Register {
        let signs = match sum {
            Sum::Plus => SumSigns::Add,
            Sum::Minus => SumSigns::Sub,
            Sum::From => SumSigns::NegAdd,
        };
        let places = arguments.map(|argument| self.place(argument));
        let in_memory = |k: &usize| matches!(places[*k], VectorLocation::Memory(..));
        // The source that the result replaces: one that is not read again; else one that must be
        // brought to a register anyway; else a copy of the third.
        let dying = (0..3).find(|k| !in_memory(k) && self.is_last_read(arguments[*k], index));
        let replaced = dying.or_else(|| (0..3).find(in_memory)).unwrap_or(2);
        let target = match places[replaced] {
            VectorLocation::Register(register) if dying.is_some() => register,
            place => {
                let target = self.take(index, &places);
                self.assembler.load(target, place);
                target
            }
        };
        // Of the other two, one may be in memory.
        let [u, v] = if replaced == 2 { [0, 1] } else { [1 - replaced, 2] };
        let (second, third, is_swapped) = match (places[u], places[v]) {
            (VectorLocation::Register(second), third) => (second, third, false),
            (third, VectorLocation::Register(second)) => (second, third, true),
            (first, third) => {
                let taken = [places[replaced], VectorLocation::Register(target)];
                let second = self.take(index, &taken);
                self.assembler.load(second, first);
                (second, third, false)
            }
        };
        let order = match (replaced, is_swapped) {
            (2, _) => OperandOrder::O231,
            (_, false) => OperandOrder::O213,
            (_, true) => OperandOrder::O132,
        };
        self.assembler.fused(order, signs, target, second, third);
        self.release(index, &arguments);
        target
    }

    /// Loads the constants that have registers, which follow those of results.
    fn keep_constants(&mut self) {
        for (place, constant) in self.constants.kept.iter().enumerate() {
            let register = (self.held.len() + place) as Register;
            self.assembler.load(register, VectorLocation::Memory(Area::Frame, *constant));
        }
    }

    /// Place of the present vector in a row.
    fn in_row(&self, row: u32) -> u32 {
        row * self.vectors_in_row + self.copy as u32
    }

    fn place(&self, value: Value) -> VectorLocation {
        match value {
            Value::Input(input) => VectorLocation::Memory(Area::Inputs, self.in_row(input)),
            Value::Constant(constant) => {
                match self.constants.kept.iter().position(|c| *c == constant) {
                    Some(place) => VectorLocation::Register((self.held.len() + place) as Register),
                    None => VectorLocation::Memory(Area::Frame, constant),
                }
            }
            Value::Step(step) => self.places[step as usize],
        }
    }

    fn is_last_read(&self, value: Value, index: usize) -> bool {
        match value {
            Value::Step(step) => self.reads[step as usize].last() == Some(&(index as u32)),
            _ => false,
        }
    }

    /// Frees the registers of values that are read for the last time.
    fn release(&mut self, index: usize, arguments: &[Value]) {
        for argument in arguments {
            if self.is_last_read(*argument, index)
                && let VectorLocation::Register(register) = self.place(*argument)
            {
                self.held[register as usize] = None;
            }
        }
    }

    /// Frees the vectors of the frame whose values were read for the last time.
    fn release_spills(&mut self, index: usize, step: &ProgramStep) {
        for argument in step.arguments() {
            if self.is_last_read(argument, index)
                && let VectorLocation::Memory(_, spill) = self.place(argument)
                && !self.free_spills.contains(&spill)
            {
                self.free_spills.push(spill);
            }
        }
    }

    /// Allots a register for a result, none of those in `taken`.
    fn take(&mut self, index: usize, taken: &[VectorLocation]) -> Register {
        let may_be =
            |register: &usize| !taken.contains(&VectorLocation::Register(*register as Register));
        let registers = || (0..self.held.len()).filter(may_be);
        if let Some(free) = registers().find(|register| self.held[*register].is_none()) {
            return free as Register;
        }
        let next_read = |register: &usize| {
            let reads = self.held[*register].map(|step| &self.reads[step as usize])?;
            reads.get(reads.partition_point(|read| *read as usize <= index)).copied()
        };
        // There are more registers than an instruction has operands.
        let register = registers().max_by_key(next_read).unwrap_or(0) as Register;
        if let Some(step) = self.held[register as usize].take() {
            let spill = self.free_spills.pop().unwrap_or_else(|| {
                self.spills += 1;
                self.spills - 1
            });
            self.assembler.store(Area::Frame, spill, register);
            self.places[step as usize] = VectorLocation::Memory(Area::Frame, spill);
        }
        register
    }
}
