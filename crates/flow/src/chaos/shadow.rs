//! Fast estimates of the exponents of many motions, each with a nearby shadow, to seven digits.
//!
//! The shadow is a motion at a small distance, to which it is reset when it has drifted far
//! (Benettin, Galgani, Strelcyn 1976); the mean divergence is a sum over two Gauss nodes per step.
//! That takes an eighth of the work of the variational equations; `variational` is the exact form.
//!
//! Parameters that differ from motion to motion are constant components of the state, so that one
//! program serves all.

use crate::chaos::reach::Reach;
use crate::error::FlowError;
use crate::motion::lyapunov::{Exponents, Record};
use crate::motion::recorded::{Loose, extended_program, filled};
use crate::motion::start::LevelFunctions;
use crate::taylor::batch::{MOTION_LANES, Queue, in_batches};
use crate::taylor::lanes::Lanes;
use crate::taylor::program::TaylorProgram;
use crate::taylor::stepper::{Accuracy, Stepper};
use crate::told::ToldShare;
use liouville::graph::{Evaluator, Expr, Tape, record};
use liouville::mechanics::calculus::DualPoint;
use liouville::mechanics::{Model, Phase};
use liouville::number::double_double::DoubleDouble;
use liouville::number::float::Float;
use liouville::number::rational::Rational;
use liouville::scalar::Scalar;

/// Number of states at which div v is computed together.
const STATES: usize = 64;
/// Lanes of a motion and its shadow.
const COUPLE: usize = 2;
/// Distance of a shadow, relative to the size of each component; rounding is 10⁻¹⁰ of it.
const DISTANCE: f64 = 1e-6;
/// Factor of growth or decay of the distance at which the shadow is put back.
const FAR: f64 = 30.0;

/// Start of a motion: its state, and the loose parameters by their positions in their ranges.
pub(crate) struct ShadowStart {
    pub state: Vec<DoubleDouble>,
    pub loose: Vec<DoubleDouble>,
}

/// Equations shared by all motions.
pub(crate) struct Shadowed {
    program: TaylorProgram,
    /// div v as a function of the state and the loose parameters.
    divergence: Tape,
    level: LevelFunctions,
    /// Number of components of the state, before the loose parameters, and dimension of the level.
    dimension: usize,
    rank: usize,
}

impl Shadowed {
    /// Compiles the equations of a model with these parameters, some of them loose.
    pub fn new(model: &Model, parameters: &[Rational], loose: &[Loose]) -> Result<Self, FlowError> {
        let program = extended_program(model, parameters, loose, loose.len(), |phase, more| {
            let mut rates = phase.field().to_vec();
            rates.extend(more.iter().map(|_| Expr::rational(&Rational::from(0))));
            (rates, Vec::new())
        })?;
        if program.jumps {
            return Err(FlowError::Jumps);
        }
        let (graph, divergence) = record(model.dimension() + loose.len(), |inputs| {
            let (state, more) = inputs.split_at(model.dimension());
            let jet = DualPoint::new(Phase::new(model, &filled(parameters, loose, more), state));
            jet.divergence() - jet.level_cofactor(&vec![true; model.level.len()])
        })?;
        let level = LevelFunctions::new(model, parameters, loose)?;
        let divergence = Tape::new(&graph, &[divergence]);
        let dimension = model.dimension();
        let rank = dimension.saturating_sub(model.level.len());
        Ok(Self { program, divergence, level, dimension, rank })
    }

    /// Level set on which motions start.
    pub fn level(&self) -> &LevelFunctions {
        &self.level
    }

    /// Follows motions for a time, negative for backwards. A motion without a start yields its
    /// error.
    pub fn follow(
        &self,
        begins: &[Result<ShadowStart, FlowError>],
        time: f64,
        threads: usize,
        progress: &(dyn Fn(f64) + Sync),
    ) -> Vec<Result<Exponents, FlowError>> {
        in_batches(begins.len(), threads, |queue, _| {
            Worker::new(self, begins, time).run(queue, progress)
        })
    }
}

type Done = Vec<(usize, Result<Exponents, FlowError>)>;

/// Motion with its shadow, in two lanes.
struct Running {
    index: usize,
    record: Record,
    reach: Reach,
    volume: f64,
    /// Share of the motion that was told.
    told: ToldShare,
}

/// Motions of one thread.
struct Worker<'w> {
    equations: &'w Shadowed,
    begins: &'w [Result<ShadowStart, FlowError>],
    time: f64,
    stepper: Stepper<Lanes<MOTION_LANES>>,
    divergence: Evaluator<'w, Float<STATES>>,
    /// States at which div v is still to be computed, row by row.
    inputs: Vec<[f64; STATES]>,
    /// Couple of each of these states, and its weight in ∫ div v.
    weights: Vec<(usize, f64)>,
    /// States within the present steps.
    within: Vec<Lanes<MOTION_LANES>>,
    running: Vec<Option<Running>>,
    done: Done,
}

impl<'w> Worker<'w> {
    fn new(
        equations: &'w Shadowed,
        begins: &'w [Result<ShadowStart, FlowError>],
        time: f64,
    ) -> Self {
        let stepper = Stepper::new(&equations.program, Accuracy::ROUGH);
        let divergence = Evaluator::new(&equations.divergence, Float::<STATES>);
        let inputs = vec![[0.0; STATES]; equations.divergence.inputs()];
        Self {
            equations,
            begins,
            time,
            stepper,
            divergence,
            inputs,
            weights: Vec::new(),
            within: Vec::new(),
            running: (0..MOTION_LANES / COUPLE).map(|_| None).collect(),
            done: Vec::new(),
        }
    }

    fn run(mut self, queue: &Queue, progress: &(dyn Fn(f64) + Sync)) -> Done {
        loop {
            for couple in 0..self.running.len() {
                while self.running[couple].is_none() {
                    let Some(index) = queue.take() else { break };
                    self.fill(couple, index, progress);
                }
            }
            if self.running.iter().all(Option::is_none) {
                return self.done;
            }
            self.stepper.expand();
            self.stepper.keep_pace(COUPLE);
            for couple in 0..self.running.len() {
                let checked = (0..COUPLE).try_for_each(|k| self.stepper.check(COUPLE * couple + k));
                if let Err(problem) = checked {
                    self.finish(couple, Some(problem), progress);
                }
            }
            self.integrate_divergence();
            self.stepper.advance();
            for couple in 0..self.running.len() {
                if self.measure(couple, progress) {
                    self.finish(couple, None, progress);
                }
            }
        }
    }

    /// Puts a motion and its shadow into two lanes; one without a start ends immediately.
    fn fill(&mut self, couple: usize, index: usize, progress: &(dyn Fn(f64) + Sync)) {
        let ShadowStart { state, loose } = match &self.begins[index] {
            Ok(begin) => begin,
            Err(problem) => {
                self.done.push((index, Err(problem.clone())));
                progress(1.0);
                return;
            }
        };
        let record = Record::short(self.time).on_level(self.equations.rank);
        let end = DoubleDouble::from_f64(record.end().unwrap_or(self.time));
        let mut reach = Reach::new(state);
        if reach.is_empty() {
            // A state that is exactly 0 has no size; where it goes has.
            reach = Reach::new(&self.after_a_step(state, loose));
        }
        let along = self.equations.level.along(state, loose, 0);
        let factor = DISTANCE / reach.distance(&along);
        let apart: Vec<f64> = along.iter().map(|u| factor * u).collect();
        reach.put(&apart);
        let beside = state.iter().zip(&apart).map(|(x, d)| *x + DoubleDouble::from_f64(*d));
        let shadow: Vec<DoubleDouble> = beside.chain(loose.iter().copied()).collect();
        self.stepper.start(COUPLE * couple, &[state.as_slice(), loose].concat(), end);
        self.stepper.start(COUPLE * couple + 1, &shadow, end);
        for lane in COUPLE * couple..COUPLE * (couple + 1) {
            self.stepper.aim(lane, self.time);
            self.stepper.hasten(lane);
        }
        self.running[couple] =
            Some(Running { index, record, reach, volume: 0.0, told: ToldShare::default() });
    }

    /// State after a step.
    fn after_a_step(&self, state: &[DoubleDouble], loose: &[DoubleDouble]) -> Vec<DoubleDouble> {
        let mut stepper = Stepper::<f64>::new(&self.equations.program, Accuracy::ROUGH);
        stepper.start(0, &[state, loose].concat(), DoubleDouble::from_f64(self.time));
        stepper.expand();
        stepper.advance();
        let mut after = stepper.pairs(0);
        after.truncate(state.len());
        after
    }

    /// Notes the contribution of the present steps to ∫ div v, by Gauss's rule with two points.
    fn integrate_divergence(&mut self) {
        let away = 0.5 / 3f64.sqrt();
        for share in [0.5 - away, 0.5 + away] {
            if self.weights.len() + self.running.len() > STATES {
                self.collect_divergence();
            }
            self.stepper.within(share, &mut self.within);
            for couple in (0..self.running.len()).filter(|couple| self.running[*couple].is_some()) {
                let lane = COUPLE * couple;
                for (input, state) in self.inputs.iter_mut().zip(&self.within) {
                    input[self.weights.len()] = state.0[lane];
                }
                self.weights.push((couple, 0.5 * self.stepper.step(lane)));
            }
        }
    }

    /// Adds what was noted to ∫ div v, in the order in which it was.
    fn collect_divergence(&mut self) {
        if self.weights.is_empty() {
            return;
        }
        self.divergence.run(&self.inputs);
        let values = self.divergence.output(0);
        for ((couple, weight), value) in self.weights.drain(..).zip(values) {
            if let Some(running) = &mut self.running[couple] {
                running.volume += weight * value;
            }
        }
    }

    /// Measures the distance of the shadow after a step. Returns whether the motion is done.
    fn measure(&mut self, couple: usize, progress: &(dyn Fn(f64) + Sync)) -> bool {
        let Some(running) = &mut self.running[couple] else { return false };
        let (own, other) = (COUPLE * couple, COUPLE * couple + 1);
        running.told.reach(self.stepper.time(own).hi / self.time, progress);
        let (state, shadow) = (self.stepper.pairs(own), self.stepper.pairs(other));
        let dimension = self.equations.dimension;
        let apart: Vec<DoubleDouble> = shadow.iter().zip(&state).map(|(x, y)| *x - *y).collect();
        let is_done = self.stepper.is_done(own);
        running.record.visit(&state[..dimension]);
        running.reach.visit(&state[..dimension]);
        let gaps: Vec<f64> = apart[..dimension].iter().map(|d| d.hi).collect();
        let distance = running.reach.distance(&gaps);
        if is_done || !(DISTANCE / FAR..=DISTANCE * FAR).contains(&distance) {
            running.record.grow(running.reach.growth(&gaps));
            let factor = DISTANCE / distance;
            let back =
                |(x, d): (&DoubleDouble, &DoubleDouble)| *x + *d * DoubleDouble::from_f64(factor);
            let shadow: Vec<DoubleDouble> = state.iter().zip(&apart).map(back).collect();
            self.stepper.place(other, &shadow);
            running.reach.put(&gaps.iter().map(|d| d * factor).collect::<Vec<f64>>());
        }
        if !is_done {
            return false;
        }
        self.collect_divergence();
        let Some(running) = &mut self.running[couple] else { return false };
        running.record.finish_block(running.volume);
        match running.record.end() {
            Some(end) => {
                self.stepper.extend(own, DoubleDouble::from_f64(end));
                self.stepper.extend(other, DoubleDouble::from_f64(end));
                false
            }
            None => true,
        }
    }

    fn finish(
        &mut self,
        couple: usize,
        problem: Option<FlowError>,
        progress: &(dyn Fn(f64) + Sync),
    ) {
        self.collect_divergence();
        let Some(mut running) = self.running[couple].take() else { return };
        let found = match problem {
            Some(problem) => Err(problem),
            None => Ok(running.record.exponents()),
        };
        self.done.push((running.index, found));
        running.told.finish(progress);
    }
}
