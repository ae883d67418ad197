//! Level sets with known branches: graphs, products, spheres, lines, empty ones.

use std::rc::Rc;

use super::branching::branching;
use super::claim::Claim;
use super::draw::Made;
use super::expr::{
    Expr, Number, Tree, add, div, modulus, mul, neg, node, ratio, replaced, root, square, sub,
    symbol, whole,
};
use super::flow::Known;
use super::grow::Garden;
use super::random::Stream;
use super::rewrite::{Rewritten, rewritten};
use super::scene::{Level, Origin, Scene, Symbol};
use super::spoil::{spoilt, unsigned};

pub const X: usize = 0;
pub const Y: usize = 1;
pub const Z: usize = 2;
/// A fourth variable, which few scenes have.
const W: usize = 3;

/// A range of a state variable, symmetric about 0.
pub fn wide(n: i64) -> Origin {
    Origin::State(Number { top: -n, bottom: 1, tens: 0 }, Number { top: n, bottom: 1, tens: 0 })
}

/// Draws a scene on a level, with claims.
pub fn on_a_level(stream: &mut Stream) -> (Scene, Vec<Made>) {
    let own = |name: &str, origin: Origin| Symbol { name: name.to_string(), origin };
    let mut scene = Scene::default();
    for name in ["x", "y", "z"] {
        let origin = match stream.below(4) {
            0 => {
                let (low, high) = super::draw::range(stream);
                Origin::State(low, high)
            }
            1 => wide(20),
            _ => wide(2),
        };
        scene.symbols.push(own(name, origin));
    }
    let (level, round) = match stream.below(15) {
        0..=2 => (graph(&mut scene, stream), false),
        3..=4 => (product(stream), false),
        5..=6 => (sphere(&mut scene, stream), true),
        7 => (two_sheets(&mut scene, stream), false),
        8..=9 => charted(&mut scene, stream),
        10 => (lines(stream), false),
        11..=12 => (branching(&mut scene, stream), false),
        13 => (pair(&mut scene, stream), false),
        _ => (empty(stream), false),
    };
    // A rotation preserves the circles about the z axis and the spheres.
    let turns = round && stream.once_in(2);
    if turns {
        scene.field = vec![(X, symbol(Y)), (Y, neg(&symbol(X)))];
    }
    scene.level = Some(level);
    let known = Known {
        integrals: match turns {
            true => vec![add(&square(&symbol(X)), &square(&symbol(Y))), symbol(Z)],
            false => vec![symbol(X), symbol(Y), symbol(Z)],
        },
        density: whole(1),
        relation: (whole(1), whole(0)),
        symmetries: vec![scene.field.clone()],
    };
    let count = if stream.once_in(6) { 2 } else { 1 };
    let made = |stream: &mut Stream| {
        let mut made = claim(&scene, &known, stream);
        // A statement true on the level by construction may be false off it.
        if stream.once_in(8) {
            (made.everywhere, made.vanishes) = (true, false);
        }
        made
    };
    let made = (0..count).map(|_| made(stream)).collect();
    (scene, made)
}

/// Draws x as a function of y and z, written in several ways.
fn graph(scene: &mut Scene, stream: &mut Stream) -> Level {
    let garden = Garden { scene, symbols: vec![Y, Z], functions: false, roots: true };
    let value = match stream.below(6) {
        0 => neg(&root(&symbol(Y))),
        1 => root(&add(&symbol(Y), &modulus(&symbol(Y)))),
        2 => add(&root(&symbol(Y)), &symbol(Z)),
        3 => modulus(&symbol(Y)),
        _ => garden.tree(stream, 2),
    };
    let x = symbol(X);
    let equation = match stream.below(4) {
        0 => (sub(&x, &value), whole(0)),
        1 => {
            let factor = add(&whole(1), &square(&symbol(Z)));
            (mul(&factor, &x), mul(&factor, &value))
        }
        2 => (add(&value, &whole(1)), add(&x, &whole(1))),
        _ => (x, value.clone()),
    };
    Level { equations: vec![equation], branches: vec![vec![(X, value)]], chart: None }
}

/// Draws a product of two factors, each of which may vanish.
fn product(stream: &mut Stream) -> Level {
    let (x, y, z) = (symbol(X), symbol(Y), symbol(Z));
    let value = match stream.below(4) {
        0 => whole(0),
        1 => square(&y),
        2 => whole(1),
        _ => mul(&y, &z),
    };
    let first = sub(&x, &value);
    // Solved for either coordinate, so that states are drawn from narrow ranges of the other.
    let circle = |at: i64, radius: Tree| {
        let centre = whole(at);
        let from_centre = |symbol: &Tree| square(&sub(symbol, &centre));
        let solved = |place: usize, other: &Tree| {
            let half = root(&sub(&square(&radius), &from_centre(other)));
            [vec![(place, add(&centre, &half))], vec![(place, sub(&centre, &half))]]
        };
        let distance = add(&from_centre(&y), &from_centre(&z));
        let branches = [solved(Y, &z), solved(Z, &y)].concat();
        (sub(&distance, &square(&radius)), branches)
    };
    let (second, others) = match stream.below(6) {
        0 => circle(0, ratio(1, 100)),
        1 => circle(1, ratio(1, 10)),
        2 => circle(0, whole(1)),
        3 => (y.clone(), vec![vec![(Y, whole(0))]]),
        4 => (sub(&y, &whole(1)), vec![vec![(Y, whole(1))]]),
        // A level without a second branch.
        _ => (add(&whole(1), &square(&y)), Vec::new()),
    };
    let mut branches = vec![vec![(X, value.clone())]];
    branches.extend(others);
    let equation = match stream.once_in(2) {
        true => (mul(&first, &second), whole(0)),
        false => (mul(&x, &second), mul(&value, &second)),
    };
    Level { equations: vec![equation], branches, chart: None }
}

/// Draws the unit sphere or a cylinder by its equation, in half of them with a range of one sign.
fn sphere(scene: &mut Scene, stream: &mut Stream) -> Level {
    let (place, other) = *stream.pick(&[(X, Y), (Y, X)]);
    let (a, b, z) = (symbol(place), symbol(other), symbol(Z));
    let (function, value, place, rest) = match stream.below(5) {
        0 => {
            let all = add(&add(&square(&a), &square(&b)), &square(&z));
            (all, whole(1), place, sub(&sub(&whole(1), &square(&b)), &square(&z)))
        }
        1 => {
            let all = add(&add(&square(&a), &square(&b)), &square(&z));
            (all, whole(2), Z, sub(&sub(&whole(2), &square(&a)), &square(&b)))
        }
        2 => (add(&square(&a), &square(&b)), whole(2), place, sub(&whole(2), &square(&b))),
        3 => (add(&square(&a), &square(&b)), whole(3), place, sub(&whole(3), &square(&b))),
        _ => (add(&square(&a), &square(&b)), ratio(1, 4), place, sub(&ratio(1, 4), &square(&b))),
    };
    one_sided(scene, place, stream);
    let branches = vec![vec![(place, root(&rest))], vec![(place, neg(&root(&rest)))]];
    Level { equations: vec![(function, value)], branches, chart: None }
}

/// Draws the two sheets of a² = g(b), as a hyperbola and a cubic curve have them, in half of them
/// with a range that contains one alone.
fn two_sheets(scene: &mut Scene, stream: &mut Stream) -> Level {
    let (place, other) = *stream.pick(&[(X, Y), (Y, X), (Z, X)]);
    let (a, b) = (symbol(place), symbol(other));
    let rest = match stream.below(6) {
        0 => add(&whole(1), &mul(&square(&b), &b)),
        1 => add(&whole(1), &square(&b)),
        2 => sub(&square(&b), &whole(1)),
        3 => add(&whole(1), &mul(&whole(2), &square(&b))),
        4 => b.clone(),
        _ => add(&whole(2), &mul(&whole(3), &b)),
    };
    one_sided(scene, place, stream);
    let branches = vec![vec![(place, root(&rest))], vec![(place, neg(&root(&rest)))]];
    Level { equations: vec![(square(&a), rest)], branches, chart: None }
}

/// Restricts the range of a state variable to one sign, half of the time.
fn one_sided(scene: &mut Scene, place: usize, stream: &mut Stream) {
    let number = |top: i64| Number { top, bottom: 10, tens: 0 };
    let (low, high) = *stream.pick(&[(1, 30), (-30, -1), (0, 30), (-20, 20), (-20, 20), (-40, 40)]);
    scene.symbols[place].origin = Origin::State(number(low), number(high));
}

/// Draws a sphere, a cylinder or a graph with a given chart.
fn charted(scene: &mut Scene, stream: &mut Stream) -> (Level, bool) {
    // The image of a chart lies in the declared ranges.
    for symbol in &mut scene.symbols {
        symbol.origin = wide(5000);
    }
    for name in ["u", "v"] {
        let (low, high) = super::draw::range(stream);
        scene.symbols.push(Symbol { name: name.to_string(), origin: Origin::Input(low, high) });
    }
    let (x, y, z) = (symbol(X), symbol(Y), symbol(Z));
    let (u, v) = (symbol(3), symbol(4));
    let shape = stream.below(4);
    let (equation, chart) = match shape {
        0 => {
            let below = add(&add(&whole(1), &square(&u)), &square(&v));
            let chart = vec![
                (X, div(&mul(&whole(2), &u), &below)),
                (Y, div(&mul(&whole(2), &v), &below)),
                (Z, div(&sub(&sub(&whole(1), &square(&u)), &square(&v)), &below)),
            ];
            ((add(&add(&square(&x), &square(&y)), &square(&z)), whole(1)), chart)
        }
        1 => {
            let below = add(&whole(1), &square(&u));
            let chart = vec![
                (X, div(&mul(&whole(2), &u), &below)),
                (Y, div(&sub(&whole(1), &square(&u)), &below)),
                (Z, v),
            ];
            ((add(&square(&x), &square(&y)), whole(1)), chart)
        }
        2 => return (curve(&u, &v), false),
        _ => {
            let (a, b) = (add(&u, &modulus(&u)), root(&square(&add(&v, &whole(1)))));
            let chart = vec![(X, add(&a, &b)), (Y, u), (Z, v)];
            ((x, add(&add(&y, &modulus(&y)), &modulus(&add(&z, &whole(1))))), chart)
        }
    };
    let branches = vec![chart.clone()];
    (Level { equations: vec![equation], branches, chart: Some(chart) }, shape < 2)
}

/// Draws the plane z = 0 with a chart by a parabola whose large terms cancel.
fn curve(u: &Tree, v: &Tree) -> Level {
    let along = add(u, v);
    let nothing =
        sub(&square(&sub(u, v)), &add(&sub(&square(u), &mul(&whole(2), &mul(u, v))), &square(v)));
    let large = mul(&Rc::new(Expr::Number(Number { top: 1, bottom: 1, tens: 12 })), &nothing);
    let chart = vec![(X, along.clone()), (Y, add(&square(&along), &large)), (Z, mul(&whole(0), u))];
    let plane = vec![(Z, whole(0))];
    Level { equations: vec![(symbol(Z), whole(0))], branches: vec![plane], chart: Some(chart) }
}

/// Draws two vectors (x, y) and (z, w) of given lengths at a given angle.
fn pair(scene: &mut Scene, stream: &mut Stream) -> Level {
    scene.symbols.push(Symbol { name: "w".to_string(), origin: wide(3) });
    // States are drawn by x alone: narrow ranges of the others would leave none of them.
    for place in [X, Y, Z] {
        one_sided(scene, place, stream);
    }
    let (x, y, z, w) = (symbol(X), symbol(Y), symbol(Z), symbol(W));
    let (a, b, c) = match stream.below(5) {
        0 => (whole(1), whole(1), whole(0)),
        1 => (whole(2), whole(1), whole(0)),
        2 => (whole(1), whole(4), ratio(-1, 2)),
        3 => (ratio(1, 4), whole(9), whole(1)),
        _ => (whole(3), whole(2), whole(-2)),
    };
    // The second vector is (c (x, y) ± √(ab − c²) (−y, x))/a.
    let across = root(&sub(&mul(&a, &b), &square(&c)));
    let solved = |y: &Tree, across: &Tree| {
        let second = [sub(&mul(&c, &x), &mul(across, y)), add(&mul(&c, y), &mul(across, &x))];
        let [z, w] = second.map(|own| div(&own, &a));
        vec![(Y, y.clone()), (Z, z), (W, w)]
    };
    let half = root(&sub(&a, &square(&x)));
    let halves = [half.clone(), neg(&half)];
    let both = |y: &Tree| [solved(y, &across), solved(y, &neg(&across))];
    let branches = halves.iter().flat_map(both).collect();
    let mut equations = vec![
        (add(&square(&x), &square(&y)), a.clone()),
        (add(&square(&z), &square(&w)), b),
        (add(&mul(&x, &z), &mul(&y, &w)), c.clone()),
    ];
    let turn = stream.below(3);
    equations.rotate_left(turn);
    Level { equations, branches, chart: None }
}

/// Draws two linear equations in the same variables.
fn lines(stream: &mut Stream) -> Level {
    let (x, y, z) = (symbol(X), symbol(Y), symbol(Z));
    let k = *stream.pick(&[1, 2, 3]);
    let first = add(&add(&x, &mul(&whole(k), &y)), &mul(&whole(3), &z));
    let second = add(&x, &y);
    // (k − 1) y = −3z; for k = 1 this leaves z = 0 and x = −y.
    let branch = match k {
        1 => vec![(Z, whole(0)), (X, neg(&y))],
        _ => {
            let value = div(&mul(&whole(-3), &z), &whole(k - 1));
            vec![(Y, value.clone()), (X, neg(&value))]
        }
    };
    Level {
        equations: vec![(first, whole(0)), (second, whole(0))],
        branches: vec![branch],
        chart: None,
    }
}

/// Draws a level without real points, or without points in the ranges.
fn empty(stream: &mut Stream) -> Level {
    let (x, y) = (symbol(X), symbol(Y));
    let (equation, branches) = match stream.below(3) {
        0 => ((add(&square(&x), &square(&y)), whole(-1)), Vec::new()),
        1 => {
            let value = add(&y, &whole(50));
            ((sub(&x, &value), whole(0)), vec![vec![(X, value)]])
        }
        _ => {
            let value = root(&sub(&whole(-1), &square(&y)));
            ((x, value.clone()), vec![vec![(X, value)]])
        }
    };
    Level { equations: vec![equation], branches, chart: None }
}

/// Draws a claim on the level: in half of them some variables are replaced by their values there.
fn claim(scene: &Scene, known: &Known, stream: &mut Stream) -> Made {
    if stream.once_in(3) {
        let mut made = super::draw::claim(scene, known, stream);
        // Fields that commute in space may leave the level.
        made.vanishes &= !matches!(made.claim, Claim::SymmetryField(_));
        return made;
    }
    let symbols = scene.states();
    let garden = Garden { scene, symbols, functions: false, roots: !stream.once_in(3) };
    let ranges = scene.intervals();
    let depth = 1 + stream.below(2);
    let tree = garden.tree(stream, depth);
    let level = scene.level.as_ref();
    let equation = level.and_then(|level| level.equations.first()).cloned();
    let mut other = tree.clone();
    let mut turned = false;
    if let Some((left, right)) = &equation {
        for index in (0..other.size()).rev() {
            if node(&other, index).is_some_and(|part| part == *left) && !stream.once_in(3) {
                other = replaced(&other, index, right);
                turned = true;
            }
        }
        if !turned {
            let (a, b) = (add(&tree, left), add(&other, right));
            return compared(scene, a, rewritten(&b, &ranges, stream, 2), &garden, stream);
        }
    }
    let other = rewritten(&other, &ranges, stream, 3);
    compared(scene, tree, other, &garden, stream)
}

/// Draws two expressions that agree on the level, or nearly so.
fn compared(
    scene: &Scene,
    left: Tree,
    right: Rewritten,
    garden: &Garden<'_>,
    stream: &mut Stream,
) -> Made {
    let (tree, exact) = match stream.below(6) {
        0 => (spoilt(&right.tree, garden, stream), false),
        1 => (unsigned(&right.tree, garden, stream), false),
        _ => (right.tree, right.exact),
    };
    let branches = scene.level.as_ref().map_or(&[][..], |level| &level.branches);
    // Symbols drawn by the oracle alone are unknown to claims.
    let typed =
        |(_, value): &&(usize, Tree)| (W..scene.symbols.len()).all(|place| !value.has(place));
    match (stream.below(8), branches.iter().flatten().find(typed)) {
        // Equal on one branch.
        (0, Some((place, value))) => {
            Made::new(Claim::Identity(symbol(*place), value.clone()), false)
        }
        (1, _) => Made::new(Claim::Integral(sub(&left, &tree)), false),
        _ => Made::new(Claim::Identity(left, tree), exact),
    }
}
