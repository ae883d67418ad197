//! Machine code for the expansions of a program over f64, of one motion or of eight in lanes.
//!
//! An interpreter of programs spends most of its time on addresses. Here addresses are part of the
//! instructions, and recent results stay in registers. The same sums are made in the same order, so
//! that the bits are those of the interpreter.

mod call;
mod constants;
mod emit;
mod encode;
mod kernel;
mod lanes;
mod values;

#[cfg(test)]
mod tests;

use crate::taylor::code::BoundProgram;
use crate::taylor::number::{BLOCK, SeriesNumber};
use call::{CallMemory, TaylorFunction};
use constants::Constants;
use encode::Width;
pub use lanes::LaneMachine;
use liouville::graph::{InstructionSet, widest};

/// Functions of a program, and the data they need besides its memory.
pub struct TaylorCode {
    order: usize,
    orders: usize,
    /// Inner sums, indexed by the number of vectors along the order, less one.
    inner_sums: Vec<TaylorFunction>,
    finish: TaylorFunction,
    /// Order 0, if all functions in it are instructions.
    values: Option<TaylorFunction>,
    constants: Constants<f64>,
    /// Values of the inner sums.
    inner: Vec<f64>,
}

impl TaylorCode {
    /// Generates machine code for a program. `None` where the processor or the system allows none.
    pub(crate) fn new(code: &BoundProgram<f64>, order: usize) -> Option<Self> {
        match widest() {
            InstructionSet::Avx512 => Self::with_width(code, order, Width::Eight),
            InstructionSet::Avx2 => Self::with_width(code, order, Width::Four),
            InstructionSet::Baseline => None,
        }
    }

    /// Generates code with instructions of this width, which the processor must have.
    fn with_width(code: &BoundProgram<f64>, order: usize, width: Width) -> Option<Self> {
        let constants = Constants::new(code);
        let lengths = 1..=order.div_ceil(BLOCK);
        let inner_sums = lengths.map(|n| TaylorFunction::new(&emit::inner_sums(code, width, n)));
        let sums = (code.counts.len() + 1).next_multiple_of(BLOCK);
        Some(Self {
            order,
            orders: order.next_multiple_of(BLOCK),
            inner_sums: inner_sums.collect::<Option<_>>()?,
            finish: TaylorFunction::new(&emit::finish(code, &constants, Width::One, 1))?,
            values: match values::values(code, &constants, Width::One) {
                Some(values) => Some(TaylorFunction::new(&values)?),
                None => None,
            },
            constants,
            inner: vec![0.0; sums],
        })
    }

    /// Computes order 0 of all rows and order 1 of the state, with the slopes. Returns `false` if
    /// there is no code for that.
    #[inline(always)]
    pub(crate) fn begin(&mut self, inverses: [&[f64]; 2], memory: &mut [f64]) -> bool {
        let Some(values) = &self.values else { return false };
        self.constants.at_order(0, inverses);
        values.call(CallMemory {
            memory,
            rows: 0,
            copies: self.orders,
            constants: &mut self.constants.list,
            sums: &mut [],
        });
        true
    }

    /// Copies the slopes computed elsewhere.
    #[inline(always)]
    pub(crate) fn take(&mut self, code: &BoundProgram<f64>) {
        self.constants.take(code);
    }

    /// Computes orders 1 to `order` - 1 of all rows, and up to `order` of the state, from what
    /// `begin` made.
    #[inline(always)]
    pub(crate) fn run(
        &mut self,
        code: &BoundProgram<f64>,
        inverses: [&[f64]; 2],
        memory: &mut [f64],
    ) {
        self.inner.fill(0.0);
        for n in 1..self.order {
            let copies = |n: usize| f64::copied(self.orders, n);
            if n >= 2 {
                self.inner_sums[(n - 2) / BLOCK].call(CallMemory {
                    memory,
                    rows: 0,
                    copies: copies(n - 1),
                    constants: &mut [],
                    sums: &mut self.inner,
                });
            }
            self.constants.at_order(n, inverses);
            self.constants.thetas(code, n);
            self.finish.call(CallMemory {
                memory,
                rows: n,
                copies: copies(n),
                constants: &mut self.constants.list,
                sums: &mut self.inner,
            });
        }
    }
}
