//! A single motion from start to end, and the drift of quantities that should be constant.

use crate::error::FlowError;
use crate::motion::kept::has_other_energy;
use crate::motion::one_sided::{ContactEvent, follow};
use crate::motion::recorded::{point, program};
use crate::motion::samples::Samples;
use crate::motion::start::{LevelFunctions, Start};
use crate::taylor::number::SeriesNumber;
use crate::taylor::stepper::{Accuracy, MotionPiece, Stepper};
use liouville::case::{Case, Expect};
use liouville::claim::ClaimKind;
use liouville::formula::Formula;
use liouville::graph::{Evaluator, Expr, Tape, record};
use liouville::mechanics::{LevelFunction, Model, Phase};
use liouville::number::double_double::{DoubleDouble, DoubleDoubles};
use liouville::number::float::Float;
use liouville::number::rational::Rational;
use liouville::scalar::Scalar;

/// Number of times at which the drift is measured.
pub(crate) const MEASUREMENTS: u32 = 256;

/// Arithmetic in which a motion is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    /// f64 with compensated sums.
    Float,
    /// Double-double: about 32 digits.
    Pair,
}

/// Role of a followed quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum QuantityRole {
    /// A function that defines the level set.
    Level,
    /// The energy.
    Energy,
    /// An integral that is claimed.
    Integral,
    /// A formula that is not an integral and has to drift.
    Decoy,
}

/// A function of the state along a motion.
#[derive(Clone, Debug)]
pub struct Followed {
    /// Name of the quantity.
    pub name: String,
    /// Role of the quantity.
    pub role: QuantityRole,
    /// Components at the start.
    pub value: Vec<DoubleDouble>,
    /// Largest |F(t) - F(0)|/|F(0)| at the times sampled; |F(t) - F(0)| where f64 cannot
    /// distinguish F(0) from 0.
    pub drift: f64,
    /// The same quotient at the end.
    pub drift_at_end: f64,
    /// Divisor of the drift.
    scale: f64,
}

/// A computed motion.
#[derive(Clone, Debug)]
pub struct Orbit {
    /// Initial state.
    pub start: Start,
    /// Duration.
    pub time: DoubleDouble,
    /// Final state.
    pub end: Vec<DoubleDouble>,
    /// Number of steps taken.
    pub steps: u64,
    /// Order of the series.
    pub order: usize,
    /// Quantities followed along the motion.
    pub followed: Vec<Followed>,
    /// Events at a one-sided constraint.
    pub events: Vec<ContactEvent>,
}

/// Follows a motion of a case for some time, backwards if it is negative.
pub fn orbit(
    case: &Case,
    start: Start,
    time: DoubleDouble,
    precision: Precision,
) -> Result<Orbit, FlowError> {
    let mut nothing = Samples::nothing();
    sampled(case, start, time, precision, (&mut nothing, &mut |_| ()))
}

/// Follows a motion, takes samples of it, and tells the share that is done. Where it ends early, the
/// samples up to there are kept.
pub(crate) fn sampled(
    case: &Case,
    start: Start,
    time: DoubleDouble,
    precision: Precision,
    seen: (&mut Samples<'_>, &mut dyn FnMut(f64)),
) -> Result<Orbit, FlowError> {
    match precision {
        Precision::Float => orbit_over::<f64>(case, start, time, Accuracy::FLOAT, seen),
        Precision::Pair => orbit_over::<DoubleDouble>(case, start, time, Accuracy::PAIR, seen),
    }
}

/// Observer of a motion in steps.
pub(crate) trait Watcher<T: SeriesNumber> {
    /// Sees a piece of the motion up to `length`; `begin` is the time at which it begins.
    fn piece(&mut self, begin: DoubleDouble, piece: &MotionPiece<'_, T>, length: T::One);

    /// Sees a state at the end of a piece.
    fn state(&mut self, now: DoubleDouble, state: &[DoubleDouble]);
}

/// Observer of a single motion: its drift, its samples, and the share that is done.
struct DriftWatcher<'l, 's> {
    watch: Watch,
    samples: &'l mut Samples<'s>,
    reach: &'l mut dyn FnMut(f64),
    time: DoubleDouble,
    measured: u32,
}

impl<T: SeriesNumber<One = T>> Watcher<T> for DriftWatcher<'_, '_> {
    fn piece(&mut self, begin: DoubleDouble, piece: &MotionPiece<'_, T>, length: T) {
        self.samples.piece(begin, piece, length);
    }

    fn state(&mut self, now: DoubleDouble, state: &[DoubleDouble]) {
        let share = now.hi / self.time.hi;
        (self.reach)(share);
        let passed = share * f64::from(MEASUREMENTS);
        if passed >= f64::from(self.measured) {
            self.measured = passed as u32 + 1;
            self.watch.measure(state);
        }
    }
}

fn orbit_over<T: SeriesNumber<One = T>>(
    case: &Case,
    start: Start,
    time: DoubleDouble,
    accuracy: Accuracy,
    (samples, reach): (&mut Samples<'_>, &mut dyn FnMut(f64)),
) -> Result<Orbit, FlowError> {
    let watch = Watch::new(case, &start)?;
    let mut watcher = DriftWatcher { watch, samples, reach, time, measured: 0 };
    let (end, steps, events) = match &case.one_sided {
        Some(rule) => {
            let found = follow::<T>(case, rule, &start, time, accuracy, &mut watcher)?;
            (found.end, found.steps, found.events)
        }
        None => {
            let program = program(&case.model, &start.parameters, |_| Vec::new())?;
            let mut stepper = Stepper::<T>::new(&program, accuracy);
            stepper.start(0, &start.state, time);
            while !stepper.is_done(0) {
                stepper.expand();
                stepper.check(0).map_err(|error| match error {
                    FlowError::Stopped => stopped(&stepper),
                    error => error,
                })?;
                let piece = stepper.piece(0);
                Watcher::<T>::piece(&mut watcher, piece.begin(), &piece, piece.length());
                stepper.advance();
                Watcher::<T>::state(&mut watcher, stepper.time(0), &stepper.pairs(0));
            }
            (stepper.pairs(0), stepper.steps(0), Vec::new())
        }
    };
    if !end.iter().all(|x| x.is_finite()) {
        return Err(FlowError::Overflow(time.hi));
    }
    watcher.watch.measure(&end);
    watcher.samples.end(time, &end);
    let (order, followed) = (accuracy.order, watcher.watch.followed);
    Ok(Orbit { start, time, end, steps, order, followed, events })
}

/// Error of a motion that is stopped from outside.
fn stopped<T: SeriesNumber>(stepper: &Stepper<T>) -> FlowError {
    let state = stepper.pairs(0).iter().map(|x| x.hi).collect();
    FlowError::StoppedAt { time: stepper.time(0).hi, state }
}

/// Followed quantities, recorded on a tape.
pub(crate) struct Watch {
    tape: Tape,
    pub followed: Vec<Followed>,
}

/// Origin of a followed quantity.
enum QuantitySource<'c> {
    Level(&'c LevelFunction),
    Energy,
    Formula(&'c Formula),
    /// Σ k x_k over the components of the state.
    Sum,
}

impl QuantitySource<'_> {
    fn values(&self, phase: &Phase<'_, Expr>) -> Vec<Expr> {
        match self {
            QuantitySource::Level(function) => vec![phase.level_function(function)],
            QuantitySource::Energy => phase.model().system.energy(phase).into_iter().collect(),
            QuantitySource::Formula(formula) => phase.evaluate(formula).components(),
            QuantitySource::Sum => {
                let weight = |k: usize| Expr::rational(&Rational::from(k as i64 + 1));
                let terms = phase.state().into_iter().enumerate();
                vec![terms.map(|(k, x)| weight(k) * x).sum()]
            }
        }
    }
}

impl Watch {
    /// Records what is followed, with its values at a start.
    pub fn new(case: &Case, start: &Start) -> Result<Self, FlowError> {
        let sources = sources(case);
        let (graph, groups) = record(case.model.dimension(), |state| {
            let phase = point(&case.model, &start.parameters, state);
            sources.iter().map(|(_, _, source)| source.values(&phase)).collect::<Vec<_>>()
        })?;
        let tape = Tape::new(&graph, &groups.concat());
        let values = values(&tape, &start.state);
        let mut rounded = Evaluator::new(&tape, Float::<1>);
        rounded.run(&start.state.iter().map(|x| [x.hi]).collect::<Vec<_>>());
        let blur: Vec<f64> = rounded.outputs().zip(&values).map(|(r, x)| r[0] - x.hi).collect();
        let shares = shares(&tape, &start.state, &values);
        let (mut rest, mut blur) = (values.as_slice(), blur.as_slice());
        let mut shares = shares.as_slice();
        let mut followed = Vec::new();
        for ((name, role, _), group) in sources.into_iter().zip(&groups) {
            let (own, others) = rest.split_at(group.len());
            let (own_blur, other_blur) = blur.split_at(group.len());
            let (own_shares, other_shares) = shares.split_at(group.len());
            (rest, blur, shares) = (others, other_blur, other_shares);
            let size = norm(own.iter().map(|x| x.hi));
            let is_zero = size <= norm(own_blur.iter().copied());
            let terms = norm(own_shares.iter().copied());
            let scale = match role == QuantityRole::Level || is_zero {
                true => 1.0,
                // Terms that cancel, as those of a pendulum that starts at a right angle.
                false if size < SMALL * terms && terms.is_finite() => terms,
                false => size,
            };
            let value = own.to_vec();
            followed.push(Followed { name, role, value, drift: 0.0, drift_at_end: 0.0, scale });
        }
        Ok(Self { tape, followed })
    }

    /// Compares the values at a state with those at the start.
    pub fn measure(&mut self, state: &[DoubleDouble]) {
        let values = values(&self.tape, state);
        let mut rest = values.as_slice();
        for followed in &mut self.followed {
            let (own, others) = rest.split_at(followed.value.len());
            rest = others;
            let change = norm(own.iter().zip(&followed.value).map(|(x, y)| (*x - *y).hi));
            let drift = change / followed.scale;
            followed.drift_at_end = drift;
            // An undefined drift is worse than any other.
            followed.drift = if drift.is_nan() { drift } else { followed.drift.max(drift) };
        }
    }
}

/// Sums of the shares |x ∂f/∂x| that the components of a state have in the values of a tape.
fn shares(tape: &Tape, state: &[DoubleDouble], values: &[DoubleDouble]) -> Vec<f64> {
    let mut evaluator = Evaluator::new(tape, DoubleDoubles);
    let mut sums = vec![0.0; values.len()];
    for k in 0..state.len() {
        let mut moved = state.to_vec();
        moved[k] = moved[k] + moved[k] * DoubleDouble::from_f64(NEXT);
        evaluator.run(&moved);
        for ((sum, x), value) in sums.iter_mut().zip(evaluator.outputs()).zip(values) {
            *sum += ((*x - *value).hi / NEXT).abs();
        }
    }
    sums
}

fn norm(parts: impl Iterator<Item = f64>) -> f64 {
    parts.map(|x| x * x).sum::<f64>().sqrt()
}

/// Evaluates the components of a formula at a state.
pub fn value_at(
    model: &Model,
    formula: &Formula,
    parameters: &[Rational],
    state: &[DoubleDouble],
) -> Result<Vec<DoubleDouble>, FlowError> {
    let (graph, components) = record(model.dimension(), |state| {
        QuantitySource::Formula(formula).values(&point(model, parameters, state))
    })?;
    Ok(values(&Tape::new(&graph, &components), state))
}

fn values(tape: &Tape, state: &[DoubleDouble]) -> Vec<DoubleDouble> {
    let mut evaluator = Evaluator::new(tape, DoubleDoubles);
    evaluator.run(state);
    evaluator.outputs().copied().collect()
}

/// Part of the size of its terms below which a value counts as 0.
const SMALL: f64 = 1e-6;
/// Relative step of a difference quotient in double-double.
const NEXT: f64 = 1e-10;

/// Change of the energy from a start to another state, relative to the energy, or to the size of its terms
/// where it is 0 beside them; 0 for a system without energy.
pub(crate) fn energy_drift(
    model: &Model,
    start: &Start,
    end: &[DoubleDouble],
) -> Result<f64, FlowError> {
    let functions = LevelFunctions::with(model, &start.parameters, &|phase| {
        model.system.energy(phase).into_iter().collect()
    })?;
    let place = model.level.len();
    let (values, gradients) = functions.at(&start.state);
    let (Some(begin), Some(gradient)) = (values.get(place), gradients.get(place)) else {
        return Ok(0.0);
    };
    let parts = gradient.iter().zip(&start.state).map(|(slope, x)| (slope.hi * x.hi).abs());
    let size = parts.sum::<f64>();
    let scale = if begin.hi.abs() < SMALL * size { size } else { begin.hi.abs() };
    Ok((functions.at(end).0[place] - *begin).hi.abs() / scale)
}

/// Lists the level functions, the energy, the claimed integrals, and formulas that have to drift.
fn sources(case: &Case) -> Vec<(String, QuantityRole, QuantitySource<'_>)> {
    let model = &case.model;
    let level = model.level.iter();
    let mut sources: Vec<_> = level
        .map(|equation| {
            (equation.text.clone(), QuantityRole::Level, QuantitySource::Level(&equation.function))
        })
        .collect();
    let has_other = has_other_energy(model);
    if model.system.has_energy() {
        let name = if has_other { "energy of the system" } else { "energy" };
        sources.push((name.to_string(), QuantityRole::Energy, QuantitySource::Energy));
    }
    for claim in &case.claims {
        let ClaimKind::Integral(integral) = &claim.kind else { continue };
        let named_energy = claim.name == "energy" && model.system.has_energy() && !has_other;
        if integral.0.has_antiderivative() || named_energy {
            continue;
        }
        let role = match claim.expect {
            Expect::Holds | Expect::Open => QuantityRole::Integral,
            Expect::Fails => QuantityRole::Decoy,
        };
        sources.push((claim.name.clone(), role, QuantitySource::Formula(&integral.0)));
    }
    if sources.iter().all(|(_, role, _)| *role != QuantityRole::Decoy) {
        sources.push(("Σ k x_k".to_string(), QuantityRole::Decoy, QuantitySource::Sum));
    }
    sources
}
