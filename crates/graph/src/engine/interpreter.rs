//! The interpreter: the reference for the results of a program, in f64.
//!
//! Steps run one at a time over a row of lanes. The last result stays in registers; where only the
//! next step reads it, it is never stored.

#![allow(clippy::needless_range_loop, reason = "loops over groups are unrolled")]

use super::program::{Program, Step, Sum, Value};
use super::vector::{Vector, Work, with_vectors};
use super::{LANES, Row};
use crate::graph::Vectors;
use crate::number::{Function, Operation};

/// Number of vectors of a result; every machine has registers for two operands of this size.
const GROUP: usize = 8;

/// Operation of a step on its arguments x, y, z; x may be the last result.
#[derive(Clone, Copy, Debug)]
enum Kind {
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
    Function(Function),
    /// x^y
    Pow,
}

/// One step over rows.
#[derive(Clone, Copy, Debug)]
struct Instruction {
    kind: Kind,
    /// Row of x; `None` for the last result.
    x: Option<u32>,
    y: u32,
    z: u32,
    /// Row of the result; `None` where only the next step reads it.
    out: Option<u32>,
}

/// A program over numbered rows: inputs, constants, results.
#[derive(Debug)]
pub(super) struct Code {
    instructions: Vec<Instruction>,
    constants: Vec<f64>,
    inputs: usize,
    outputs: Vec<u32>,
    rows: usize,
}

impl Code {
    /// Lays out a program.
    pub(super) fn new(program: &Program) -> Self {
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
        Code {
            instructions,
            constants: program.constants.clone(),
            inputs: program.inputs,
            outputs: program.outputs.iter().map(|output| row(*output, &row_of)).collect(),
            rows: rows as usize,
        }
    }

    /// Memory of a run, with the constants in place.
    pub(super) fn rows(&self) -> Vec<Row> {
        let mut rows = vec![Row([0.0; LANES]); self.rows];
        for (row, constant) in rows[self.inputs..].iter_mut().zip(&self.constants) {
            row.0 = [*constant; LANES];
        }
        rows
    }

    /// Row of an output.
    pub(super) fn output(&self, index: usize) -> usize {
        self.outputs[index] as usize
    }

    /// Runs the program once over its rows.
    pub(super) fn run(&self, vectors: Vectors, rows: &mut [Row]) {
        with_vectors(vectors, Run { instructions: &self.instructions, rows });
    }
}

/// Step arranged to take the last result as its first argument, if possible.
struct Arranged {
    kind: Kind,
    arguments: [Value; 3],
    takes_last: bool,
}

impl Arranged {
    fn new(program: &Program, index: usize) -> Self {
        let last = index.checked_sub(1).map(|last| Value::Step(last as u32));
        let is_last = |value: Value| Some(value) == last;
        // Unused arguments repeat the first one.
        let (kind, arguments) = match program.steps[index] {
            Step::Unary(function, a) => (Kind::Function(function), [a; 3]),
            Step::Binary(operation, a, b) => match operation {
                Operation::Pow => (Kind::Pow, [a, b, a]),
                Operation::Add if is_last(b) => (Kind::Add, [b, a, b]),
                Operation::Add => (Kind::Add, [a, b, a]),
                Operation::Sub if is_last(b) => (Kind::SubFrom, [b, a, b]),
                Operation::Sub => (Kind::Sub, [a, b, a]),
                Operation::Mul if is_last(b) => (Kind::Mul, [b, a, b]),
                Operation::Mul => (Kind::Mul, [a, b, a]),
            },
            Step::Fused(sum, [a, b, c]) if is_last(c) => match sum {
                Sum::Plus => (Kind::AddMul, [c, a, b]),
                Sum::Minus => (Kind::SubFromMul, [c, a, b]),
                Sum::From => (Kind::SubMul, [c, a, b]),
            },
            Step::Fused(sum, [a, b, c]) => {
                let kind = match sum {
                    Sum::Plus => Kind::MulAdd,
                    Sum::Minus => Kind::MulSub,
                    Sum::From => Kind::MulSubFrom,
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
    rows: &'r mut [Row],
}

impl Work for Run<'_> {
    #[inline(always)]
    fn run<V: Vector>(self) {
        let Self { instructions, rows } = self;
        for start in (0..LANES).step_by(GROUP * V::LANES) {
            let mut last = [V::splat(0.0); GROUP];
            for instruction in instructions {
                let x = match instruction.x {
                    Some(row) => read(rows, row, start),
                    None => last,
                };
                let (y, z) = (instruction.y, instruction.z);
                last = match instruction.kind {
                    Kind::Add => zip(x, read(rows, y, start), V::add),
                    Kind::Sub => zip(x, read(rows, y, start), V::sub),
                    Kind::SubFrom => zip(read(rows, y, start), x, V::sub),
                    Kind::Mul => zip(x, read(rows, y, start), V::mul),
                    Kind::MulAdd => zip3(x, read(rows, y, start), read(rows, z, start), V::mul_add),
                    Kind::MulSub => zip3(x, read(rows, y, start), read(rows, z, start), V::mul_sub),
                    Kind::MulSubFrom => {
                        zip3(x, read(rows, y, start), read(rows, z, start), V::neg_mul_add)
                    }
                    Kind::AddMul => zip3(read(rows, y, start), read(rows, z, start), x, V::mul_add),
                    Kind::SubFromMul => {
                        zip3(read(rows, y, start), read(rows, z, start), x, V::mul_sub)
                    }
                    Kind::SubMul => {
                        zip3(read(rows, y, start), read(rows, z, start), x, V::neg_mul_add)
                    }
                    Kind::Function(function) => match function {
                        Function::Neg => each(x, V::neg),
                        Function::Recip => zip([V::splat(1.0); GROUP], x, V::div),
                        Function::Sqrt => each(x, V::sqrt),
                        Function::Abs => each(x, V::abs),
                        Function::Exp => by_lane(x, x, |x, _| libm::exp(x)),
                        Function::Ln => by_lane(x, x, |x, _| libm::log(x)),
                        Function::Sin => by_lane(x, x, |x, _| libm::sin(x)),
                        Function::Cos => by_lane(x, x, |x, _| libm::cos(x)),
                        Function::Atan => by_lane(x, x, |x, _| libm::atan(x)),
                    },
                    Kind::Pow => by_lane(x, read(rows, y, start), libm::pow),
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
fn read<V: Vector>(rows: &[Row], row: u32, start: usize) -> [V; GROUP] {
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
        let (mut of_x, mut of_y) = ([0.0; LANES], [0.0; LANES]);
        x[k].store(&mut of_x);
        y[k].store(&mut of_y);
        for lane in 0..V::LANES {
            of_x[lane] = f(of_x[lane], of_y[lane]);
        }
        x[k] = V::load(&of_x);
    }
    x
}
