//! Case `index` of a seed: a scene with one or more claims.

use super::claim::Claim;
use super::derive::derived;
use super::expr::{Number, Tree, add, modulus, mul, root, square, sub, substituted, symbol, whole};
use super::flow::{Known, flow};
use super::grow::Garden;
use super::levels;
use super::limits;
use super::print::Hand;
use super::random::Stream;
use super::rewrite::{Rewritten, rewritten};
use super::scene::{Origin, Scene, Symbol};
use super::spoil::{spoilt, unsigned};

/// A claim with the facts about it that follow from its construction.
#[derive(Clone, Debug)]
pub struct Made {
    pub claim: Claim,
    /// Whether its residual vanishes by construction wherever it is defined.
    pub vanishes: bool,
    /// Whether it is claimed off the level too.
    pub everywhere: bool,
}

impl Made {
    /// Makes a claim at the place of its scene.
    pub fn new(claim: Claim, vanishes: bool) -> Self {
        Self { claim, vanishes, everywhere: false }
    }

    /// Writes the body of the claim's table.
    pub fn body(&self, names: &[String], hand: Hand) -> String {
        let body = self.claim.body(names, hand);
        if self.everywhere { format!("{body}\nwhere = \"everywhere\"") } else { body }
    }
}

/// A scene with claims.
#[derive(Clone, Debug)]
pub struct Drawn {
    pub scene: Scene,
    pub made: Vec<Made>,
    pub hand: Hand,
    pub seed: u64,
}

/// Draws case `index` of a seed.
pub fn drawn(seed: u64, index: u64) -> Drawn {
    let mut stream = Stream::new(seed, index);
    let stream = &mut stream;
    let hand = Hand(stream.below(8) as u8);
    let own_seed = 1 + stream.bits() % 1_000_000;
    let (scene, made) = match stream.below(20) {
        0..=3 => levels::on_a_level(stream),
        4..=5 => limits::limit(stream),
        _ => {
            let mut scene = plain(stream);
            let known = flow(&mut scene, stream);
            let count = if stream.once_in(8) { 3 } else { 1 };
            let made = (0..count).map(|_| claim(&scene, &known, stream)).collect();
            (scene, made)
        }
    };
    Drawn { scene, made, hand, seed: own_seed }
}

fn number(top: i64, bottom: i64) -> Number {
    Number { top, bottom, tens: 0 }
}

/// Draws a random range.
pub fn range(stream: &mut Stream) -> (Number, Number) {
    let (a, b) = *stream.pick(&[
        ((1, 1), (2, 1)),
        ((1, 1), (2, 1)),
        ((1, 2), (2, 1)),
        ((0, 1), (2, 1)),
        ((-2, 1), (2, 1)),
        ((-2, 1), (2, 1)),
        ((-2, 1), (2, 1)),
        ((-2, 1), (-1, 1)),
        ((-1, 2), (2, 1)),
        ((-6, 1), (21, 10)),
        ((0, 1), (1, 1)),
        ((-1, 1), (1000, 1)),
        ((1, 1000), (1, 100)),
    ]);
    (number(a.0, a.1), number(b.0, b.1))
}

/// Draws state variables and parameters.
pub fn plain(stream: &mut Stream) -> Scene {
    let mut symbols = Vec::new();
    let count = *stream.pick(&[1, 2, 2, 2, 3]);
    for name in ["x", "y", "z"].iter().take(count) {
        let (low, high) = range(stream);
        symbols.push(Symbol { name: name.to_string(), origin: Origin::State(low, high) });
    }
    let mut scene = Scene { symbols, ..Scene::default() };
    for name in ["a", "b"].iter().take(stream.below(3)) {
        let origin = parameter(&scene, stream);
        scene.symbols.push(Symbol { name: name.to_string(), origin });
    }
    scene
}

fn parameter(scene: &Scene, stream: &mut Stream) -> Origin {
    let parameters: Vec<usize> = (0..scene.symbols.len())
        .filter(|place| !matches!(scene.symbols[*place].origin, Origin::State(..)))
        .collect();
    match stream.below(9) {
        0 => {
            Origin::Fixed(*stream.pick(&[number(0, 1), number(-1, 1), number(3, 1), number(1, 2)]))
        }
        1..=3 => {
            let all = [
                number(-1, 1),
                number(2, 1),
                number(-3, 2),
                number(3, 1),
                number(1, 4),
                number(0, 1),
            ];
            let mut list: Vec<Number> = Vec::new();
            while list.len() < 2 + stream.below(2) {
                let one = *stream.pick(&all);
                if !list.contains(&one) {
                    list.push(one);
                }
            }
            Origin::List(list)
        }
        4..=5 if !parameters.is_empty() => {
            let garden =
                Garden { scene, symbols: parameters.clone(), functions: false, roots: true };
            let a = garden.symbol(stream);
            Origin::Formula(match stream.below(4) {
                0 => root(&sub(&whole(1), &square(&a))),
                1 => root(&a),
                2 => modulus(&a),
                _ => garden.tree(stream, 2),
            })
        }
        _ => {
            let (low, high) = range(stream);
            Origin::Range(low, high)
        }
    }
}

/// Draws two expressions that differ only in the sign of a symbol, next to a root that seems to
/// determine it.
fn shadowed(garden: &Garden<'_>, stream: &mut Stream) -> (Tree, Tree) {
    let u = garden.symbol(stream);
    let factor = garden.one_sided(stream);
    let shadow = match stream.below(4) {
        0 => root(&mul(&factor, &u)),
        1 => root(&mul(&u, &root(&factor))),
        2 => mul(&root(&mul(&u, &factor)), &garden.atom(stream)),
        _ => root(&mul(&u, &modulus(&factor))),
    };
    let with = |u: &Tree| match &shadow {
        shadow if shadow.size() % 3 == 0 => mul(u, &add(&whole(1), shadow)),
        shadow if shadow.size() % 3 == 1 => add(shadow, u),
        shadow => add(u, shadow),
    };
    (with(&modulus(&u)), with(&u))
}

/// Draws two expressions that agree wherever both have values, or nearly so.
pub fn pair(garden: &Garden<'_>, stream: &mut Stream) -> (Rewritten, Rewritten) {
    let ranges = garden.scene.intervals();
    if garden.roots && stream.once_in(16) {
        let (left, right) = shadowed(garden, stream);
        let times = (stream.below(2), stream.below(3));
        let loose = |tree: Tree| Rewritten { tree, exact: false };
        return (
            loose(rewritten(&left, &ranges, stream, times.0).tree),
            loose(rewritten(&right, &ranges, stream, times.1).tree),
        );
    }
    let depth = 1 + stream.below(3);
    let tree = garden.tree(stream, depth);
    let times = (stream.below(3), 1 + stream.below(6));
    let mut left = rewritten(&tree, &ranges, stream, times.0);
    let mut right = rewritten(&tree, &ranges, stream, times.1);
    match stream.below(10) {
        0..=4 => {}
        5..=6 => right = Rewritten { tree: unsigned(&right.tree, garden, stream), exact: false },
        7..=8 => right = Rewritten { tree: spoilt(&right.tree, garden, stream), exact: false },
        _ => left = Rewritten { tree: unsigned(&left.tree, garden, stream), exact: false },
    }
    (left, right)
}

/// Draws a claim of any kind.
pub fn claim(scene: &Scene, known: &Known, stream: &mut Stream) -> Made {
    let garden = Garden::new(scene, stream);
    let ranges = scene.intervals();
    let (left, right) = pair(&garden, stream);
    let exact = left.exact && right.exact;
    // A function that vanishes, or nearly so.
    let nothing = match stream.below(4) {
        0 => mul(&garden.atom(stream), &sub(&left.tree, &right.tree)),
        _ => sub(&left.tree, &right.tree),
    };
    let kept = |stream: &mut Stream| -> Rewritten {
        let depth = 1 + stream.below(2);
        let tree = garden.tree(stream, depth);
        let picks: Vec<Tree> = scene
            .symbols
            .iter()
            .map(|_| match known.integrals.is_empty() {
                true => whole(2),
                false => stream.pick(&known.integrals).clone(),
            })
            .collect();
        let of_integrals = substituted(&tree, &|place| picks[place].clone());
        let times = stream.below(4);
        rewritten(&of_integrals, &ranges, stream, times)
    };
    let made = Made::new;
    let alone = stream.once_in(2);
    match stream.below(100) {
        0..=44 => made(Claim::Identity(left.tree, right.tree), exact),
        45..=56 => {
            let kept = kept(stream);
            match alone {
                true => made(Claim::Integral(kept.tree), kept.exact),
                false => made(Claim::Integral(add(&kept.tree, &nothing)), kept.exact && exact),
            }
        }
        57..=66 => {
            let rate = |place: usize| scene.rate(place).cloned().unwrap_or_else(|| whole(0));
            match alone {
                true => {
                    let times = stream.below(4);
                    let slope = rewritten(&derived(&left.tree, &rate), &ranges, stream, times);
                    // Where a function is undefined on an open set, so is its rate.
                    made(Claim::Rate(left.tree, slope.tree), slope.exact)
                }
                false => {
                    let place = *stream.pick(&scene.states());
                    let slope = add(&rate(place), &nothing);
                    made(Claim::Rate(symbol(place), slope), exact)
                }
            }
        }
        67..=74 => {
            let factor = kept(stream);
            match alone {
                true => made(Claim::Density(mul(&known.density, &factor.tree)), factor.exact),
                false => {
                    let density = mul(&known.density, &add(&whole(1), &nothing));
                    made(Claim::Density(density), exact)
                }
            }
        }
        75..=81 => {
            let (f, cofactor) = &known.relation;
            match alone {
                true => {
                    let factor = kept(stream);
                    let times = stream.below(3);
                    let f = rewritten(&mul(f, &factor.tree), &ranges, stream, times);
                    made(Claim::Relation(f.tree, cofactor.clone()), f.exact && factor.exact)
                }
                false => made(Claim::Relation(f.clone(), add(cofactor, &nothing)), exact),
            }
        }
        82..=87 => {
            let mut field = stream.pick(&known.symmetries).clone();
            let factor = kept(stream);
            let on_axis = field.iter().all(|(_, rate)| rate.is(1));
            let mut vanishes = exact || alone;
            // Multiples by conserved factors commute; fields that do not conserve them are
            // excepted.
            if on_axis || scene.field == field {
                vanishes &= factor.exact;
                for (_, rate) in &mut field {
                    *rate = mul(&factor.tree, rate);
                }
            }
            if !alone && let Some((_, rate)) = field.first_mut() {
                *rate = add(rate, &nothing);
            }
            made(Claim::SymmetryField(field), vanishes)
        }
        _ => independent(&garden, left, right, exact, stream),
    }
}

/// Draws functions that may depend on each other.
fn independent(
    garden: &Garden<'_>,
    left: Rewritten,
    right: Rewritten,
    exact: bool,
    stream: &mut Stream,
) -> Made {
    let difference = sub(&left.tree, &right.tree);
    let states = garden.scene.states().len();
    let other = garden.tree(stream, 1);
    let ranges = garden.scene.intervals();
    let (list, vanishes) = match stream.below(4) {
        0 => (vec![difference], exact),
        1 => (vec![mul(&garden.atom(stream), &difference)], exact),
        2 if states > 1 => (vec![other.clone(), add(&other, &difference)], exact),
        3 if states > 1 => {
            let squared = rewritten(&square(&other), &ranges, stream, 2);
            (vec![other, squared.tree], squared.exact)
        }
        _ => (vec![left.tree], false),
    };
    Made::new(Claim::Independent(list), vanishes)
}
