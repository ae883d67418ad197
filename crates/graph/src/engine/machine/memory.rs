//! Executable memory for machine code: written first, executed afterwards, never both at once.

#![allow(
    unsafe_code,
    reason = "generated instructions are called; measured in docs/dev/experiments.md"
)]

use memmap2::{Mmap, MmapMut};

use super::super::{ROW_STATES, RowBlock};
use super::encode::{Assembly, MemoryExtent};
use crate::assembler::Width;
use crate::graph::{InstructionSet, widest};

/// Signature of the code: inputs, frame, outputs, turns.
#[cfg(target_arch = "x86_64")]
type Entry = unsafe extern "sysv64" fn(*const f64, *mut f64, *mut f64, usize);

/// Placeholder, never called: other processors have no code.
#[cfg(not(target_arch = "x86_64"))]
type Entry = unsafe extern "C" fn(*const f64, *mut f64, *mut f64, usize);

/// Maps instructions into executable memory; `None` where the system refuses it.
pub fn executable(bytes: &[u8]) -> Option<Mmap> {
    let mut memory = MmapMut::map_anon(bytes.len()).ok()?;
    memory.copy_from_slice(bytes);
    memory.make_exec().ok()
}

/// A callable function in executable memory.
#[derive(Debug)]
pub(super) struct Executable {
    memory: Mmap,
    width: Width,
    copies: usize,
    extent: MemoryExtent,
}

impl Executable {
    /// Maps the code. `None` where the processor lacks the instructions, or the system refuses the
    /// memory.
    pub(super) fn new(assembly: &Assembly) -> Option<Self> {
        let has = match assembly.width {
            Width::Eight => widest() == InstructionSet::Avx512,
            Width::One | Width::Four => widest() != InstructionSet::Baseline,
        };
        if !has {
            return None;
        }
        let memory = executable(&assembly.bytes)?;
        let Assembly { width, copies, extent, .. } = *assembly;
        Some(Self { memory, width, copies, extent })
    }

    /// Runs over all lanes of the rows. Panics where there are fewer rows than the code touches.
    pub(super) fn run(
        &self,
        inputs: &[RowBlock],
        frame: &mut [RowBlock],
        outputs: &mut [RowBlock],
    ) {
        let enough = inputs.len() >= self.extent.inputs
            && outputs.len() >= self.extent.outputs
            && frame.len() * ROW_STATES >= self.extent.frame * self.width.numbers();
        assert!(enough, "machine code needs {:?}", self.extent);
        // SAFETY: an `Assembly` is made by the assembler alone, and its bytes are a function of this
        // type that touches no more than its extent, in rows of `ROW_STATES` states; the processor has
        // its instructions. `RowBlock` is an array of f64, so a slice of rows is contiguous.
        unsafe {
            let entry: Entry = std::mem::transmute(self.memory.as_ptr());
            let turns = ROW_STATES / self.width.numbers() / self.copies;
            entry(
                inputs.as_ptr().cast(),
                frame.as_mut_ptr().cast(),
                outputs.as_mut_ptr().cast(),
                turns,
            );
        }
    }
}
