//! Linear systems whose columns are derivatives of functions, and whose rows are random states
//! modulo a prime, for one choice of the parameters.
//!
//! d(W x^a) = x^a (W Σ a_i dx_i/x_i + dW): the tape computes x, dx, W and dW once for each state,
//! and all columns follow from them.

use std::sync::OnceLock;

use super::super::echelon::Echelon;
use super::super::local::{random, sign};
use super::super::symbols::symbolised;
use super::super::terms::recorded;
use super::super::{Effort, Halt, SearchError};
use super::Coordinates;
use super::powers::{SparseColumn, VariablePowers};
use super::recording::{Derivation, Recording};
use super::states::KeptStates;
use crate::streams::SearchStream;
use liouville::case::Case;
use liouville::claim::LevelSubset;
use liouville::formula::Formula;
use liouville::graph::{Evaluator, Expr, Graph, Tape};
use liouville::mechanics::Draw;
use liouville::mechanics::calculus::DualPoint;
use liouville::number::GOLDEN;
use liouville::number::prime::{Modulus, Prime, UNDEFINED};
use liouville::number::rational::Rational;
use liouville::proof::{ProofRng, statement_seed};
use liouville::verdict::Sampler;

/// Number of lanes of the evaluation.
const SYSTEM_LANES: usize = 8;
/// Number of successive dependent rows after which the rank is accepted: accidents have probability
/// p⁻⁸.
const SPARE_ROWS: usize = 8;
/// Largest number of choices of parameters tried until some state has a value, roots included.
const MOST_DRAWS: usize = 64;
/// Number of primes that are kept.
const KEPT_PRIMES: usize = 8;

/// A column of a linear system.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Column {
    /// An output of the recording.
    Given(usize),
    /// The derivative of a factor times a product of powers of the variables.
    Product {
        /// Index of the direction.
        derivation: usize,
        /// Index of the factor.
        factor: usize,
        /// One exponent for each variable.
        exponents: Vec<u32>,
    },
}

/// A prime, and values for the draws of the parameters.
#[derive(Clone, Debug)]
pub struct PrimePoint {
    /// Prime field.
    pub modulus: Modulus,
    /// Values of the draws of the parameters.
    pub parameters: Vec<u64>,
    /// Values of the parameters' coordinates.
    pub coordinates: Vec<u64>,
}

/// Basis of the relations between columns; `None` if too few states have values.
type Found = Result<Option<Vec<Vec<u64>>>, SearchError>;

/// A linear system: its columns, and the tape that computes its rows.
pub struct LinearSystem {
    /// Columns of the unknowns.
    pub columns: Vec<Column>,
    tape: Tape,
    inputs: usize,
    parameters: Vec<Draw>,
    draws: Vec<Draw>,
    derivations: Vec<Derivation>,
    /// Number of outputs before the coordinates of the parameters.
    own: usize,
    coordinates: Vec<Formula>,
    /// Numbers under roots in the field.
    radicands: Vec<Rational>,
    /// The first primes, drawn when they are asked for.
    primes: [OnceLock<Modulus>; KEPT_PRIMES],
    seed: u64,
    /// Condition for an early end of eliminations.
    halt: Halt,
    states: KeptStates,
}

impl LinearSystem {
    /// Records the values that `make` needs at a state of the level; the columns are added later.
    pub fn record(
        case: &Case,
        effort: &Effort,
        make: impl FnOnce(&DualPoint<'_, Expr>, &mut Recording),
    ) -> Result<Self, SearchError> {
        Self::recorded(case, effort, false, make)
    }

    /// Records as [`record`](Self::record) does, with numbers in place of functions that have no values
    /// modulo a prime.
    pub fn record_with_symbols(
        case: &Case,
        effort: &Effort,
        make: impl FnOnce(&DualPoint<'_, Expr>, &mut Recording),
    ) -> Result<Self, SearchError> {
        Self::recorded(case, effort, true, make)
    }

    fn recorded(
        case: &Case,
        effort: &Effort,
        has_symbols: bool,
        make: impl FnOnce(&DualPoint<'_, Expr>, &mut Recording),
    ) -> Result<Self, SearchError> {
        let coordinates = Coordinates::of(case)?;
        let (graph, recorded) = recorded(case, |jet| {
            let mut recording = Recording::default();
            make(jet, &mut recording);
            let own = recording.outputs.len();
            let values = coordinates.names.iter().map(|term| jet.phase.scalar(term));
            recording.outputs.extend(values);
            (recording, own)
        })?;
        Self::compiled(case, effort, has_symbols, coordinates, &graph, recorded)
    }

    /// Makes the equations of what was recorded; `own` outputs come before the coordinates.
    fn compiled(
        case: &Case,
        effort: &Effort,
        has_symbols: bool,
        Coordinates { names, radicands }: Coordinates,
        graph: &Graph,
        (recording, own): (Recording, usize),
    ) -> Result<Self, SearchError> {
        let seed = effort.options.seed;
        let sampler = Sampler::new(case, &LevelSubset::level(&case.model), seed)?;
        if sampler.is_numerical() {
            return Err(SearchError::NoChart);
        }
        let fixed = vec![None; sampler.recipes().len()];
        let (graph, outputs) = sampler.compose(graph, &[recording.outputs], &fixed)?;
        let (graph, outputs) = match has_symbols.then(|| symbolised(&graph, &outputs)).flatten() {
            Some(made) => made,
            None => (graph, outputs),
        };
        let outputs = outputs.concat();
        // No constant of the system can be chosen to vanish modulo a prime.
        let seed = statement_seed(seed, &graph, &outputs);
        Ok(Self {
            columns: Vec::new(),
            tape: Tape::new(&graph, &outputs),
            inputs: graph.inputs(),
            parameters: case.model.parameter_draws(),
            draws: sampler.recipes().to_vec(),
            derivations: recording.derivations,
            own,
            coordinates: names,
            radicands,
            primes: Default::default(),
            seed,
            halt: effort.halt.clone(),
            states: KeptStates::default(),
        })
    }

    /// Condition for an early end.
    pub fn halt(&self) -> &Halt {
        &self.halt
    }

    /// Sets another condition for an early end.
    pub fn halt_by(&mut self, halt: Halt) {
        self.halt = halt;
    }

    /// Number of outputs of the tape.
    fn outputs(&self) -> usize {
        self.own + self.coordinates.len()
    }

    /// Returns the parameters' coordinates.
    pub fn coordinates(&self) -> &[Formula] {
        &self.coordinates
    }

    /// Makes choice `index` of the parameters, modulo the prime with index `prime`; `None` where no
    /// state has a value.
    pub fn at(&self, prime: u64, index: u64) -> Option<PrimePoint> {
        let drawn = || Coordinates::prime(&self.radicands, self.seed, prime);
        let modulus = match self.primes.get(prime as usize) {
            Some(kept) => *kept.get_or_init(drawn),
            None => drawn(),
        };
        let mut rng = SearchStream::Equations.under(self.seed ^ index.wrapping_mul(GOLDEN));
        for _ in 0..MOST_DRAWS {
            let parameters = random(&self.parameters, &modulus, &mut rng);
            let mut at = PrimePoint { modulus, parameters, coordinates: Vec::new() };
            let mut seen = None;
            self.visit(&at, index, 4, &mut |values| {
                seen = Some(values[self.own..self.outputs()].to_vec());
                false
            });
            if let Some(coordinates) = seen {
                at.coordinates = coordinates;
                return Some(at);
            }
        }
        None
    }

    /// Passes the outputs at random states that have values, with the growth of the variables, to
    /// `is_done` until it has seen enough; `false` if it has not within the limit of blocks.
    fn visit(
        &self,
        at: &PrimePoint,
        stream: u64,
        blocks: usize,
        is_done: &mut dyn FnMut(&[u64]) -> bool,
    ) -> bool {
        let states = self.states.of(at, stream, self.seed);
        let mut evaluator = None;
        let mut is_enough = false;
        for block in 0..blocks {
            let rows = states.block(block, |rng| {
                let evaluator = evaluator.get_or_insert_with(|| {
                    Evaluator::new(&self.tape, Prime::new([at.modulus; SYSTEM_LANES]))
                });
                evaluator.run(&self.inputs_of(at, rng));
                let values: Vec<[u64; SYSTEM_LANES]> = evaluator.outputs().copied().collect();
                let lanes = (0..SYSTEM_LANES).filter_map(|lane| {
                    let row: Vec<u64> = values.iter().map(|block| block[lane]).collect();
                    (!row.contains(&UNDEFINED)).then(|| self.with_growth(&at.modulus, row))
                });
                lanes.collect()
            });
            is_enough = rows.iter().any(|row| !is_done(row));
            if is_enough {
                break;
            }
        }
        self.states.trim();
        is_enough
    }

    /// Draws the inputs of one block of states.
    fn inputs_of(&self, at: &PrimePoint, rng: &mut ProofRng) -> Vec<[u64; SYSTEM_LANES]> {
        (0..self.inputs)
            .map(|input| match at.parameters.get(input) {
                Some(value) => [*value; SYSTEM_LANES],
                None if matches!(self.draws.get(input), Some(Draw::Sign)) => {
                    std::array::from_fn(|_| sign(&at.modulus, rng))
                }
                None => std::array::from_fn(|_| rng.element(&at.modulus)),
            })
            .collect()
    }

    /// Appends dx/x for the variables of all derivations, 0 where x is 0.
    fn with_growth(&self, m: &Modulus, mut row: Vec<u64>) -> Vec<u64> {
        for own in &self.derivations {
            for k in own.start..own.start + own.variables {
                let (x, dx) = (row[k], row[k + own.variables]);
                row.push(if x == 0 { 0 } else { m.mul(dx, m.inverse(x)) });
            }
        }
        row
    }

    /// Finds a basis of the relations between some columns, each vector being 1 at a free column, 0
    /// at the other free ones and at all columns after its own; `None` if too few states have
    /// values.
    pub fn null_space(&self, at: &PrimePoint, columns: &[usize]) -> Found {
        self.relations_of(at, columns, |column, powers| powers.derivative(&at.modulus, column))
    }

    /// A basis of the relations between the functions themselves, as
    /// [`null_space`](Self::null_space) has it between their derivatives.
    pub fn dependences(&self, at: &PrimePoint, columns: &[usize]) -> Found {
        self.relations_of(at, columns, |column, powers| powers.value(&at.modulus, column))
    }

    /// A basis of the relations between the entries of some columns.
    fn relations_of(
        &self,
        at: &PrimePoint,
        columns: &[usize],
        entry: impl Fn(&SparseColumn, &VariablePowers<'_>) -> u64,
    ) -> Found {
        let (m, columns) = (&at.modulus, self.sparse(&at.modulus, columns));
        self.relations(at, columns.len(), &mut |values| self.row(m, values, &columns, &entry))
    }

    /// Selects the columns whose functions do not depend on earlier ones; `None` if too few states
    /// have values.
    pub fn distinct(
        &self,
        at: &PrimePoint,
        columns: &[usize],
    ) -> Result<Option<Vec<usize>>, SearchError> {
        let Some(relations) = self.dependences(at, columns)? else { return Ok(None) };
        let last = |own: &Vec<u64>| own.iter().rposition(|entry| *entry != 0);
        let dependent: Vec<usize> = relations.iter().filter_map(last).collect();
        let kept = (0..columns.len()).filter(|k| !dependent.contains(k));
        Ok(Some(kept.map(|k| columns[k]).collect()))
    }

    /// Finds a basis of the relations between combinations of the functions, and products of
    /// outputs.
    pub fn combination_relations(
        &self,
        at: &PrimePoint,
        combinations: &[Vec<u64>],
        further: &[Vec<usize>],
    ) -> Found {
        let m = &at.modulus;
        let columns: Vec<usize> = (0..self.columns.len()).collect();
        let columns = self.sparse(m, &columns);
        self.relations(at, combinations.len() + further.len(), &mut |values| {
            let all = self.row(m, values, &columns, &|column, powers| powers.value(m, column));
            let sum =
                |c: &Vec<u64>| c.iter().zip(&all).fold(0, |sum, (a, x)| m.add(sum, m.mul(*a, *x)));
            let product =
                |p: &Vec<usize>| p.iter().fold(m.one(), |product, k| m.mul(product, values[*k]));
            combinations.iter().map(sum).chain(further.iter().map(product)).collect()
        })
    }

    /// Computes rows of some columns at `count` random states of a stream, the same states for all
    /// parameters; `None` if too few of them have values.
    pub fn rows(
        &self,
        at: &PrimePoint,
        stream: u64,
        columns: &[usize],
        count: usize,
    ) -> Option<Vec<Vec<u64>>> {
        let (m, columns) = (&at.modulus, self.sparse(&at.modulus, columns));
        let mut rows = Vec::with_capacity(count);
        let enough = self.visit(at, stream, 1 + count, &mut |values| {
            let derivative =
                |column: &SparseColumn, powers: &VariablePowers<'_>| powers.derivative(m, column);
            rows.push(self.row(m, values, &columns, &derivative));
            rows.len() < count
        });
        enough.then_some(rows)
    }

    fn relations(
        &self,
        at: &PrimePoint,
        width: usize,
        row: &mut dyn FnMut(&[u64]) -> Vec<u64>,
    ) -> Found {
        let mut echelon = Echelon::new(width, at.modulus);
        let mut dependent = 0;
        let enough = self.visit(at, 1, 64 * (width + SPARE_ROWS), &mut |values| {
            dependent = if echelon.push(row(values)) { 0 } else { dependent + 1 };
            self.halt.meter().set(echelon.rank(), width + 1);
            dependent < SPARE_ROWS && self.halt.check().is_ok()
        });
        self.halt.check()?;
        if !enough {
            return Ok(None);
        }
        let vector = |free| self.halt.check().map(|()| echelon.null_vector(free));
        echelon.free().into_iter().map(vector).collect::<Result<_, _>>().map(Some)
    }

    /// Computes the entries of some columns at a state.
    fn row(
        &self,
        m: &Modulus,
        values: &[u64],
        columns: &[SparseColumn],
        entry: &dyn Fn(&SparseColumn, &VariablePowers<'_>) -> u64,
    ) -> Vec<u64> {
        let mut growth = &values[self.outputs()..];
        let mut powers = Vec::with_capacity(self.derivations.len());
        let highest = columns.iter().map(SparseColumn::highest).max().unwrap_or(0);
        for own in &self.derivations {
            let (first, rest) = growth.split_at(own.variables);
            powers.push(VariablePowers::of(m, own, values, first, highest));
            growth = rest;
        }
        let one = |column: &SparseColumn| match column {
            SparseColumn::Given(output) => values[*output],
            SparseColumn::Product { derivation, .. } => entry(column, &powers[*derivation]),
        };
        columns.iter().map(one).collect()
    }

    fn sparse(&self, m: &Modulus, columns: &[usize]) -> Vec<SparseColumn> {
        columns.iter().map(|index| SparseColumn::of(m, &self.columns[*index])).collect()
    }
}
