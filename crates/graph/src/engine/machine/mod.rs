//! Machine code for a program: straight line, in a loop over the vectors of a row.
//!
//! ```text
//! Program ─ registers allotted ─▶ instructions ─ encoded ─▶ bytes ─ write, then execute ─▶ function
//! ```
//!
//! Code exists for x86-64 with AVX-512 or with AVX2 and FMA. Elsewhere, and for programs with
//! functions that are not instructions (exp, sin, …), the interpreter does the work.

mod allocate;
mod encode;
mod memory;

use super::program::Program;
use super::{LANES, Row};
use crate::graph::Vectors;
use encode::Width;
use memory::Executable;

pub use memory::executable;

/// A program in machine code.
#[derive(Debug)]
pub(super) struct Code {
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
    frame: Vec<Row>,
    outputs: Vec<Row>,
}

impl Code {
    /// Generates machine code with these vectors. `None` where the processor, the system or the
    /// program allows none.
    pub(super) fn new(program: &Program, vectors: Vectors) -> Option<Self> {
        let width = match vectors {
            Vectors::Avx512 => Width::Eight,
            Vectors::Avx2 => Width::Four,
            Vectors::Baseline => return None,
        };
        let (assembly, constants) = allocate::assemble(program, width)?;
        let lanes = width.lanes();
        let frame_rows = assembly.extent.frame.max(constants.len()).div_ceil(LANES / lanes);
        let outputs = program.outputs.len();
        let executable = Executable::new(&assembly)?;
        Some(Self { executable, constants, frame_rows, lanes, outputs })
    }

    /// Memory of a run, with the constants in place.
    pub(super) fn memory(&self) -> Memory {
        let mut frame = vec![Row([0.0; LANES]); self.frame_rows];
        let vectors = frame.iter_mut().flat_map(|row| row.0.chunks_exact_mut(self.lanes));
        for (vector, constant) in vectors.zip(&self.constants) {
            vector.fill(*constant);
        }
        Memory { frame, outputs: vec![Row([0.0; LANES]); self.outputs] }
    }

    /// Runs the program once over rows of inputs.
    pub(super) fn run(&self, inputs: &[Row], memory: &mut Memory) {
        self.executable.run(inputs, &mut memory.frame, &mut memory.outputs);
    }
}

impl Memory {
    /// Row of an output.
    pub(super) fn output(&self, index: usize) -> &Row {
        &self.outputs[index]
    }
}
