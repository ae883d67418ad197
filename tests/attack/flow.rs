//! Fields with known invariants, for claims about motion.

use super::expr::{Tree, add, div, mul, neg, square, symbol, whole};
use super::random::Stream;
use super::scene::Scene;

/// Known invariants of a field.
pub struct Known {
    /// Conserved functions.
    pub integrals: Vec<Tree>,
    /// Invariant density.
    pub density: Tree,
    /// Function with its cofactor.
    pub relation: (Tree, Tree),
    /// Fields that commute with the field.
    pub symmetries: Vec<Vec<(usize, Tree)>>,
}

/// Gives the scene a field with known invariants.
pub fn flow(scene: &mut Scene, stream: &mut Stream) -> Known {
    let states = scene.states();
    let (x, rest) = (states[0], &states[1..]);
    let others = |from: usize| rest.iter().skip(from).map(|place| symbol(*place));
    let parameters: Vec<Tree> = (0..scene.symbols.len())
        .filter(|place| !states.contains(place) && scene.symbols[*place].name != "ε")
        .map(symbol)
        .collect();
    let plain = |integrals: Vec<Tree>, field: &[(usize, Tree)]| Known {
        integrals: integrals.into_iter().chain(parameters.clone()).collect(),
        density: whole(1),
        relation: (whole(1), whole(0)),
        symmetries: vec![field.to_vec()],
    };
    let choice = match states.len() {
        1 => stream.below(3),
        _ => stream.below(7),
    };
    let (own, y) = (symbol(x), rest.first().map_or(symbol(x), |place| symbol(*place)));
    let (field, known) = match choice {
        0 => {
            let mut known = plain(states.iter().map(|place| symbol(*place)).collect(), &[]);
            known.symmetries = states.iter().map(|place| vec![(*place, whole(1))]).collect();
            (Vec::new(), known)
        }
        1 => {
            let field = vec![(x, whole(1))];
            let known = plain(others(0).collect(), &field);
            (field, known)
        }
        2 if states.len() == 1 => {
            let field = vec![(x, own.clone())];
            let mut known = plain(Vec::new(), &field);
            known.density = div(&whole(1), &own);
            known.relation = (own, whole(1));
            (field, known)
        }
        2 | 3 => {
            let field = vec![(x, y)];
            let known = plain(others(0).collect(), &field);
            (field, known)
        }
        4 => {
            let field = vec![(x, own.clone()), (rest[0], y.clone())];
            let mut known = plain([div(&own, &y)].into_iter().chain(others(1)).collect(), &field);
            known.density = div(&whole(1), &mul(&own, &y));
            known.relation = (add(&square(&own), &square(&y)), whole(2));
            (field, known)
        }
        5 => {
            let field = vec![(x, y.clone()), (rest[0], neg(&own))];
            let circle = add(&square(&own), &square(&y));
            let mut known = plain([circle].into_iter().chain(others(1)).collect(), &field);
            known.symmetries.push(vec![(x, own), (rest[0], y)]);
            (field, known)
        }
        _ => {
            let field = vec![(x, own.clone()), (rest[0], neg(&y))];
            let mut known = plain([mul(&own, &y)].into_iter().chain(others(1)).collect(), &field);
            known.relation = (y, whole(-1));
            (field, known)
        }
    };
    scene.field = field;
    known
}
