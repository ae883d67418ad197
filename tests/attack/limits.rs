//! Limits of expressions at points where they may be undefined.

use super::claim::Claim;
use super::draw::{Made, range};
use super::expr::{
    Expr, Function, Number, Tree, add, div, modulus, mul, of, power, ratio, root, square, sub,
    symbol, whole,
};
use super::random::Stream;
use super::scene::{Origin, Scene, Symbol};

/// An expression with its limit, if that is a number.
type Tending = (Tree, Option<Tree>);

/// Draws a limit for ε → 0.
pub fn limit(stream: &mut Stream) -> (Scene, Vec<Made>) {
    let positive = (Number { top: 1, bottom: 1, tens: 0 }, Number { top: 2, bottom: 1, tens: 0 });
    let (low, high) = if stream.once_in(3) { range(stream) } else { positive };
    let (from, to) = positive;
    let tenth = Number { top: 1, bottom: 10, tens: 0 };
    let own = |name: &str, origin: Origin| Symbol { name: name.to_string(), origin };
    let symbols = vec![
        own("x", Origin::State(low, high)),
        own("a", Origin::Range(from, to)),
        own("ε", Origin::Range(tenth, Number { top: 1, bottom: 1, tens: 0 })),
    ];
    let scene = Scene { symbols, ..Scene::default() };
    let count = if stream.once_in(6) { 2 } else { 1 };
    let made = (0..count).map(|_| claim(stream)).collect();
    (scene, made)
}

fn claim(stream: &mut Stream) -> Made {
    let (tree, tends) = composed(stream);
    let wrong = |stream: &mut Stream| match stream.below(4) {
        0 => whole(0),
        1 => whole(1),
        2 => symbol(1),
        _ => whole(2),
    };
    let to = match tends {
        Some(limit) if !stream.once_in(3) => limit,
        _ => wrong(stream),
    };
    Made::new(Claim::Limit(tree, to, 2), false)
}

/// Draws one or more combined pieces.
fn composed(stream: &mut Stream) -> Tending {
    let (a, to) = piece(stream);
    let x = symbol(stream.below(2));
    match stream.below(8) {
        0 => (div(&x, &a), to.map(|to| div(&x, &to))),
        1 => (div(&whole(1), &a), to.map(|to| div(&whole(1), &to))),
        2 => (add(&x, &a), to.map(|to| add(&x, &to))),
        3 => {
            let (b, other) = piece(stream);
            (mul(&a, &b), to.zip(other).map(|(to, other)| mul(&to, &other)))
        }
        4 => (of(Function::Exp, &a), to.map(|to| of(Function::Exp, &to))),
        5 => (root(&a), to.map(|to| root(&to))),
        6 => (div(&whole(1), &div(&whole(1), &a)), to),
        _ => (a, to),
    }
}

/// Draws an expression in ε with a known limit.
fn piece(stream: &mut Stream) -> Tending {
    let e = symbol(2);
    let c = match stream.below(3) {
        0 => whole(1),
        1 => symbol(1),
        _ => whole(2),
    };
    let ce = mul(&c, &e);
    let one = whole(1);
    let (tree, to) = match stream.below(16) {
        0 => (div(&of(Function::Sin, &ce), &e), c),
        1 => (div(&sub(&of(Function::Exp, &ce), &one), &e), c),
        2 => (div(&of(Function::Log, &add(&one, &ce)), &e), c),
        3 => (div(&sub(&root(&add(&one, &ce)), &one), &e), div(&c, &whole(2))),
        4 => (div(&sub(&one, &of(Function::Cos, &e)), &e), whole(0)),
        5 => (div(&sub(&one, &of(Function::Cos, &e)), &square(&e)), ratio(1, 2)),
        6 => (mul(&ce, &of(Function::Log, &e)), whole(0)),
        7 => (of(Function::Exp, &mul(&ce, &of(Function::Log, &e))), one),
        8 => (div(&power(&e, 3, 1), &square(&e)), whole(0)),
        9 => {
            let x = symbol(0);
            (div(&sub(&square(&add(&x, &e)), &square(&x)), &e), mul(&whole(2), &x))
        }
        10 => (std::rc::Rc::new(Expr::PowerTo(stream.pick(&[c, whole(0)]).clone(), e)), one),
        11 => (add(&root(&mul(&whole(-1), &square(&e))), &one), one),
        12 => (div(&modulus(&e), &e), one),
        13 => (add(&c, &root(&e)), c),
        14 => (add(&c, &of(Function::Sin, &ce)), c),
        _ => (add(&root(&add(&square(&c), &e)), &e), c),
    };
    (tree, Some(to))
}
