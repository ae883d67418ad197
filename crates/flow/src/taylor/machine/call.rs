//! Calls of machine code.

#![allow(
    unsafe_code,
    reason = "generated instructions are called; measured in docs/dev/experiments.md"
)]

use memmap2::Mmap;

use super::encode::TaylorEncoder;
use crate::taylor::lanes::Lanes;
use crate::taylor::number::SeriesNumber;
use liouville::engine::executable;

/// Signature of the code: rows, copies, constants, sums.
#[cfg(target_arch = "x86_64")]
type Entry = unsafe extern "sysv64" fn(*mut f64, *mut f64, *mut f64, *mut f64);

/// Placeholder, never called: there is no code for other processors.
#[cfg(not(target_arch = "x86_64"))]
type Entry = unsafe extern "C" fn(*mut f64, *mut f64, *mut f64, *mut f64);

/// Numbers of which machine code sees the f64.
pub(super) trait Packed: SeriesNumber {
    /// The f64 of a list of numbers.
    fn floats(list: &mut [Self]) -> &mut [f64];
}

impl Packed for f64 {
    #[inline(always)]
    fn floats(list: &mut [f64]) -> &mut [f64] {
        list
    }
}

impl Packed for Lanes<8> {
    #[inline(always)]
    fn floats(list: &mut [Self]) -> &mut [f64] {
        const { assert!(size_of::<Self>() == size_of::<[f64; 8]>(), "no padding") };
        // SAFETY: the type is laid out as its only field, eight f64, and has their size.
        unsafe { std::slice::from_raw_parts_mut(list.as_mut_ptr().cast(), list.len() * 8) }
    }
}

/// A callable function in executable memory.
pub(super) struct TaylorFunction {
    memory: Mmap,
    touched: [(i32, i32); 4],
}

/// Memory passed to a function.
pub(super) struct CallMemory<'m> {
    /// Rows and copies; the next two fields are the offsets of their bases in it.
    pub(super) memory: &'m mut [f64],
    pub(super) rows: usize,
    pub(super) copies: usize,
    pub(super) constants: &'m mut [f64],
    pub(super) sums: &'m mut [f64],
}

/// Whether what is touched around a base lies in memory of this length.
fn within((least, most): (i32, i32), base: usize, length: usize) -> bool {
    let (base, length) = (base as i64, length as i64);
    base <= length && base + i64::from(least) >= 0 && base + i64::from(most) <= length
}

impl TaylorFunction {
    /// Maps the code. `None` where the system refuses the memory. The processor must have the
    /// instructions.
    pub(super) fn new(assembler: &TaylorEncoder) -> Option<Self> {
        if cfg!(not(target_arch = "x86_64")) {
            return None;
        }
        Some(Self { memory: executable(assembler.bytes())?, touched: assembler.touched })
    }

    /// Calls the function. Panics if it would access memory outside the given buffers.
    pub(super) fn call(&self, given: CallMemory<'_>) {
        let CallMemory { memory, rows, copies, constants, sums } = given;
        let [of_rows, of_copies, of_constants, of_sums] = self.touched;
        let enough = within(of_rows, rows, memory.len())
            && within(of_copies, copies, memory.len())
            && within(of_constants, 0, constants.len())
            && within(of_sums, 0, sums.len());
        assert!(enough, "machine code needs {:?}", self.touched);
        // SAFETY: the bytes come from the assembler alone, as a function of this type that jumps to
        // places of its own and touches no more than it records, which lies within the given buffers.
        // It is made only where the processor has its instructions.
        unsafe {
            let entry: Entry = std::mem::transmute(self.memory.as_ptr());
            let all = memory.as_mut_ptr();
            let (constants, sums) = (constants.as_mut_ptr(), sums.as_mut_ptr());
            entry(all.add(rows), all.add(copies), constants, sums);
        }
    }
}
