//! Equal and opposite values of a graph, found at random points of prime fields.

use rustc_hash::FxHashMap;

use crate::graph::{Evaluator, Expr, Tape};
use crate::number::prime::UNDEFINED;
use crate::number::quadratic::{Element, Quadratic};

use super::digest::SeedDigest;
use super::lower::Algebraic;
use super::rng::{ProofRng, ProofStream};
use super::tower::Tower;
use super::trial::{Certificate, Residues, TRIAL_LANES, Trial};

/// Largest number of blocks of points drawn until most values exist.
const MOST_BLOCKS: usize = 16;

/// Partition of the values of a graph into classes that are equal, opposite or zero wherever they
/// exist.
#[derive(Clone, Debug, Default)]
pub struct Classes {
    /// Class by place, shared by equal and opposite values, and whether the value is the opposite
    /// of the class.
    pub of: Vec<Option<(u32, bool)>>,
    /// Whether the value is known to be 0, or known not to vanish identically, by place.
    zero: Vec<Option<bool>>,
    /// Bound on the probability that some value is classified wrongly.
    pub certificate: Option<Certificate>,
}

impl Classes {
    /// Whether the value at a place is known to be 0.
    pub fn is_zero(&self, place: usize) -> bool {
        self.zero.get(place) == Some(&Some(true))
    }

    /// Whether the value at a place is known not to vanish identically.
    pub fn is_nonzero(&self, place: usize) -> bool {
        self.zero.get(place) == Some(&Some(false))
    }

    /// Classifies those values of the original graph of `algebraic` that contain only independent
    /// roots: a random sign of another root would make unequal values equal.
    pub fn of(
        algebraic: &Algebraic<'_>,
        trial: &Trial<'_>,
        tower: &Tower,
        digest: SeedDigest,
    ) -> Self {
        let count = algebraic.values.len();
        let mut found = Self { of: vec![None; count], zero: vec![None; count], certificate: None };
        let Some(certificate) = trial.of_differences() else { return found };
        let is_clean = |place: &usize| {
            algebraic.values[*place].is_some_and(|value| tower.is_clean(algebraic, value))
        };
        let places: Vec<usize> = (0..count).filter(is_clean).collect();
        let outputs: Vec<Expr> =
            places.iter().filter_map(|place| algebraic.values[*place]).collect();
        let tape = Tape::new(&algebraic.graph, &outputs);
        let field = Quadratic::new(*trial.moduli());
        let mut evaluator = Evaluator::new(&tape, field.clone());
        let mut rng = ProofRng::of(digest, ProofStream::Classes);
        let is_defined = |block: &[Element; TRIAL_LANES]| block.iter().all(|x| x[0] != UNDEFINED);
        let mut most = 0;
        let mut values: Vec<[Element; TRIAL_LANES]> = Vec::new();
        for _ in 0..MOST_BLOCKS {
            evaluator
                .run(&<Quadratic<TRIAL_LANES> as Residues>::blocks(&trial.points(&[], &mut rng)));
            let defined = evaluator.outputs().filter(|block| is_defined(block)).count();
            if values.is_empty() || defined > most {
                most = defined;
                values = evaluator.outputs().copied().collect();
            }
            if defined == outputs.len() {
                break;
            }
        }
        let symbolic = algebraic.symbolic();
        let mut classes: FxHashMap<[Element; TRIAL_LANES], u32> = FxHashMap::default();
        let mut merged = 0;
        for (place, block) in places.into_iter().zip(&values) {
            if !is_defined(block) {
                continue;
            }
            if block.iter().all(|x| *x == [0, 0]) {
                found.zero[place] = Some(true);
                merged += 1;
                continue;
            }
            // A function may have the value that a symbol in its place has not: 2 sin(π/6) − 1 = 0.
            let is_symbolic =
                algebraic.values[place].is_some_and(|own| symbolic[algebraic.graph.place(own)]);
            found.zero[place] = (!is_symbolic).then_some(false);
            let opposite: [Element; TRIAL_LANES] =
                std::array::from_fn(|lane| field.negative(lane, block[lane]));
            let is_opposite = opposite < *block;
            let next = classes.len() as u32;
            let own = if is_opposite { opposite } else { *block };
            let class = *classes.entry(own).or_insert(next);
            merged += i32::from(class != next);
            found.of[place] = Some((class, is_opposite));
        }
        if merged > 0 {
            let error_log2 = certificate.error_log2 + f64::from(merged).log2();
            found.certificate = Some(Certificate { error_log2, ..certificate });
        }
        found
    }
}
