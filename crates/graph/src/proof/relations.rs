//! Linear relations with rational coefficients between values of a graph.

use crate::graph::{Evaluator, Expr, Fault, Graph, Step, Tape, record};
use crate::number::prime::{Modulus, UNDEFINED};
use crate::number::quadratic::Quadratic;
use crate::number::rational::Rational;
use crate::scalar::Scalar;

use super::bounds::InputDistribution;
use super::digest::SeedDigest;
use super::elimination::reduce;
use super::lower::Algebraic;
use super::reconstruct::reconstruct;
use super::rng::{ProofRng, ProofStream, RequiredRoots};
use super::symbols::Symbols;
use super::tower::Tower;
use super::trial::{Certificate, Residues, Roots, TRIAL_LANES, Trial, TrialResult, both, points};

/// Largest number of values to be related: the cost is cubic.
pub const MOST_VALUES: usize = 40;
/// Largest number of functions inside of each other whose arguments are compared with what is inside.
const MOST_NESTED_FUNCTIONS: usize = 4;
/// Number of rows beyond the number of columns.
pub const SPARE_ROWS: usize = 4;

/// A map from the values at some places to values that must vanish; `None` if a value is missing.
pub type Defects<'a> = dyn Fn(&[Option<Expr>]) -> Option<Vec<Expr>> + 'a;

/// A combination constant + Σ multiples_i e_i over a basis e.
#[derive(Clone, Debug, PartialEq)]
pub struct Combination {
    /// Rational constant.
    pub constant: Rational,
    /// Multiples of the basis elements.
    pub multiples: Vec<Rational>,
}

/// A search for linear relations in a graph; transcendental steps count as independent.
pub struct RelationSearch<'g> {
    graph: &'g Graph,
    sources: &'g [InputDistribution],
    algebraic: Algebraic<'static>,
    digest: SeedDigest,
    /// Whether relations between the arguments of functions inside of the values are used.
    is_related: bool,
    /// Error of the relations proved so far.
    pub certificate: Option<Certificate>,
}

impl<'g> RelationSearch<'g> {
    /// Prepares to relate values of `graph`.
    pub fn new(
        graph: &'g Graph,
        sources: &'g [InputDistribution],
        algebraic: Algebraic<'static>,
        digest: SeedDigest,
    ) -> Self {
        Self { graph, sources, algebraic, digest, is_related: false, certificate: None }
    }

    /// Expresses each place's value in a basis chosen among them, together with the number 1 if
    /// `with_one`; `None` if no basis was found and proved.
    pub fn between(&mut self, places: &[usize], with_one: bool) -> Option<Vec<Combination>> {
        if places.is_empty() || places.len() > MOST_VALUES {
            return None;
        }
        let mut rng = ProofRng::of(self.digest, ProofStream::Relations);
        let modulus = prime_for(&self.algebraic, &mut rng);
        let columns = places.len() + usize::from(with_one);
        let outputs: Option<Vec<Expr>> =
            places.iter().map(|place| self.algebraic.values[*place]).collect();
        let count = columns + SPARE_ROWS;
        let rows = rows(&self.algebraic, &outputs?, with_one, count, &modulus, &mut rng)?;
        let (pivots, rows) = reduce(rows, columns, &modulus);
        let offset = usize::from(with_one);
        let basis: Vec<usize> = pivots.iter().copied().filter(|c| *c >= offset).collect();
        let combinations: Option<Vec<Combination>> = (offset..columns)
            .map(|column| {
                let coefficient = |pivot: usize| match pivots.iter().position(|p| *p == pivot) {
                    _ if pivot == column => Some(Rational::from(1)),
                    Some(row) if !pivots.contains(&column) => {
                        reconstruct(rows[row][column], &modulus)
                    }
                    _ => Some(Rational::from(0)),
                };
                let constant = if with_one { coefficient(0)? } else { Rational::from(0) };
                let multiples: Option<Vec<Rational>> =
                    basis.iter().map(|pivot| coefficient(*pivot)).collect();
                Some(Combination { constant, multiples: multiples? })
            })
            .collect();
        let combinations = combinations?;
        let basis: Vec<usize> = basis.iter().map(|column| places[column - offset]).collect();
        self.verify(places, &basis, &combinations).then_some(combinations)
    }

    /// Whether two values are reciprocal (`true`) or equal (`false`); `None` if neither is proved.
    pub fn is_reciprocal(&mut self, a: usize, b: usize) -> Option<bool> {
        let defect = |reciprocal: bool| {
            move |values: &[Option<Expr>]| -> Option<Vec<Expr>> {
                let (a, b) = (values[a]?, values[b]?);
                let one = Expr::rational(&Rational::from(1));
                Some(vec![if reciprocal { a * b - one } else { a - b }])
            }
        };
        [false, true].into_iter().find(|reciprocal| self.vanish(&[a, b], &defect(*reciprocal)))
    }

    /// Whether the values at the places are proved to be the combinations.
    fn verify(&mut self, places: &[usize], basis: &[usize], combinations: &[Combination]) -> bool {
        self.vanish(places, &|values| {
            places
                .iter()
                .zip(combinations)
                .map(|(place, combination)| {
                    let mut rest = values[*place]? - Expr::rational(&combination.constant);
                    for (element, multiple) in basis.iter().zip(&combination.multiples) {
                        rest -= values[*element]? * Expr::rational(multiple);
                    }
                    Some(rest)
                })
                .collect()
        })
    }

    /// Whether some functions of the values at these places are proved to vanish; the error of the
    /// proof is added.
    fn vanish(&mut self, places: &[usize], defects: &Defects<'_>) -> bool {
        let Self { graph, sources, digest, is_related, .. } = *self;
        let defect = Defect { graph, sources, digest, is_related };
        let Some(own) = defect.vanishing(places, defects) else { return false };
        self.certificate = both(self.certificate, Some(own));
        true
    }
}

/// Draws a prime whose field contains the roots of an algebraic graph.
pub fn prime_for(algebraic: &Algebraic<'_>, rng: &mut ProofRng) -> Modulus {
    rng.prime_with_roots(&RequiredRoots {
        odd: algebraic.odd_indices(),
        squares: algebraic.squares(),
        depth: algebraic.depth(),
    })
}

/// Evaluates at random points over one prime, two rows for each point: an element of the quadratic
/// extension is two of the field. `None` if too few points exist.
pub fn rows(
    algebraic: &Algebraic<'_>,
    outputs: &[Expr],
    with_one: bool,
    count: usize,
    modulus: &Modulus,
    rng: &mut ProofRng,
) -> Option<Vec<Vec<u64>>> {
    let tape = Tape::new(&algebraic.graph, outputs);
    let moduli = [*modulus; TRIAL_LANES];
    let mut evaluator = Evaluator::new(&tape, Quadratic::new(moduli));
    let mut rows = Vec::new();
    for _ in 0..64 * count {
        let block = points(&moduli, &algebraic.sources, &[], rng);
        evaluator.run(&<Quadratic<TRIAL_LANES> as Residues>::blocks(&block));
        for lane in 0..TRIAL_LANES {
            let values: Vec<[u64; 2]> = evaluator.outputs().map(|block| block[lane]).collect();
            if values.iter().any(|value| value[0] == UNDEFINED) {
                continue;
            }
            for (part, one) in [modulus.one(), 0].into_iter().enumerate() {
                let one = with_one.then_some(one);
                let row: Vec<u64> =
                    one.into_iter().chain(values.iter().map(|value| value[part])).collect();
                rows.push(row);
            }
        }
        if rows.len() >= 2 * count {
            return Some(rows);
        }
    }
    None
}

/// Gives the functions of a graph symbols, one for each element of a basis of their arguments; also returns the error
/// of the relations between these.
///
/// The arguments of functions of functions are compared once more for each level, with the relations inside of them.
pub fn symbols(
    graph: &Graph,
    reached: &[bool],
    sources: &[InputDistribution],
    digest: SeedDigest,
) -> Result<(Symbols, Option<Certificate>), Fault> {
    let related = |inside: &Symbols, is_related: bool| {
        let formal = Algebraic::formal(graph, reached, sources, inside)?;
        let own = RelationSearch::new(graph, sources, formal, digest);
        let mut relations = RelationSearch { is_related, ..own };
        let symbols = Symbols::by_basis(graph, reached, &mut relations);
        Ok((symbols, relations.certificate))
    };
    let opaque = Symbols::opaque(graph, reached);
    let (mut symbols, mut certificate) = related(&opaque, false)?;
    for _ in 1..depth_of_functions(graph, reached).min(MOST_NESTED_FUNCTIONS) {
        let (next, further) = related(&symbols, true)?;
        if next.opaque_count() > symbols.opaque_count() {
            break;
        }
        (symbols, certificate) = (next, both(certificate, further));
    }
    Ok((symbols, certificate))
}

/// Largest number of functions inside of each other, numbers such as π = 4 atan 1 excepted.
fn depth_of_functions(graph: &Graph, reached: &[bool]) -> usize {
    let (mut moves, mut depths) = (vec![false; graph.len()], vec![0; graph.len()]);
    for (place, step) in graph.steps().enumerate().filter(|(place, _)| reached[*place]) {
        moves[place] = matches!(step, Step::Input(_)) || step.arguments().any(|a| moves[a]);
        let inside = step.arguments().map(|a| depths[a]).max().unwrap_or(0);
        depths[place] = inside + usize::from(step.is_transcendental() && moves[place]);
    }
    depths.into_iter().max().unwrap_or(0)
}

/// A test of functions of the values at some places of a graph.
#[derive(Clone, Copy)]
pub struct Defect<'d> {
    /// Graph of the computation.
    pub graph: &'d Graph,
    /// Distributions of its inputs.
    pub sources: &'d [InputDistribution],
    /// Digest of the statement to be proved.
    pub digest: SeedDigest,
    /// Whether relations between the arguments of transcendental functions are used.
    pub is_related: bool,
}

impl Defect<'_> {
    /// Proves that functions of the values at these places vanish.
    pub fn vanishing(&self, places: &[usize], defects: &Defects<'_>) -> Option<Certificate> {
        let Self { sources, digest, .. } = *self;
        let reached = self.graph.reached_from(places);
        let (graph, defects) =
            record(sources.len(), |inputs| defects(&self.graph.repeated(&reached, inputs))).ok()?;
        let defects = defects?;
        let reached = graph.reached(defects.iter().copied());
        let (symbols, related) = match self.is_related {
            true => symbols(&graph, &reached, sources, digest).ok()?,
            false => (Symbols::opaque(&graph, &reached), None),
        };
        let lowered = Algebraic::of(&graph, &reached, sources, &symbols).ok()?;
        let values: Option<Vec<Expr>> =
            defects.iter().map(|defect| lowered.values[graph.place(*defect)]).collect();
        let values = values?;
        let trial = Trial::new(&lowered, digest);
        let tower = Tower::of(&graph, &lowered, &trial, digest);
        let is_clean = |defect: &Expr| tower.is_clean(&lowered, *defect);
        if !lowered.has_few_signs() || !values.iter().all(is_clean) {
            return None;
        }
        match trial.test(&[&values], Roots { nested: tower.nested, fixed: &[] }).pop() {
            Some(TrialResult::Zero(certificate)) => both(Some(certificate), related),
            _ => None,
        }
    }
}
