//! A loop of vector instructions on rows, encoded with the extent of the memory it touches.

#[cfg(test)]
mod tests;

use crate::assembler::{
    Encoder, Label, Operand, OperandOrder, PairInstruction, Pointer, Register, SumSigns, Width,
};
use crate::engine::ROW_STATES;

/// Area of memory, with a register that points to it; places are numbered vector by vector. Inputs
/// and outputs are rows of several vectors, and each turn of the loop begins some vectors further
/// on; the frame holds the same vectors in every turn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Area {
    Inputs,
    Outputs,
    Frame,
}

impl Area {
    fn pointer(self) -> Pointer {
        match self {
            Area::Inputs => Pointer::Rdi,
            Area::Outputs => Pointer::Rdx,
            Area::Frame => Pointer::Rsi,
        }
    }
}

/// Location of a vector.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum VectorLocation {
    Register(Register),
    Memory(Area, u32),
}

/// Encoder of a loop under construction, with the extent of the memory it touches.
#[derive(Debug)]
pub(super) struct Assembler {
    width: Width,
    encoder: Encoder,
    first: Label,
    extent: MemoryExtent,
}

/// Extent of the memory touched in each area; of inputs and outputs in vectors, until it is known
/// how many make a row.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct MemoryExtent {
    /// Number of rows of inputs.
    pub(super) inputs: usize,
    /// Number of rows of outputs.
    pub(super) outputs: usize,
    /// Number of vectors of the frame.
    pub(super) frame: usize,
}

/// Code of a function of the areas and the number of turns, `extern "sysv64"`, whose only effect is
/// to read and write within its extent.
#[derive(Debug)]
pub(super) struct Assembly {
    pub(super) bytes: Vec<u8>,
    pub(super) width: Width,
    /// Number of vectors that a turn computes.
    pub(super) copies: usize,
    pub(super) extent: MemoryExtent,
}

impl Assembler {
    pub(super) fn new(width: Width) -> Self {
        let encoder = Encoder::default();
        Self { width, first: encoder.label(), encoder, extent: MemoryExtent::default() }
    }

    /// Loads a register: `target = source`.
    pub(super) fn load(&mut self, target: Register, source: VectorLocation) {
        let source = self.touched(source);
        self.encoder.load(self.width, target, source);
    }

    /// Stores a register to memory.
    pub(super) fn store(&mut self, area: Area, index: u32, source: Register) {
        let to = self.touch(area, index);
        self.encoder.store(self.width, to, source);
    }

    /// Emits `target = x op y`.
    pub(super) fn pair(
        &mut self,
        pair: PairInstruction,
        target: Register,
        x: Register,
        y: VectorLocation,
    ) {
        let y = self.touched(y);
        self.encoder.pair(self.width, pair, [target, x], y);
    }

    /// Emits `target = √x`.
    pub(super) fn square_root(&mut self, target: Register, x: VectorLocation) {
        let x = self.touched(x);
        self.encoder.square_root(self.width, target, x);
    }

    /// Emits a fused sum of target, second and third.
    pub(super) fn fused(
        &mut self,
        order: OperandOrder,
        signs: SumSigns,
        target: Register,
        second: Register,
        third: VectorLocation,
    ) {
        let third = self.touched(third);
        self.encoder.fused(self.width, (order, signs), [target, second], third);
    }

    /// Closes the loop: advances by some vectors in every row, and repeats for the number of turns.
    pub(super) fn finish(self, copies: usize) -> Assembly {
        let Self { width, mut encoder, first, extent } = self;
        for area in [Area::Inputs, Area::Outputs] {
            encoder.advance(area.pointer(), (width.numbers() * copies) as i32);
        }
        encoder.repeat(first);
        encoder.end();
        let in_row = ROW_STATES / width.numbers();
        let MemoryExtent { inputs, outputs, frame } = extent;
        // The last turn begins this far behind the first.
        let rows = |vectors: usize| match vectors {
            0 => 0,
            vectors => (vectors + in_row - copies).div_ceil(in_row),
        };
        let extent = MemoryExtent { inputs: rows(inputs), outputs: rows(outputs), frame };
        Assembly { bytes: encoder.into_bytes(), width, copies, extent }
    }

    /// Returns the operand at a location, which counts as touched.
    fn touched(&mut self, location: VectorLocation) -> Operand {
        match location {
            VectorLocation::Register(register) => Operand::Register(register),
            VectorLocation::Memory(area, index) => {
                let (pointer, distance) = self.touch(area, index);
                Operand::Memory(pointer, distance)
            }
        }
    }

    fn touch(&mut self, area: Area, index: u32) -> (Pointer, i32) {
        let extent = match area {
            Area::Inputs => &mut self.extent.inputs,
            Area::Outputs => &mut self.extent.outputs,
            Area::Frame => &mut self.extent.frame,
        };
        *extent = (*extent).max(index as usize + 1);
        (area.pointer(), index as i32 * self.width.numbers() as i32)
    }
}
