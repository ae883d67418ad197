//! Squares among the values of a graph: A Π A_i = c b² for a radicand A and others A_i.

use rustc_hash::FxHashMap;

use crate::graph::{Evaluator, Expr, Tape};
use crate::number::prime::{Modulus, UNDEFINED};
use crate::number::quadratic::{Element, Quadratic};
use crate::number::rational::Rational;
use crate::scalar::Scalar;

use super::digest::SeedDigest;
use super::lower::Algebraic;
use super::partners::PartnerValue;
use super::reconstruct::reconstruct;
use super::rng::{ProofRng, ProofStream};
use super::trial::{MOST_NESTED, PRIMES, Residues, TRIAL_LANES, points, prime_of, suitable_moduli};

/// Number of lanes of one prime; the first is compared with the others.
const SHARED: usize = TRIAL_LANES / PRIMES;
/// Largest number of blocks of points tried until all needed values exist.
const MOST_BLOCKS: usize = 8;

/// The factor b, a product or quotient of values of the original graph, by their places.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Square {
    /// The number 1.
    One,
    /// A value.
    Value(usize),
    /// A product of two values.
    Product(usize, usize),
    /// A quotient of two values.
    Quotient(usize, usize),
    /// A function that is no value of the graph.
    Function(PartnerValue),
}

impl Square {
    /// Returns the places.
    pub fn places(self) -> Vec<usize> {
        match self {
            Square::One => Vec::new(),
            Square::Value(a) => vec![a],
            Square::Function(own) => vec![own.place],
            Square::Product(a, b) | Square::Quotient(a, b) => vec![a, b],
        }
    }

    /// Records b from the values at places.
    pub fn value(self, at: impl Fn(usize) -> Option<Expr>) -> Option<Expr> {
        Some(match self {
            Square::One => Expr::rational(&Rational::from(1)),
            Square::Value(a) => at(a)?,
            Square::Function(own) => own.value(at)?,
            Square::Product(a, b) => at(a)? * at(b)?,
            Square::Quotient(a, b) => at(a)? / at(b)?,
        })
    }
}

/// Values at random points.
type Values = [Element; TRIAL_LANES];

/// The square of the value at a place.
struct SquareAt {
    place: usize,
    square: Values,
    /// The square at the last point divided by that at the first point of the same prime, and the
    /// inverse of this ratio, in which constant factors cancel.
    ratios: [Element; 2],
    /// Whether the sign of the value is known.
    is_known: bool,
}

/// All values of a graph at random points where its independent roots exist.
pub struct RootSamples {
    field: Quadratic<TRIAL_LANES>,
    moduli: [Modulus; TRIAL_LANES],
    /// Entries for values that are nonzero at all points, by increasing place.
    entries: Vec<SquareAt>,
    /// The first entry with a ratio, and the first with a known sign.
    with_ratio: FxHashMap<Element, [Option<usize>; 2]>,
    /// Values of the radicands, by base.
    radicands: Vec<Values>,
}

/// The point by whose ratio entries are looked up.
const LAST: usize = TRIAL_LANES - 1;
const COMPARED: usize = TRIAL_LANES - SHARED;

impl RootSamples {
    /// Evaluates the graph at points where the radicands of the bases `needed` have roots; `None`
    /// if no such point is found. `known` tells which signs are known.
    pub fn of(
        algebraic: &Algebraic<'_>,
        needed: &[usize],
        known: &[bool],
        digest: SeedDigest,
    ) -> Option<Self> {
        let places: Vec<usize> =
            (0..algebraic.values.len()).filter(|at| algebraic.values[*at].is_some()).collect();
        let mut outputs: Vec<Expr> =
            places.iter().filter_map(|place| algebraic.values[*place]).collect();
        outputs.extend(algebraic.bases.iter().map(|base| base.radicand));
        // √√A exists only at some of the points at which √A does.
        let chained = needed.iter().map(|index| &algebraic.bases[*index]);
        let chained = chained.filter(|base| base.links.len() > 1);
        let last = chained.filter_map(|base| base.links.last()).map(|(link, _)| *link);
        let radicands = places.len()..outputs.len();
        outputs.extend(last);
        let last = radicands.end..outputs.len();
        let tape = Tape::new(&algebraic.graph, &outputs);
        // An identity must be tested modulo primes that were not used to find it.
        let moduli = suitable_moduli(digest, ProofStream::Squares, algebraic);
        let field = Quadratic::new(moduli);
        let mut evaluator = Evaluator::new(&tape, field.clone());
        let mut rng = ProofRng::of(digest, ProofStream::Squares);
        let is_defined = |block: &Values| block.iter().all(|x| x[0] != UNDEFINED);
        let found = (0..MOST_BLOCKS << MOST_NESTED).any(|_| {
            let block = points(&moduli, &algebraic.sources, &[], &mut rng);
            evaluator.run(&<Quadratic<TRIAL_LANES> as Residues>::blocks(&block));
            let mut radicands = needed.iter().map(|base| places.len() + base);
            radicands.all(|place| is_defined(evaluator.output(place)))
                && last.clone().all(|place| is_defined(evaluator.output(place)))
        });
        if !found {
            return None;
        }
        let mut entries: Vec<SquareAt> = Vec::new();
        for (index, place) in places.iter().enumerate() {
            let block = *evaluator.output(index);
            if is_defined(&block) && block.iter().all(|x| *x != [0, 0]) {
                let square =
                    std::array::from_fn(|lane| field.product(lane, block[lane], block[lane]));
                let is_known = known.get(*place) == Some(&true);
                entries.push(SquareAt { place: *place, square, ratios: [[0; 2]; 2], is_known });
            }
        }
        let ends = entries.iter().flat_map(|entry| [entry.square[COMPARED], entry.square[LAST]]);
        let inverses = field.inverses(LAST, &ends.collect::<Vec<Element>>());
        let mut with_ratio: FxHashMap<Element, [Option<usize>; 2]> = FxHashMap::default();
        for (index, (entry, inverse)) in entries.iter_mut().zip(inverses.chunks(2)).enumerate() {
            let [compared, last] = [entry.square[COMPARED], entry.square[LAST]];
            entry.ratios =
                [field.product(LAST, last, inverse[0]), field.product(LAST, compared, inverse[1])];
            let [first, known] = with_ratio.entry(entry.ratios[0]).or_default();
            first.get_or_insert(index);
            if entry.is_known {
                known.get_or_insert(index);
            }
        }
        let radicands = radicands.map(|index| *evaluator.output(index)).collect();
        Some(Self { field, moduli, entries, with_ratio, radicands })
    }

    /// Finds b and c with A Π A_i = c b² at all points, for a base and others by their indices: b
    /// from the places before `before`, first with a known sign, then with any.
    pub fn squares(&self, base: usize, others: &[usize], before: usize) -> Vec<(Rational, Square)> {
        let radicands = [base].into_iter().chain(others.iter().copied());
        let radicands: Option<Vec<&Values>> =
            radicands.map(|own| self.radicands.get(own)).collect();
        let Some((first, rest)) = radicands.as_deref().and_then(<[&Values]>::split_first) else {
            return Vec::new();
        };
        let target = rest.iter().fold(**first, |target, own| self.product(&target, own));
        if target.iter().any(|x| x[0] == UNDEFINED || *x == [0, 0]) {
            return Vec::new();
        }
        let ones: Values = self.moduli.map(|m| [m.one(), 0]);
        if self.is_multiple(&target, &ones) {
            let number = self.number(&target, &ones);
            return number.map(|number| (number, Square::One)).into_iter().collect();
        }
        let found = [true, false].into_iter().filter_map(|only_known| {
            let (square, values) = self.find(&target, only_known, before)?;
            Some((self.number(&target, &values)?, square))
        });
        let mut found: Vec<(Rational, Square)> = found.collect();
        found.dedup();
        found
    }

    /// Finds b such that b² is a constant multiple of the target; returns b and the values of b².
    fn find(&self, target: &Values, only_known: bool, before: usize) -> Option<(Square, Values)> {
        let of = |ratio: Element| -> Option<&SquareAt> {
            let [first, known] = self.with_ratio.get(&ratio)?;
            let entry = &self.entries[(if only_known { *known } else { *first })?];
            (entry.place < before).then_some(entry)
        };
        let compared = self.field.inverse(LAST, target[COMPARED])?;
        let ratio = self.field.product(LAST, target[LAST], compared);
        if let Some(entry) = of(ratio).filter(|entry| self.is_multiple(target, &entry.square)) {
            return Some((Square::Value(entry.place), entry.square));
        }
        let usable = self.entries.iter().take_while(|entry| entry.place < before);
        usable.filter(|entry| entry.is_known || !only_known).find_map(|entry| {
            let [own, inverse] = entry.ratios;
            // b² = xy: the ratio of x is that of b² over that of y.
            if let Some(other) = of(self.field.product(LAST, ratio, inverse)) {
                let square = self.product(&other.square, &entry.square);
                if self.is_multiple(target, &square) {
                    return Some((Square::Product(other.place, entry.place), square));
                }
            }
            let other = of(self.field.product(LAST, ratio, own))?;
            let inverse = self.inverse(&entry.square)?;
            let square = self.product(&other.square, &inverse);
            let found = Square::Quotient(other.place, entry.place);
            self.is_multiple(target, &square).then_some((found, square))
        })
    }

    fn product(&self, a: &Values, b: &Values) -> Values {
        std::array::from_fn(|lane| match (a[lane], b[lane]) {
            ([UNDEFINED, _], _) | (_, [UNDEFINED, _]) => [UNDEFINED; 2],
            (a, b) => self.field.product(lane, a, b),
        })
    }

    fn inverse(&self, values: &Values) -> Option<Values> {
        let mut inverse = [[0; 2]; TRIAL_LANES];
        for lane in 0..TRIAL_LANES {
            inverse[lane] = self.field.inverse(lane, values[lane])?;
        }
        Some(inverse)
    }

    /// Whether, for each prime, a is the same multiple of b at all points.
    fn is_multiple(&self, a: &Values, b: &Values) -> bool {
        (0..TRIAL_LANES).all(|lane| {
            let first = prime_of(lane) * SHARED;
            let product = |x: Element, y: Element| self.field.product(lane, x, y);
            product(a[lane], b[first]) == product(a[first], b[lane])
        })
    }

    /// Finds the rational number that is a/b at all points.
    fn number(&self, a: &Values, b: &Values) -> Option<Rational> {
        let mut number = None;
        for lane in (0..TRIAL_LANES).step_by(SHARED) {
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
