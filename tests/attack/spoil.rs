//! Near misses: expressions with a slight change.

use std::rc::Rc;

use super::expr::{
    Expr, Function, Tree, add, modulus, mul, neg, node, of, power, replaced, root, square, sub,
    symbol, ten_to, whole,
};
use super::grow::Garden;
use super::random::Stream;
use super::scene::Origin;

/// Changes one thing in the expression.
pub fn spoilt(tree: &Tree, garden: &Garden<'_>, stream: &mut Stream) -> Tree {
    for _ in 0..8 {
        let index = stream.below(tree.size());
        let Some(part) = node(tree, index) else { continue };
        if let Some(new) = changed(&part, garden, stream) {
            return replaced(tree, index, &new);
        }
    }
    add(tree, &garden.atom(stream))
}

/// Drops moduli at up to three places, a change that may show in one cell only.
pub fn unsigned(tree: &Tree, garden: &Garden<'_>, stream: &mut Stream) -> Tree {
    let mut found = tree.clone();
    for _ in 0..1 + stream.below(3) {
        let moduli: Vec<usize> = (0..found.size())
            .filter(|index| node(&found, *index).is_some_and(|part| bare(&part).is_some()))
            .collect();
        if moduli.is_empty() {
            return spoilt(&found, garden, stream);
        }
        let index = *stream.pick(&moduli);
        if let Some(inner) = node(&found, index).as_ref().and_then(bare) {
            let new = if stream.once_in(3) { neg(&inner) } else { inner };
            found = replaced(&found, index, &new);
        }
    }
    found
}

/// Returns a for |a| and √(a²).
fn bare(part: &Tree) -> Option<Tree> {
    match &**part {
        Expr::Of(Function::Modulus, a) => Some(a.clone()),
        Expr::Of(Function::Root, a) => match &**a {
            Expr::Power(b, 2, 1) => Some(b.clone()),
            _ => None,
        },
        _ => None,
    }
}

fn changed(part: &Tree, garden: &Garden<'_>, stream: &mut Stream) -> Option<Tree> {
    let small = |stream: &mut Stream| ten_to(*stream.pick(&[-3, -15, -30, -30, -40]));
    match (&**part, stream.below(9)) {
        (_, 0) => Some(mul(part, &add(&whole(1), &small(stream)))),
        (_, 1) => Some(add(part, &mul(&small(stream), &garden.symbol(stream)))),
        // A term that vanishes on an open set.
        (_, 2) => {
            let y = garden.symbol(stream);
            let one_sided = match stream.once_in(2) {
                true => sub(&modulus(&y), &y),
                false => add(&modulus(&y), &y),
            };
            let factor = if stream.once_in(2) { one_sided } else { root(&one_sided) };
            Some(add(part, &mul(&factor, &garden.atom(stream))))
        }
        // A wave that vanishes at short decimals.
        (_, 4) if garden.functions && stream.once_in(3) => {
            let turns = mul(&whole(4000), &of(Function::Atan, &whole(1)));
            Some(add(part, &of(Function::Sin, &mul(&turns, &garden.symbol(stream)))))
        }
        // A term that vanishes except on a sliver at an end of the range.
        (_, 3) if stream.once_in(4) => {
            let place = *stream.pick(&garden.symbols);
            let (Origin::State(_, high) | Origin::Range(_, high)) =
                garden.scene.symbols[place].origin
            else {
                return None;
            };
            let end = sub(&Rc::new(Expr::Number(high)), &ten_to(*stream.pick(&[-2, -4, -7])));
            let past = sub(&symbol(place), &end);
            Some(add(part, &add(&past, &modulus(&past))))
        }
        (Expr::Of(Function::Modulus, a), 3..=5) => Some(a.clone()),
        (Expr::Of(Function::Modulus, a), _) => Some(neg(a)),
        (Expr::Of(Function::Root, _), 3) => Some(neg(part)),
        (Expr::Of(Function::Root, a), _) => bare(part).or_else(|| Some(root(&modulus(a)))),
        (Expr::Add(a, b), 3..=4) => Some(sub(a, b)),
        (Expr::Sub(a, b), 3..=4) => Some(add(a, b)),
        (Expr::Mul(a, b), 3..=4) => Some(if stream.once_in(2) { a.clone() } else { b.clone() }),
        (Expr::Power(a, top, bottom), 3..=5) => Some(power(a, top + 1, *bottom)),
        (Expr::Number(n), 3..=6) => {
            let mut n = *n;
            n.top += 1;
            Some(Rc::new(Expr::Number(n)))
        }
        (Expr::Symbol(_), 3) => Some(symbol(*stream.pick(&garden.symbols))),
        (Expr::Symbol(_), 4..=6) => Some(modulus(part)),
        (Expr::Symbol(_), 7) => Some(root(&square(part))),
        _ => None,
    }
}
