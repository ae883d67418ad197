//! Squares among the values of a graph: A Π A_i = c b² for a radicand A and others A_i.

use rustc_hash::FxHashMap;

use crate::graph::{Evaluator, Expr, Tape};
use crate::number::prime::{Modulus, UNDEFINED};
use crate::number::quadratic::{Element, Quadratic};
use crate::number::rational::Rational;
use crate::scalar::Scalar;

use super::chance::{Chance, Stream};
use super::digest::Digest;
use super::lower::Algebraic;
use super::reconstruct::reconstruct;
use super::trial::{LANES, MOST_NESTED, PRIMES, Residues, points, prime_of, suitable_moduli};

/// Lanes of one prime: the first is what the others are compared with.
const SHARED: usize = LANES / PRIMES;
/// Blocks of points that are tried until all values that are needed exist.
const MOST_BLOCKS: usize = 8;

/// b, the product or quotient of values of the original graph, by their places.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Square {
    /// 1
    One,
    /// A value.
    Value(usize),
    /// A product of two values.
    Product(usize, usize),
    /// A quotient of two values.
    Quotient(usize, usize),
}

impl Square {
    /// The places.
    pub fn places(self) -> Vec<usize> {
        match self {
            Square::One => Vec::new(),
            Square::Value(a) => vec![a],
            Square::Product(a, b) | Square::Quotient(a, b) => vec![a, b],
        }
    }

    /// The value of b, from the values at places.
    pub fn value(self, at: impl Fn(usize) -> Option<Expr>) -> Option<Expr> {
        Some(match self {
            Square::One => Expr::rational(&Rational::from(1)),
            Square::Value(a) => at(a)?,
            Square::Product(a, b) => at(a)? * at(b)?,
            Square::Quotient(a, b) => at(a)? / at(b)?,
        })
    }
}

/// The values of a block at each lane over that at the first lane of the same prime.
type Ratios = [Element; LANES];

/// All values of a graph at random points where its independent roots exist.
pub struct Samples {
    field: Quadratic<LANES>,
    moduli: [Modulus; LANES],
    /// The squares of the values at places, and whether the sign of the value is known.
    squares: Vec<(usize, [Element; LANES], Ratios, bool)>,
    /// The first of them with given ratios, and the first with a known sign.
    with_ratios: FxHashMap<Element, [Option<usize>; 2]>,
    /// The radicands, by base.
    radicands: Vec<[Element; LANES]>,
}

impl Samples {
    /// Values at points where the radicands of the bases `needed` exist; `None` where no such point
    /// is found. `known` tells where signs are known.
    pub fn of(
        algebraic: &Algebraic<'_>,
        needed: &[usize],
        known: &[bool],
        digest: Digest,
    ) -> Option<Self> {
        let places: Vec<usize> =
            (0..algebraic.values.len()).filter(|at| algebraic.values[*at].is_some()).collect();
        let mut outputs: Vec<Expr> =
            places.iter().filter_map(|place| algebraic.values[*place]).collect();
        outputs.extend(algebraic.bases.iter().map(|base| base.radicand));
        let tape = Tape::new(&algebraic.graph, &outputs);
        // An identity has to be tested modulo primes that had no part in finding it.
        let moduli = suitable_moduli(digest, Stream::Squares, algebraic);
        let field = Quadratic::new(moduli);
        let mut evaluator = Evaluator::new(&tape, field.clone());
        let mut chance = Chance::of(digest, Stream::Squares);
        let is_defined = |block: &[Element; LANES]| block.iter().all(|x| x[0] != UNDEFINED);
        let found = (0..MOST_BLOCKS << MOST_NESTED).any(|_| {
            let block = points(&moduli, &algebraic.sources, &[], &mut chance);
            evaluator.run(&<Quadratic<LANES> as Residues>::blocks(&block));
            needed.iter().all(|base| is_defined(evaluator.output(places.len() + base)))
        });
        if !found {
            return None;
        }
        let radicands =
            (places.len()..outputs.len()).map(|index| *evaluator.output(index)).collect();
        let mut samples = Self {
            field,
            moduli,
            squares: Vec::new(),
            with_ratios: FxHashMap::default(),
            radicands,
        };
        for (index, place) in places.iter().enumerate() {
            let block = *evaluator.output(index);
            if is_defined(&block) && block.iter().all(|x| *x != [0, 0]) {
                samples.note(*place, &block, known.get(*place) == Some(&true));
            }
        }
        Some(samples)
    }

    fn note(&mut self, place: usize, block: &[Element; LANES], is_known: bool) {
        let square = std::array::from_fn(|lane| self.field.product(lane, block[lane], block[lane]));
        let Some(ratios) = self.ratios(&square) else { return };
        let next = self.squares.len();
        self.squares.push((place, square, ratios, is_known));
        let [first, known] = self.with_ratios.entry(key(&ratios)).or_default();
        first.get_or_insert(next);
        if is_known {
            known.get_or_insert(next);
        }
    }

    /// Each value over that at the first lane of its prime: a number as factor drops out.
    fn ratios(&self, values: &[Element; LANES]) -> Option<Ratios> {
        let mut ratios = [[0; 2]; LANES];
        for lane in 0..LANES {
            let inverse = self.field.inverse(lane, values[prime_of(lane) * SHARED])?;
            ratios[lane] = self.field.product(lane, values[lane], inverse);
        }
        Some(ratios)
    }

    /// b and c with A Π A_i = c b² at all points, for a base and others by their numbers: b from the
    /// places before `before`, with a known sign where there is such a b.
    pub fn square(
        &self,
        base: usize,
        others: &[usize],
        before: usize,
    ) -> Option<(Rational, Square)> {
        let mut target = *self.radicands.get(base)?;
        if target.iter().any(|x| x[0] == UNDEFINED) {
            return None;
        }
        for other in others {
            for lane in 0..LANES {
                let factor = self.radicands[*other][lane];
                target[lane] = self.field.product(lane, target[lane], factor);
            }
        }
        let ratios = self.ratios(&target)?;
        if ratios.iter().enumerate().all(|(lane, x)| *x == [self.moduli[lane].one(), 0]) {
            let scale = self.number(&target, &self.moduli.map(|m| [m.one(), 0]))?;
            return Some((scale, Square::One));
        }
        [true, false].into_iter().find_map(|only_known| {
            let (square, values) = self.find(&ratios, only_known, before)?;
            Some((self.number(&target, &values)?, square))
        })
    }

    /// b with these ratios of b², and the values of b².
    fn find(
        &self,
        target: &Ratios,
        only_known: bool,
        before: usize,
    ) -> Option<(Square, [Element; LANES])> {
        let value = |ratios: &Ratios| self.place(ratios, only_known, before);
        if let Some((place, values)) = value(target) {
            return Some((Square::Value(place), values));
        }
        let product = |a: &[Element; LANES], b: &[Element; LANES]| -> [Element; LANES] {
            std::array::from_fn(|lane| self.field.product(lane, a[lane], b[lane]))
        };
        let inverse = |a: &[Element; LANES]| -> Option<[Element; LANES]> {
            let mut inverse = [[0; 2]; LANES];
            for lane in 0..LANES {
                inverse[lane] = self.field.inverse(lane, a[lane])?;
            }
            Some(inverse)
        };
        let usable = self.squares.iter().take_while(|square| square.0 < before);
        usable.filter(|square| square.3 || !only_known).find_map(
            |(place, square, ratios, _)| {
                // The last lane decides almost always.
                let lane = LANES - 1;
                let over = self.field.inverse(lane, ratios[lane])?;
                let rest = self.field.product(lane, target[lane], over);
                if self.with_ratios.contains_key(&rest) {
                    let wanted = product(target, &inverse(ratios)?);
                    if let Some((other, values)) = value(&wanted) {
                        return Some((Square::Product(other, *place), product(&values, square)));
                    }
                }
                let times = self.field.product(lane, target[lane], ratios[lane]);
                if self.with_ratios.contains_key(&times) {
                    let wanted = product(target, ratios);
                    if let Some((other, values)) = value(&wanted) {
                        let values = product(&values, &inverse(square)?);
                        return Some((Square::Quotient(other, *place), values));
                    }
                }
                None
            },
        )
    }

    /// The place of a value whose square has these ratios, and the square.
    fn place(
        &self,
        target: &Ratios,
        only_known: bool,
        before: usize,
    ) -> Option<(usize, [Element; LANES])> {
        let [first, known] = self.with_ratios.get(&key(target))?;
        let index = if only_known { known } else { first };
        let (place, square, ratios, _) = &self.squares[(*index)?];
        (ratios == target && *place < before).then_some((*place, *square))
    }

    /// The rational number that a is times b at all points.
    fn number(&self, a: &[Element; LANES], b: &[Element; LANES]) -> Option<Rational> {
        let mut number = None;
        for lane in (0..LANES).step_by(SHARED) {
            let image = self.field.product(lane, a[lane], self.field.inverse(lane, b[lane])?);
            let found = match image {
                [real, 0] => reconstruct(real, &self.moduli[lane])?,
                _ => return None,
            };
            if number.get_or_insert_with(|| found.clone()) != &found {
                return None;
            }
        }
        number
    }
}

/// What values are looked up by: the ratio at the last lane.
fn key(ratios: &Ratios) -> Element {
    ratios[LANES - 1]
}
