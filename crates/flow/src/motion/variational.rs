//! Motions with tangent vectors, by the variational equations w' = (dv)w, and ∫ div v.
//!
//! num-dual records the field of the vectors. Each is normalised after each step; the sum of the
//! logarithms over the time is the largest exponent.

use std::ops::Range;

use crate::error::FlowError;
use crate::motion::lyapunov::{Exponents, Record};
use crate::motion::recorded::extended_program;
use crate::motion::start::{LevelFunctions, Start};
use crate::taylor::batch::{Lockstep, MOTION_LANES, Queue, in_batches};
use crate::taylor::lanes::Lanes;
use crate::taylor::number::SeriesNumber;
use crate::taylor::program::TaylorProgram;
use crate::taylor::stepper::{Accuracy, Stepper};
use crate::told::ToldShare;
use liouville::mechanics::Model;
use liouville::mechanics::calculus::DualPoint;
use liouville::number::double_double::DoubleDouble;
use liouville::number::rational::Rational;

/// Number of steps after which vectors are made tangent to the level again.
const STRIDE: u64 = 8;
/// Number of tangent vectors; the alignment index takes two.
const VECTORS: usize = 2;

/// Equations of a motion with tangent vectors: the rows are the state, the vectors, and ∫ div v.
struct Bundle {
    program: TaylorProgram,
    dimension: usize,
    /// Dimension of the level.
    rank: usize,
    /// Level to which vectors are kept tangent, if the field alone does not.
    level: Option<LevelFunctions>,
}

impl Bundle {
    /// Compiles the equations of a model with these parameters.
    fn new(model: &Model, parameters: &[Rational]) -> Result<Self, FlowError> {
        let dimension = model.dimension();
        let program = variational_program(model, parameters, VECTORS)?;
        let is_kept = program.level.is_none();
        let level = (!is_kept).then(|| LevelFunctions::new(model, parameters, &[])).transpose()?;
        let rank = dimension.saturating_sub(model.level.len());
        Ok(Self { program, dimension, rank, level })
    }

    /// All rows at the start of a motion, with the vectors tangent to the level set.
    fn begin(&self, level: &LevelFunctions, state: &[DoubleDouble]) -> Vec<DoubleDouble> {
        let mut begin = state.to_vec();
        for index in 0..VECTORS {
            begin.extend(level.along(state, &[], index).into_iter().map(DoubleDouble::from_f64));
        }
        begin.push(DoubleDouble::default());
        begin
    }

    fn vector(&self, index: usize) -> Range<usize> {
        (index + 1) * self.dimension..(index + 2) * self.dimension
    }

    fn volume(&self) -> usize {
        (VECTORS + 1) * self.dimension
    }

    /// Follows motions for a time, negative for backwards. A motion without a start yields its
    /// error.
    fn follow(
        &self,
        begins: &[Result<Vec<DoubleDouble>, FlowError>],
        time: f64,
        threads: usize,
        progress: &(dyn Fn(f64) + Sync),
    ) -> Vec<Result<Exponents, FlowError>> {
        let task = VariationalTask { bundle: self, begins, time };
        in_batches(begins.len(), threads, |queue, lockstep| match lockstep {
            Lockstep::One => Worker::<f64>::new(&task).run(queue, progress),
            Lockstep::Lanes => Worker::<Lanes<MOTION_LANES>>::new(&task).run(queue, progress),
        })
    }
}

/// Compiles the field with this many tangent vectors, and div v on the level, after the state.
pub(crate) fn variational_program(
    model: &Model,
    parameters: &[Rational],
    vectors: usize,
) -> Result<TaylorProgram, FlowError> {
    let dimension = model.dimension();
    extended_program(model, parameters, &[], vectors * dimension + 1, |phase, more| {
        let jet = DualPoint::new(phase.with(&[], &phase.state()));
        let mut rates = jet.phase.field().to_vec();
        for vector in more[..vectors * dimension].chunks(dimension) {
            rates.extend(jet.phase.lift(vector).field().iter().map(|rate| rate.eps));
        }
        let level = vec![true; model.level.len()];
        rates.push(jet.divergence() - jet.level_cofactor(&level));
        (rates, Vec::new())
    })
}

/// Motions to follow, with their equations and time.
struct VariationalTask<'t> {
    bundle: &'t Bundle,
    begins: &'t [Result<Vec<DoubleDouble>, FlowError>],
    time: f64,
}

type Done = Vec<(usize, Result<Exponents, FlowError>)>;

/// Motions of one thread.
struct Worker<'t, T: SeriesNumber<One = f64>> {
    task: &'t VariationalTask<'t>,
    stepper: Stepper<T>,
    running: Vec<Option<(usize, Record, ToldShare)>>,
    done: Done,
}

impl<'t, T: SeriesNumber<One = f64>> Worker<'t, T> {
    fn new(task: &'t VariationalTask<'t>) -> Self {
        let stepper = Stepper::new(&task.bundle.program, Accuracy::FLOAT);
        let running = (0..T::LANES).map(|_| None).collect();
        Self { task, stepper, running, done: Vec::new() }
    }

    fn run(mut self, queue: &Queue, progress: &(dyn Fn(f64) + Sync)) -> Done {
        loop {
            for lane in 0..T::LANES {
                while self.running[lane].is_none() {
                    let Some(index) = queue.take() else { break };
                    self.fill(lane, index, progress);
                }
            }
            if self.running.iter().all(Option::is_none) {
                return self.done;
            }
            self.stepper.expand();
            for lane in 0..T::LANES {
                if let Err(problem) = self.stepper.check(lane) {
                    self.finish(lane, Some(problem), progress);
                }
            }
            self.stepper.advance();
            for lane in 0..T::LANES {
                if self.measure(lane, progress) {
                    self.finish(lane, None, progress);
                }
            }
        }
    }

    /// Puts a motion into a lane; one without a start ends immediately.
    fn fill(&mut self, lane: usize, index: usize, progress: &(dyn Fn(f64) + Sync)) {
        match &self.task.begins[index] {
            Ok(begin) => {
                let record = Record::new(self.task.time).on_level(self.task.bundle.rank);
                let end = record.end().unwrap_or(self.task.time);
                self.stepper.start(lane, begin, DoubleDouble::from_f64(end));
                self.stepper.aim(lane, self.task.time);
                if self.task.time < 0.0 {
                    // Motions with friction run away backwards in time, and have no exponents there.
                    self.stepper.hasten(lane);
                }
                self.running[lane] = Some((index, record, ToldShare::default()));
            }
            Err(problem) => {
                self.done.push((index, Err(problem.clone())));
                progress(1.0);
            }
        }
    }

    /// Measures the vectors after a step. Returns whether the motion is done.
    fn measure(&mut self, lane: usize, progress: &(dyn Fn(f64) + Sync)) -> bool {
        let Some((_, record, told)) = &mut self.running[lane] else { return false };
        let bundle = self.task.bundle;
        let mut state = self.stepper.pairs(lane);
        if let Some(level) = &bundle.level
            && self.stepper.steps(lane).is_multiple_of(STRIDE)
        {
            let normals = level.normals(&state[..bundle.dimension]);
            (0..VECTORS).for_each(|k| make_tangent(&mut state[bundle.vector(k)], &normals));
            self.stepper.place(lane, &state);
        }
        let lengths: [f64; VECTORS] = std::array::from_fn(|index| {
            let vector = &state[bundle.vector(index)];
            vector.iter().map(|x| x.hi * x.hi).sum::<f64>().sqrt()
        });
        for (index, length) in lengths.iter().enumerate() {
            self.stepper.scale(lane, bundle.vector(index), 1.0 / length);
        }
        record.grow(lengths[0]);
        record.visit(&state[..bundle.dimension]);
        let apart = |sign: f64| {
            let both = state[bundle.vector(0)].iter().zip(&state[bundle.vector(1)]);
            let parts = both.map(|(x, y)| x.hi / lengths[0] + sign * y.hi / lengths[1]);
            parts.map(|x| x * x).sum::<f64>().sqrt()
        };
        let time = self.stepper.time(lane).hi;
        record.align(time, apart(1.0).min(apart(-1.0)));
        told.reach(time / self.task.time, progress);
        if !self.stepper.is_done(lane) {
            return false;
        }
        record.finish_block(state[bundle.volume()].hi);
        match record.end() {
            Some(end) => {
                self.stepper.extend(lane, DoubleDouble::from_f64(end));
                false
            }
            None => true,
        }
    }

    fn finish(&mut self, lane: usize, problem: Option<FlowError>, progress: &(dyn Fn(f64) + Sync)) {
        let Some((index, record, mut told)) = self.running[lane].take() else { return };
        let found = match problem {
            Some(problem) => Err(problem),
            None => Ok(record.exponents()),
        };
        self.done.push((index, found));
        told.finish(progress);
    }
}

/// Takes from a vector what is along unit vectors across the level.
fn make_tangent(vector: &mut [DoubleDouble], normals: &[Vec<f64>]) {
    for normal in normals {
        let along: f64 = vector.iter().zip(normal).map(|(x, n)| x.hi * n).sum();
        for (x, n) in vector.iter_mut().zip(normal) {
            *x = *x - DoubleDouble::from_f64(along * n);
        }
    }
}

/// Motions of one system, each with two tangent vectors and ∫ div v.
pub struct Variational {
    bundle: Bundle,
    begins: Vec<Result<Vec<DoubleDouble>, FlowError>>,
}

impl Variational {
    /// Prepares the motion from a start, with vectors tangent to the level set.
    pub fn new(model: &Model, start: &Start) -> Result<Self, FlowError> {
        Self::all(model, &start.parameters, &[Ok(start.clone())])
    }

    /// Prepares motions from several starts with the same parameters.
    pub fn all(
        model: &Model,
        parameters: &[Rational],
        starts: &[Result<Start, FlowError>],
    ) -> Result<Self, FlowError> {
        let bundle = Bundle::new(model, parameters)?;
        let level = LevelFunctions::new(model, parameters, &[])?;
        let begin = |start: &Start| bundle.begin(&level, &start.state);
        let begins = starts.iter().map(|start| start.as_ref().map(begin).map_err(Clone::clone));
        Ok(Self { begins: begins.collect(), bundle })
    }

    /// Follows the first motion for a time, negative for backwards.
    pub fn exponents(&self, time: f64) -> Result<Exponents, FlowError> {
        let mut found = self.bundle.follow(&self.begins[..1], time, 1, &|_| ());
        found.pop().unwrap_or(Err(FlowError::NoStart))
    }

    /// Follows all motions; calls `progress` with shares of a motion as they are done.
    pub fn all_exponents(
        &self,
        time: f64,
        threads: usize,
        progress: &(dyn Fn(f64) + Sync),
    ) -> Vec<Result<Exponents, FlowError>> {
        self.bundle.follow(&self.begins, time, threads, progress)
    }
}
