//! States at a place: random draws, turned into parameters and a state inside the number domain.

use std::sync::Arc;

use crate::case::Case;
use crate::claim::Place;
use crate::graph::{Evaluator, Expr, Fault, Graph, Tape, record};
use crate::mechanics::{Chart, Draw, Draws, Line, Origin};
use crate::number::Domain;
use crate::number::ball::{Ball, Balls};
use crate::number::exact::Exact;
use crate::number::precise::Precise;
use crate::number::rational::Rational;
use crate::proof::{Extent, Fact, Group, Source, conditions};
use crate::scalar::Scalar;

use super::newton::Newton;
use super::{JudgeError, coverage};

/// What is granted beside the bits and digits of a printed state.
const SPARE_BITS: u32 = 64;
const SPARE_DIGITS: usize = 8;
/// States a run of a tape treats at once.
pub const LANES: usize = 64;

/// Makes the inputs of a case's tapes at one place.
#[derive(Clone)]
pub struct Sampler {
    seed: u64,
    draws: Draws,
    recipes: Vec<Draw>,
    /// From draws to parameters and state.
    graph: Arc<Graph>,
    made: Vec<Expr>,
    /// How many of the draws make the parameters.
    parameter_draws: usize,
    dimension: usize,
    tape: Tape,
    newton: Option<Newton>,
}

impl Sampler {
    /// A sampler of states at `place`.
    pub fn new(case: &Case, place: &Place, seed: u64) -> Result<Self, Fault> {
        let model = &case.model;
        let mut draws = model.parameter_draws();
        let parameter_draws = draws.len();
        draws.extend(case.chart.draws(&case.free_draws, &place.kept));
        let (graph, outputs) = record(draws.len(), |inputs| {
            let (mut values, state) = model.make_parameters(inputs);
            let point = case.chart.point(model, &place.kept, &values, state);
            values.extend(point);
            values
        })?;
        let some = place.kept.iter().any(|kept| *kept);
        let all = place.kept.iter().all(|kept| *kept);
        let newton = match &case.chart {
            Chart::Rolling | Chart::Sphere | Chart::Free => None,
            // A chart of the whole level knows nothing of its equations one by one.
            Chart::Given(_) | Chart::Solved(_) if all => None,
            _ => some.then(|| Newton::new(model, &place.kept)).transpose()?,
        };
        let tape = Tape::new(&graph, &outputs);
        let dimension = model.dimension();
        let (recipes, draws) = (draws.clone(), Draws::new(&draws));
        let made = outputs;
        let graph = Arc::new(graph);
        Ok(Self { seed, draws, recipes, graph, made, parameter_draws, dimension, tape, newton })
    }

    /// Are the states found numerically, with an estimated rather than a proved distance from the
    /// level?
    pub fn is_numerical(&self) -> bool {
        self.newton.is_some()
    }

    /// Parameters and state of the states `start..start + LANES`, as balls.
    pub fn balls(&self, start: u64) -> Vec<Balls<LANES>> {
        self.maker().balls(start)
    }

    /// What makes many blocks of balls.
    pub(super) fn maker(&self) -> Maker<'_> {
        Maker { sampler: self, evaluator: Evaluator::new(&self.tape, Ball::<LANES>) }
    }

    /// The same for `lanes` states in another domain; states found numerically are known in f64
    /// only.
    pub fn states<D: Domain + Clone>(&self, domain: &D, lanes: usize, start: u64) -> Vec<D::Block> {
        self.made_in(domain, &self.numbers(lanes, start))
    }

    /// The draws of `lanes` states in a domain.
    pub fn drawn<D: Domain>(&self, domain: &D, lanes: usize, start: u64) -> Vec<D::Block> {
        self.columns(domain, &self.numbers(lanes, start))
    }

    /// Parameters and one state made from given numbers in place of draws.
    pub fn made_from<D: Domain + Clone>(&self, domain: &D, numbers: &[Rational]) -> Vec<D::Block> {
        self.made_in(domain, &[numbers.to_vec()])
    }

    fn numbers(&self, lanes: usize, start: u64) -> Vec<Vec<Rational>> {
        (0..lanes).map(|lane| self.draws.state(self.seed, start + lane as u64)).collect()
    }

    /// Where each of the numbers that are drawn can be.
    pub fn extents(&self) -> Vec<Extent> {
        let extent = |draw: &Draw| match draw {
            Draw::Within(range) => Extent::between(&range.low, &range.high),
            Draw::Of(Line::All, _) => Extent::ALL,
            Draw::Of(Line::Positive, _) => Extent::POSITIVE,
            // Each value is put in before anything is proved.
            Draw::OneOf(_) => Extent::ALL,
        };
        self.recipes.iter().map(extent).collect()
    }

    /// Is a number drawn from a list of several?
    pub fn has_lists(&self) -> bool {
        self.recipes.iter().any(|draw| matches!(draw, Draw::OneOf(values) if values.len() > 1))
    }

    /// The same states with the listed numbers fixed.
    pub fn with(&self, fixed: &[Option<Rational>]) -> Self {
        let one = |(draw, fixed): (&Draw, &Option<Rational>)| match fixed {
            Some(value) => Draw::OneOf(vec![value.clone()]),
            None => draw.clone(),
        };
        let recipes: Vec<Draw> = self.recipes.iter().zip(fixed).map(one).collect();
        Self { draws: Draws::new(&recipes), recipes, ..self.clone() }
    }

    /// The parameters that are drawn from lists, with the values they have at every state.
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

    /// How each of the numbers is drawn.
    pub fn recipes(&self) -> &[Draw] {
        &self.recipes
    }

    /// Values of `graph`, which starts from parameters and states, as values of a graph that starts
    /// from draws, those in `fixed` replaced by constants.
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

    /// The same for groups of values with facts; what is known of the states beside comes with them.
    pub fn compose_groups(
        &self,
        graph: &Graph,
        groups: &[Group],
        fixed: &[Option<Rational>],
    ) -> Result<(Graph, Vec<Group>), Fault> {
        let own: Vec<(usize, Fact)> = {
            let reached = self.graph.reached(self.made.iter().copied());
            conditions(&self.graph, &reached)
        };
        let (composed, groups) = record(self.draws.len(), |draws| {
            let (inputs, made) = self.inputs_from(graph, draws, fixed)?;
            let own: Option<Vec<(Expr, Fact)>> =
                own.iter().map(|(place, fact)| Some((made[*place]?, *fact))).collect();
            let own = own?;
            let needed = groups.iter().flat_map(|group| {
                group.outputs.iter().copied().chain(group.facts.iter().map(|(value, _)| *value))
            });
            let reached = graph.reached(needed);
            let values = graph.replay(&reached, &inputs, |_, _, _| None);
            let at = |value: &Expr| values[graph.place(*value)];
            let group = |group: &Group| {
                let facts = group.facts.iter().map(|(value, fact)| Some((at(value)?, *fact)));
                let mut facts = facts.collect::<Option<Vec<(Expr, Fact)>>>()?;
                facts.extend(own.iter().copied());
                Some(Group { outputs: group.outputs.iter().map(at).collect::<Option<_>>()?, facts })
            };
            groups.iter().map(group).collect::<Option<Vec<Group>>>()
        })?;
        groups.map(|groups| (composed, groups)).ok_or(Fault::ForeignValue)
    }

    /// Parameters, states and further inputs of `graph` from draws, and all values on the way.
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

    /// What each of the draws is in a field.
    pub fn sources(&self) -> Vec<Source> {
        vec![Source::Uniform; self.recipes.len()]
    }

    /// Checks that a parametrisation typed by the user fills the level set.
    pub fn check_coverage(&self, case: &Case) -> Result<(), JudgeError> {
        let Chart::Given(_) = &case.chart else { return Ok(()) };
        let dimension = self.dimension.saturating_sub(case.model.level.len());
        let found = coverage::rank(case, &self.draws, self.parameter_draws, self.seed)?;
        if found < dimension {
            return Err(JudgeError::PartialChart { found, dimension });
        }
        Ok(())
    }

    /// States in another domain with few parameter sets: one for every `LANES / sets` states.
    pub fn states_sharing_parameters<D: Domain + Clone>(
        &self,
        domain: &D,
        start: u64,
        sets: usize,
    ) -> Vec<D::Block> {
        let numbers: Vec<Vec<Rational>> =
            (0..LANES).map(|lane| self.sharing(sets, lane, start, Draws::state)).collect();
        self.made_in(domain, &numbers)
    }

    /// The draws of a state with the parameters of its set.
    fn sharing<T: Clone>(
        &self,
        sets: usize,
        lane: usize,
        start: u64,
        state: impl Fn(&Draws, u64, u64) -> Vec<T>,
    ) -> Vec<T> {
        let set = lane * sets / LANES;
        let mut values = state(&self.draws, self.seed, set as u64);
        let own = state(&self.draws, self.seed, start + lane as u64);
        values[self.parameter_draws..].clone_from_slice(&own[self.parameter_draws..]);
        values
    }

    /// The draws of some states, a block each.
    fn columns<D: Domain>(&self, domain: &D, lanes: &[Vec<Rational>]) -> Vec<D::Block> {
        (0..self.draws.len())
            .map(|k| {
                let column: Vec<Rational> = lanes.iter().map(|lane| lane[k].clone()).collect();
                domain.values(&column)
            })
            .collect()
    }

    /// Parameters and states made from draws.
    fn made_in<D: Domain + Clone>(&self, domain: &D, lanes: &[Vec<Rational>]) -> Vec<D::Block> {
        let mut evaluator = Evaluator::new(&self.tape, domain.clone());
        evaluator.run(&self.columns(domain, lanes));
        evaluator.outputs().cloned().collect()
    }

    /// Parameters and state of one state, exact where they are rational.
    pub fn exact(&self, index: u64) -> Vec<Option<Rational>> {
        self.exact_from(self.draws.state(self.seed, index))
    }

    fn exact_from(&self, values: Vec<Rational>) -> Vec<Option<Rational>> {
        let mut evaluator = Evaluator::new(&self.tape, Exact);
        evaluator.run(&values.into_iter().map(Some).collect::<Vec<_>>());
        let state_begins = self.tape.outputs() - self.dimension;
        evaluator
            .outputs()
            .enumerate()
            .map(|(k, value)| value.clone().filter(|_| self.newton.is_none() || k < state_begins))
            .collect()
    }

    /// The same as text, for what is not rational so many digits that states of `bits` bits are
    /// told apart: with them a residual that was computed from as many bits is found again.
    pub fn printed(&self, index: u64, bits: u32) -> Vec<String> {
        if bits > f64::MANTISSA_DIGITS {
            return self.printed_from(&self.draws.state(self.seed, index), bits);
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

    /// A state made from given numbers as text, with digits for `bits` bits.
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

/// Makes blocks of balls, with memory of its own.
pub struct Maker<'s> {
    sampler: &'s Sampler,
    evaluator: Evaluator<'s, Ball<LANES>>,
}

impl Maker<'_> {
    /// Parameters and state of the states `start..start + LANES`.
    pub fn balls(&mut self, start: u64) -> Vec<Balls<LANES>> {
        let Sampler { draws, seed, .. } = self.sampler;
        self.made(|lane| draws.nearest(*seed, start + lane as u64))
    }

    /// The same with few parameter sets and many states: one set for every `LANES / sets` states.
    pub fn balls_sharing_parameters(&mut self, start: u64, sets: usize) -> Vec<Balls<LANES>> {
        let sampler = self.sampler;
        self.made(|lane| sampler.sharing(sets, lane, start, Draws::nearest))
    }

    fn made(&mut self, draws_of: impl Fn(usize) -> Vec<(f64, bool)>) -> Vec<Balls<LANES>> {
        let lanes: [Vec<(f64, bool)>; LANES] = std::array::from_fn(draws_of);
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
