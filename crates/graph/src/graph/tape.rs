//! The tape: a graph laid out as a straight line of instructions over numbered slots.

use super::{Expr, Graph, Node};
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};

/// Index of the memory for one block of values.
pub(crate) type Slot = u32;

/// One instruction; the result slot may be one of the argument slots.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Instruction {
    Unary {
        function: UnaryFunction,
        a: Slot,
        out: Slot,
    },
    Binary {
        operation: BinaryOperation,
        a: Slot,
        b: Slot,
        out: Slot,
    },
    /// A power with a constant exponent, an index into the tape's exponents.
    Power {
        a: Slot,
        exponent: u32,
        out: Slot,
    },
}

/// Straight-line code that computes the given expressions of a graph from its inputs, and nothing
/// else.
///
/// Slots `0..inputs` hold the inputs; then come the constants, and then the intermediate results,
/// whose slots are reused as soon as a value has been read for the last time.
#[derive(Clone, Debug)]
pub struct Tape {
    pub(super) inputs: usize,
    pub(super) constants: Vec<Rational>,
    pub(super) exponents: Vec<Rational>,
    pub(super) instructions: Vec<Instruction>,
    pub(super) outputs: Vec<Slot>,
    pub(super) slots: usize,
}

impl Tape {
    /// Lays out the nodes that `outputs` need; all other nodes of the graph are left out.
    pub fn new(graph: &Graph, outputs: &[Expr]) -> Self {
        let roots: Vec<usize> =
            outputs.iter().map(|expr| expr.id().map_or(0, |id| id.0 as usize)).collect();
        let (last_use, mut used, mut constants) = last_uses(graph, &roots);
        used.reverse();
        constants.reverse();
        let mut tape = Tape {
            inputs: graph.inputs(),
            constants: Vec::with_capacity(constants.len()),
            exponents: Vec::new(),
            instructions: Vec::with_capacity(used.len()),
            outputs: Vec::new(),
            slots: 0,
        };
        let mut slot_of: Vec<Slot> = vec![0; last_use.len()];
        for (index, constant) in constants {
            slot_of[index] = (tape.inputs + tape.constants.len()) as Slot;
            tape.constants.push(graph.constants[constant as usize].clone());
        }
        let mut slots =
            Slots { free: Vec::new(), next: (tape.inputs + tape.constants.len()) as Slot };
        for index in used.into_iter().map(|index| index as usize) {
            let release = |argument: usize, slots: &mut Slots| {
                if last_use[argument] as usize == index {
                    slots.free.push(slot_of[argument]);
                }
            };
            let instruction = match graph.nodes[index] {
                Node::Constant(_) => continue,
                Node::Input(input) => {
                    slot_of[index] = input;
                    continue;
                }
                Node::Unary(function, a) => {
                    release(a.0 as usize, &mut slots);
                    let a = slot_of[a.0 as usize];
                    Instruction::Unary { function, a, out: slots.take() }
                }
                Node::Power(a, exponent) => {
                    release(a.0 as usize, &mut slots);
                    let a = slot_of[a.0 as usize];
                    let value = graph.constants[exponent as usize].clone();
                    tape.exponents.push(value);
                    let exponent = (tape.exponents.len() - 1) as u32;
                    Instruction::Power { a, exponent, out: slots.take() }
                }
                Node::Binary(operation, a, b) => {
                    release(a.0 as usize, &mut slots);
                    if a != b {
                        release(b.0 as usize, &mut slots);
                    }
                    let (a, b) = (slot_of[a.0 as usize], slot_of[b.0 as usize]);
                    Instruction::Binary { operation, a, b, out: slots.take() }
                }
            };
            slot_of[index] = instruction.out();
            tape.instructions.push(instruction);
        }
        tape.outputs = roots.iter().map(|root| slot_of[*root]).collect();
        tape.slots = slots.next as usize;
        tape
    }

    /// Number of operations that one run takes for each state.
    pub fn operations(&self) -> usize {
        self.instructions.len()
    }

    /// Returns the instructions in order, over slots.
    pub(crate) fn instructions(&self) -> &[Instruction] {
        &self.instructions
    }

    /// Returns the constants, whose slots follow those of the inputs.
    pub(crate) fn constants(&self) -> &[Rational] {
        &self.constants
    }

    /// Returns the exponents that powers refer to.
    pub(crate) fn exponents(&self) -> &[Rational] {
        &self.exponents
    }

    /// Returns the slot of each output after the last instruction.
    pub(crate) fn output_slots(&self) -> &[Slot] {
        &self.outputs
    }

    /// Number of inputs.
    pub fn inputs(&self) -> usize {
        self.inputs
    }

    /// Number of outputs.
    pub fn outputs(&self) -> usize {
        self.outputs.len()
    }
}

impl Instruction {
    fn out(self) -> Slot {
        match self {
            Instruction::Unary { out, .. }
            | Instruction::Binary { out, .. }
            | Instruction::Power { out, .. } => out,
        }
    }
}

impl Node {
    pub(super) fn is_computed(&self) -> bool {
        !matches!(self, Node::Constant(_) | Node::Input(_))
    }
}

const UNUSED: u32 = u32::MAX;
const KEPT: u32 = u32::MAX - 1;

/// Finds the index of each node's last user, as far as the last root: past the end for an output,
/// `UNUSED` for a node without users, `KEPT` for inputs and constants, whose slots are not used again;
/// then the nodes that have users, and the constants among them, the last one first.
fn last_uses(graph: &Graph, roots: &[usize]) -> (Vec<u32>, Vec<u32>, Vec<(usize, u32)>) {
    let nodes = graph.nodes.len();
    let end = roots.iter().filter(|root| **root < nodes).max().map_or(0, |last| last + 1);
    let mut last = vec![UNUSED; end];
    for root in roots.iter().filter(|root| **root < nodes) {
        last[*root] = end as u32;
    }
    let (mut used, mut constants) = (Vec::with_capacity(end), Vec::new());
    for index in (0..end).rev() {
        if last[index] == UNUSED {
            continue;
        }
        let mut read = |argument: super::NodeId| {
            let entry = &mut last[argument.0 as usize];
            if *entry == UNUSED {
                *entry = index as u32;
            }
        };
        match graph.nodes[index] {
            Node::Constant(constant) => {
                last[index] = KEPT;
                constants.push((index, constant));
                continue;
            }
            Node::Input(_) => last[index] = KEPT,
            Node::Unary(_, a) | Node::Power(a, _) => read(a),
            Node::Binary(_, a, b) => {
                read(a);
                read(b);
            }
        }
        used.push(index as u32);
    }
    (last, used, constants)
}

struct Slots {
    free: Vec<Slot>,
    next: Slot,
}

impl Slots {
    fn take(&mut self) -> Slot {
        self.free.pop().unwrap_or_else(|| {
            self.next += 1;
            self.next - 1
        })
    }
}
