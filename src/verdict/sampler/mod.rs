//! Sampling of states at a place: random draws, from which the number domain computes parameters
//! and a state.

mod attempts;
mod branches;
mod compose;
mod draw;
mod maker;
mod numerical;
mod place_parts;
mod print;
mod ranges;
mod unmet;
mod void_signs;

pub use branches::Branch;
pub use maker::Maker;
pub use place_parts::PlaceParts;
pub use ranges::{extent, inside};

use std::sync::{Arc, OnceLock};

use crate::case::Case;
use crate::claim::LevelSubset;
use crate::graph::{Expr, Fault, Graph, Tape, literally, record};
use crate::level::{self, Order, Part, Pivot, Solution};
use crate::mechanics::{Chart, Draw, DrawSource, Model, combinations};
use crate::number::ball::Balls;
use crate::number::rational::Rational;
use crate::proof::{Extent, InputDistribution};

use super::{JudgeError, coverage};

use attempts::KnownAttempts;
use numerical::NumericalLevel;
use ranges::{guarded, ranges};

/// Number of states in one run of a tape.
pub const TAPE_LANES: usize = 64;

/// A sampler of the inputs of a case's tapes at one place.
#[derive(Clone)]
pub struct Sampler {
    seed: u64,
    draws: DrawSource,
    recipes: Vec<Draw>,
    /// Parameters and state as functions of the draws.
    graph: Arc<Graph>,
    made: Vec<Expr>,
    /// Values that are not negative at a state: distances of solved components from the ends of
    /// their ranges, and sides of equations that were squared.
    facts: Vec<Expr>,
    /// Solution of the level, with the values that must not vanish, or a part of it is missed.
    solution: Option<Arc<Solution>>,
    pivots: Arc<[Pivot]>,
    /// Part of the place that is solved, unless it is the whole.
    branch: Option<Branch>,
    /// Number of draws for the parameters.
    parameter_draws: usize,
    dimension: usize,
    /// Whether each level equation holds at the states.
    kept: Vec<bool>,
    /// Tape for parameters and state, undefined where they are out of range.
    tape: Arc<Tape>,
    /// Tape for parameters and state wherever they exist.
    unguarded: Arc<Tape>,
    /// Whether some draws lead to no state.
    is_guarded: bool,
    /// Whether the states are made with moduli.
    has_moduli: bool,
    newton: Option<NumericalLevel>,
    /// Whether the states are a part of lower dimension than the place.
    is_thin: bool,
    /// First block of states, once it was asked for.
    first: Arc<OnceLock<Vec<Balls<TAPE_LANES>>>>,
    /// Attempts at states, once they were asked for.
    attempts: KnownAttempts,
}

impl Sampler {
    /// Makes a sampler of states at `place`.
    pub fn new(case: &Case, place: &LevelSubset, seed: u64) -> Result<Self, Fault> {
        Self::of_place(case, place, seed)?.without_void_signs(case)
    }

    fn of_place(case: &Case, place: &LevelSubset, seed: u64) -> Result<Self, Fault> {
        let (model, kept) = (&case.model, &place.kept);
        let some = kept.iter().any(|kept| *kept);
        let is_charted = match &case.chart {
            Chart::Rolling | Chart::Sphere | Chart::Free => true,
            // A chart of the whole level does not give its equations separately.
            Chart::Given(_) => kept.iter().all(|kept| *kept),
            Chart::Equations => false,
        };
        let solution = |order: Order| match is_charted || !some {
            true => None,
            false => level::solve(model, kept, order),
        };
        let whole = |order| Self::of_solution(case, None, place, seed, is_charted, solution(order));
        let sampler = whole(Order::Usual)?;
        // Small ranges of solved components are seldom met from random directions.
        let has_directions = sampler.solution().is_some_and(Solution::has_directions);
        if has_directions && !sampler.has_states() {
            let other = whole(Order::ByRoots)?;
            if other.solution.is_some() && other.has_states() {
                return Ok(other);
            }
        }
        let may_be_a_part =
            sampler.is_numerical() || sampler.solution.is_some() && !sampler.has_states();
        let part = match may_be_a_part {
            true => sampler.only_part(case)?,
            false => None,
        };
        if let Some(part) = part {
            return Ok(part);
        }
        // A factor that is nowhere 0 may have been solved for: (x³ − 3x + 1)(y² + 1) = 0.
        if sampler.solution.is_some() && !sampler.has_states() {
            let found = Self::of_solution(case, None, place, seed, is_charted, None)?;
            if found.has_states() {
                return Ok(found);
            }
        }
        Ok(sampler)
    }

    /// Makes a sampler of the only part of a place that may contain states, as |x| + |y| = 1 has one for
    /// x, y > 0; `None` where there are several, or the place cannot be divided.
    fn only_part(&self, case: &Case) -> Result<Option<Self>, Fault> {
        let cover = PlaceParts::of(case, self)?;
        let Some(choices) = combinations(&cover.draws) else { return Ok(None) };
        let [fixed] = &choices[..] else { return Ok(None) };
        let Some(parts) = cover.divided(fixed)? else { return Ok(None) };
        match &parts[..] {
            [part] if part.is_whole => {
                let own = self.on_part(&case.model, part, cover.recipes(fixed))?;
                Ok(own.has_states().then_some(own))
            }
            _ => Ok(None),
        }
    }

    /// Makes a sampler of the states that a solution of the level makes, if there is one.
    fn of_solution(
        case: &Case,
        branch: Option<Branch>,
        place: &LevelSubset,
        seed: u64,
        is_charted: bool,
        solution: Option<Solution>,
    ) -> Result<Self, Fault> {
        let kept = &place.kept;
        let model = branch.as_ref().map_or(&case.model, |branch| &branch.model);
        let some = kept.iter().any(|kept| *kept);
        let newton = (some && !is_charted && solution.is_none())
            .then(|| NumericalLevel::new(case, kept))
            .transpose()?;
        let mut draws = model.parameter_draws();
        let parameter_draws = draws.len();
        draws.extend(match &solution {
            Some(solution) => solution.draws(&case.free_draws),
            None => case.chart.draws(&case.free_draws, kept),
        });
        let (graph, (made, guarded, facts, pivots)) = record(draws.len(), |inputs| {
            let (parameters, state) = model.make_parameters(inputs);
            let Some(solution) = &solution else {
                let mut made = parameters;
                let point = literally(|| case.chart.point(model, kept, &made, state));
                made.extend(point);
                return (made.clone(), made, Vec::new(), Vec::new());
            };
            let solved = solution.point(model, parameters, state);
            let bounds = ranges(case, solution, &solved.made);
            let point = &solved.made[model.free_components()..];
            let chosen = level::signs(model, kept, point, &solution.halves());
            let facts = solved.facts.iter().map(|(value, _)| *value);
            let facts: Vec<Expr> = facts.chain(bounds).chain(chosen).collect();
            let guarded = guarded(&solved.made, facts.iter().copied());
            (solved.made, guarded, facts, solved.pivots)
        })?;
        let (tape, unguarded) =
            (Tape::new(&graph, &guarded).into(), Tape::new(&graph, &made).into());
        let is_guarded = solution.is_some();
        let has_moduli = level::has_moduli(&graph, &guarded);
        let dimension = model.dimension();
        let (recipes, draws) = (draws.clone(), DrawSource::new(&draws));
        let (graph, pivots) = (Arc::new(graph), pivots.into());
        let solution = solution.map(Arc::new);
        let sampler = Self {
            seed,
            draws,
            recipes,
            graph,
            made: guarded,
            facts,
            solution,
            pivots,
            branch,
            parameter_draws,
            dimension,
            kept: kept.clone(),
            tape,
            unguarded,
            is_guarded,
            has_moduli,
            newton,
            is_thin: false,
            first: Arc::default(),
            attempts: KnownAttempts::default(),
        };
        Ok(match sampler.is_guarded && !sampler.has_states() {
            true => sampler.narrowed(),
            false => sampler,
        })
    }

    /// Whether some state of the first block is known.
    pub fn has_states(&self) -> bool {
        let states = self.balls(0);
        (0..TAPE_LANES).any(|lane| states.iter().all(|block| block.is_defined(lane)))
    }

    /// Makes a sampler of the states on a part of the same place, with their own distributions.
    pub fn on_part(&self, model: &Model, part: &Part, recipes: Vec<Draw>) -> Result<Self, Fault> {
        let (graph, made) = record(part.graph.inputs(), |inputs| {
            let all: Vec<Expr> = part.made.iter().chain(&part.facts).copied().collect();
            let reached = part.graph.reached(all.iter().copied());
            let values = part.graph.repeated(&reached, inputs);
            let at = |value: &Expr| values[part.graph.place(*value)];
            let mut made = all.iter().map(at).collect::<Option<Vec<Expr>>>()?;
            let mut facts = made.split_off(part.made.len());
            facts.extend(level::signs(model, &self.kept, &made[model.free_components()..], &[]));
            let guarded = guarded(&made, facts.iter().copied());
            Some((made, facts, guarded))
        })?;
        let (made, facts, guarded) = made.ok_or(Fault::ForeignValue)?;
        Ok(Self {
            seed: self.seed,
            draws: DrawSource::new(&recipes),
            recipes,
            tape: Tape::new(&graph, &guarded).into(),
            unguarded: Tape::new(&graph, &made).into(),
            is_guarded: true,
            has_moduli: level::has_moduli(&graph, &guarded),
            graph: Arc::new(graph),
            made: guarded,
            facts,
            solution: None,
            pivots: Arc::new([]),
            branch: None,
            parameter_draws: self.parameter_draws,
            dimension: self.dimension,
            kept: self.kept.clone(),
            newton: None,
            is_thin: part.is_thin,
            first: Arc::default(),
            attempts: KnownAttempts::default(),
        }
        .narrowed())
    }

    /// Whether the states are a part of lower dimension than the place.
    pub fn is_thin(&self) -> bool {
        self.is_thin
    }

    /// Whether the draws are the components of the state, so that every state of the place is drawn; a
    /// chart, or a solution of the level, may miss some.
    pub fn misses_nothing(&self, case: &Case) -> bool {
        let is_charted = match case.chart {
            Chart::Rolling | Chart::Sphere => true,
            Chart::Free => false,
            Chart::Given(_) | Chart::Equations => self.kept.contains(&true),
        };
        !is_charted && !self.is_part()
    }

    /// Whether the states are one part of the place, made by formulas of its own.
    pub fn is_part(&self) -> bool {
        self.branch.is_some() || self.is_guarded && self.solution.is_none()
    }

    /// Whether some draws may lead to no state.
    pub fn is_guarded(&self) -> bool {
        self.is_guarded
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
        if fixed.iter().all(Option::is_none) {
            return self.clone();
        }
        let pairs = self.recipes.iter().zip(fixed);
        let recipes: Vec<Draw> = pairs.map(|(draw, fixed)| draw.fixed(fixed.as_ref())).collect();
        let (draws, first) = (DrawSource::new(&recipes), Arc::default());
        let attempts = KnownAttempts::default();
        Self { draws, recipes, first, attempts, ..self.clone() }
    }

    /// Returns the distribution of each number.
    pub fn recipes(&self) -> &[Draw] {
        &self.recipes
    }

    /// Returns the graph from draws to parameters and states.
    pub fn graph(&self) -> &Graph {
        &self.graph
    }

    /// Returns the values that must not vanish at a state, or a part of the place is missed.
    pub fn pivots(&self) -> &[Pivot] {
        &self.pivots
    }

    /// Returns the part of the place that is solved, unless it is the whole.
    pub fn branch(&self) -> Option<&Branch> {
        self.branch.as_ref()
    }

    /// Returns the solution of the level, if there is one.
    pub fn solution(&self) -> Option<&Solution> {
        self.solution.as_deref()
    }

    /// Returns parameters and state, as values of [`Self::graph`].
    pub fn made(&self) -> &[Expr] {
        &self.made
    }

    /// Number of draws for the parameters.
    pub fn parameter_draws(&self) -> usize {
        self.parameter_draws
    }

    /// Returns the distribution of each draw in a field.
    pub fn sources(&self) -> Vec<InputDistribution> {
        let source = |draw: &Draw| match draw {
            Draw::Sign => InputDistribution::Sign,
            _ => InputDistribution::Uniform,
        };
        self.recipes.iter().map(source).collect()
    }

    /// Checks that a parametrisation given by the user fills the level set, for each choice of listed values
    /// for which it has a value.
    pub fn check_coverage(&self, case: &Case) -> Result<(), JudgeError> {
        let Chart::Given(_) = &case.chart else { return Ok(()) };
        let dimension = self.dimension.saturating_sub(case.model.level.len());
        let choices = combinations(&self.recipes);
        let mut is_seen = false;
        for fixed in choices.unwrap_or_else(|| vec![vec![None; self.recipes.len()]]) {
            let chosen = self.with(&fixed);
            let rank = coverage::rank(case, &chosen.draws, self.parameter_draws, self.seed)?;
            is_seen |= rank.is_some();
            if let Some(found) = rank.filter(|found| *found < dimension) {
                let listed = match self.has_lists() {
                    true => format!(", for {}", chosen.listed(case, |_| true)),
                    false => String::new(),
                };
                return Err(JudgeError::PartialChart { found, dimension, listed });
            }
        }
        match is_seen {
            true => Ok(()),
            false => Err(JudgeError::PartialChart { found: 0, dimension, listed: String::new() }),
        }
    }
}
