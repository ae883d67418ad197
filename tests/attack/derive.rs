//! Derivatives as expressions, for claims that state a rate.

use std::rc::Rc;

use super::expr::{
    Expr, Function, Tree, add, div, modulus, mul, neg, of, power, ratio, root, square, sub, whole,
};

/// Differentiates an expression, given the derivatives of the symbols.
pub fn derived(tree: &Tree, rates: &dyn Fn(usize) -> Tree) -> Tree {
    let part = |a: &Tree| derived(a, rates);
    match &**tree {
        Expr::Number(_) => whole(0),
        Expr::Symbol(place) => rates(*place),
        Expr::Neg(a) => negated(&part(a)),
        Expr::Add(a, b) => sum(&part(a), &part(b)),
        Expr::Sub(a, b) => sum(&part(a), &negated(&part(b))),
        Expr::Mul(a, b) => sum(&product(&part(a), b), &product(a, &part(b))),
        Expr::Div(a, b) => {
            let (da, db) = (part(a), part(b));
            sum(&quotient(&da, b), &negated(&quotient(&product(a, &db), &square(b))))
        }
        Expr::Power(a, top, bottom) => {
            let lowered = match (top - bottom, bottom) {
                (0, _) => whole(1),
                (1, 1) => a.clone(),
                (n, d) => power(a, n, *d),
            };
            product(&mul(&ratio(*top, *bottom), &lowered), &part(a))
        }
        Expr::PowerTo(a, b) => {
            let inner =
                sum(&product(&part(b), &of(Function::Log, a)), &quotient(&product(b, &part(a)), a));
            product(tree, &inner)
        }
        Expr::Of(function, a) => {
            let slope = match function {
                Function::Root => div(&whole(1), &mul(&whole(2), &root(a))),
                Function::Modulus => div(a, &modulus(a)),
                Function::Exp => tree.clone(),
                Function::Log => div(&whole(1), a),
                Function::Sin => of(Function::Cos, a),
                Function::Cos => neg(&of(Function::Sin, a)),
                Function::Atan => div(&whole(1), &add(&whole(1), &square(a))),
            };
            product(&slope, &part(a))
        }
        Expr::Norm(parts) => {
            let total = parts
                .iter()
                .map(|x| product(x, &part(x)))
                .fold(whole(0), |total, term| sum(&total, &term));
            quotient(&total, &Rc::new(Expr::Norm(parts.clone())))
        }
    }
}

fn sum(a: &Tree, b: &Tree) -> Tree {
    match (a.is(0), b.is(0), &**b) {
        (true, _, _) => b.clone(),
        (_, true, _) => a.clone(),
        (_, _, Expr::Neg(b)) => sub(a, b),
        _ => add(a, b),
    }
}

fn negated(a: &Tree) -> Tree {
    if a.is(0) { a.clone() } else { neg(a) }
}

fn product(a: &Tree, b: &Tree) -> Tree {
    match () {
        () if a.is(0) || b.is(0) => whole(0),
        () if a.is(1) => b.clone(),
        () if b.is(1) => a.clone(),
        () => mul(a, b),
    }
}

fn quotient(a: &Tree, b: &Tree) -> Tree {
    if a.is(0) { whole(0) } else { div(a, b) }
}
