//! Starts of motions through a surface: whole states, values of its axes, or drawn.

use num_dual::Dual;

use crate::error::FlowError;
use crate::motion::columns::Columns;
use crate::motion::conserved::{Conserved, Fixed};
use crate::motion::recorded::point;
use crate::motion::start::{LevelFunctions, Start, drawn};
use crate::section::surface::CrossingSurface;
use liouville::case::{Case, Direction};
use liouville::graph::{Evaluator, Expr, Tape, record};
use liouville::mechanics::{Model, Phase};
use liouville::number::double_double::{DoubleDouble, DoubleDoubles};
use liouville::number::rational::Rational;
use liouville::scalar::Scalar;

/// Number of drawn states from which Newton's method is tried.
const TRIES: u64 = 64;
/// Distance from a zero, relative to the state, at which a condition holds.
const HOLDS: f64 = 1e-14;

/// Beginning of a motion, as a user gives it.
#[derive(Clone, Debug, PartialEq)]
pub enum Begin {
    /// Components of the state, moved to the level.
    State(Vec<Rational>),
    /// State drawn at this index, moved to the level.
    Drawn(u64),
    /// Point of the surface with these values of its axes.
    Axes(Vec<Rational>),
}

/// Surface on which motions may start, with the axes whose values place them there.
#[derive(Clone, Copy)]
pub struct Launchpad<'l> {
    /// Surface.
    pub surface: &'l CrossingSurface,
    /// Axes.
    pub axes: &'l Columns,
    /// Direction in which the motion is to cross the surface.
    pub direction: Direction,
}

/// Starts of a case: on its level, and with the given values of functions that motions keep.
pub struct Launches<'l> {
    /// Case whose motions start.
    pub case: &'l Case,
    /// Functions whose values all starts share; by default each start has those of its state.
    pub fixed: &'l [Fixed],
    /// Surface for starts by the values of axes.
    pub pad: Option<Launchpad<'l>>,
    /// Seed of the drawn states, and of the free parameters.
    pub seed: u64,
    /// Index of the free parameters among the draws.
    pub index: u64,
}

/// Point over which gradients are recorded.
type Lifted<'m> = Phase<'m, Dual<Expr>>;

impl Launches<'_> {
    /// Returns the start of a motion.
    pub fn start(&self, begin: &Begin) -> Result<Start, FlowError> {
        let parameters = drawn(self.case, self.seed, self.index)?.0;
        let state = match begin {
            Begin::State(state) => state.clone(),
            Begin::Drawn(index) => drawn(self.case, self.seed, *index)?.1,
            Begin::Axes(at) => {
                let pad = self.pad.ok_or(FlowError::NoStart)?;
                return self.on_surface(&pad, parameters, at);
            }
        };
        let model = &self.case.model;
        if self.fixed.is_empty() {
            let state = state.iter().map(DoubleDouble::from_rational).collect();
            return Start::near(model, parameters, state);
        }
        let conditions = self.conditions(model, &parameters, &|_| Vec::new())?;
        moved(&conditions, parameters, &state).map_err(|error| self.out_of_reach(error))
    }

    /// The error for a start that is not found, with the values that there are if one is wanted.
    fn out_of_reach(&self, error: FlowError) -> FlowError {
        const DRAWN: u64 = 64;
        if error != FlowError::NoStart {
            return error;
        }
        let range = |fixed: &Fixed| {
            let own = |index| {
                let (parameters, state) = drawn(self.case, self.seed, index).ok()?;
                fixed.at(&self.case.model, &parameters, &state)
            };
            let all: Vec<f64> = (0..DRAWN).filter_map(own).collect();
            let (low, high) =
                (all.iter().copied().reduce(f64::min), all.iter().copied().reduce(f64::max));
            Some([low?, high?])
        };
        let ranges: Vec<(usize, f64, f64)> = (0..self.fixed.len())
            .filter_map(|place| range(&self.fixed[place]).map(|[low, high]| (place, low, high)))
            .collect();
        let is_outside = |(place, low, high): &&(usize, f64, f64)| {
            !(*low..=*high).contains(&self.fixed[*place].value.to_f64().0)
        };
        let found = ranges.iter().find(is_outside).or(ranges.first());
        match found.map(|(place, low, high)| (&self.fixed[*place], low, high)) {
            Some((fixed, low, high)) => FlowError::NoValueState {
                name: fixed.function.name().to_string(),
                value: fixed.value.to_string(),
                low: format!("{low:.4}"),
                high: format!("{high:.4}"),
            },
            None => error,
        }
    }

    /// Returns the starts of many motions from states.
    pub(crate) fn starts(
        &self,
        states: Vec<Vec<Rational>>,
    ) -> Result<Vec<Result<Start, FlowError>>, FlowError> {
        let parameters = drawn(self.case, self.seed, self.index)?.0;
        let conditions = self.conditions(&self.case.model, &parameters, &|_| Vec::new())?;
        let start = |state: Vec<Rational>| {
            moved(&conditions, parameters.clone(), &state).map_err(|error| self.out_of_reach(error))
        };
        Ok(states.into_iter().map(start).collect())
    }

    /// Records the level, the functions with given values, and further functions that vanish.
    fn conditions(
        &self,
        model: &Model,
        parameters: &[Rational],
        further: &dyn Fn(&Lifted<'_>) -> Vec<Dual<Expr>>,
    ) -> Result<LevelFunctions, FlowError> {
        let is_energy = |own: &Fixed| matches!(own.function, Conserved::Energy);
        if self.fixed.iter().any(is_energy) && !model.system.has_energy() {
            return Err(FlowError::NoEnergy);
        }
        LevelFunctions::with(model, parameters, &|phase| {
            let own = self.fixed.iter().filter_map(|fixed| {
                Some(fixed.function.value(phase)? - Dual::rational(&fixed.value))
            });
            let mut all: Vec<_> = own.collect();
            all.extend(further(phase));
            all
        })
    }

    /// Finds a state with these values of the axes, from drawn ones by Newton's method.
    fn on_surface(
        &self,
        pad: &Launchpad<'_>,
        parameters: Vec<Rational>,
        at: &[Rational],
    ) -> Result<Start, FlowError> {
        let model = pad.surface.model();
        let (graph, rate) =
            record(model.dimension(), |state| pad.surface.rate(&point(model, &parameters, state)))?;
        let rate = Tape::new(&graph, &[rate]);
        let conditions = self.conditions(model, &parameters, &|phase| {
            let values = pad.axes.values(phase).into_iter().zip(at);
            let mut all = vec![pad.surface.value(phase)];
            all.extend(values.map(|(value, at)| value - Dual::rational(at)));
            all
        })?;
        for index in 0..TRIES {
            let state = drawn(self.case, self.seed, index)?.1;
            let Ok(start) = moved(&conditions, parameters.clone(), &state) else { continue };
            let mut evaluator = Evaluator::new(&rate, DoubleDoubles);
            evaluator.run(&start.state);
            let rate = evaluator.output(0).hi;
            let fits = match pad.direction {
                Direction::Both => true,
                Direction::Up => rate > 0.0,
                Direction::Down => rate < 0.0,
            };
            if fits {
                return Ok(start);
            }
        }
        let values: Vec<String> = at.iter().map(|x| x.to_f64().0.to_string()).collect();
        let (names, values) = (pad.axes.titles().join(", "), values.join(", "));
        Err(FlowError::NoPoint(format!("({names}) = ({values})")))
    }
}

/// Moves a state to where the conditions hold.
fn moved(
    conditions: &LevelFunctions,
    parameters: Vec<Rational>,
    state: &[Rational],
) -> Result<Start, FlowError> {
    let mut state: Vec<DoubleDouble> = state.iter().map(DoubleDouble::from_rational).collect();
    let moved = conditions.correct(&mut state, &[])?;
    // Where conditions contradict each other the steps may shrink elsewhere than at a zero.
    let norm = |parts: &[DoubleDouble]| parts.iter().map(|x| x.hi * x.hi).sum::<f64>().sqrt();
    let size = norm(&state).max(1.0);
    let (values, gradients) = conditions.at(&state);
    let holds = |(value, gradient): (&DoubleDouble, &Vec<DoubleDouble>)| {
        value.hi.abs() <= HOLDS * size * norm(gradient)
    };
    match values.iter().zip(&gradients).all(holds) {
        true => Ok(Start { parameters, state, moved }),
        false => Err(FlowError::NoStart),
    }
}
