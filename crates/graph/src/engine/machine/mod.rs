//! Machine code for a program: straight lines for some vectors of a row, in a loop.
//!
//! ```text
//! Program ─ vectors interleaved ─ registers allotted ─▶ instructions ─ encoded ─▶ bytes ─ write, then execute ─▶ function
//! ```
//!
//! Code exists for x86-64 with AVX-512 or with AVX2 and FMA. Elsewhere, and for programs with
//! functions that are not instructions (exp, sin, …), the interpreter does the work.

mod allocate;
mod constants;
mod encode;
mod interleave;
mod memory;

use super::program::StepProgram;
use super::{ROW_STATES, RowBlock};
use crate::assembler::Width;
use crate::graph::InstructionSet;
use memory::Executable;

pub use memory::executable;

/// A program in machine code.
#[derive(Debug)]
pub(super) struct MachineProgram {
    executable: Executable,
    /// Initial content of the frame; spilled values follow.
    constants: Vec<f64>,
    frame_rows: usize,
    lanes: usize,
    outputs: usize,
}

/// Memory of a run, apart from its inputs.
#[derive(Debug)]
pub(super) struct Memory {
    frame: Vec<RowBlock>,
    outputs: Vec<RowBlock>,
}

impl MachineProgram {
    /// Generates machine code with these vectors. `None` where the processor, the system or the
    /// program allows none.
    pub(super) fn new(program: &StepProgram, vectors: InstructionSet) -> Option<Self> {
        let width = match vectors {
            InstructionSet::Avx512 => Width::Eight,
            InstructionSet::Avx2 => Width::Four,
            InstructionSet::Baseline => return None,
        };
        let (assembly, constants) = allocate::assemble(program, width)?;
        let lanes = width.numbers();
        let frame_rows = assembly.extent.frame.max(constants.len()).div_ceil(ROW_STATES / lanes);
        let outputs = program.outputs.len();
        let executable = Executable::new(&assembly)?;
        Some(Self { executable, constants, frame_rows, lanes, outputs })
    }

    /// Memory of a run, with the constants in place.
    pub(super) fn memory(&self) -> Memory {
        let mut frame = vec![RowBlock([0.0; ROW_STATES]); self.frame_rows];
        let vectors = frame.iter_mut().flat_map(|row| row.0.chunks_exact_mut(self.lanes));
        for (vector, constant) in vectors.zip(&self.constants) {
            vector.fill(*constant);
        }
        Memory { frame, outputs: vec![RowBlock([0.0; ROW_STATES]); self.outputs] }
    }

    /// Runs the program once over rows of inputs.
    pub(super) fn run(&self, inputs: &[RowBlock], memory: &mut Memory) {
        self.executable.run(inputs, &mut memory.frame, &mut memory.outputs);
    }
}

impl Memory {
    /// Row of an output.
    pub(super) fn output(&self, index: usize) -> &RowBlock {
        &self.outputs[index]
    }
}
