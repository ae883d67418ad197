//! Orbits of a map: its iterates, the drift of what should be constant, and samples.
//!
//! ```text
//! case, start ─ record ─▶ images as written, and what must exist ─ tape ─▶ x, Φ(x), Φ(Φ(x)), …
//! ```

use crate::error::FlowError;
use crate::halt::Halt;
use crate::motion::columns::Columns;
use crate::motion::orbit::{Followed, MEASUREMENTS, Precision, Watch};
use crate::motion::recorded::point;
use crate::motion::start::Start;
use crate::taylor::batch::each;
use crate::taylor::number::SeriesNumber;
use crate::taylor::program::TaylorProgram;
use crate::taylor::saturating::{Saturating, area};
use crate::taylor::values::PlainValues;
use crate::taylor::watch::Domain;
use crate::told::ToldShare;
use liouville::case::Case;
use liouville::graph::{Evaluator, Expr, Graph, Tape, record};
use liouville::mechanics::Model;
use liouville::number::double_double::{DoubleDouble, DoubleDoubles};
use liouville::number::float::Float;

/// Number of iterates between two reports of progress.
const TOLD_EVERY: u64 = 4096;

/// Size of a state from which on an orbit counts as one that escapes where its image is no number; only
/// words depend on it.
const FAR: f64 = 1e10;

/// An orbit of a map.
#[derive(Clone, Debug)]
pub struct MapOrbit {
    /// Initial state.
    pub start: Start,
    /// Number of iterates.
    pub iterates: u64,
    /// Last iterate.
    pub end: Vec<DoubleDouble>,
    /// Quantities followed along the orbit.
    pub followed: Vec<Followed>,
}

/// Reason why an orbit of a map cannot be computed, or ends early.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum IterateError {
    /// The start, or a formula, is at fault.
    #[error("{0}")]
    Start(#[from] FlowError),
    /// An image has no value.
    #[error("`{formula}` has no value after {}, at {place}", counted(*iterates))]
    NoValue {
        /// Formula as written.
        formula: String,
        /// Number of iterates that were found.
        iterates: u64,
        /// The last state, in words.
        place: String,
    },
    /// The map has no derivative at a state, as |x| has none at 0.
    #[error("the map has no derivative after {}, at {place}", counted(*iterates))]
    NoDerivative {
        /// Number of iterates that were found.
        iterates: u64,
        /// The last state, in words.
        place: String,
    },
    /// The derivative of the map takes a tangent vector to 0.
    #[error("det DΦ is 0 after {}, at {place}: an exponent is −∞ from there on", counted(*iterates))]
    Degenerate {
        /// Number of iterates that were found.
        iterates: u64,
        /// The last state, in words.
        place: String,
    },
    /// The orbit was stopped from outside.
    #[error("stopped after {}, at {place}", counted(*iterates))]
    Stopped {
        /// Number of iterates that were found.
        iterates: u64,
        /// The last state, in words.
        place: String,
    },
    /// A number on the way to an image is beyond the range of f64, and the orbit is not.
    #[error("a number of the map is too large or too small for f64 after {}, at {place}", counted(*iterates))]
    OutOfRange {
        /// Number of iterates that were found.
        iterates: u64,
        /// The last state, in words.
        place: String,
    },
    /// The orbit goes beyond the range of f64.
    #[error("the orbit escapes: after {}, at {place}, the next is too large for f64", counted(*iterates))]
    Escapes {
        /// Number of iterates that were found.
        iterates: u64,
        /// The last state, in words.
        place: String,
    },
}

impl IterateError {
    /// Advice on how to avoid the error.
    pub fn help(&self) -> &'static str {
        match self {
            IterateError::Start(error) => error.help(),
            IterateError::NoValue { iterates: 0, .. } => {
                "choose another start, or other parameters"
            }
            IterateError::Degenerate { .. } => {
                "leave out what the map takes to one value, or choose other parameters"
            }
            IterateError::NoDerivative { .. }
            | IterateError::NoValue { .. }
            | IterateError::OutOfRange { .. }
            | IterateError::Escapes { .. }
            | IterateError::Stopped { .. } => "choose another start, or fewer --iterates",
        }
    }
}

fn counted(iterates: u64) -> String {
    format!("{iterates} iterate{}", if iterates == 1 { "" } else { "s" })
}

/// Columns of samples, and the number of iterates from one to the next.
pub struct MapSampling<'s> {
    /// Columns of each row.
    pub columns: &'s Columns,
    /// Every how many iterates a sample is taken, 1 or more.
    pub every: u64,
}

/// An orbit with its samples.
pub struct SampledMapOrbit {
    /// Orbit as a whole, or the reason why it ended early or did not start.
    pub orbit: Result<MapOrbit, IterateError>,
    /// Rows of samples, up to the end or to where the orbit ended early.
    pub rows: Vec<Vec<DoubleDouble>>,
}

/// Iterates a map from several starts, each with samples if these are requested. Calls `progress` with
/// shares of an orbit as they are done.
pub fn iterates(
    case: &Case,
    starts: &[Result<Start, FlowError>],
    (count, precision): (u64, Precision),
    sampling: Option<&MapSampling<'_>>,
    threads: usize,
    progress: &(dyn Fn(f64) + Sync),
) -> Vec<SampledMapOrbit> {
    each(starts.len(), threads, &|index| {
        let mut told = ToldShare::default();
        let mut rows = Vec::new();
        let mut reach = |share| told.reach(share, progress);
        let orbit = match &starts[index] {
            Ok(start) => one(case, start, (count, precision), sampling, (&mut rows, &mut reach)),
            Err(problem) => Err(problem.clone().into()),
        };
        told.finish(progress);
        SampledMapOrbit { orbit, rows }
    })
}

fn one(
    case: &Case,
    start: &Start,
    (count, precision): (u64, Precision),
    sampling: Option<&MapSampling<'_>>,
    (rows, reach): (&mut Vec<Vec<DoubleDouble>>, &mut dyn FnMut(f64)),
) -> Result<MapOrbit, IterateError> {
    let map = RecordedMap::new(&case.model, start)?;
    let mut watch = Watch::new(case, start)?;
    let gauge = sampling.map(|own| own.columns.recorded(&start.parameters)).transpose()?;
    let mut row = gauge.as_ref().map(|gauge| gauge.rows());
    let every = sampling.map_or(1, |own| own.every.max(1));
    let mut next = map.stepper(precision);
    let mut state = start.state.clone();
    let halt = Halt::current();
    let mut measured = 0;
    for index in 0..=count {
        if let Some(row) = row.as_mut().filter(|_| index % every == 0) {
            rows.push(row(DoubleDouble::from_f64(index as f64), &state));
        }
        let passed = index as f64 / count.max(1) as f64 * f64::from(MEASUREMENTS);
        if passed >= f64::from(measured) || index == count {
            measured = passed as u32 + 1;
            watch.measure(&state);
        }
        if index % TOLD_EVERY == 0 {
            reach(index as f64 / count.max(1) as f64);
            if halt.is_raised() && index < count {
                return Err(map.stopped(index, &state));
            }
        }
        if index < count {
            state = next(&state).map_err(|fault| map.problem(&fault, index, &state))?;
        }
    }
    Ok(MapOrbit { start: start.clone(), iterates: count, end: state, followed: watch.followed })
}

/// Reason why a state has no image.
pub(super) enum Fault {
    /// The formula with this index has no value.
    Formula(usize),
    /// The map has an image, and no derivative.
    Derivative,
    /// A component of the image is infinite.
    Escapes,
    /// A component of the image is no number.
    OutOfRange,
}

/// Function from a state to its image.
pub(super) type Next<'m> = Box<dyn FnMut(&[DoubleDouble]) -> Result<Vec<DoubleDouble>, Fault> + 'm>;

/// A map with fixed parameters on a tape: its images, and the arguments of operations as written that
/// do not exist everywhere.
pub(super) struct RecordedMap {
    tape: Tape,
    /// The same with rules for moduli, extremes and functions that tend to constants, if it has any.
    rules: Option<TaylorProgram>,
    /// Number of components of the state and of the tangent vectors.
    components: usize,
    names: Vec<String>,
    formulas: Vec<String>,
    /// Domain of each argument, with the index of its formula.
    guards: Vec<(Domain, usize)>,
}

impl RecordedMap {
    fn new(model: &Model, start: &Start) -> Result<Self, FlowError> {
        Self::with_vectors(model, start, 0)
    }

    /// Records a map and its derivative along so many vectors.
    pub(super) fn with_vectors(
        model: &Model,
        start: &Start,
        vectors: usize,
    ) -> Result<Self, FlowError> {
        let dimension = model.dimension();
        let components = dimension * (1 + vectors);
        let own = model.equations_of_motion();
        let all: Vec<_> = model.parameter_formulas_of(&own).into_iter().chain(own).collect();
        let (graph, (images, written)) = record(components, |inputs| {
            let (state, vectors) = inputs.split_at(dimension);
            let phase = point(model, &start.parameters, state);
            let written: Vec<Vec<Expr>> =
                all.iter().map(|formula| phase.literal_values([*formula])).collect();
            let mut images = phase.field().to_vec();
            for vector in vectors.chunks(dimension.max(1)) {
                images.extend(phase.lift(vector).field().iter().map(|image| image.eps));
            }
            (images, written)
        })?;
        if graph.inputs() > components {
            return Err(FlowError::Antiderivative);
        }
        let (guards, arguments) = guards(&graph, images.split_at(dimension), &written);
        let rules = TaylorProgram::compile(&graph, &images, &arguments).ok();
        Ok(Self {
            rules: rules.filter(TaylorProgram::has_own_rules),
            tape: Tape::new(&graph, &[images, arguments].concat()),
            components,
            names: (0..dimension).map(|k| model.component_name(k)).collect(),
            formulas: all.iter().map(|formula| formula.text().trim().to_string()).collect(),
            guards,
        })
    }

    pub(super) fn stepper(&self, precision: Precision) -> Next<'_> {
        match (precision, &self.rules) {
            (Precision::Float, Some(rules)) => self.by_rules::<f64>(rules),
            (Precision::Pair, Some(rules)) => self.by_rules::<DoubleDouble>(rules),
            (Precision::Float, None) => {
                let mut evaluator = Evaluator::new(&self.tape, Float::<1>);
                Box::new(move |state| {
                    evaluator.run(&state.iter().map(|x| [x.hi]).collect::<Vec<_>>());
                    self.checked(evaluator.outputs().map(|x| DoubleDouble::from_f64(x[0])))
                })
            }
            (Precision::Pair, None) => {
                let mut evaluator = Evaluator::new(&self.tape, DoubleDoubles);
                Box::new(move |state| {
                    evaluator.run(state);
                    self.checked(evaluator.outputs().copied())
                })
            }
        }
    }

    fn by_rules<T: SeriesNumber<One = T> + 'static>(&self, rules: &TaylorProgram) -> Next<'_> {
        let mut values = PlainValues::<T>::new(rules);
        Box::new(move |state| {
            values.run(&state.iter().map(|x| T::split(*x).0).collect::<Vec<_>>());
            self.checked(values.rates().chain(values.outputs()).map(|x| x.pair()))
        })
    }

    /// The image among the values of the tape, if it exists.
    fn checked(
        &self,
        values: impl Iterator<Item = DoubleDouble>,
    ) -> Result<Vec<DoubleDouble>, Fault> {
        let mut image: Vec<DoubleDouble> = values.collect();
        let arguments = image.split_off(self.components);
        let broken = self.guards.iter().zip(&arguments).find(|((domain, _), argument)| {
            argument.hi.is_finite() && !domain.contains(argument.hi)
        });
        match broken {
            Some(((_, formula), _)) if *formula >= self.formulas.len() => Err(Fault::Derivative),
            Some(((_, formula), _)) => Err(Fault::Formula(*formula)),
            None if image.iter().all(|x| x.is_finite()) => Ok(image),
            None if image.iter().any(|x| x.hi.is_infinite()) => Err(Fault::Escapes),
            None => Err(Fault::OutOfRange),
        }
    }

    /// A state in words.
    fn place(&self, state: &[DoubleDouble]) -> String {
        // −0 + 0 is 0.
        let parts =
            self.names.iter().zip(state).map(|(name, x)| format!("{name} = {:?}", x.hi + 0.0));
        parts.collect::<Vec<_>>().join(", ")
    }

    /// End of an orbit at whose state a tangent vector goes to 0.
    pub(super) fn degenerate(&self, iterates: u64, state: &[DoubleDouble]) -> IterateError {
        IterateError::Degenerate { iterates, place: self.place(state) }
    }

    /// End of an orbit that is stopped from outside.
    pub(super) fn stopped(&self, iterates: u64, state: &[DoubleDouble]) -> IterateError {
        IterateError::Stopped { iterates, place: self.place(state) }
    }

    pub(super) fn problem(
        &self,
        fault: &Fault,
        iterates: u64,
        state: &[DoubleDouble],
    ) -> IterateError {
        let place = self.place(state);
        match fault {
            Fault::Formula(index) => {
                let formula = self.formulas.get(*index).cloned().unwrap_or_default();
                IterateError::NoValue { formula, iterates, place }
            }
            Fault::Derivative => IterateError::NoDerivative { iterates, place },
            Fault::Escapes => IterateError::Escapes { iterates, place },
            Fault::OutOfRange if state.iter().any(|x| x.hi.abs() >= FAR) => {
                IterateError::Escapes { iterates, place }
            }
            Fault::OutOfRange => IterateError::OutOfRange { iterates, place },
        }
    }
}

/// Domains of all operations that do not exist everywhere, with their formulas and their arguments.
fn guards(
    graph: &Graph,
    (images, slopes): (&[Expr], &[Expr]),
    written: &[Vec<Expr>],
) -> (Vec<(Domain, usize)>, Vec<Expr>) {
    let (mut guards, mut arguments) = (Vec::new(), Vec::new());
    let mut seen = vec![false; graph.len()];
    let in_images = graph.reached(images.iter().copied());
    let sources = written.iter().map(|own| graph.reached(own.iter().copied()));
    let in_slopes = graph.reached(slopes.iter().copied());
    let last = written.len().saturating_sub(1);
    let named = (0..written.len()).chain([last, written.len()]);
    // What the images contain and no formula counts with the last one; slopes come after all formulas.
    for (formula, reached) in named.zip(sources.chain([in_images, in_slopes])) {
        for place in (0..graph.len()).filter(|place| reached[*place]) {
            if std::mem::replace(&mut seen[place], true) {
                continue;
            }
            // The argument of the logarithm asinh u is positive, though rounding may make it 0.
            let is_area = matches!(area(graph, place), Some((Saturating::Asinh, _)));
            if let Some((domain, argument)) = Domain::of(graph.step(place)).filter(|_| !is_area) {
                guards.push((domain, formula));
                arguments.push(graph.at(argument));
            }
        }
    }
    (guards, arguments)
}
