//! Squares among the values of a graph: A Π A_i = c² b² for a radicand A and earlier ones A_i.

use rustc_hash::FxHashMap;

use crate::graph::{Evaluator, Expr, Tape};
use crate::number::prime::{Modulus, Prime, UNDEFINED};
use crate::number::rational::Rational;

use super::algebraic::{Algebraic, Root};
use super::chance::Chance;
use super::digest::Digest;
use super::identity::{LANES, MOST_ROOTS, Trial, points};
use super::standing::Standing;

/// Blocks of points that are tried before no common point of all roots is expected any more.
const MOST_BLOCKS: usize = (64 << MOST_ROOTS) / LANES;
/// Products of at most this many earlier radicands are tried.
const MOST_FACTORS: usize = 4;
/// Points that a square must fit before a proof is tried.
const SAMPLES: usize = LANES;
/// c² for the constants c with which √A = ±c b is looked for.
const SQUARES: [(i64, i64); 7] = [(1, 1), (4, 1), (1, 4), (9, 1), (1, 9), (16, 1), (1, 16)];

/// b, the product or quotient of two values or one alone, by places of the original graph.
#[derive(Clone, Copy)]
pub struct Base {
    pub value: usize,
    /// Another place, and whether it divides.
    pub beside: Option<(usize, bool)>,
}

impl Base {
    /// The places.
    pub fn places(self) -> impl Iterator<Item = usize> {
        [Some(self.value), self.beside.map(|(place, _)| place)].into_iter().flatten()
    }

    /// Its value, from the values at the places.
    pub fn from(self, at: impl Fn(usize) -> Option<Expr>) -> Option<Expr> {
        let value = at(self.value)?;
        Some(match self.beside {
            None => value,
            Some((place, false)) => value * at(place)?,
            Some((place, true)) => value / at(place)?,
        })
    }
}

/// All values of the original graph at points where the independent roots exist.
pub struct Samples {
    moduli: Vec<Modulus>,
    /// By place; `None` where the graph has no value that a field can compute.
    values: Vec<Option<Vec<u64>>>,
    /// For each root: its radicand at these points.
    radicands: Vec<(usize, Vec<u64>)>,
}

impl Samples {
    /// Values at points where all roots exist; `None` where there are hardly any.
    pub fn of(
        algebraic: &Algebraic,
        trial: &Trial<'_>,
        roots: &[(Root, Standing)],
        digest: Digest,
    ) -> Option<Self> {
        let kept: Vec<usize> =
            (0..algebraic.values.len()).filter(|at| algebraic.values[*at].is_some()).collect();
        let mut outputs: Vec<Expr> =
            kept.iter().filter_map(|place| algebraic.values[*place]).collect();
        let count = outputs.len();
        outputs.extend(roots.iter().map(|(root, _)| root.radicand));
        let tape = Tape::new(&algebraic.graph, &outputs);
        let moduli = trial.moduli_for_search();
        let mut evaluator = Evaluator::new(&tape, Prime::new(moduli));
        let mut chance = Chance::of(digest, 4);
        let mut samples = Self {
            moduli: Vec::new(),
            values: algebraic.values.iter().map(|value| value.map(|_| Vec::new())).collect(),
            radicands: roots.iter().map(|(root, _)| (root.sign, Vec::new())).collect(),
        };
        for _ in 0..MOST_BLOCKS {
            evaluator.run(&points(&moduli, &algebraic.sources, &[], &mut chance));
            for (lane, modulus) in moduli.iter().enumerate() {
                let exists = |index: usize| {
                    let radicand = evaluator.output(count + index)[lane];
                    roots[index].0.is_modulus
                        || (radicand != UNDEFINED && modulus.is_square(radicand))
                };
                if !(0..roots.len()).all(exists) {
                    continue;
                }
                samples.moduli.push(*modulus);
                for (index, place) in kept.iter().enumerate() {
                    if let Some(values) = &mut samples.values[*place] {
                        values.push(evaluator.output(index)[lane]);
                    }
                }
                for (index, (_, values)) in samples.radicands.iter_mut().enumerate() {
                    values.push(evaluator.output(count + index)[lane]);
                }
            }
            if samples.moduli.len() >= SAMPLES {
                return Some(samples);
            }
        }
        None
    }

    fn radicand(&self, root: &Root) -> Option<&Vec<u64>> {
        self.radicands.iter().find(|(sign, _)| *sign == root.sign).map(|(_, values)| values)
    }

    /// A base b from earlier places, a square c² and earlier roots with A Π A_i = c² b² at all
    /// points; one whose signs are `known` where there is one.
    pub fn square(
        &self,
        place: usize,
        root: &Root,
        earlier: &[&Root],
        known: &[bool],
    ) -> Option<(Base, Rational, Vec<usize>)> {
        let radicand = self.radicand(root)?;
        let squares = Squares::of(self, place, known);
        [true, false]
            .into_iter()
            .find_map(|only_known| self.square_among(&squares, only_known, radicand, earlier))
    }

    fn square_among(
        &self,
        squares: &Squares,
        only_known: bool,
        radicand: &[u64],
        earlier: &[&Root],
    ) -> Option<(Base, Rational, Vec<usize>)> {
        for subset in 0u32..1 << earlier.len().min(MOST_FACTORS) {
            let chosen = || earlier.iter().enumerate().filter(move |(k, _)| subset >> k & 1 == 1);
            let mut target = radicand.to_vec();
            for (_, root) in chosen() {
                for ((entry, factor), m) in
                    target.iter_mut().zip(self.radicand(root)?).zip(&self.moduli)
                {
                    *entry = m.mul(*entry, *factor);
                }
            }
            for (n, d) in SQUARES {
                let square = Rational::new(n, d);
                let scaled: Option<Vec<u64>> = target
                    .iter()
                    .zip(&self.moduli)
                    .map(|(x, m)| Some(m.mul(*x, m.rational(&square.recip()?)?)))
                    .collect();
                if let Some(base) = squares.find(&self.moduli, &scaled?, only_known) {
                    let over = chosen().filter_map(|(_, root)| root.place).collect();
                    return Some((base, square, over));
                }
            }
        }
        None
    }
}

/// The squares of all values before a place, by what they are at the first point.
struct Squares {
    squares: Vec<Square>,
    at_first: FxHashMap<u64, usize>,
}

/// The square of the value at a place, at all points.
struct Square {
    place: usize,
    values: Vec<u64>,
    /// Is the sign of the value known?
    is_known: bool,
}

impl Squares {
    fn of(samples: &Samples, before: usize, known: &[bool]) -> Self {
        let mut all = Self { squares: Vec::new(), at_first: FxHashMap::default() };
        for (place, values) in samples.values.iter().enumerate().take(before) {
            let Some(values) = values else { continue };
            // 0 has no inverse, and is the square of nothing that is asked for.
            if values.iter().any(|value| *value == UNDEFINED || *value == 0) {
                continue;
            }
            let square = values.iter().zip(&samples.moduli).map(|(x, m)| m.mul(*x, *x));
            let values: Vec<u64> = square.collect();
            let Some(first) = values.first() else { continue };
            let (next, is_known) = (all.squares.len(), known.get(place) == Some(&true));
            let index = all.at_first.entry(*first).or_insert(next);
            if is_known && all.squares.get(*index).is_some_and(|square| !square.is_known) {
                *index = next;
            }
            all.squares.push(Square { place, values, is_known });
        }
        all
    }

    /// The place whose square this is.
    fn place(&self, target: &[u64], only_known: bool) -> Option<usize> {
        let square = &self.squares[*self.at_first.get(target.first()?)?];
        (square.values == target && (square.is_known || !only_known)).then_some(square.place)
    }

    fn find(&self, moduli: &[Modulus], target: &[u64], only_known: bool) -> Option<Base> {
        if let Some(value) = self.place(target, only_known) {
            return Some(Base { value, beside: None });
        }
        let combined = |square: &[u64], over: bool| -> Vec<u64> {
            let pairs = target.iter().zip(square).zip(moduli);
            pairs.map(|((t, s), m)| m.mul(*t, if over { *s } else { m.inverse(*s) })).collect()
        };
        let squares = self.squares.iter().filter(|square| square.is_known || !only_known);
        squares.into_iter().find_map(|square| {
            [false, true].into_iter().find_map(|over| {
                // The first point decides almost always.
                let first = combined(&square.values[..1], over);
                self.at_first.get(first.first()?)?;
                let value = self.place(&combined(&square.values, over), only_known)?;
                Some(Base { value, beside: Some((square.place, over)) })
            })
        })
    }
}
