//! Sweeps: the residual of a claim in f64 at any number of states.
//!
//! ```text
//! seed, i ─ generator ─▶ draws ─ chart ─▶ state ─ residual/scale ─▶ the largest, and where
//!                        └───────────── one tape, by the engine ─┘
//! ```
//!
//! Draws, chart and residual are one tape: states are not stored, and memory does not grow with
//! their number. The result is the same for any number of threads. It is not a verdict, since a
//! number in f64 has no error bound. [`judge`](crate::verdict::judge) proves and refutes; a sweep
//! finds where a formula without a proof is off most, or maps a quantity over ranges of parameters.
//! A [`Part`](crate::part::Part) of the states may run on any machine; [`Extremes::and`] combines the
//! results.
//!
//! ```
//! use liouville::case::Case;
//! use liouville::sweep::Sweep;
//!
//! let case = Case::parse(
//!     r#"
//!     title = "Euler's top, with a slip in the exponent"
//!     system = "rubber-plane"
//!     [parameters]
//!     m = "0.5..2"
//!     R = "1..3"
//!     I = "inertia(0.5..5)"
//!     [body]
//!     shape = "ball"
//!     [[claim]]
//!     integral = "|J*ω × γ|²"
//!     [[claim]]
//!     density = "(γ,J⁻¹*γ)"
//!     "#,
//!     &[],
//! )?;
//! let [right, wrong] = [0, 1].map(|k| Sweep::new(&case, &case.claims[k], 1).expect("it has a chart"));
//! let peak = right.run(0..100_000, f64::INFINITY).peak.expect("it has values");
//! assert!(peak.ratio < 1e-13, "rounding at most, at state {}", peak.index);
//!
//! // A wrong formula is off by more than rounding: one look is enough.
//! let found = wrong.run(0..100_000_000, 1e-6);
//! let peak = found.peak.expect("it has values");
//! assert!(peak.ratio > 1e-6 && found.states < 100_000_000);
//! let (parameters, state) = wrong.state(peak.index);
//! assert_eq!((parameters[0].0.as_str(), state[0].0.as_str()), ("m", "ω"));
//! # Ok::<(), liouville::case::CaseError>(())
//! ```

mod generator;
mod scale;

use std::ops::Range;

use num_traits::Zero;
use rayon::prelude::*;

use crate::case::{Case, PlacedClaim};
use crate::engine::{Backend, Engine, ROW_STATES, RowBlock, Runner};
use crate::graph::{Evaluator, Fault, Tape, record};
use crate::mechanics::Phase;
use crate::mechanics::calculus::DualPoint;
use crate::number::float::Float;
use crate::requirement;
use crate::scalar::Scalar;
use crate::verdict::{NamedValue, Sampler, antiderivative_value, named};
use generator::Generator;

/// Number of states that a thread takes at a time, enough that their distribution costs nothing.
const PORTION: u64 = 1 << 14;
/// Number of states between two tests of the stopping condition, the same for any number of
/// threads.
const WAVE: u64 = 1 << 20;

/// Reason why there is no sweep.
#[derive(Clone, Debug, thiserror::Error)]
pub enum SweepError {
    /// A formula asked a recorded value for its magnitude.
    #[error(transparent)]
    Fault(#[from] Fault),
    /// States come one by one from Newton's method.
    #[error("the level set has no parametrisation to make states from")]
    NoChart,
    /// The claim has no residual.
    #[error("a claim of this kind has no residual")]
    NoResidual,
}

impl SweepError {
    /// Advice on how to avoid the error.
    pub fn help(&self) -> &'static str {
        match self {
            SweepError::Fault(_) => "write the formula with operations that hold for every number",
            SweepError::NoChart => "give the case a [level.chart]",
            SweepError::NoResidual => "leave this claim to `liouville check`",
        }
    }
}

/// A claim prepared for evaluation at many states.
#[derive(Debug)]
pub struct Sweep<'c> {
    case: &'c Case,
    generator: Generator,
    engine: Engine,
    /// Number of components that vanish where the claim holds.
    components: usize,
    /// The same components, computed without the square of the scale, which follows them then, and their sizes.
    careful: Option<Tape>,
    /// Tape from draws to parameters and state.
    point: Tape,
}

/// Result of a sweep.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Extremes {
    /// Number of states evaluated.
    pub states: u64,
    /// Number of states at which the residual has a value.
    pub defined: u64,
    /// State of the largest residual; the first of several.
    pub peak: Option<Peak>,
}

/// A state and its residual.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak {
    /// Number of the state under the sweep's seed.
    pub index: u64,
    /// Largest |residual|/scale of all components. The scale is a reference size of the
    /// residual ([`crate::claim::ResidualContext::scale`]), or 1 for kinds of claims without one.
    pub ratio: f64,
}

impl Extremes {
    /// Combines the results of two sweeps, `self` being of earlier states: of the parts of a sweep
    /// in order, the result of the whole.
    pub fn and(self, later: Self) -> Self {
        let peak = match (self.peak, later.peak) {
            (Some(a), Some(b)) => Some(if b.ratio > a.ratio { b } else { a }),
            (a, b) => a.or(b),
        };
        Self { states: self.states + later.states, defined: self.defined + later.defined, peak }
    }
}

impl<'c> Sweep<'c> {
    /// Records a claim, from the draws of its states on.
    pub fn new(case: &'c Case, claim: &PlacedClaim, seed: u64) -> Result<Self, SweepError> {
        Self::by(case, claim, seed, Backend::Quickest)
    }

    /// Records a claim for an engine of one's choice, which does not affect the numbers.
    pub fn by(
        case: &'c Case,
        claim: &PlacedClaim,
        seed: u64,
        means: Backend,
    ) -> Result<Self, SweepError> {
        let sampler = Sampler::new(case, &claim.place, seed)?;
        if sampler.is_numerical() {
            return Err(SweepError::NoChart);
        }
        let free = case.model.free_components();
        let (graph, groups) = record(free + case.model.dimension(), |inputs| {
            let (parameters, state) = inputs.split_at(free);
            let jet = DualPoint::new(Phase::new(&case.model, parameters, state));
            let residual = claim.kind.residual(&jet, &claim.place.kept);
            // Where nothing moves, the scale of a rate is 0.
            let scale = claim.kind.context(&jet, &claim.place.kept).scale;
            let scale = scale.filter(|scale| !scale.is_zero());
            let ratio = |residual: crate::graph::Expr| {
                let size = residual.modulus();
                scale.map_or(size, |square| size / num_dual::DualNum::sqrt(&square))
            };
            let components = residual.len();
            let sizes: Vec<_> = residual.iter().map(|own| own.modulus()).collect();
            let mut ratios = residual.into_iter().map(ratio).collect::<Vec<_>>();
            if let Some(square) = scale.filter(|_| components > 0) {
                ratios.push(square);
                ratios.extend(&sizes);
            }
            let mut system = requirement::of_system(&jet.phase);
            system.extend(requirement::of_level(&jet.phase));
            let required = requirement::of_claim(&jet, &claim.kind, &system);
            ([ratios, inputs.to_vec(), required, sizes], components)
        })?;
        let ([ratios, inputs, required, mut sizes], components) = groups;
        if components == 0 {
            return Err(SweepError::NoResidual);
        }
        let recipes = sampler.recipes();
        let (own, points) = sampler.compose(&graph, &[inputs], &vec![None; recipes.len()])?;
        let point = Tape::new(&own, &points.concat());
        // What is written and was simplified away still has to have a value.
        let left_out = graph.left_out(&ratios, &required);
        let careful = match ratios.get(components) {
            Some(square) => {
                sizes.push(*square);
                let (graph, sizes) = sampler.compose_in_ranges(&graph, &sizes, &left_out)?;
                let (graph, ratios) =
                    scale::ratios(&graph, &sizes[..components], sizes[components])?;
                Some(Tape::new(&graph, &ratios))
            }
            None => None,
        };
        let (graph, ratios) = sampler.compose_in_ranges(&graph, &ratios, &left_out)?;
        Ok(Self {
            case,
            generator: Generator::new(recipes, seed),
            engine: Engine::new(&Tape::new(&graph, &ratios), means),
            components,
            careful,
            point,
        })
    }

    /// Evaluates states until the residual is `enough` times its scale at one of them, which is
    /// tested after every 2²⁰ states.
    pub fn run(&self, states: Range<u64>, enough: f64) -> Extremes {
        let mut found = Extremes::default();
        let mut wave = states.start..states.start;
        while wave.end < states.end && found.peak.is_none_or(|peak| peak.ratio < enough) {
            wave = wave.end..wave.end.saturating_add(WAVE).min(states.end);
            let portions = (wave.end - wave.start).div_ceil(PORTION);
            let portion = |runner: &mut Runner, number: u64| {
                let start = wave.start + number * PORTION;
                self.extremes(runner, start..(start + PORTION).min(wave.end))
            };
            let of_wave = (0..portions)
                .into_par_iter()
                .map_init(|| self.runner(), portion)
                .reduce(Extremes::default, Extremes::and);
            found = found.and(of_wave);
        }
        found
    }

    /// Parameters and state of state `index`, by name, in the notation of `eval`.
    pub fn state(&self, index: u64) -> (Vec<NamedValue>, Vec<NamedValue>) {
        let mut draws = vec![RowBlock([0.0; ROW_STATES]); self.point.inputs()];
        self.fix_antiderivatives(&mut draws);
        self.generator.fill(index, &mut draws);
        let mut evaluator = Evaluator::new(&self.point, Float::<1>);
        evaluator.run(&draws.iter().map(|row| [row.0[0]]).collect::<Vec<_>>());
        let values = evaluator.outputs().map(|value| format!("{:?}", value[0]));
        named(&self.case.model, &values.collect::<Vec<String>>())
    }

    /// Engine that runs the sweep.
    pub fn engine(&self) -> &Engine {
        &self.engine
    }

    fn runner(&self) -> Runner {
        let mut runner = self.engine.runner();
        self.fix_antiderivatives(runner.inputs());
        runner
    }

    /// Sets the antiderivatives, whose rows follow those of the draws.
    fn fix_antiderivatives(&self, inputs: &mut [RowBlock]) {
        for (number, row) in inputs.iter_mut().skip(self.generator.draws()).enumerate() {
            row.0 = [antiderivative_value(number).to_f64().0; ROW_STATES];
        }
    }

    /// Evaluates a few states, one row after the other.
    fn extremes(&self, runner: &mut Runner, states: Range<u64>) -> Extremes {
        let mut found = Extremes::default();
        for start in states.clone().step_by(ROW_STATES) {
            self.generator.fill(start, runner.inputs());
            runner.run();
            let lanes = (states.end - start).min(ROW_STATES as u64) as usize;
            let mut ratios = *runner.output(0);
            for component in 1..self.components {
                worse(&mut ratios, runner.output(component));
            }
            if let Some(careful) = &self.careful {
                for lane in 0..lanes {
                    let square = runner.output(self.components).0[lane];
                    let has_sizes = || {
                        let sizes = self.components + 1..2 * self.components + 1;
                        sizes.into_iter().all(|size| runner.output(size).0[lane].is_finite())
                    };
                    if !(scale::LEAST..=scale::MOST).contains(&square) && has_sizes() {
                        ratios.0[lane] = careful_ratio(careful, runner.inputs(), lane);
                    }
                }
            }
            found = found.and(peak(&ratios.0[..lanes], start));
        }
        found
    }
}

/// Takes the larger of two values, or an undefined one.
fn worse(ratios: &mut RowBlock, others: &RowBlock) {
    for (ratio, other) in ratios.0.iter_mut().zip(&others.0) {
        if *other > *ratio || other.is_nan() {
            *ratio = *other;
        }
    }
}

/// Computes the largest ratio at one state, from its draws; NaN where one has no value.
fn careful_ratio(tape: &Tape, inputs: &[RowBlock], lane: usize) -> f64 {
    let mut evaluator = Evaluator::new(tape, Float::<1>);
    evaluator.run(&inputs.iter().map(|row| [row.0[lane]]).collect::<Vec<_>>());
    let larger = |most: f64, own: f64| if own > most || own.is_nan() { own } else { most };
    evaluator.outputs().map(|value| value[0]).fold(0.0, larger)
}

/// Largest of some numbers, in two passes without a branch on any of them.
fn peak(ratios: &[f64], start: u64) -> Extremes {
    let (mut defined, mut most) = (0, f64::NEG_INFINITY);
    for ratio in ratios {
        let is_defined = *ratio < f64::INFINITY;
        defined += u64::from(is_defined);
        most = if is_defined && *ratio > most { *ratio } else { most };
    }
    let place = ratios.iter().position(|ratio| *ratio == most);
    // 0 without a sign.
    let peak = place.map(|lane| Peak { index: start + lane as u64, ratio: most + 0.0 });
    Extremes { states: ratios.len() as u64, defined, peak }
}
