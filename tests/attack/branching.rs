//! Levels on which an equation loses its unknown: on one branch of another equation, or for one
//! value of a listed parameter.

use super::expr::{Number, Tree, add, modulus, mul, square, sub, symbol, whole};
use super::levels::{X, Y, Z, wide};
use super::random::Stream;
use super::scene::{Level, Origin, Scene, Symbol};

/// Draws a level of two equations, or of one with a listed parameter.
pub fn branching(scene: &mut Scene, stream: &mut Stream) -> Level {
    match stream.below(6) {
        0 => two_values(stream),
        1 => two_signs(scene, stream),
        2 => leading(stream),
        3 => curve(stream),
        4 => listed_pair(scene, stream),
        _ => listed_slope(scene, stream),
    }
}

fn some(stream: &mut Stream) -> Tree {
    whole(*stream.pick(&[1, 2, -1]))
}

fn level(equations: Vec<(Tree, Tree)>, branches: Vec<Vec<(usize, Tree)>>) -> Level {
    Level { equations, branches, chart: None }
}

/// Draws two equations in either order.
fn both(first: Tree, second: Tree, stream: &mut Stream) -> Vec<(Tree, Tree)> {
    let mut equations = vec![(first, whole(0)), (second, whole(0))];
    if stream.once_in(2) {
        equations.swap(0, 1);
    }
    equations
}

/// (x − a)(x − b) = 0 with p y + q z = r, where p and q vanish on one branch each.
fn two_values(stream: &mut Stream) -> Level {
    let (x, y, z) = (symbol(X), symbol(Y), symbol(Z));
    let (a, b) = (whole(0), some(stream));
    let first = match stream.below(3) {
        0 => mul(&sub(&x, &a), &sub(&x, &b)),
        1 => sub(&square(&x), &mul(&b, &x)),
        _ => sub(&modulus(&sub(&mul(&whole(2), &x), &b)), &modulus(&b)),
    };
    let second = add(&mul(&sub(&x, &a), &y), &mul(&sub(&b, &x), &z));
    let branches = vec![vec![(X, a), (Z, whole(0))], vec![(X, b), (Y, whole(0))]];
    level(both(first, second, stream), branches)
}

/// x² = y² with (x − y) w + k (x + y) z = 0.
fn two_signs(scene: &mut Scene, stream: &mut Stream) -> Level {
    let w = scene.symbols.len();
    scene.symbols.push(Symbol { name: "w".to_string(), origin: wide(2) });
    let (x, y, z) = (symbol(X), symbol(Y), symbol(Z));
    let first = match stream.below(3) {
        0 => sub(&modulus(&x), &modulus(&y)),
        _ => sub(&square(&x), &square(&y)),
    };
    let of_w = mul(&sub(&x, &y), &symbol(w));
    let second = add(&of_w, &mul(&some(stream), &mul(&add(&x, &y), &z)));
    let branches = vec![
        vec![(X, y.clone()), (Z, whole(0))],
        vec![(X, sub(&whole(0), &y)), (w, whole(0))],
        vec![(X, whole(0)), (Y, whole(0))],
    ];
    level(both(first, second, stream), branches)
}

/// x (x − 1) = 0 with (1 − x)(z² − 1) + x (z − k) = 0, quadratic on one branch and linear on the
/// other.
fn leading(stream: &mut Stream) -> Level {
    let (x, z, k) = (symbol(X), symbol(Z), some(stream));
    let bend = mul(&sub(&whole(1), &x), &sub(&square(&z), &whole(1)));
    let second = add(&bend, &mul(&x, &sub(&z, &k)));
    let first = mul(&x, &sub(&x, &whole(1)));
    let branches = vec![
        vec![(X, whole(0)), (Z, whole(1))],
        vec![(X, whole(0)), (Z, whole(-1))],
        vec![(X, whole(1)), (Z, k)],
    ];
    level(both(first, second, stream), branches)
}

/// (x − k) y + w z = 0 with x z = 0: each equation alone loses points only.
fn curve(stream: &mut Stream) -> Level {
    let (x, y, z) = (symbol(X), symbol(Y), symbol(Z));
    let k = some(stream);
    let first = add(&mul(&sub(&x, &k), &y), &z);
    let second = mul(&x, &z);
    let branches = vec![
        // z = 0: (x − k) y = 0
        vec![(Z, whole(0)), (X, k.clone())],
        vec![(Z, whole(0)), (Y, whole(0))],
        // x = 0: z = k y
        vec![(X, whole(0)), (Z, mul(&k, &y))],
    ];
    level(both(first, second, stream), branches)
}

/// Adds a parameter that is 0 or 1, and an input of the oracle.
fn listed(scene: &mut Scene) -> (Tree, Tree) {
    let place = scene.symbols.len();
    let number = |top: i64| Number { top, bottom: 1, tens: 0 };
    let list = Origin::List(vec![number(0), number(1)]);
    scene.symbols.push(Symbol { name: "a".to_string(), origin: list });
    (symbol(place), input(scene, "s", X))
}

/// Adds an input of the oracle with the range of a state variable.
fn input(scene: &mut Scene, name: &str, of: usize) -> Tree {
    let place = scene.symbols.len();
    if let Origin::State(low, high) = scene.symbols[of].origin {
        scene.symbols.push(Symbol { name: name.to_string(), origin: Origin::Input(low, high) });
    }
    symbol(place)
}

/// a x + (1 − a) y = 0 for a = 0 and a = 1.
fn listed_pair(scene: &mut Scene, stream: &mut Stream) -> Level {
    let (a, s) = listed(scene);
    let t = input(scene, "t", Y);
    let (x, y) = (symbol(X), symbol(Y));
    let other = sub(&whole(1), &a);
    let equation = add(&mul(&a, &x), &mul(&mul(&some(stream), &other), &y));
    let branch = vec![(X, mul(&other, &s)), (Y, mul(&a, &t))];
    level(vec![(equation, whole(0))], vec![branch])
}

/// (a − 1) x + y z = 0 for a = 0 and a = 1.
fn listed_slope(scene: &mut Scene, stream: &mut Stream) -> Level {
    let (a, s) = listed(scene);
    let t = input(scene, "t", Y);
    let (x, y, z) = (symbol(X), symbol(Y), symbol(Z));
    let other = sub(&whole(1), &a);
    let equation = match stream.once_in(2) {
        true => (mul(&other, &x), mul(&y, &z)),
        false => (add(&mul(&sub(&a, &whole(1)), &x), &mul(&y, &z)), whole(0)),
    };
    // For a = 1 either y or z is 0, and x is free.
    let branch = |lost: usize, kept: &Tree| {
        let value = mul(&other, &t);
        let solved = add(&mul(&other, &mul(&t, kept)), &mul(&a, &s));
        vec![(X, solved), (lost, value)]
    };
    level(vec![equation], vec![branch(Y, &z), branch(Z, &y)])
}
