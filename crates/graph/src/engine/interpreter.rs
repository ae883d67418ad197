//! The interpreter: the reference for the results of a program, in f64.
//!
//! Steps run one at a time over a row of lanes. The last result stays in registers; where only the
//! next step reads it, it is never stored.

#![allow(clippy::needless_range_loop, reason = "loops over groups are unrolled")]

use super::program::{PairOperation, ProgramStep, StepProgram, Sum, Value};
use super::vector::{BlockKernel, Vector, with_vectors};
use super::{ROW_STATES, RowBlock};
use crate::graph::InstructionSet;
use crate::number::{BinaryOperation, UnaryFunction};

/// Number of vectors of a result; every machine has registers for two operands of this size.
const GROUP: usize = 8;

/// Operation of a step on its arguments x, y, z; x may be the last result.
#[derive(Clone, Copy, Debug)]
enum StepKind {
    /// x + y
    Add,
    /// x - y
    Sub,
    /// y - x
    SubFrom,
    /// x y
    Mul,
    /// x y + z
    MulAdd,
    /// x y - z
    MulSub,
    /// z - x y
    MulSubFrom,
    /// y z + x
    AddMul,
    /// y z - x
    SubFromMul,
    /// x - y z
    SubMul,
    /// A function of x, native to the processor or not.
    Function(UnaryFunction),
    /// x^y
    Pow,
    Pair(PairOperation),
}

/// One step over rows.
#[derive(Clone, Copy, Debug)]
struct Instruction {
    kind: StepKind,
    /// Row of x; `None` for the last result.
    x: Option<u32>,
    y: u32,
    z: u32,
    /// Row of the result; `None` where only the next step reads it.
    out: Option<u32>,
}

/// A program over numbered rows: inputs, constants, results.
#[derive(Debug)]
pub(super) struct InterpretedProgram {
    instructions: Vec<Instruction>,
    constants: Vec<f64>,
    inputs: usize,
    outputs: Vec<u32>,
    rows: usize,
}

impl InterpretedProgram {
    /// Lays out a program.
    pub(super) fn new(program: &StepProgram) -> Self {
        let (reads, is_output) = (program.reads(), program.is_output());
        let arranged: Vec<Arranged> =
            (0..program.steps.len()).map(|index| Arranged::new(program, index)).collect();
        let is_stored = |step: usize| {
            let is_carried = arranged.get(step + 1).is_some_and(|next| next.takes_last);
            is_output[step] || !is_carried || reads[step].len() > 1
        };
        let first = (program.inputs + program.constants.len()) as u32;
        let mut row_of = vec![0; program.steps.len()];
        let (mut free, mut rows): (Vec<u32>, u32) = (Vec::new(), first);
        let row = |value: Value, row_of: &[u32]| match value {
            Value::Input(input) => input,
            Value::Constant(constant) => program.inputs as u32 + constant,
            Value::Step(step) => row_of[step as usize],
        };
        let mut instructions = Vec::with_capacity(arranged.len());
        for (index, Arranged { kind, arguments, takes_last }) in arranged.iter().enumerate() {
            let [x, y, z] = arguments.map(|argument| row(argument, &row_of));
            for (k, argument) in arguments.iter().enumerate() {
                let Value::Step(step) = *argument else { continue };
                let step = step as usize;
                let is_last = reads[step].last() == Some(&(index as u32));
                let is_again = arguments[..k].contains(argument);
                if is_last && !is_again && !is_output[step] && is_stored(step) {
                    free.push(row_of[step]);
                }
            }
            let out = is_stored(index).then(|| {
                free.pop().unwrap_or_else(|| {
                    rows += 1;
                    rows - 1
                })
            });
            row_of[index] = out.unwrap_or(0);
            instructions.push(Instruction {
                kind: *kind,
                x: (!takes_last).then_some(x),
                y,
                z,
                out,
            });
        }
        InterpretedProgram {
            instructions,
            constants: program.constants.clone(),
            inputs: program.inputs,
            outputs: program.outputs.iter().map(|output| row(*output, &row_of)).collect(),
            rows: rows as usize,
        }
    }

    /// Memory of a run, with the constants in place.
    pub(super) fn rows(&self) -> Vec<RowBlock> {
        let mut rows = vec![RowBlock([0.0; ROW_STATES]); self.rows];
        for (row, constant) in rows[self.inputs..].iter_mut().zip(&self.constants) {
            row.0 = [*constant; ROW_STATES];
        }
        rows
    }

    /// Row of an output.
    pub(super) fn output(&self, index: usize) -> usize {
        self.outputs[index] as usize
    }

    /// Runs the program once over its rows.
    pub(super) fn run(&self, vectors: InstructionSet, rows: &mut [RowBlock]) {
        with_vectors(vectors, Run { instructions: &self.instructions, rows });
    }
}

/// Step arranged to take the last result as its first argument, if possible.
struct Arranged {
    kind: StepKind,
    arguments: [Value; 3],
    takes_last: bool,
}

impl Arranged {
    fn new(program: &StepProgram, index: usize) -> Self {
        let last = index.checked_sub(1).map(|last| Value::Step(last as u32));
        let is_last = |value: Value| Some(value) == last;
        // Unused arguments repeat the first one.
        let (kind, arguments) = match program.steps[index] {
            ProgramStep::Unary(function, a) => (StepKind::Function(function), [a; 3]),
            ProgramStep::Pair(operation, a, b) => (StepKind::Pair(operation), [a, b, a]),
            ProgramStep::Binary(operation, a, b) => match operation {
                BinaryOperation::Pow => (StepKind::Pow, [a, b, a]),
                BinaryOperation::Add if is_last(b) => (StepKind::Add, [b, a, b]),
                BinaryOperation::Add => (StepKind::Add, [a, b, a]),
                BinaryOperation::Sub if is_last(b) => (StepKind::SubFrom, [b, a, b]),
                BinaryOperation::Sub => (StepKind::Sub, [a, b, a]),
                BinaryOperation::Mul if is_last(b) => (StepKind::Mul, [b, a, b]),
                BinaryOperation::Mul => (StepKind::Mul, [a, b, a]),
            },
            ProgramStep::Fused(sum, [a, b, c]) if is_last(c) => match sum {
                Sum::Plus => (StepKind::AddMul, [c, a, b]),
                Sum::Minus => (StepKind::SubFromMul, [c, a, b]),
                Sum::From => (StepKind::SubMul, [c, a, b]),
            },
            ProgramStep::Fused(sum, [a, b, c]) => {
                let kind = match sum {
                    Sum::Plus => StepKind::MulAdd,
                    Sum::Minus => StepKind::MulSub,
                    Sum::From => StepKind::MulSubFrom,
                };
                (kind, if is_last(b) { [b, a, c] } else { [a, b, c] })
            }
        };
        let read_twice =
            program.steps[index].arguments().filter(|a| *a == arguments[0]).count() > 1;
        Self { kind, arguments, takes_last: is_last(arguments[0]) && !read_twice }
    }
}

/// Instructions over rows, with the vector type still to be chosen.
struct Run<'r> {
    instructions: &'r [Instruction],
    rows: &'r mut [RowBlock],
}

impl BlockKernel for Run<'_> {
    #[inline(always)]
    fn run<V: Vector>(self) {
        let Self { instructions, rows } = self;
        for start in (0..ROW_STATES).step_by(GROUP * V::LANES) {
            let mut last = [V::splat(0.0); GROUP];
            for instruction in instructions {
                let x = match instruction.x {
                    Some(row) => read(rows, row, start),
                    None => last,
                };
                let (y, z) = (instruction.y, instruction.z);
                last = match instruction.kind {
                    StepKind::Add => zip(x, read(rows, y, start), V::add),
                    StepKind::Sub => zip(x, read(rows, y, start), V::sub),
                    StepKind::SubFrom => zip(read(rows, y, start), x, V::sub),
                    StepKind::Mul => zip(x, read(rows, y, start), V::mul),
                    StepKind::MulAdd => {
                        zip3(x, read(rows, y, start), read(rows, z, start), V::mul_add)
                    }
                    StepKind::MulSub => {
                        zip3(x, read(rows, y, start), read(rows, z, start), V::mul_sub)
                    }
                    StepKind::MulSubFrom => {
                        zip3(x, read(rows, y, start), read(rows, z, start), V::neg_mul_add)
                    }
                    StepKind::AddMul => {
                        zip3(read(rows, y, start), read(rows, z, start), x, V::mul_add)
                    }
                    StepKind::SubFromMul => {
                        zip3(read(rows, y, start), read(rows, z, start), x, V::mul_sub)
                    }
                    StepKind::SubMul => {
                        zip3(read(rows, y, start), read(rows, z, start), x, V::neg_mul_add)
                    }
                    StepKind::Function(function) => match function {
                        UnaryFunction::Neg => each(x, V::neg),
                        UnaryFunction::Recip => zip([V::splat(1.0); GROUP], x, V::div),
                        UnaryFunction::Sqrt => each(x, V::sqrt),
                        UnaryFunction::Abs => each(x, V::abs),
                        UnaryFunction::Exp => by_lane(x, x, |x, _| libm::exp(x)),
                        UnaryFunction::Ln => by_lane(x, x, |x, _| libm::log(x)),
                        UnaryFunction::Sin => by_lane(x, x, |x, _| libm::sin(x)),
                        UnaryFunction::Cos => by_lane(x, x, |x, _| libm::cos(x)),
                        UnaryFunction::Atan => by_lane(x, x, |x, _| libm::atan(x)),
                    },
                    StepKind::Pow => by_lane(x, read(rows, y, start), libm::pow),
                    StepKind::Pair(operation) => {
                        by_lane(x, read(rows, y, start), |x, y| operation.of(x, y))
                    }
                };
                if let Some(row) = instruction.out {
                    let to = &mut rows[row as usize].0[start..][..GROUP * V::LANES];
                    for k in 0..GROUP {
                        last[k].store(&mut to[k * V::LANES..]);
                    }
                }
            }
        }
    }
}

// The functions below use loops, and functions by name: a closure, or a function of the standard
// library, would be compiled without the instructions that the vectors need.

#[inline(always)]
fn read<V: Vector>(rows: &[RowBlock], row: u32, start: usize) -> [V; GROUP] {
    let lanes = &rows[row as usize].0[start..][..GROUP * V::LANES];
    let mut group = [V::splat(0.0); GROUP];
    for k in 0..GROUP {
        group[k] = V::load(&lanes[k * V::LANES..]);
    }
    group
}

#[inline(always)]
fn each<V: Vector>(mut x: [V; GROUP], f: impl Fn(V) -> V) -> [V; GROUP] {
    for k in 0..GROUP {
        x[k] = f(x[k]);
    }
    x
}

#[inline(always)]
fn zip<V: Vector>(mut x: [V; GROUP], y: [V; GROUP], f: impl Fn(V, V) -> V) -> [V; GROUP] {
    for k in 0..GROUP {
        x[k] = f(x[k], y[k]);
    }
    x
}

#[inline(always)]
fn zip3<V: Vector>(
    mut x: [V; GROUP],
    y: [V; GROUP],
    z: [V; GROUP],
    f: impl Fn(V, V, V) -> V,
) -> [V; GROUP] {
    for k in 0..GROUP {
        x[k] = f(x[k], y[k], z[k]);
    }
    x
}

/// Applies a function that is not an instruction, one lane after the other.
#[inline(always)]
fn by_lane<V: Vector>(mut x: [V; GROUP], y: [V; GROUP], f: impl Fn(f64, f64) -> f64) -> [V; GROUP] {
    for k in 0..GROUP {
        let (mut of_x, mut of_y) = ([0.0; ROW_STATES], [0.0; ROW_STATES]);
        x[k].store(&mut of_x);
        y[k].store(&mut of_y);
        for lane in 0..V::LANES {
            of_x[lane] = f(of_x[lane], of_y[lane]);
        }
        x[k] = V::load(&of_x);
    }
    x
}
