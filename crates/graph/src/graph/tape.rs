//! The tape: a graph laid out as a straight line of instructions over numbered slots.

use std::cell::Cell;

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
        let mut layout = LAYOUT.take();
        layout.fill(graph, &roots);
        let tape = Self::laid_out(graph, &roots, &mut layout);
        if layout.places.len() <= MOST_KEPT {
            LAYOUT.set(layout);
        }
        tape
    }

    fn laid_out(graph: &Graph, roots: &[usize], layout: &mut Layout) -> Self {
        let Layout { places, used, constants } = layout;
        let mut tape = Tape {
            inputs: graph.inputs(),
            constants: Vec::with_capacity(constants.len()),
            exponents: Vec::new(),
            instructions: Vec::with_capacity(used.len()),
            outputs: Vec::new(),
            slots: 0,
        };
        for (index, constant) in constants.iter().rev() {
            places[*index].slot = (tape.inputs + tape.constants.len()) as Slot;
            tape.constants.push(graph.constants[*constant as usize].clone());
        }
        let mut slots =
            Slots { free: Vec::new(), next: (tape.inputs + tape.constants.len()) as Slot };
        for index in used.iter().rev() {
            // Returns the slot of an argument, and makes it free after its last use.
            let read = |argument: super::NodeId, slots: &mut Slots| {
                let Place { last, slot } = places[argument.0 as usize];
                if last == *index {
                    slots.free.push(slot);
                }
                slot
            };
            let instruction = match graph.nodes[*index as usize] {
                Node::Constant(_) => continue,
                Node::Input(input) => {
                    places[*index as usize].slot = input;
                    continue;
                }
                Node::Unary(function, a) => {
                    let a = read(a, &mut slots);
                    Instruction::Unary { function, a, out: slots.take() }
                }
                Node::Power(a, exponent) => {
                    let a = read(a, &mut slots);
                    let value = graph.constants[exponent as usize].clone();
                    tape.exponents.push(value);
                    let exponent = (tape.exponents.len() - 1) as u32;
                    Instruction::Power { a, exponent, out: slots.take() }
                }
                Node::Binary(operation, a, b) => {
                    let (is_square, a) = (a == b, read(a, &mut slots));
                    let b = if is_square { a } else { read(b, &mut slots) };
                    Instruction::Binary { operation, a, b, out: slots.take() }
                }
            };
            places[*index as usize].slot = instruction.out();
            tape.instructions.push(instruction);
        }
        tape.outputs = roots.iter().map(|root| places[*root].slot).collect();
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

/// Number of nodes up to which the memory of a layout is kept for the next one.
const MOST_KEPT: usize = 1 << 16;

thread_local! {
    /// Memory of the last layout on this thread.
    static LAYOUT: Cell<Layout> = const {
        Cell::new(Layout { places: Vec::new(), used: Vec::new(), constants: Vec::new() })
    };
}

/// Properties of the nodes before they are laid out.
#[derive(Default)]
struct Layout {
    /// Each node as far as the last root.
    places: Vec<Place>,
    /// Nodes that have users, the last one first.
    used: Vec<u32>,
    /// Constants among them with their numbers, the last one first.
    constants: Vec<(usize, u32)>,
}

/// A node in a layout.
#[derive(Clone, Copy)]
struct Place {
    /// Index of the last user: past the end for an output, `UNUSED` for a node without users, `KEPT`
    /// for inputs and constants, whose slots are not used again.
    last: u32,
    /// Slot, once it has one.
    slot: Slot,
}

impl Layout {
    /// Finds the last uses of the nodes that some roots need.
    fn fill(&mut self, graph: &Graph, roots: &[usize]) {
        let nodes = graph.nodes.len();
        let end = roots.iter().filter(|root| **root < nodes).max().map_or(0, |last| last + 1);
        let Self { places, used, constants } = self;
        places.clear();
        places.resize(end, Place { last: UNUSED, slot: 0 });
        used.clear();
        constants.clear();
        for root in roots.iter().filter(|root| **root < nodes) {
            places[*root].last = end as u32;
        }
        for index in (0..end).rev() {
            if places[index].last == UNUSED {
                continue;
            }
            let mut read = |argument: super::NodeId| {
                let last = &mut places[argument.0 as usize].last;
                if *last == UNUSED {
                    *last = index as u32;
                }
            };
            match graph.nodes[index] {
                Node::Constant(constant) => {
                    places[index].last = KEPT;
                    constants.push((index, constant));
                    continue;
                }
                Node::Input(_) => places[index].last = KEPT,
                Node::Unary(_, a) | Node::Power(a, _) => read(a),
                Node::Binary(_, a, b) => {
                    read(a);
                    read(b);
                }
            }
            used.push(index as u32);
        }
    }
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

#[cfg(test)]
mod tests {
    use super::super::record;
    use super::*;

    #[test]
    fn a_layout_leaves_nothing_for_the_next_one() {
        let graph = |count: usize| {
            let build = |x: &[Expr]| {
                let mut values = vec![x[0], x[1]];
                for k in 2..count {
                    let next = values[k - 1] * values[k - 2] + values[k / 2];
                    values.push(next * Expr::from(k as f64));
                }
                values
            };
            record(2, build).expect("records")
        };
        let all = [40, 7, 200, 3, 90].map(graph);
        for (graph, values) in &all {
            for outputs in [&values[values.len() - 1..], &values[1..2], values] {
                let own = format!("{:?}", Tape::new(graph, outputs));
                let lay_out = || format!("{:?}", Tape::new(graph, outputs));
                let alone = std::thread::scope(|scope| scope.spawn(lay_out).join());
                assert_eq!(own, alone.expect("a thread of its own"));
            }
        }
    }
}
