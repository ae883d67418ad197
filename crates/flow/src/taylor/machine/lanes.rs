//! Machine code for eight motions in lanes, with the sums that one motion alone has.

use super::call::{CallMemory, Packed, TaylorFunction};
use super::constants::Constants;
use super::encode::Width;
use super::kernel::{self, SLOT};
use super::{emit, values};
use crate::taylor::code::BoundProgram;
use crate::taylor::lanes::Lanes;
use liouville::graph::{InstructionSet, widest};

/// Number of motions.
pub(super) const CODE_LANES: usize = 8;

pub(super) type Block = Lanes<CODE_LANES>;

/// Functions of a program in lanes, and the data they need besides its memory.
pub struct LaneMachine {
    order: usize,
    width: Width,
    /// Inner sums of the orders 2, 4, …, each with parts of those of the next order.
    sums_of_two: Vec<TaylorFunction>,
    /// Rest of the inner sums of the orders 3, 5, …
    rest: Vec<TaylorFunction>,
    finish: TaylorFunction,
    /// Order 0, if all functions in it are instructions.
    values: Option<TaylorFunction>,
    constants: Constants<Block>,
    /// Inner sums and parts of them.
    sums: Vec<Block>,
}

impl LaneMachine {
    /// Generates machine code for a program. `None` where the processor or the system allows none.
    pub(crate) fn new(code: &BoundProgram<Block>, order: usize) -> Option<Self> {
        match widest() {
            InstructionSet::Avx512 => Self::with_width(code, order, Width::Eight),
            InstructionSet::Avx2 => Self::with_width(code, order, Width::Four),
            InstructionSet::Baseline => None,
        }
    }

    /// Generates code with instructions of this width, which the processor must have.
    pub(super) fn with_width(
        code: &BoundProgram<Block>,
        order: usize,
        width: Width,
    ) -> Option<Self> {
        let constants = Constants::new(code);
        let even = || (2..order).step_by(2);
        let sums_of_two =
            even().map(|n| TaylorFunction::new(&kernel::two_orders(code, width, n, n + 1 < order)));
        let odd = even().filter(|n| n + 1 < order);
        let rest = odd.map(|n| TaylorFunction::new(&kernel::rest(code, width, n)));
        Some(Self {
            order,
            width,
            sums_of_two: sums_of_two.collect::<Option<_>>()?,
            rest: rest.collect::<Option<_>>()?,
            finish: TaylorFunction::new(&emit::finish(code, &constants, width, SLOT))?,
            values: match values::values(code, &constants, width) {
                Some(values) => Some(TaylorFunction::new(&values)?),
                None => None,
            },
            constants,
            sums: vec![Block::default(); (code.counts.len() + 1) * SLOT],
        })
    }

    /// First lanes of the vectors that make up all lanes.
    fn parts(&self) -> impl Iterator<Item = usize> + use<> {
        (0..CODE_LANES).step_by(self.width.numbers())
    }

    /// Computes order 0 of all rows and order 1 of the state, with the slopes. Returns `false` if
    /// there is no code for that.
    pub(crate) fn begin(&mut self, inverses: [&[Block]; 2], memory: &mut [Block]) -> bool {
        self.constants.at_order(0, inverses);
        let Some(values) = &self.values else { return false };
        for first in self.parts() {
            values.call(CallMemory {
                memory: Block::floats(memory),
                rows: first,
                copies: first,
                constants: &mut Block::floats(&mut self.constants.list)[first..],
                sums: &mut [],
            });
        }
        true
    }

    /// Copies the slopes computed elsewhere.
    pub(crate) fn take(&mut self, code: &BoundProgram<Block>) {
        self.constants.take(code);
    }

    /// Computes orders 1 to `order` - 1 of all rows, and up to `order` of the state, from what
    /// `begin` made.
    pub(crate) fn run(
        &mut self,
        code: &BoundProgram<Block>,
        inverses: [&[Block]; 2],
        memory: &mut [Block],
    ) {
        // Order 1 has no inner sums.
        self.sums.iter_mut().step_by(SLOT).for_each(|total| *total = Block::default());
        for n in 1..self.order {
            self.inner_sums(n, memory);
            self.constants.at_order(n, inverses);
            self.constants.thetas(code, n);
            for first in self.parts() {
                self.finish.call(CallMemory {
                    memory: Block::floats(memory),
                    rows: n * CODE_LANES + first,
                    copies: n * CODE_LANES + first,
                    constants: &mut Block::floats(&mut self.constants.list)[first..],
                    sums: &mut Block::floats(&mut self.sums)[first..],
                });
            }
        }
    }

    fn inner_sums(&mut self, n: usize, memory: &mut [Block]) {
        let kernels = if n.is_multiple_of(2) { &self.sums_of_two } else { &self.rest };
        let Some(kernel) = (n / 2).checked_sub(1).and_then(|index| kernels.get(index)) else {
            return;
        };
        for first in self.parts() {
            kernel.call(CallMemory {
                memory: Block::floats(memory),
                rows: first,
                copies: first,
                constants: &mut [],
                sums: &mut Block::floats(&mut self.sums)[first..],
            });
        }
    }
}
