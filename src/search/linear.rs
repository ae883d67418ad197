//! Rational relations between functions of a state and the parameters: Σ a_j f_j = 0 with constant
//! a_j, found at random points modulo a prime.

use super::SearchError;
use super::echelon::Echelon;
use crate::case::Case;
use crate::claim::Place;
use crate::graph::{Evaluator, Expr, Graph, Tape};
use crate::mechanics::Draw;
use crate::number::prime::{Modulus, Prime, UNDEFINED};
use crate::number::rational::Rational;
use crate::proof::{Chance, reconstruct};
use crate::verdict::Sampler;

/// Rows beyond the number of columns: each false relation survives one with probability 1/p.
const SPARE: usize = 8;
/// Lanes of the evaluation.
const LANES: usize = 8;

/// Functions on the level, evaluated at random states for random parameters modulo a prime.
pub struct Functions {
    graph: Graph,
    outputs: Vec<Vec<Expr>>,
    draws: Vec<Draw>,
    modulus: Modulus,
    chance: Chance,
}

impl Functions {
    /// Functions recorded in `graph`, each of some components, at states of the level.
    pub fn new(
        case: &Case,
        graph: &Graph,
        functions: &[Vec<Expr>],
        seed: u64,
    ) -> Result<Self, SearchError> {
        let sampler = Sampler::new(case, &Place::level(&case.model), seed)?;
        if sampler.is_numerical() {
            return Err(SearchError::NoChart);
        }
        let fixed = vec![None; sampler.recipes().len()];
        let (graph, outputs) = sampler.compose(graph, functions, &fixed)?;
        let mut chance = Chance::new(seed, 41);
        let modulus = chance.prime(&[3, 5], &[2, 3]);
        Ok(Self { graph, outputs, draws: sampler.recipes().to_vec(), modulus, chance })
    }

    /// A basis of the relations among the columns, by echelon form.
    pub fn relations(&mut self) -> Result<Relations, SearchError> {
        let columns = self.outputs.len();
        let height = self.outputs.first().map_or(0, Vec::len);
        let outputs = self.outputs.concat();
        let tape = Tape::new(&self.graph, &outputs);
        let mut evaluator = Evaluator::new(&tape, Prime::new([self.modulus; LANES]));
        let mut echelon = Echelon::new(columns, self.modulus);
        let (mut dependent, mut blocks) = (0, 0);
        while dependent < SPARE {
            blocks += 1;
            if blocks > 64 * (columns + SPARE) {
                return Err(SearchError::NoPoints);
            }
            let inputs: Vec<[u64; LANES]> =
                (0..self.graph.inputs()).map(|input| self.draw(input)).collect();
            evaluator.run(&inputs);
            let values: Vec<&[u64; LANES]> = evaluator.outputs().collect();
            for lane in 0..LANES {
                for component in 0..height {
                    let column = values.iter().skip(component).step_by(height);
                    let row: Vec<u64> = column.map(|block| block[lane]).collect();
                    if row.contains(&UNDEFINED) {
                        continue;
                    }
                    dependent = if echelon.push(row) { 0 } else { dependent + 1 };
                }
            }
        }
        Ok(Relations { echelon, modulus: self.modulus })
    }

    fn draw(&mut self, input: usize) -> [u64; LANES] {
        match self.draws.get(input) {
            Some(Draw::OneOf(values)) => {
                let first = values.first().and_then(|value| self.modulus.rational(value));
                [first.unwrap_or(0); LANES]
            }
            _ => std::array::from_fn(|_| self.chance.element(&self.modulus)),
        }
    }
}

/// The relations between some functions.
pub struct Relations {
    echelon: Echelon,
    modulus: Modulus,
}

impl Relations {
    /// The columns that do not depend on those before them.
    pub fn independent(&self, columns: usize) -> Vec<usize> {
        (0..columns).filter(|column| self.echelon.has_pivot(*column)).collect()
    }

    /// A basis of the relations with rational coefficients; others are left out and counted.
    pub fn rational(&self) -> (Vec<Vec<Rational>>, usize) {
        let mut irrational = 0;
        let vectors = self.echelon.null_space().into_iter().filter_map(|vector| {
            let image = |x: &u64| reconstruct(*x, &self.modulus);
            let found: Option<Vec<Rational>> = vector.iter().map(image).collect();
            irrational += usize::from(found.is_none());
            found
        });
        (vectors.collect(), irrational)
    }
}
