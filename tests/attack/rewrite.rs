//! Rewriting that preserves values.
//!
//! Each rule gives an expression that equals the old one wherever both have values. A rule is
//! *exact* if both have values at the same states; exact rules preserve the function.

use super::expr::{
    Expr, Function, Tree, add, div, modulus, mul, neg, node, of, power, replaced, root, square,
    sub, whole,
};
use super::interval::{Interval, is_nonnegative, is_positive};
use super::random::Stream;

/// An expression, and whether it is the same function as the original.
#[derive(Clone, Debug)]
pub struct Rewritten {
    pub tree: Tree,
    pub exact: bool,
}

/// Largest size of an expression.
pub const LARGEST: usize = 70;

/// Rewrites an expression at some random nodes.
pub fn rewritten(tree: &Tree, ranges: &[Interval], stream: &mut Stream, times: usize) -> Rewritten {
    let mut found = Rewritten { tree: tree.clone(), exact: true };
    for _ in 0..times {
        let index = stream.below(found.tree.size());
        let Some(part) = node(&found.tree, index) else { continue };
        let Some(new) = rule(&part, ranges, stream) else { continue };
        let whole_tree = replaced(&found.tree, index, &new.tree);
        if whole_tree.size() <= LARGEST {
            found = Rewritten { tree: whole_tree, exact: found.exact && new.exact };
        }
    }
    found
}

fn exact(tree: Tree) -> Option<Rewritten> {
    Some(Rewritten { tree, exact: true })
}

fn loose(tree: Tree, exact: bool) -> Option<Rewritten> {
    Some(Rewritten { tree, exact })
}

/// Applies a random rule that fits a node.
fn rule(tree: &Tree, ranges: &[Interval], stream: &mut Stream) -> Option<Rewritten> {
    let shaped = by_shape(tree, ranges, stream);
    if shaped.is_some() && !stream.once_in(3) {
        return shaped;
    }
    anywhere(tree, ranges, stream)
}

/// Applies rules that fit any expression.
fn anywhere(a: &Tree, ranges: &[Interval], stream: &mut Stream) -> Option<Rewritten> {
    let sure = is_nonnegative(a, ranges);
    match stream.below(12) {
        0 if sure => exact(modulus(a)),
        1 | 2 if sure => exact(root(&multiplied(a))),
        3 if sure => exact(square(&root(a))),
        3 => loose(square(&root(a)), false),
        4 => loose(mul(&root(a), &root(a)), sure),
        // Functions are the slowest operations of the oracle.
        5 if !stream.once_in(4) => None,
        5 if is_positive(a, ranges) => exact(of(Function::Exp, &of(Function::Log, a))),
        5 => exact(of(Function::Log, &of(Function::Exp, a))),
        6 => exact(sub(&mul(&whole(2), a), a)),
        7 => {
            let half = |of: Tree| div(&of, &whole(2));
            exact(sub(&half(add(a, &modulus(a))), &half(sub(&modulus(a), a))))
        }
        8 if is_positive(a, ranges) => exact(div(&square(a), a)),
        9 => exact(sub(&add(a, &whole(1)), &whole(1))),
        10 => exact(neg(&neg(a))),
        11 if is_positive(a, ranges) => {
            let (top, bottom) = *stream.pick(&[(1, 2), (1, 4), (1, 3), (3, 4), (1, 8)]);
            exact(mul(&power(a, top, bottom), &power(a, bottom - top, bottom)))
        }
        _ => None,
    }
}

/// Makes a², expanded if a is a sum.
fn multiplied(a: &Tree) -> Tree {
    let cross = |x: &Tree, y: &Tree| mul(&mul(&whole(2), x), y);
    match &**a {
        Expr::Add(x, y) => add(&add(&square(x), &cross(x, y)), &square(y)),
        Expr::Sub(x, y) => add(&sub(&square(x), &cross(x, y)), &square(y)),
        _ => square(a),
    }
}

/// Applies rules that depend on the form of an expression.
fn by_shape(tree: &Tree, ranges: &[Interval], stream: &mut Stream) -> Option<Rewritten> {
    let sure = |a: &Tree| is_nonnegative(a, ranges);
    match &**tree {
        Expr::Add(a, b) => match (&**a, &**b, stream.below(4)) {
            (Expr::Mul(x, y), Expr::Mul(z, w), _) if x == z => exact(mul(x, &add(y, w))),
            (Expr::Add(x, y), _, 0) => exact(add(x, &add(y, b))),
            (_, Expr::Add(x, y), 0) => exact(add(&add(a, x), y)),
            (Expr::Of(Function::Root, x), _, 1) if sure(b) => {
                let cross = mul(&mul(&whole(2), b), &root(x));
                exact(root(&add(&add(&square(b), x), &cross)))
            }
            (_, _, 2) => exact(sub(a, &neg(b))),
            _ => exact(add(b, a)),
        },
        Expr::Sub(a, b) => match (&**a, &**b, stream.below(4)) {
            (Expr::Power(x, 2, 1), Expr::Power(y, 2, 1), _) => exact(mul(&sub(x, y), &add(x, y))),
            (Expr::Of(Function::Root, x), Expr::Of(Function::Root, y), 0 | 1) => {
                loose(div(&sub(x, y), &add(&root(x), &root(y))), false)
            }
            (_, _, 2) => exact(add(a, &neg(b))),
            _ => exact(neg(&sub(b, a))),
        },
        Expr::Mul(a, b) => match (&**a, &**b, stream.below(4)) {
            (Expr::Of(Function::Root, x), Expr::Of(Function::Root, y), 0..=2) => {
                loose(root(&mul(x, y)), sure(x) && sure(y))
            }
            (Expr::Of(Function::Modulus, x), Expr::Of(Function::Modulus, y), 0..=2) => {
                exact(modulus(&mul(x, y)))
            }
            (Expr::Power(x, p, q), Expr::Power(y, r, s), _) if x == y && p * s + r * q != 0 => {
                let (top, bottom) = lowest(p * s + r * q, q * s);
                let whole_powers = *q == 1 && *s == 1 && *p > 0 && *r > 0;
                loose(power(x, top, bottom), whole_powers || is_positive(x, ranges))
            }
            (_, Expr::Add(x, y), 0 | 1) => exact(add(&mul(a, x), &mul(a, y))),
            (_, Expr::Sub(x, y), 0 | 1) => exact(sub(&mul(a, x), &mul(a, y))),
            (Expr::Mul(x, y), _, 2) => exact(mul(x, &mul(y, b))),
            _ => exact(mul(b, a)),
        },
        Expr::Div(a, b) => match (&**a, &**b, stream.below(3)) {
            (Expr::Add(x, y), _, 0) => exact(add(&div(x, b), &div(y, b))),
            (_, Expr::Of(Function::Root, x), 0 | 1) => exact(div(&mul(a, &root(x)), x)),
            _ => exact(mul(a, &power(b, -1, 1))),
        },
        Expr::Power(a, 2, 1) => match (&**a, stream.below(3)) {
            (Expr::Of(Function::Root, x), _) => loose(x.clone(), sure(x)),
            (Expr::Of(Function::Modulus, x), _) => exact(square(x)),
            (Expr::Add(..) | Expr::Sub(..), 0 | 1) => exact(multiplied(a)),
            (_, 0) => exact(square(&modulus(a))),
            _ => exact(mul(a, a)),
        },
        Expr::Power(a, 1, 2) => exact(root(a)),
        Expr::Power(a, 1, 4) if is_positive(a, ranges) => exact(root(&root(a))),
        Expr::Power(a, top, bottom) if *bottom > 1 && is_positive(a, ranges) => {
            exact(mul(&power(a, 1, *bottom), &power(a, top - 1, *bottom)))
        }
        Expr::Neg(a) => match &**a {
            Expr::Sub(x, y) => exact(sub(y, x)),
            _ => exact(mul(&whole(-1), a)),
        },
        Expr::Of(function, a) => of_function(*function, tree, a, ranges, stream),
        Expr::Norm([a, b, c]) => exact(root(&add(&add(&square(a), &square(b)), &square(c)))),
        Expr::Number(_) | Expr::Symbol(_) | Expr::Power(..) | Expr::PowerTo(..) => None,
    }
}

fn lowest(top: i64, bottom: i64) -> (i64, i64) {
    let common = num_integer::gcd(top, bottom);
    (top / common, bottom / common)
}

fn of_function(
    function: Function,
    tree: &Tree,
    a: &Tree,
    ranges: &[Interval],
    stream: &mut Stream,
) -> Option<Rewritten> {
    let sure = |a: &Tree| is_nonnegative(a, ranges);
    let twice = |x: &Tree| mul(&whole(2), x);
    match (function, &**a) {
        (Function::Root, Expr::Mul(x, y)) => match (sure(x), sure(y)) {
            (true, true) => exact(mul(&root(x), &root(y))),
            _ if stream.once_in(2) => loose(mul(&root(x), &root(y)), false),
            _ => loose(mul(&root(&modulus(x)), &root(&modulus(y))), false),
        },
        (Function::Root, Expr::Div(x, y)) => {
            loose(div(&root(x), &root(y)), sure(x) && is_positive(y, ranges))
        }
        (Function::Root, Expr::Power(x, 2, 1)) => exact(modulus(x)),
        (Function::Root, _) if stream.once_in(3) => exact(power(a, 1, 2)),
        (Function::Root, _) => exact(root(&square(&root(a)))),
        (Function::Modulus, _) if sure(a) && !stream.once_in(4) => exact(a.clone()),
        (Function::Modulus, _) if sure(&neg(a)) && !stream.once_in(4) => exact(neg(a)),
        (Function::Modulus, Expr::Mul(x, y)) => exact(mul(&modulus(x), &modulus(y))),
        (Function::Modulus, Expr::Sub(x, y)) if stream.once_in(2) => exact(modulus(&sub(y, x))),
        (Function::Modulus, _) if stream.once_in(2) => exact(root(&square(a))),
        (Function::Modulus, _) => exact(modulus(tree)),
        (Function::Exp, Expr::Add(x, y)) => {
            exact(mul(&of(Function::Exp, x), &of(Function::Exp, y)))
        }
        (Function::Exp, Expr::Of(Function::Log, x)) => loose(x.clone(), is_positive(x, ranges)),
        (Function::Exp, _) => exact(square(&of(Function::Exp, &div(a, &whole(2))))),
        (Function::Log, Expr::Mul(x, y)) => loose(
            add(&of(Function::Log, x), &of(Function::Log, y)),
            is_positive(x, ranges) && is_positive(y, ranges),
        ),
        (Function::Log, _) => loose(twice(&of(Function::Log, &root(a))), true),
        (Function::Sin, Expr::Add(x, y)) => exact(add(
            &mul(&of(Function::Sin, x), &of(Function::Cos, y)),
            &mul(&of(Function::Cos, x), &of(Function::Sin, y)),
        )),
        (Function::Sin, _) => {
            let half = div(a, &whole(2));
            exact(mul(&twice(&of(Function::Sin, &half)), &of(Function::Cos, &half)))
        }
        (Function::Cos, _) => {
            let half = div(a, &whole(2));
            exact(sub(&whole(1), &twice(&square(&of(Function::Sin, &half)))))
        }
        (Function::Atan, _) => exact(neg(&of(Function::Atan, &neg(a)))),
    }
}
