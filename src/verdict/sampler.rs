//! Sampling of states at a place: random draws, from which the number domain computes parameters
//! and a state.

use std::sync::Arc;

use crate::case::Case;
use crate::claim::Place;
use num_dual::DualNum;

use crate::graph::{Evaluator, Expr, Fault, Graph, Step, Tape, literally, record};
use crate::level::{self, Pivot, Solution};
use crate::mechanics::{Chart, Draw, Draws, Line, Origin};
use crate::number::ball::{Ball, Balls};
use crate::number::exact::Exact;
use crate::number::mixed::{Mixed, Number};
use crate::number::precise::Precise;
use crate::number::rational::Rational;
use crate::number::{Domain, Function};
use crate::proof::{Extent, Group, Source};
use crate::scalar::Scalar;

use super::newton::Newton;
use super::{JudgeError, coverage};

/// Number of spare bits in a printed state, followed by the number of spare digits.
const SPARE_BITS: u32 = 64;
const SPARE_DIGITS: usize = 8;
/// Number of states in one run of a tape.
pub const LANES: usize = 64;

/// Number of draws tried for a state that has to lie in given ranges.
const ATTEMPTS: u32 = 64;
/// Bits in which a state that f64 cannot decide is looked at.
const EXACT_BITS: u32 = 256;

/// A sampler of the inputs of a case's tapes at one place.
#[derive(Clone)]
pub struct Sampler {
    seed: u64,
    draws: Draws,
    recipes: Vec<Draw>,
    /// Parameters and state as functions of the draws.
    graph: Arc<Graph>,
    made: Vec<Expr>,
    /// Solution of the level, with the values that must not vanish, or a part of it is missed.
    solution: Option<Arc<Solution>>,
    pivots: Arc<[Pivot]>,
    /// Number of draws for the parameters.
    parameter_draws: usize,
    dimension: usize,
    /// Whether each level equation holds at the states.
    kept: Vec<bool>,
    /// Tape for parameters and state, undefined where they are out of range.
    tape: Tape,
    /// Tape for parameters and state wherever they exist.
    unguarded: Tape,
    /// Whether some draws lead to no state.
    is_guarded: bool,
    /// Whether the states are made with moduli.
    has_moduli: bool,
    newton: Option<Newton>,
}

impl Sampler {
    /// Makes a sampler of states at `place`.
    pub fn new(case: &Case, place: &Place, seed: u64) -> Result<Self, Fault> {
        let (model, kept) = (&case.model, &place.kept);
        let some = kept.iter().any(|kept| *kept);
        let is_charted = match &case.chart {
            Chart::Rolling | Chart::Sphere | Chart::Free => true,
            // A chart of the whole level does not give its equations separately.
            Chart::Given(_) => kept.iter().all(|kept| *kept),
            Chart::Equations => false,
        };
        let solution = match is_charted || !some {
            true => None,
            false => level::solve(model, kept),
        };
        let newton = (some && !is_charted && solution.is_none())
            .then(|| Newton::new(model, kept))
            .transpose()?;
        let mut draws = model.parameter_draws();
        let parameter_draws = draws.len();
        draws.extend(match &solution {
            Some(solution) => solution.draws(&case.free_draws),
            None => case.chart.draws(&case.free_draws, kept),
        });
        let (graph, (made, guarded, pivots)) = record(draws.len(), |inputs| {
            let (parameters, state) = model.make_parameters(inputs);
            let Some(solution) = &solution else {
                let mut made = parameters;
                let point = literally(|| case.chart.point(model, kept, &made, state));
                made.extend(point);
                return (made.clone(), made, Vec::new());
            };
            let solved = solution.point(model, parameters, state);
            let bounds = ranges(case, solution, &solved.made);
            let facts = solved.facts.iter().map(|(value, _)| *value).chain(bounds);
            let guarded = guarded(&solved.made, facts);
            (solved.made, guarded, solved.pivots)
        })?;
        let (tape, unguarded) = (Tape::new(&graph, &guarded), Tape::new(&graph, &made));
        let is_guarded = solution.is_some();
        let reached = graph.reached(guarded.iter().copied());
        let is_modulus = |step: Step<'_>| matches!(step, Step::Unary(Function::Abs, _));
        let has_moduli = (0..reached.len()).any(|k| reached[k] && is_modulus(graph.step(k)));
        let dimension = model.dimension();
        let (recipes, draws) = (draws.clone(), Draws::new(&draws));
        let (graph, pivots) = (Arc::new(graph), pivots.into());
        let solution = solution.map(Arc::new);
        Ok(Self {
            seed,
            draws,
            recipes,
            graph,
            made: guarded,
            solution,
            pivots,
            parameter_draws,
            dimension,
            kept: kept.clone(),
            tape,
            unguarded,
            is_guarded,
            has_moduli,
            newton,
        })
    }

    /// Whether the states are found numerically, with an estimated rather than a proved distance
    /// from the level.
    pub fn is_numerical(&self) -> bool {
        self.newton.is_some()
    }

    /// Whether each of the level's equations holds at the states.
    pub fn kept(&self) -> &[bool] {
        &self.kept
    }

    /// Computes parameters and state of the states `start..start + LANES`, as balls.
    pub fn balls(&self, start: u64) -> Vec<Balls<LANES>> {
        self.maker().balls(start)
    }

    /// Makes a reusable source of many blocks of balls.
    pub(super) fn maker(&self) -> Maker<'_> {
        Maker { sampler: self, evaluator: Evaluator::new(&self.tape, Ball::<LANES>) }
    }

    /// Computes parameters and state for `lanes` states in another domain; states found numerically
    /// are known in f64 only.
    pub fn states<D: Domain + Clone>(&self, domain: &D, lanes: usize, start: u64) -> Vec<D::Block> {
        self.made_in(domain, &self.numbers(lanes, start))
    }

    /// Returns the draws of `lanes` states in a domain.
    pub fn drawn<D: Domain>(&self, domain: &D, lanes: usize, start: u64) -> Vec<D::Block> {
        self.columns(domain, &self.numbers(lanes, start))
    }

    /// Computes parameters and one state from given numbers instead of draws.
    pub fn made_from<D: Domain + Clone>(&self, domain: &D, numbers: &[Rational]) -> Vec<D::Block> {
        self.made_in(domain, &[numbers.to_vec()])
    }

    fn numbers(&self, lanes: usize, start: u64) -> Vec<Vec<Rational>> {
        let attempts = self.attempts(start, lanes, None);
        let state = |(lane, attempt)| self.draws.attempt(self.seed, start + lane as u64, attempt);
        attempts.into_iter().enumerate().map(state).collect()
    }

    /// Finds, for each of some states, the first attempt at which the draws lead to a state, by
    /// enclosures in f64; the first of all if none does. With few parameter sets, each state uses
    /// those of its set.
    fn attempts(&self, start: u64, lanes: usize, sets: Option<usize>) -> Vec<u32> {
        let mut attempts = vec![0; lanes];
        if !self.is_guarded {
            return attempts;
        }
        let mut evaluator = Evaluator::new(&self.tape, Ball::<LANES>);
        for first in (0..lanes).step_by(LANES) {
            let own = &mut attempts[first..lanes.min(first + LANES)];
            let mut open: Vec<usize> = (0..own.len()).collect();
            for attempt in 0..ATTEMPTS {
                let numbers: Vec<Vec<(f64, bool)>> = open
                    .iter()
                    .map(|lane| self.nearest(start + (first + lane) as u64, attempt, sets))
                    .collect();
                let last = open.len() - 1;
                let column = |k: usize| Balls::about(|lane| numbers[lane.min(last)][k]);
                let columns: Vec<Balls<LANES>> = (0..self.draws.len()).map(column).collect();
                evaluator.run(&columns);
                let exists = |lane: usize| evaluator.outputs().all(|block| block.is_defined(lane));
                let mut left = Vec::new();
                for (place, lane) in open.iter().enumerate() {
                    let index = start + (first + lane) as u64;
                    match exists(place) || self.exists_exactly(index, attempt, sets) {
                        true => own[*lane] = attempt,
                        false => left.push(*lane),
                    }
                }
                open = left;
                if open.is_empty() {
                    break;
                }
            }
        }
        attempts
    }

    /// Whether the draws lead to a state in exact numbers. Only these know that √(y + |y|) exists
    /// for y < 0, so they are asked where a modulus is involved.
    fn exists_exactly(&self, index: u64, attempt: u32, sets: Option<usize>) -> bool {
        if !self.has_moduli {
            return false;
        }
        let domain = Mixed::new(EXACT_BITS);
        let made = self.made_in(&domain, &[self.drawn_numbers(index, attempt, sets)]);
        made.iter().all(|value| matches!(value, Number::Exact(_) | Number::Ball(_)))
    }

    /// Returns the draws of a state, with the parameters of its set if there are few.
    fn drawn_numbers(&self, index: u64, attempt: u32, sets: Option<usize>) -> Vec<Rational> {
        let mut own = self.draws.attempt(self.seed, index, attempt);
        if let Some(sets) = sets {
            let set = (index % LANES as u64) as usize * sets / LANES;
            let shared = self.draws.state(self.seed, set as u64);
            own[..self.parameter_draws].clone_from_slice(&shared[..self.parameter_draws]);
        }
        own
    }

    /// Returns the draws of a state in f64, with the parameters of its set if there are few.
    fn nearest(&self, index: u64, attempt: u32, sets: Option<usize>) -> Vec<(f64, bool)> {
        let mut own = self.draws.nearest(self.seed, index, attempt);
        if let Some(sets) = sets {
            let set = (index % LANES as u64) as usize * sets / LANES;
            let shared = self.draws.nearest(self.seed, set as u64, 0);
            own[..self.parameter_draws].copy_from_slice(&shared[..self.parameter_draws]);
        }
        own
    }

    /// Returns the range of each drawn number.
    pub fn extents(&self) -> Vec<Extent> {
        self.recipes.iter().map(extent).collect()
    }

    /// Whether some number is drawn from a list of several.
    pub fn has_lists(&self) -> bool {
        self.recipes.iter().any(|draw| matches!(draw, Draw::OneOf(values) if values.len() > 1))
    }

    /// Makes a sampler of the same states with the listed numbers fixed.
    pub fn with(&self, fixed: &[Option<Rational>]) -> Self {
        let one = |(draw, fixed): (&Draw, &Option<Rational>)| match fixed {
            Some(value) => Draw::OneOf(vec![value.clone()]),
            None => draw.clone(),
        };
        let recipes: Vec<Draw> = self.recipes.iter().zip(fixed).map(one).collect();
        Self { draws: Draws::new(&recipes), recipes, ..self.clone() }
    }

    /// Lists the parameters drawn from lists, with the values they have at every state.
    pub fn listed(&self, case: &Case) -> String {
        let mut draws = self.recipes.iter();
        let mut listed = Vec::new();
        for parameter in case.model.free_parameters() {
            let Origin::Free(recipe) = &parameter.origin else { continue };
            let own = draws.by_ref().take(recipe.draws().len());
            let values: Vec<String> = own
                .filter_map(|draw| match draw {
                    Draw::OneOf(values) => Some(values.first()?.to_string()),
                    _ => None,
                })
                .collect();
            match &values[..] {
                [] => {}
                [one] => listed.push(format!("{} = {one}", parameter.name)),
                all => listed.push(format!("{} from {}", parameter.name, all.join(", "))),
            }
        }
        listed.join(", ")
    }

    /// Returns the distribution of each number.
    pub fn recipes(&self) -> &[Draw] {
        &self.recipes
    }

    /// Composes values of `graph`, a function of parameters and states, with the map from draws,
    /// replacing the draws in `fixed` by constants.
    ///
    /// Further inputs of `graph` (antiderivatives) follow the draws.
    pub fn compose(
        &self,
        graph: &Graph,
        groups: &[Vec<Expr>],
        fixed: &[Option<Rational>],
    ) -> Result<(Graph, Vec<Vec<Expr>>), Fault> {
        let (composed, values) = record(self.draws.len(), |draws| {
            let (inputs, _) = self.inputs_from(graph, draws, fixed)?;
            let reached = graph.reached(groups.iter().flatten().copied());
            let values = graph.replay(&reached, &inputs, |_, _, _| None);
            let group = |group: &Vec<Expr>| {
                group.iter().map(|value| values[graph.place(*value)]).collect::<Option<Vec<Expr>>>()
            };
            groups.iter().map(group).collect::<Option<Vec<Vec<Expr>>>>()
        })?;
        values.map(|values| (composed, values)).ok_or(Fault::ForeignValue)
    }

    /// Composes groups of values; states, too, are defined wherever the values matter.
    pub fn compose_groups(
        &self,
        graph: &Graph,
        groups: &[Group],
        fixed: &[Option<Rational>],
    ) -> Result<(Graph, Vec<Group>), Fault> {
        let (composed, groups) = record(self.draws.len(), |draws| {
            let (inputs, _) = self.inputs_from(graph, draws, fixed)?;
            let values_of = |needed: &mut dyn Iterator<Item = Expr>| {
                graph.replay(&graph.reached(needed), &inputs, |_, _, _| None)
            };
            let outputs = values_of(&mut groups.iter().flat_map(|group| &group.outputs).copied());
            // √x √x is x where x ≥ 0, and the required value is undefined elsewhere.
            let required = literally(|| {
                values_of(&mut groups.iter().flat_map(|group| &group.required).copied())
            });
            let all = |some: &[Expr], values: &[Option<Expr>]| {
                some.iter().map(|value| values[graph.place(*value)]).collect::<Option<Vec<Expr>>>()
            };
            let group = |group: &Group| {
                let mut required = all(&group.required, &required)?;
                required.extend(&inputs[..self.made.len()]);
                Some(Group { outputs: all(&group.outputs, &outputs)?, required })
            };
            groups.iter().map(group).collect::<Option<Vec<Group>>>()
        })?;
        groups.map(|groups| (composed, groups)).ok_or(Fault::ForeignValue)
    }

    /// Records parameters, states and further inputs of `graph` as functions of draws, with all
    /// intermediate values.
    fn inputs_from(
        &self,
        graph: &Graph,
        draws: &[Expr],
        fixed: &[Option<Rational>],
    ) -> Option<(Vec<Expr>, Vec<Option<Expr>>)> {
        let draws: Vec<Expr> = draws
            .iter()
            .zip(fixed)
            .map(|(draw, fixed)| fixed.as_ref().map_or(*draw, Expr::rational))
            .collect();
        let reached = self.graph.reached(self.made.iter().copied());
        let values = self.graph.replay(&reached, &draws, |_, _, _| None);
        let made = self.made.iter().map(|value| values[self.graph.place(*value)]);
        let mut inputs = made.collect::<Option<Vec<Expr>>>()?;
        inputs.extend((inputs.len()..graph.inputs()).map(|_| Expr::input()));
        Some((inputs, values))
    }

    /// Returns the graph from draws to parameters and states.
    pub fn graph(&self) -> &Graph {
        &self.graph
    }

    /// Returns the values that must not vanish at a state, or a part of the place is missed.
    pub fn pivots(&self) -> &[Pivot] {
        &self.pivots
    }

    /// Returns the solution of the level, if there is one.
    pub fn solution(&self) -> Option<&Solution> {
        self.solution.as_deref()
    }

    /// Returns parameters and state, as values of [`Self::graph`].
    pub fn made(&self) -> &[Expr] {
        &self.made
    }

    /// Returns the draws of a state in f64, and whether each is exact.
    pub fn nearest_draws(&self, index: u64) -> Vec<(f64, bool)> {
        self.draws.nearest(self.seed, index, 0)
    }

    /// Returns the draws of a state near the ends of ranges, in f64.
    pub fn nearest_edge(&self, index: u64) -> Vec<(f64, bool)> {
        self.draws.nearest_edge(self.seed, index)
    }

    /// Number of draws for the parameters.
    pub fn parameter_draws(&self) -> usize {
        self.parameter_draws
    }

    /// Returns the distribution of each draw in a field.
    pub fn sources(&self) -> Vec<Source> {
        let source = |draw: &Draw| match draw {
            Draw::Sign => Source::Sign,
            _ => Source::Uniform,
        };
        self.recipes.iter().map(source).collect()
    }

    /// Checks that a parametrisation given by the user fills the level set.
    pub fn check_coverage(&self, case: &Case) -> Result<(), JudgeError> {
        let Chart::Given(_) = &case.chart else { return Ok(()) };
        let dimension = self.dimension.saturating_sub(case.model.level.len());
        let found = coverage::rank(case, &self.draws, self.parameter_draws, self.seed)?;
        if found < dimension {
            return Err(JudgeError::PartialChart { found, dimension });
        }
        Ok(())
    }

    /// Computes states in another domain with few parameter sets: one for every `LANES / sets`
    /// states.
    pub fn states_sharing_parameters<D: Domain + Clone>(
        &self,
        domain: &D,
        start: u64,
        sets: usize,
    ) -> Vec<D::Block> {
        let attempts = self.attempts(start, LANES, Some(sets));
        let state = |(lane, attempt)| self.drawn_numbers(start + lane as u64, attempt, Some(sets));
        let numbers: Vec<Vec<Rational>> = attempts.into_iter().enumerate().map(state).collect();
        self.made_in(domain, &numbers)
    }

    /// Computes one of these states in a domain of one lane.
    pub fn state_sharing_parameters<D: Domain + Clone>(
        &self,
        domain: &D,
        index: u64,
        sets: usize,
    ) -> Vec<D::Block> {
        let attempt = self.attempts(index, 1, Some(sets))[0];
        let values = self.drawn_numbers(index, attempt, Some(sets));
        self.made_in(domain, &[values])
    }

    /// Computes states in another domain near the ends of ranges and near 0, with few parameter
    /// sets.
    pub fn states_at_edges<D: Domain + Clone>(
        &self,
        domain: &D,
        start: u64,
        sets: usize,
    ) -> Vec<D::Block> {
        let state = |lane: usize| {
            let mut values = self.draws.state(self.seed, (lane * sets / LANES) as u64);
            let own = self.draws.edge(self.seed, start + lane as u64);
            values[self.parameter_draws..].clone_from_slice(&own[self.parameter_draws..]);
            values
        };
        self.made_in(domain, &(0..LANES).map(state).collect::<Vec<_>>())
    }

    /// Converts the draws of some states to a domain, one block for each draw.
    fn columns<D: Domain>(&self, domain: &D, lanes: &[Vec<Rational>]) -> Vec<D::Block> {
        (0..self.draws.len())
            .map(|k| {
                let column: Vec<Rational> = lanes.iter().map(|lane| lane[k].clone()).collect();
                domain.values(&column)
            })
            .collect()
    }

    /// Computes parameters and states from draws.
    fn made_in<D: Domain + Clone>(&self, domain: &D, lanes: &[Vec<Rational>]) -> Vec<D::Block> {
        let mut evaluator = Evaluator::new(&self.tape, domain.clone());
        evaluator.run(&self.columns(domain, lanes));
        evaluator.outputs().cloned().collect()
    }

    /// Computes parameters and state of one state, exact where they are rational.
    pub fn exact(&self, index: u64) -> Vec<Option<Rational>> {
        self.exact_from(self.numbers(1, index).swap_remove(0))
    }

    fn exact_from(&self, values: Vec<Rational>) -> Vec<Option<Rational>> {
        let mut evaluator = Evaluator::new(&self.unguarded, Exact);
        evaluator.run(&values.into_iter().map(Some).collect::<Vec<_>>());
        let state_begins = self.tape.outputs() - self.dimension;
        evaluator
            .outputs()
            .enumerate()
            .map(|(k, value)| value.clone().filter(|_| self.newton.is_none() || k < state_begins))
            .collect()
    }

    /// Prints parameters and state; irrational numbers with enough digits to distinguish states of
    /// `bits` bits, so that a residual computed in this precision can be reproduced.
    pub fn printed(&self, index: u64, bits: u32) -> Vec<String> {
        if bits > f64::MANTISSA_DIGITS {
            return self.printed_from(&self.numbers(1, index).swap_remove(0), bits);
        }
        let start = index - index % LANES as u64;
        let lane = (index % LANES as u64) as usize;
        let balls = std::cell::LazyCell::new(|| self.balls(start));
        let text = |(k, value): (usize, Option<Rational>)| match value {
            Some(exact) => exact.to_string(),
            None => format!("{:?}", balls[k].mid[lane]),
        };
        self.exact(index).into_iter().enumerate().map(text).collect()
    }

    /// Prints a state made from given numbers, with digits for `bits` bits.
    pub fn printed_from(&self, numbers: &[Rational], bits: u32) -> Vec<String> {
        let domain = Precise::new(bits + SPARE_BITS);
        let digits = (f64::from(bits) * std::f64::consts::LOG10_2) as usize + SPARE_DIGITS;
        let precise = std::cell::LazyCell::new(|| self.made_from(&domain, numbers));
        let written = |k: usize| precise[k].as_ref()?.decimal(digits);
        let text = |(k, value): (usize, Option<Rational>)| match value {
            Some(exact) => exact.to_string(),
            None => written(k).unwrap_or_else(|| f64::NAN.to_string()),
        };
        self.exact_from(numbers.to_vec()).into_iter().enumerate().map(text).collect()
    }
}

/// Returns the range of a drawn number.
pub fn extent(draw: &Draw) -> Extent {
    match draw {
        Draw::Within(range) => Extent::between(&range.low, &range.high),
        Draw::Of(Line::All, _) => Extent::ALL,
        Draw::Of(Line::Positive, _) => Extent::POSITIVE,
        // Each value is substituted before anything is proved.
        Draw::OneOf(_) => Extent::ALL,
        Draw::Sign => Extent::SIGN,
    }
}

/// Returns the distances of components determined by a level from the ends of their ranges.
fn ranges(case: &Case, solution: &Solution, made: &[Expr]) -> Vec<Expr> {
    let (parameters, state) = made.split_at(case.model.free_components());
    let recipes = case.model.parameter_draws();
    let of_state = solution.components().into_iter().map(|k| (state[k], &case.free_draws[k]));
    let of_parameters = solution.parameters().into_iter().filter_map(|k| {
        let draw = case.model.draw_of_component(k).and_then(|draw| recipes.get(draw))?;
        Some((parameters[k], draw))
    });
    let ends = of_state.chain(of_parameters).filter_map(|(value, draw)| match draw {
        Draw::Within(range) => {
            let [low, high] = [&range.low, &range.high].map(Expr::rational);
            Some([value - low, high - value])
        }
        _ => None,
    });
    ends.flatten().collect()
}

/// Makes parameters and state undefined where some values are negative: √x is undefined for x < 0.
fn guarded(made: &[Expr], facts: impl Iterator<Item = Expr>) -> Vec<Expr> {
    let mut guarded = made.to_vec();
    literally(|| {
        let zero = Expr::rational(&Rational::from(0));
        for fact in facts {
            if let Some(first) = guarded.last_mut() {
                *first += zero * fact.sqrt();
            }
        }
    });
    guarded
}

/// A source of blocks of balls with its working memory.
pub struct Maker<'s> {
    sampler: &'s Sampler,
    evaluator: Evaluator<'s, Ball<LANES>>,
}

impl Maker<'_> {
    /// Computes parameters and state of the states `start..start + LANES`.
    pub fn balls(&mut self, start: u64) -> Vec<Balls<LANES>> {
        self.made(start, None)
    }

    /// Computes states with few parameter sets: one set for every `LANES / sets` states.
    pub fn balls_sharing_parameters(&mut self, start: u64, sets: usize) -> Vec<Balls<LANES>> {
        self.made(start, Some(sets))
    }

    fn made(&mut self, start: u64, sets: Option<usize>) -> Vec<Balls<LANES>> {
        let sampler = self.sampler;
        let attempts = sampler.attempts(start, LANES, sets);
        let lanes: [Vec<(f64, bool)>; LANES] =
            std::array::from_fn(|lane| sampler.nearest(start + lane as u64, attempts[lane], sets));
        let column = |k: usize| Balls::about(|lane| lanes[lane][k]);
        let columns: Vec<Balls<LANES>> = (0..self.sampler.draws.len()).map(column).collect();
        self.evaluator.run(&columns);
        let mut values: Vec<Balls<LANES>> = self.evaluator.outputs().cloned().collect();
        if let Some(newton) = &self.sampler.newton {
            newton.project(&mut values);
        }
        values
    }
}
