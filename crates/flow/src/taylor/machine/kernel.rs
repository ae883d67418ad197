//! Inner sums in lanes, two orders at a time.
//!
//! Each operation has eight sums along the order, as a single motion has: sum j takes the terms
//! k = 1 + j, 9 + j, … of each product, and ((s₀ + s₄) + (s₂ + s₆)) + ((s₁ + s₅) + (s₃ + s₇)) is the
//! total. Of the next order, the sums that lack terms with the order under way are those of k = 1 and
//! of the last k. The others are made with the present order, so that what is loaded is used twice;
//! these two are made when that order is there.

use super::encode::{At, BaseRegister, Register, TaylorEncoder, Width};
use super::lanes::{Block, CODE_LANES};
use crate::taylor::code::{BoundProgram, Place, Product, first};
use crate::taylor::number::BLOCK;

/// Registers for temporary values.
const X: Register = 14;
const Y: Register = 15;

/// Vectors kept for each operation: its total, and parts of the total of the next order.
pub(super) const SLOT: usize = 1 + PARTS;
/// Number of parts: s₄, s₂ + s₆, the partner of the last sum, and the other odd pair.
const PARTS: usize = 4;

/// Order up to which the products are shorter than calls of a subroutine are long.
const SHORT: usize = 6;

/// Sums j of an order, in registers as far as there are any.
type Sums = [Option<Register>; BLOCK];

/// Sums of the order after n that are complete before order n is.
fn early(n: usize) -> impl Fn(usize) -> bool {
    move |j| j < n && j != 0 && j != last(n)
}

/// Sum with the last term of the order after n.
fn last(n: usize) -> usize {
    (n - 1) % BLOCK
}

/// Emits the inner sums of order n, and the parts of those of the next order if there is one.
pub(super) fn two_orders(
    code: &BoundProgram<Block>,
    width: Width,
    n: usize,
    has_next: bool,
) -> TaylorEncoder {
    let is_early = early(n);
    let sums: Sums = std::array::from_fn(|j| (j + 1 < n).then_some(j as Register));
    let mut free = BLOCK as Register..X;
    let next: Sums =
        std::array::from_fn(|j| if has_next && is_early(j) { free.next() } else { None });
    let clear =
        |to: &mut TaylorEncoder| sums.iter().chain(&next).flatten().for_each(|sum| to.zero(*sum));
    let product = |to: &mut TaylorEncoder, from: Places| {
        let negative = from.negative;
        for k in 1..n {
            let j = (k - 1) % BLOCK;
            to.load(width, X, from.row(k));
            if let Some(sum) = next[j] {
                // y of order n + 1 - k is still there.
                to.fused_with(width, negative, [sum, X, Y]);
            }
            to.load(width, Y, from.copy(n - k));
            if let Some(sum) = sums[j] {
                to.fused_with(width, negative, [sum, X, Y]);
            }
        }
    };
    let end = |to: &mut TaylorEncoder| {
        if let Some(total) = folded(to, width, &sums) {
            normalise(to, width, total, n - 1);
            to.store(width, total, order(BaseRegister::Sums, 0));
        }
        for (slot, pair) in pairs(n).into_iter().enumerate() {
            let pair = pair.map(|j| j.and_then(|j| next[j]));
            if let Some(part) = sum_of(to, width, pair) {
                to.store(width, part, order(BaseRegister::Sums, 1 + slot));
            }
        }
    };
    match n <= SHORT {
        true => in_line(code, &clear, &product, &end),
        false => by_calls(code, &clear, &product, &end),
    }
}

/// Emits what the inner sums of the order after n still lack.
pub(super) fn rest(code: &BoundProgram<Block>, width: Width, n: usize) -> TaylorEncoder {
    let is_early = early(n);
    let (first, other) = (0, 1);
    let clear = |to: &mut TaylorEncoder| [first, other].iter().for_each(|sum| to.zero(*sum));
    let product = |to: &mut TaylorEncoder, from: Places| {
        for k in 1..=n {
            let sum = match (k - 1) % BLOCK {
                0 => first,
                j if j == last(n) => other,
                _ => continue,
            };
            to.load(width, X, from.row(k));
            to.load(width, Y, from.copy(n + 1 - k));
            to.fused_with(width, from.negative, [sum, X, Y]);
        }
    };
    let end = |to: &mut TaylorEncoder| {
        for (slot, pair) in pairs(n).into_iter().enumerate() {
            if pair.into_iter().flatten().any(&is_early) {
                let sum = if slot < 2 { first } else { other };
                to.load(width, X, order(BaseRegister::Sums, 1 + slot));
                to.add(width, sum, sum, X);
            }
        }
        to.add(width, first, first, other);
        normalise(to, width, first, n);
        to.store(width, first, order(BaseRegister::Sums, 0));
    };
    in_line(code, &clear, &product, &end)
}

/// Places of a product from which its orders are counted.
#[derive(Clone, Copy)]
struct Places {
    x: usize,
    cy: usize,
    negative: bool,
}

impl Places {
    fn row(self, k: usize) -> At {
        order(BaseRegister::Rows, self.x + k)
    }

    fn copy(self, k: usize) -> At {
        order(BaseRegister::Copies, self.cy + k)
    }
}

type Emit<'e> = &'e dyn Fn(&mut TaylorEncoder);
type EmitProduct<'e> = &'e dyn Fn(&mut TaylorEncoder, Places);

/// Emits all products of all operations one after another. Sums are cleared before each operation.
fn in_line(
    code: &BoundProgram<Block>,
    clear: Emit<'_>,
    product: EmitProduct<'_>,
    end: Emit<'_>,
) -> TaylorEncoder {
    let mut to = TaylorEncoder::default();
    let mut products = code.products.as_slice();
    for count in &code.counts {
        clear(&mut to);
        for own in first(&mut products, *count) {
            let (x, cy) = (own.x as usize, own.cy as usize);
            product(&mut to, Places { x, cy, negative: own.negative });
        }
        end(&mut to);
        to.next_sums((SLOT * CODE_LANES) as i32);
    }
    to.end();
    to.moves(BaseRegister::Sums, (code.counts.len().saturating_sub(1) * SLOT * CODE_LANES) as i32);
    to
}

/// Emits the same by calls of subroutines, of which those for products are long.
fn by_calls(
    code: &BoundProgram<Block>,
    clear: Emit<'_>,
    product: EmitProduct<'_>,
    end: Emit<'_>,
) -> TaylorEncoder {
    let mut to = TaylorEncoder::default();
    let jump = to.jump();
    let [plus, minus] = [false, true].map(|negative| {
        let first = to.label();
        clear(&mut to);
        let next = to.label();
        product(&mut to, Places { x: 0, cy: 0, negative });
        to.give_back();
        [first, next]
    });
    let ending = to.label();
    end(&mut to);
    to.next_sums((SLOT * CODE_LANES) as i32);
    to.give_back();
    to.land(&jump);
    let mut products = code.products.as_slice();
    let distance = |place: Place| (place as usize * CODE_LANES) as i32;
    for count in &code.counts {
        for (index, own) in first(&mut products, *count).iter().enumerate() {
            to.point(distance(own.x), distance(own.cy));
            let subroutine = if own.negative { minus } else { plus };
            to.call(subroutine[index.min(1)]);
        }
        to.call(ending);
    }
    to.end();
    let most = |places: &dyn Fn(&Product) -> Place| code.products.iter().map(places).max();
    to.moves(BaseRegister::Rows, distance(most(&|own| own.x).unwrap_or(0)));
    to.moves(BaseRegister::Copies, distance(most(&|own| own.cy).unwrap_or(0)));
    to.moves(BaseRegister::Sums, (code.counts.len().saturating_sub(1) * SLOT * CODE_LANES) as i32);
    to
}

/// Address of an order of a row, or of a vector of a slot.
fn order(base: BaseRegister, index: usize) -> At {
    At(base, (index * CODE_LANES) as i32)
}

/// Sums of the order after n whose totals are its parts, in the order in which they are added.
fn pairs(n: usize) -> [[Option<usize>; 2]; PARTS] {
    let partner = |j: usize| (j + BLOCK / 2) % BLOCK;
    let odd = (last(n) + 2) % BLOCK;
    [
        [Some(4), None],
        [Some(2), Some(6)],
        [Some(partner(last(n))), None],
        [Some(odd), Some(partner(odd))],
    ]
}

fn folded(to: &mut TaylorEncoder, width: Width, sums: &Sums) -> Option<Register> {
    let mut both = |a, b| sum_of(to, width, [a, b]);
    let [a, b, c, d] = [0, 2, 1, 3].map(|j| both(sums[j], sums[j + BLOCK / 2]));
    let [left, right] = [both(a, b), both(c, d)];
    both(left, right)
}

fn sum_of(to: &mut TaylorEncoder, width: Width, pair: [Option<Register>; 2]) -> Option<Register> {
    if let [Some(a), Some(b)] = pair {
        to.add(width, a, a, b);
    }
    pair[0].or(pair[1])
}

/// Adds 0 where fewer than eight terms were added: sums without terms are 0, not -0.
fn normalise(to: &mut TaylorEncoder, width: Width, total: Register, terms: usize) {
    if terms < BLOCK {
        to.zero(X);
        to.add(width, total, total, X);
    }
}
