//! Rational relations between functions of a state and the parameters: Σ a_j f_j = 0 with constant
//! a_j, found at random points modulo a prime.

use super::budget::Budget;
use super::echelon::Echelon;
use super::local::sign;
use super::symbols::symbolised;
use super::{Effort, Halt, SearchError};
use crate::streams::SearchStream;
use liouville::case::Case;
use liouville::claim::LevelSubset;
use liouville::graph::{Evaluator, Expr, Graph, Tape};
use liouville::mechanics::{Draw, DrawSource};
use liouville::number::ball::Ball;
use liouville::number::prime::{Modulus, Prime, UNDEFINED};
use liouville::number::rational::Rational;
use liouville::number::{Domain, Enclosing};
use liouville::proof::{ProofRng, reconstruct, root_numbers};
use liouville::verdict::Sampler;

/// Number of rows beyond the number of columns: each false relation survives one with probability
/// 1/p.
const SPARE_ROWS: usize = 8;
/// Number of lanes of the evaluation.
const RELATION_LANES: usize = 8;
/// Number of blocks without a value after which a function is given up; roots exist at half of the
/// points.
const TRIALS: usize = 16;

/// Functions on the level, evaluated at random states and parameters modulo a prime.
pub struct SampledFunctions {
    graph: Graph,
    outputs: Vec<Vec<Expr>>,
    draws: Vec<Draw>,
    modulus: Modulus,
    rng: ProofRng,
    halt: Halt,
    /// Whether numbers stand for functions.
    pub has_symbols: bool,
}

impl SampledFunctions {
    /// Prepares functions recorded in `graph`, each with some components, at states of the level.
    pub fn new(
        case: &Case,
        graph: &Graph,
        functions: &[Vec<Expr>],
        effort: &Effort,
    ) -> Result<Self, SearchError> {
        let seed = effort.options.seed;
        let sampler = Sampler::new(case, &LevelSubset::level(&case.model), seed)?;
        if sampler.is_numerical() {
            return Err(SearchError::NoChart);
        }
        let fixed = vec![None; sampler.recipes().len()];
        let (graph, outputs) = sampler.compose(graph, functions, &fixed)?;
        let mut rng = SearchStream::Relations.under(seed);
        let modulus = rng.prime_for(&root_numbers(&graph));
        let (draws, halt) = (sampler.recipes().to_vec(), effort.halt.clone());
        Ok(Self { graph, outputs, draws, modulus, rng, halt, has_symbols: false })
    }

    /// Prepares functions as [`new`](Self::new) does, with numbers in place of functions that have no
    /// values modulo a prime.
    pub fn with_symbols(
        case: &Case,
        graph: &Graph,
        functions: &[Vec<Expr>],
        effort: &Effort,
    ) -> Result<Self, SearchError> {
        let plain = Self::new(case, graph, functions, effort)?;
        Ok(match symbolised(&plain.graph, &plain.outputs) {
            Some((graph, outputs)) => Self { graph, outputs, has_symbols: true, ..plain },
            None => plain,
        })
    }

    /// Returns the functions that have a value somewhere.
    pub fn defined(&mut self) -> Vec<usize> {
        let mut has_value = vec![false; self.outputs.len()];
        self.visit(TRIALS, &mut |row| {
            for (known, value) in has_value.iter_mut().zip(row) {
                *known |= value != UNDEFINED;
            }
            !has_value.iter().all(|known| *known)
        });
        (0..has_value.len()).filter(|column| has_value[*column]).collect()
    }

    /// Keeps only some of the functions.
    pub fn restrict(&mut self, columns: &[usize]) {
        self.outputs = columns.iter().map(|j| self.outputs[*j].clone()).collect();
    }

    /// Number of functions.
    pub fn count(&self) -> usize {
        self.outputs.len()
    }

    /// Evaluates the functions at states and parameters in f64, one row for each component; values
    /// within rounding errors of 0 become 0.
    pub fn floats(&self, states: usize, seed: u64) -> Vec<Vec<f64>> {
        let height = self.outputs.first().map_or(0, Vec::len);
        let tape = Tape::new(&self.graph, &self.outputs.concat());
        let mut evaluator = Evaluator::new(&tape, Ball::<1>);
        let first = |draw: &Draw| match draw {
            Draw::OneOf(values) => Draw::OneOf(values.iter().take(1).cloned().collect()),
            within => within.clone(),
        };
        let draws = DrawSource::new(&self.draws.iter().map(first).collect::<Vec<Draw>>());
        let mut rows = Vec::new();
        for index in 0..states as u64 {
            let drawn = draws.state(seed, index);
            let mut inputs: Vec<_> =
                drawn.into_iter().map(|value| Ball::<1>.values(&[value])).collect();
            inputs.resize(self.graph.inputs(), Ball::<1>.constant(&Rational::from(1)));
            evaluator.run(&inputs);
            let value = |block| match Ball::<1>::enclosure(block, 0) {
                Some((middle, radius)) if middle.abs() > radius => middle,
                Some(_) => 0.0,
                None => f64::NAN,
            };
            let values: Vec<f64> = evaluator.outputs().map(value).collect();
            rows.extend((0..height).map(|component| {
                values.iter().skip(component).step_by(height).copied().collect::<Vec<f64>>()
            }));
        }
        rows.retain(|row| row.iter().all(|x| x.is_finite()));
        rows
    }

    /// Finds a basis of the relations among the columns, by echelon form.
    pub fn relations(&mut self) -> Result<FunctionRelations, SearchError> {
        let halt = self.halt.clone();
        self.relations_within(&Budget::unlimited(&halt))
    }

    /// Finds a basis of the relations within a limit on the elimination.
    pub fn relations_within(
        &mut self,
        budget: &Budget<'_>,
    ) -> Result<FunctionRelations, SearchError> {
        let columns = self.outputs.len();
        let mut echelon = Echelon::new(columns, self.modulus);
        let (mut dependent, halt) = (0, self.halt.clone());
        self.visit(64 * (columns + SPARE_ROWS), &mut |row| {
            if !row.contains(&UNDEFINED) {
                dependent = if echelon.push(row) { 0 } else { dependent + 1 };
                halt.meter().set(echelon.rank(), columns + 1);
            }
            dependent < SPARE_ROWS && budget.check(&echelon).is_ok()
        });
        budget.check(&echelon)?;
        match dependent < SPARE_ROWS {
            true => Err(SearchError::NoPoints),
            false => Ok(FunctionRelations { echelon, modulus: self.modulus, halt }),
        }
    }

    /// Passes the functions at random points, component by component, to `is_done` until it returns
    /// `false`.
    fn visit(&mut self, blocks: usize, is_done: &mut dyn FnMut(Vec<u64>) -> bool) {
        let height = self.outputs.first().map_or(0, Vec::len);
        let tape = Tape::new(&self.graph, &self.outputs.concat());
        let mut evaluator = Evaluator::new(&tape, Prime::new([self.modulus; RELATION_LANES]));
        for _ in 0..blocks {
            let inputs: Vec<[u64; RELATION_LANES]> =
                (0..self.graph.inputs()).map(|input| self.draw(input)).collect();
            evaluator.run(&inputs);
            let values: Vec<&[u64; RELATION_LANES]> = evaluator.outputs().collect();
            for lane in 0..RELATION_LANES {
                for component in 0..height {
                    let column = values.iter().skip(component).step_by(height);
                    if !is_done(column.map(|block| block[lane]).collect()) {
                        return;
                    }
                }
            }
        }
    }

    fn draw(&mut self, input: usize) -> [u64; RELATION_LANES] {
        match self.draws.get(input) {
            Some(Draw::OneOf(values)) => {
                let first = values.first().and_then(|value| self.modulus.rational(value));
                [first.unwrap_or(0); RELATION_LANES]
            }
            Some(Draw::Sign) => std::array::from_fn(|_| sign(&self.modulus, &mut self.rng)),
            _ => std::array::from_fn(|_| self.rng.element(&self.modulus)),
        }
    }
}

/// Relations between functions.
pub struct FunctionRelations {
    echelon: Echelon,
    modulus: Modulus,
    halt: Halt,
}

impl FunctionRelations {
    /// Returns the columns that do not depend on those before them.
    pub fn independent(&self) -> Vec<usize> {
        (0..self.echelon.columns()).filter(|column| self.echelon.has_pivot(*column)).collect()
    }

    /// Returns a basis of the relations with rational coefficients; others are omitted and counted.
    pub fn rational(&self) -> Result<(Vec<Vec<Rational>>, usize), SearchError> {
        let (mut vectors, mut irrational) = (Vec::new(), 0);
        for free in self.echelon.free() {
            self.halt.check()?;
            let image = |x: &u64| reconstruct(*x, &self.modulus);
            let own = self.echelon.null_vector(free);
            let found: Option<Vec<Rational>> = own.iter().map(image).collect();
            irrational += usize::from(found.is_none());
            vectors.extend(found);
        }
        Ok((vectors, irrational))
    }
}
