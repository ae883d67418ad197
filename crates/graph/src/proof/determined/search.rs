//! The search for relations between values at random points.

use std::collections::BTreeSet;

use crate::graph::{Evaluator, Expr, Fault, Graph, Step, Tape, record};
use crate::number::UnaryFunction;
use crate::number::prime::{Modulus, Prime, UNDEFINED};
use crate::proof::Prover;
use crate::proof::digest::SeedDigest;
use crate::proof::rng::{ProofRng, ProofStream};
use crate::proof::trial::PRIMES;

use super::Determination;
use super::monomials::monomials;
use super::solved::{Relation, Table, combination, quotient};

/// Largest degree of P and Q.
const MOST_DEGREE: usize = 6;
/// Largest number of monomials in the determining values.
const MOST_MONOMIALS: usize = 128;
/// Number of points beyond the number of unknown coefficients.
const SPARE_POINTS: usize = 8;
/// Largest number of multiplications of all eliminations.
const MOST_WORK: usize = 1 << 27;

/// Returns the argument of a function that takes no two arguments to one value.
fn argument_of_one_to_one(step: &Step<'_>) -> Option<usize> {
    match step {
        Step::Unary(
            UnaryFunction::Sqrt | UnaryFunction::Exp | UnaryFunction::Ln | UnaryFunction::Atan,
            argument,
        ) => Some(*argument),
        _ => None,
    }
}

/// A search for relations: what is known, by places.
pub struct Search<'g> {
    graph: &'g Graph,
    known: BTreeSet<usize>,
    /// Known values in which relations are polynomials.
    symbols: Vec<usize>,
    functions: Vec<usize>,
    /// Whether constants are the same at all points of a table, and not symbols.
    has_fixed_constants: bool,
    /// Number of multiplications so far.
    work: usize,
}

impl<'g> Search<'g> {
    /// Starts a search in which the constants alone are known.
    pub fn new(
        graph: &'g Graph,
        functions: Vec<usize>,
        constants: &[usize],
        has_fixed_constants: bool,
    ) -> Self {
        let known = constants.iter().copied().collect();
        let symbols = if has_fixed_constants { Vec::new() } else { constants.to_vec() };
        let mut search = Self { graph, known, symbols, functions, has_fixed_constants, work: 0 };
        search.learn_functions();
        search
    }

    /// Returns the known values in which relations are polynomials.
    pub fn symbols(&self) -> &[usize] {
        &self.symbols
    }

    /// Whether a value is known.
    pub fn is_known(&self, place: usize) -> bool {
        self.known.contains(&place) || matches!(self.graph.step(place), Step::Constant(_))
    }

    /// Adds a known value, and what follows from it.
    pub fn learn(&mut self, place: usize) {
        if self.is_known(place) {
            return;
        }
        self.known.insert(place);
        self.symbols.push(place);
        self.learn_functions();
    }

    fn learn_functions(&mut self) {
        for function in self.functions.clone() {
            let step = self.graph.step(function);
            if step.arguments().all(|argument| self.is_known(argument)) {
                self.learn(function);
            }
            if let (true, Some(argument)) = (self.is_known(function), argument_of_one_to_one(&step))
            {
                self.learn(argument);
            }
        }
    }

    /// Returns the free symbol of a function; a sine and a cosine share the tangent of the half angle.
    fn abstracted(&self, function: usize, step: Step<'_>, symbols: &[Expr]) -> Expr {
        let Step::Unary(name @ (UnaryFunction::Sin | UnaryFunction::Cos), angle) = step else {
            return symbols[function];
        };
        let is_of_angle = |place: &usize| {
            matches!(self.graph.step(*place),
                Step::Unary(UnaryFunction::Sin | UnaryFunction::Cos, own) if own == angle)
        };
        let first = self.functions.iter().position(is_of_angle).unwrap_or(function);
        let (tangent, one) = (symbols[first], Expr::from(1.0));
        let above = match name {
            UnaryFunction::Sin => tangent + tangent,
            _ => one - tangent * tangent,
        };
        above / (one + tangent * tangent)
    }

    /// Evaluates all values that matter at random points; with random constants modulo several
    /// primes, or modulo one prime with constants as symbols; none if a value has no image there.
    pub fn tables(
        &self,
        prover: &Prover<'_>,
        of: &Determination,
        reached: &[bool],
    ) -> Result<Vec<Table>, Fault> {
        let inputs = self.graph.inputs();
        let (abstracted, made) = record(inputs + self.functions.len(), |all| {
            self.graph.replay(reached, &all[..inputs], |place, step, _| {
                let function = self.functions.binary_search(&place).ok()?;
                Some(self.abstracted(function, step, &all[inputs..]))
            })
        })?;
        let all = [&of.wanted[..], &of.given, &of.constants].concat();
        let arguments =
            self.functions.iter().flat_map(|k| self.graph.step(*k).arguments().collect::<Vec<_>>());
        let tracked: BTreeSet<usize> = all
            .iter()
            .map(|value| self.graph.place(*value))
            .chain(self.functions.iter().copied())
            .chain(arguments)
            .collect();
        let tracked: Vec<usize> = tracked.into_iter().filter(|k| made[*k].is_some()).collect();
        let outputs: Vec<Expr> = tracked.iter().filter_map(|place| made[*place]).collect();
        let tape = Tape::new(&abstracted, &outputs);
        let mut rng =
            ProofRng::of(SeedDigest::of(prover.seed, self.graph, &[all]), ProofStream::Inverses);
        let fixed: BTreeSet<usize> = of
            .constants
            .iter()
            .filter_map(|value| match self.graph.step(self.graph.place(*value)) {
                Step::Input(input) if self.has_fixed_constants => Some(input),
                _ => None,
            })
            .collect();
        let count = 2 * MOST_MONOMIALS + SPARE_POINTS;
        let primes = if self.has_fixed_constants { PRIMES } else { 1 };
        let mut tables = Vec::new();
        for _ in 0..primes {
            let modulus: Modulus = rng.prime(&[], &[]);
            let mut evaluator = Evaluator::new(&tape, Prime::new([modulus]));
            let mut point: Vec<[u64; 1]> =
                (0..abstracted.inputs()).map(|_| [rng.element(&modulus)]).collect();
            let mut rows = Vec::new();
            for _ in 0..count {
                for (input, value) in point.iter_mut().enumerate() {
                    if !fixed.contains(&input) {
                        *value = [rng.element(&modulus)];
                    }
                }
                evaluator.run(&point);
                let row: Vec<u64> = evaluator.outputs().map(|[value]| *value).collect();
                if row.contains(&UNDEFINED) {
                    return Ok(Vec::new());
                }
                rows.push(row);
            }
            tables.push(Table { modulus, tracked: tracked.clone(), rows });
        }
        Ok(tables)
    }

    /// Finds a value that the known ones determine, by a relation of least degree.
    pub fn next_relation(
        &mut self,
        tables: &[Table],
        wanted: &[usize],
    ) -> Option<(usize, Relation)> {
        let graph = self.graph;
        let of_functions = self.functions.iter().flat_map(|place| {
            let step = graph.step(*place);
            let own = argument_of_one_to_one(&step).map(|_| *place);
            step.arguments().chain(own).collect::<Vec<_>>()
        });
        let open: BTreeSet<usize> =
            wanted.iter().copied().chain(of_functions).filter(|k| !self.is_known(*k)).collect();
        for degree in 1..=MOST_DEGREE {
            let Some(all) = monomials(self.symbols.len(), degree, MOST_MONOMIALS) else { break };
            for is_quotient in [false, true] {
                for place in &open {
                    let n = all.len() * (1 + usize::from(is_quotient));
                    self.work = self.work.saturating_add(n * n * n);
                    if self.work > MOST_WORK {
                        return None;
                    }
                    let find = |table: &Table| match is_quotient {
                        false => combination(table, &all, &self.symbols, *place),
                        true => quotient(table, &all, &self.symbols, *place),
                    };
                    let mut found = tables.iter().map(find);
                    let first = found.next().flatten();
                    if let (Some(first), true) = (first, found.all(|other| other.is_some())) {
                        return Some((*place, first));
                    }
                }
            }
        }
        None
    }
}
