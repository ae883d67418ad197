//! Bulk evaluation of tapes in f64: a row of 64 states at a time, by an interpreter or by machine
//! code.
//!
//! ```text
//! Tape ─ products fused with sums ─▶ Program ─┬─▶ interpreter (any processor; the reference)
//!                                             └─▶ machine code (x86-64 with AVX2 or AVX-512)
//! ```
//!
//! Both give the same bits on every processor. The domain [`Float`](crate::number::float::Float)
//! rounds a product before it is added; here the sum is rounded once. No verdict rests on these
//! numbers: they have no error bounds.
//!
//! ```
//! use liouville_graph::engine::{Backend, Engine};
//! use liouville_graph::graph::{Tape, record};
//!
//! let (graph, norm) = record(2, |x| x[0] * x[0] + x[1] * x[1])?;
//! let engine = Engine::new(&Tape::new(&graph, &[norm]), Backend::Quickest);
//! let mut runner = engine.runner();
//! runner.inputs()[0].0 = std::array::from_fn(|lane| lane as f64);
//! runner.inputs()[1].0 = [2.0; 64];
//! runner.run();
//! assert_eq!(runner.output(0).0[3], 13.0);
//! # Ok::<(), liouville_graph::graph::Fault>(())
//! ```

mod balls;
mod interpreter;
mod machine;
mod program;
mod vector;

#[cfg(test)]
mod tests;

use std::sync::Arc;

use crate::graph::{InstructionSet, Tape, widest};
pub use balls::{BallEngine, BallRunner, InputExtent};
pub use machine::executable;

pub use program::StepCounts;
use program::StepProgram;

/// Number of states in a row.
pub const ROW_STATES: usize = 64;

/// Numbers of 64 states, one for each, aligned to a cache line.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub struct RowBlock(pub [f64; ROW_STATES]);

/// Means of running a tape.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Backend {
    /// Machine code where possible, else the interpreter. Pays from some ten thousand states on.
    Quickest,
    /// The interpreter.
    Interpreter,
}

/// A tape prepared to run; clones share the code.
#[derive(Clone, Debug)]
pub struct Engine(Arc<EngineCode>);

#[derive(Debug)]
struct EngineCode {
    steps: usize,
    counts: StepCounts,
    inputs: usize,
    vectors: InstructionSet,
    interpreter: interpreter::InterpretedProgram,
    machine: Option<machine::MachineProgram>,
}

impl Engine {
    /// Prepares a tape.
    pub fn new(tape: &Tape, means: Backend) -> Self {
        Self::with_vectors(tape, means, widest())
    }

    fn with_vectors(tape: &Tape, means: Backend, vectors: InstructionSet) -> Self {
        let program = StepProgram::new(tape);
        let machine = match means {
            Backend::Quickest => machine::MachineProgram::new(&program, vectors),
            Backend::Interpreter => None,
        };
        let interpreter = interpreter::InterpretedProgram::new(&program);
        let (steps, inputs) = (program.steps.len(), program.inputs);
        let counts = program.counts();
        Self(Arc::new(EngineCode { steps, counts, inputs, vectors, interpreter, machine }))
    }

    /// Whether there is machine code. Not where the processor or the system does not allow it, nor
    /// for a tape with functions that are not processor instructions: exp, sin, …
    pub fn is_machine_code(&self) -> bool {
        self.0.machine.is_some()
    }

    /// Number of steps of a run: operations of the tape, less the products fused with sums.
    pub fn steps(&self) -> usize {
        self.0.steps
    }

    /// Number of steps of each kind.
    pub fn counts(&self) -> StepCounts {
        self.0.counts
    }

    /// Number of inputs of a run.
    pub fn inputs(&self) -> usize {
        self.0.inputs
    }

    /// Memory to run in, one for each thread.
    pub fn runner(&self) -> Runner {
        let memory = match &self.0.machine {
            Some(code) => Memory::Machine {
                inputs: vec![RowBlock([0.0; ROW_STATES]); self.0.inputs],
                memory: code.memory(),
            },
            None => Memory::Interpreter(self.0.interpreter.rows()),
        };
        Runner { code: Arc::clone(&self.0), memory }
    }
}

/// Memory in which an [`Engine`] runs.
#[derive(Debug)]
pub struct Runner {
    code: Arc<EngineCode>,
    memory: Memory,
}

#[derive(Debug)]
enum Memory {
    Interpreter(Vec<RowBlock>),
    Machine { inputs: Vec<RowBlock>, memory: machine::Memory },
}

impl Runner {
    /// Rows of the inputs, to be filled; they keep their values from run to run.
    pub fn inputs(&mut self) -> &mut [RowBlock] {
        match &mut self.memory {
            Memory::Interpreter(rows) => &mut rows[..self.code.inputs],
            Memory::Machine { inputs, .. } => inputs,
        }
    }

    /// Computes the outputs of all lanes.
    pub fn run(&mut self) {
        match (&mut self.memory, &self.code.machine) {
            (Memory::Machine { inputs, memory }, Some(code)) => code.run(inputs, memory),
            (Memory::Interpreter(rows), _) => self.code.interpreter.run(self.code.vectors, rows),
            (Memory::Machine { .. }, None) => {}
        }
    }

    /// Computes the outputs for rows of inputs that lie elsewhere, without copying them for machine
    /// code.
    ///
    /// # Panics
    ///
    /// Panics if there are fewer rows than inputs.
    pub fn run_on(&mut self, rows: &[RowBlock]) {
        match (&mut self.memory, &self.code.machine) {
            (Memory::Machine { memory, .. }, Some(code)) => code.run(rows, memory),
            _ => {
                let inputs = self.code.inputs;
                self.inputs().copy_from_slice(&rows[..inputs]);
                self.run();
            }
        }
    }

    /// Row of an output of the last run.
    pub fn output(&self, index: usize) -> &RowBlock {
        match &self.memory {
            Memory::Interpreter(rows) => &rows[self.code.interpreter.output(index)],
            Memory::Machine { memory, .. } => memory.output(index),
        }
    }
}
