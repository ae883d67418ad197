//! Values that other values determine at almost all inputs.
//!
//! t is determined by s = (s₁, …, s_k) if Q(s) t = P(s), with polynomials P and Q and Q(s) ≠ 0
//! almost everywhere. What is determined joins s, and so does f(t), whatever the function f is; and
//! with f(t), t for one-to-one f. Relations are found with every f in the graph as a free symbol.
//!
//! docs/soundness.md, "Maps that are one-to-one".

mod monomials;
mod search;
mod solved;

use crate::graph::{Evaluator, Expr, Fault, Graph, Step, Tape, literally, record};
use crate::number::ball::{Ball, Balls};
use crate::number::rational::Rational;
use crate::scalar::Scalar;

use super::bounds::{Bounds, InputDistribution};
use super::coprime::is_single_valued;
use super::{Group, Prover};
use monomials::{Monomial, product};
use search::Search;
use solved::Relation;

/// Largest degree of a value that is tried with random constants.
const LARGEST_DEGREE: f64 = 400.0;
/// Largest height of such a value, in bits.
const LARGEST_HEIGHT: f64 = 4000.0;

/// A question whether some values determine others.
#[derive(Clone, Debug, Default)]
pub struct Determination {
    /// Values to be determined.
    pub wanted: Vec<Expr>,
    /// Values that determine them.
    pub given: Vec<Expr>,
    /// Values that are the same wherever the given ones are compared.
    pub constants: Vec<Expr>,
    /// Values that exist at the inputs that count.
    pub required: Vec<Expr>,
    /// Values that are not negative at the inputs that count.
    pub facts: Vec<Expr>,
}

impl Prover<'_> {
    /// Whether the wanted values are proved to be determined by the given ones: no two inputs with
    /// equal given values and constants, outside of a set of measure 0, differ in a wanted value.
    pub fn is_determined(&self, graph: &Graph, of: &Determination) -> Result<bool, Fault> {
        let places = |values: &[Expr]| values.iter().map(|v| graph.place(*v)).collect::<Vec<_>>();
        let [wanted, given, constants] = [&of.wanted, &of.given, &of.constants].map(|v| places(v));
        let reached = graph.reached_from(&[&wanted[..], &given, &constants].concat());
        let functions: Vec<usize> =
            (0..reached.len()).filter(|k| reached[*k] && !graph.step(*k).is_rational()).collect();
        let sources = self.sources_of(graph);
        let is_free = |step: Step<'_>| match step {
            Step::Constant(_) => true,
            Step::Input(input) => sources[input] == InputDistribution::Uniform,
            _ => false,
        };
        let mut steps = graph.steps().zip(&reached).filter(|(_, reached)| **reached);
        let is_rational = functions.is_empty()
            && steps.all(|(step, _)| !matches!(step, Step::Input(_)) || is_free(step))
            && constants.iter().all(|place| is_free(graph.step(*place)));
        if is_rational && !self.is_within_limits(graph, &wanted, &given) {
            return Ok(false);
        }
        let mut search = Search::new(graph, functions, &constants, is_rational);
        given.iter().for_each(|place| search.learn(*place));
        let tables = search.tables(self, of, &reached)?;
        if tables.is_empty() {
            return Ok(false);
        }
        while !wanted.iter().all(|place| search.is_known(*place)) {
            let Some((place, relation)) = search.next_relation(&tables, &wanted) else {
                return Ok(false);
            };
            if !is_rational && !self.holds(graph, of, place, search.symbols(), &relation)? {
                return Ok(false);
            }
            search.learn(place);
        }
        Ok(true)
    }

    fn is_within_limits(&self, graph: &Graph, wanted: &[usize], given: &[usize]) -> bool {
        let all = [wanted, given].concat();
        let bounds = Bounds::of(graph, &graph.reached_from(&all), &self.sources_of(graph));
        all.iter().all(|place| {
            let found = bounds.multiplied_out(*place);
            found.is_some_and(|(degree, height)| {
                degree <= LARGEST_DEGREE && height <= LARGEST_HEIGHT
            })
        })
    }

    /// Whether Q t = P is proved, and Q is not 0 on any cell of signs.
    fn holds(
        &self,
        graph: &Graph,
        of: &Determination,
        place: usize,
        symbols: &[usize],
        relation: &Relation,
    ) -> Result<bool, Fault> {
        let Some([above, below]) = relation.reconstructed() else { return Ok(false) };
        let reached = graph.reached_from(&[symbols, &[place][..]].concat());
        let conditions = graph.reached([&of.required[..], &of.facts].concat());
        let (graph, made) = record(graph.inputs(), |inputs| {
            let made = graph.repeated(&reached, inputs);
            let values = symbols.iter().map(|place| made[*place]).collect::<Option<Vec<Expr>>>()?;
            let sum = |terms: &[(Monomial, Rational)]| -> Expr {
                let of = |(monomial, factor): &(Monomial, _)| {
                    product(monomial, &values) * Expr::rational(factor)
                };
                terms.iter().map(of).sum()
            };
            let (above, below) = (sum(&above), sum(&below));
            let kept = literally(|| graph.repeated(&conditions, inputs));
            let all = |some: &[Expr]| -> Option<Vec<Expr>> {
                some.iter().map(|value| kept[graph.place(*value)]).collect()
            };
            Some((made[place]? * below - above, below, all(&of.required)?, all(&of.facts)?))
        })?;
        let Some((defect, below, required, facts)) = made else { return Ok(false) };
        let group = Group { outputs: vec![defect], required, facts, presence: Vec::new() };
        Ok(self.prove(&graph, &[group])?.iter().all(|outcome| outcome.is_zero())
            && self.is_almost_nowhere_zero(&graph, below)?)
    }

    /// Whether a value is known to be 0 on a set of measure 0 at most.
    pub(super) fn is_almost_nowhere_zero(&self, graph: &Graph, value: Expr) -> Result<bool, Fault> {
        if let Some(value) = graph.constant_value(value) {
            return Ok(!value.is_zero());
        }
        // A meromorphic function that is not 0 at one point is 0 on no open set.
        let is_uniform = |source: &InputDistribution| *source == InputDistribution::Uniform;
        if self.sources.iter().all(is_uniform) && is_single_valued(graph, &[value]) {
            let tape = Tape::new(graph, &[value]);
            let mut evaluator = Evaluator::new(&tape, Ball::<1>);
            let coordinate = |k: usize| Balls::new([0.5 + 0.37 * (k as f64).sin()], [0.0]);
            evaluator.run(&(0..graph.inputs()).map(coordinate).collect::<Vec<_>>());
            return Ok(evaluator
                .outputs()
                .all(|found| found.is_defined(0) && found.mid[0].abs() > found.rad[0]));
        }
        self.is_nonzero_on_all_cells(graph, value)
    }
}
