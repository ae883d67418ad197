//! Instructions for bound operations.

use super::call::Packed;
use super::constants::Constants;
use super::encode::{At, BaseRegister, PairSelection, Register, TaylorEncoder, Width};
use crate::taylor::code::{BoundProgram, OrderEffect, Place, Product, first};
use crate::taylor::number::BLOCK;

/// Registers that keep the last rows in turn; 0 and 1 are for temporary values.
const KEPT: std::ops::Range<usize> = 2..16;

/// Emits the inner sums along `vectors` vectors. The rows are addressed at order 0, the copies at
/// the last order that exists.
pub(super) fn inner_sums(code: &BoundProgram<f64>, width: Width, vectors: usize) -> TaylorEncoder {
    let mut to = TaylorEncoder::default();
    let mut products = code.products.as_slice();
    for (block, counts) in code.counts.chunks(BLOCK).enumerate() {
        for (lane, count) in counts.iter().enumerate() {
            let own = first(&mut products, *count);
            inner_sum(&mut to, width, own, vectors, lane as Register);
        }
        (counts.len()..BLOCK).for_each(|lane| to.zero(lane as Register));
        totals(&mut to, width, (block * BLOCK) as i32);
    }
    to.end();
    to
}

/// Adds the products of one operation in the lanes of a register: eight sums, or four where it has
/// four lanes.
fn inner_sum(
    to: &mut TaylorEncoder,
    width: Width,
    products: &[Product],
    vectors: usize,
    register: Register,
) {
    const X: Register = 8;
    const UPPER: Register = 9;
    for (sum, within) in [(register, 0), (UPPER, 4)] {
        if within > 0 && width == Width::Eight {
            break;
        }
        to.zero(sum);
        for product in products {
            for vector in 0..vectors {
                let along = (vector * BLOCK) as i32 + within;
                to.load(width, X, At(BaseRegister::Rows, product.x as i32 + 1 + along));
                to.fused(width, sum, X, At(BaseRegister::Copies, product.cy as i32 + along));
            }
        }
    }
    if width == Width::Four {
        to.add(width, register, register, UPPER);
    }
}

/// Adds the lanes of registers 0 to 7 in the interpreter's order,
/// ((s₀ + s₄) + (s₂ + s₆)) + ((s₁ + s₅) + (s₃ + s₇)); with four lanes, s₀ + s₄ and so on are there
/// already.
fn totals(to: &mut TaylorEncoder, width: Width, at: i32) {
    const X: Register = 8;
    const Y: Register = 9;
    let mut folded = |first: PairSelection, second: PairSelection, [out, a, b]: [Register; 3]| {
        to.pairs(width, first, [X, a, b]);
        to.pairs(width, second, [Y, a, b]);
        to.add(width, out, X, Y);
    };
    let mut mixed = Vec::new();
    match width {
        Width::Eight => {
            for [a, b] in [[0, 2], [4, 6], [1, 3], [5, 7]] {
                folded(PairSelection::Lower, PairSelection::Upper, [a, a, b]);
            }
            for [a, b] in [[0, 4], [1, 5]] {
                folded(PairSelection::Even, PairSelection::Odd, [a, a, b]);
            }
            mixed.push([0, 1]);
        }
        _ => {
            for [a, b] in [[0, 2], [1, 3], [4, 6], [5, 7]] {
                folded(PairSelection::Even, PairSelection::Odd, [a, a, b]);
            }
            mixed.extend([[0, 1], [4, 5]]);
        }
    }
    for (index, [a, b]) in mixed.into_iter().enumerate() {
        to.mix(width, false, [X, a, b]);
        to.mix(width, true, [Y, a, b]);
        to.add(width, X, X, Y);
        to.store(width, X, At(BaseRegister::Sums, at + (index * width.numbers()) as i32));
    }
}

/// Emits order n of all rows from the inner sums, and order n + 1 of the state. Rows and copies are
/// addressed at order n, the inner sums of operations at a distance of `slot` numbers.
pub(super) fn finish<T: Packed>(
    code: &BoundProgram<T>,
    constants: &Constants<T>,
    width: Width,
    slot: usize,
) -> TaylorEncoder {
    let mut to = TaylorEncoder::default();
    let mut kept = Kept::new();
    let mut term = 0;
    let mut copy = code.of_state;
    let mut terms = code.terms.as_slice();
    for (index, finish) in code.finishes.iter().enumerate() {
        let own = first(&mut terms, finish.terms);
        let sum = kept.place_of(finish.place);
        let inner = At(BaseRegister::Sums, (finish.inner as usize * slot * T::LANES) as i32);
        if finish.inner as usize == code.counts.len() {
            to.zero(sum);
        } else if code.operations[index].rule.is_sum() {
            to.load(width, sum, inner);
        } else {
            to.load(width, sum, constants.scale(index));
            to.multiply(width, sum, sum, inner);
        }
        if let OrderEffect::Divides = finish.order {
            to.multiply(width, sum, sum, Constants::<T>::BY_N);
        }
        for read in own {
            let x = kept.find(read.x).unwrap_or_else(|| {
                to.load(width, 0, row::<T>(read.x));
                0
            });
            to.fused(width, sum, x, constants.slope(term));
            term += 1;
        }
        to.store(width, sum, row::<T>(finish.place));
        for _ in 0..finish.copies {
            to.multiply(width, 1, sum, constants.weight(copy));
            to.store(width, 1, copied::<T>(code.copies[copy].place));
            copy += 1;
        }
    }
    next_order(code, constants, width, &mut to, &kept);
    to.end();
    to
}

/// Emits order n + 1 of the state.
pub(super) fn next_order<T: Packed>(
    code: &BoundProgram<T>,
    constants: &Constants<T>,
    width: Width,
    to: &mut TaylorEncoder,
    kept: &Kept,
) {
    let next = |At(base, distance): At, orders: i32| At(base, distance + orders * T::LANES as i32);
    // Copies run backwards where numbers are added along the order.
    let along = if T::WIDTH > 1 { -1 } else { 1 };
    let mut copy = 0;
    for component in &code.state {
        let rate = kept.find(component.rate).unwrap_or_else(|| {
            to.load(width, 0, row::<T>(component.rate));
            0
        });
        to.multiply(width, 1, rate, Constants::<T>::BY_NEXT);
        to.store(width, 1, next(row::<T>(component.place), 1));
        for _ in 0..component.copies {
            to.multiply(width, 0, 1, constants.weight(copy));
            to.store(width, 0, next(copied::<T>(code.copies[copy].place), along));
            copy += 1;
        }
    }
}

/// Address of a row.
pub(super) fn row<T: Packed>(place: Place) -> At {
    At(BaseRegister::Rows, (place as usize * T::LANES) as i32)
}

/// Address of a copy.
fn copied<T: Packed>(place: Place) -> At {
    At(BaseRegister::Copies, (place as usize * T::LANES) as i32)
}

/// Rows held in registers.
pub(super) struct Kept {
    rows: [Option<Place>; KEPT.end],
    next: usize,
}

impl Kept {
    pub(super) fn new() -> Self {
        Self { rows: [None; KEPT.end], next: KEPT.start }
    }

    /// Allots a register for a row that is about to be made.
    pub(super) fn place_of(&mut self, row: Place) -> Register {
        let register = self.next;
        self.next = if register + 1 == KEPT.end { KEPT.start } else { register + 1 };
        self.rows[register] = Some(row);
        register as Register
    }

    pub(super) fn find(&self, row: Place) -> Option<Register> {
        self.rows.iter().position(|own| *own == Some(row)).map(|register| register as Register)
    }
}
