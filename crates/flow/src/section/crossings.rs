//! Crossings of a surface by many motions, several in the lanes of each of several threads.
//!
//! A motion that has all its crossings gives its lane to the next one.

use crate::error::FlowError;
use crate::motion::start::Start;
use crate::taylor::batch::{Lockstep, MOTION_LANES, Queue, in_batches};
use crate::taylor::event::{Ends, Event, Sides, value};
use crate::taylor::lanes::Lanes;
use crate::taylor::number::SeriesNumber;
use crate::taylor::program::TaylorProgram;
use crate::taylor::stepper::{Accuracy, MotionPiece, Stepper};
use crate::told::ToldShare;
use liouville::case::Direction;
use liouville::number::double_double::DoubleDouble;

/// Number of steps without a crossing after which a motion counts as lost.
const MAX_STEPS_BETWEEN: u64 = 100_000;
/// Number of its roundings within which a motion may keep to the surface, all through its first step.
const ROUNDINGS: f64 = 64.0;
/// Number of crossings in the other direction alone after which a motion counts as lost.
const MAX_OTHERS: usize = 1000;

/// Part of a motion's longest step above which a step has a usual length; only the words on a motion that
/// ends depend on it.
const USUAL: f64 = 1e-2;

/// Motions to follow. Output 0 of the program vanishes on the surface.
pub(crate) struct CrossingTask<'t> {
    pub program: &'t TaylorProgram,
    pub starts: &'t [Result<Start, FlowError>],
    /// Direction of the crossings that count.
    pub direction: Direction,
    /// Number of crossings to collect for each motion.
    pub crossings: usize,
    /// Number of crossings left out at the beginning.
    pub skip: usize,
    pub backwards: bool,
    /// Whether output 1 of the program has to be positive at a crossing.
    pub has_side: bool,
}

/// Crossing of a surface.
pub(crate) struct Met<P> {
    pub at: P,
    pub time: f64,
    /// Whether the function grows with time there.
    pub rising: bool,
}

/// Crossings of one motion.
pub(crate) struct MotionCrossings<P> {
    /// Crossings that count, without those at the beginning.
    pub crossings: Vec<Met<P>>,
    /// Number of crossings in the other direction.
    pub others: usize,
    /// Number of points where the motion touches the surface without crossing it.
    pub tangencies: usize,
    /// Number of steps taken.
    pub steps: u64,
    /// Whether it stays near the surface all through its first step, within some roundings.
    pub is_close: bool,
    /// Final state, where it is finite.
    pub end: Option<Vec<DoubleDouble>>,
    /// Reason why the motion ended early, or did not start.
    pub problem: Option<FlowError>,
}

impl CrossingTask<'_> {
    /// Follows all motions; `observe` makes a function of the times and states of crossings,
    /// one for each thread. Calls `progress` with shares of a motion as they are done.
    pub fn run<P: Send, L: FnMut(DoubleDouble, &[DoubleDouble]) -> P>(
        &self,
        threads: usize,
        observe: &(dyn Fn() -> L + Sync),
        progress: &(dyn Fn(f64) + Sync),
    ) -> Vec<MotionCrossings<P>> {
        in_batches(self.starts.len(), threads, |queue, lockstep| match lockstep {
            Lockstep::One => Worker::<f64, P, L>::new(self, queue, observe()).run(progress),
            Lockstep::Lanes => {
                Worker::<Lanes<MOTION_LANES>, P, L>::new(self, queue, observe()).run(progress)
            }
        })
    }
}

/// Motions of one thread.
struct Worker<'w, T: SeriesNumber<One = f64>, P, L> {
    task: &'w CrossingTask<'w>,
    queue: &'w Queue,
    observe: L,
    stepper: Stepper<T>,
    running: Vec<Option<Running<P>>>,
    done: Vec<(usize, MotionCrossings<P>)>,
}

/// Motion in a lane.
struct Running<P> {
    index: usize,
    track: MotionCrossings<P>,
    sides: Sides,
    /// Number of crossings in the direction that counts, including those left out.
    counted: usize,
    /// Steps and crossings in the other direction at the last crossing that counts.
    last_met: (u64, usize),
    /// Share of the motion that was told.
    told: ToldShare,
}

impl<'w, T: SeriesNumber<One = f64>, P: Send, L: FnMut(DoubleDouble, &[DoubleDouble]) -> P>
    Worker<'w, T, P, L>
{
    fn new(task: &'w CrossingTask<'w>, queue: &'w Queue, observe: L) -> Self {
        let stepper = Stepper::new(task.program, Accuracy::FLOAT);
        let running = (0..T::LANES).map(|_| None).collect();
        Self { task, queue, observe, stepper, running, done: Vec::new() }
    }

    fn run(mut self, progress: &(dyn Fn(f64) + Sync)) -> Vec<(usize, MotionCrossings<P>)> {
        loop {
            for lane in 0..T::LANES {
                if self.running[lane].is_none() {
                    self.fill(lane, progress);
                }
            }
            if self.running.iter().all(Option::is_none) {
                return self.done;
            }
            self.stepper.expand();
            let ends = self.stepper.ends(0);
            for lane in 0..T::LANES {
                if self.crosses(lane, &ends) {
                    self.finish(lane, progress);
                } else if let Some(running) = &mut self.running[lane] {
                    let all = self.task.skip + self.task.crossings;
                    running.told.reach(running.counted as f64 / all as f64, progress);
                }
            }
            self.stepper.advance();
        }
    }

    /// Puts the next motion into a lane; motions without a start are finished at once.
    fn fill(&mut self, lane: usize, progress: &(dyn Fn(f64) + Sync)) {
        while let Some(index) = self.queue.take() {
            let mut track = MotionCrossings {
                crossings: Vec::new(),
                others: 0,
                tangencies: 0,
                steps: 0,
                is_close: false,
                end: None,
                problem: None,
            };
            match &self.task.starts[index] {
                Ok(start) => {
                    self.stepper.start_open(lane, &start.state, self.task.backwards);
                    let (sides, told) = (Sides::default(), ToldShare::default());
                    self.running[lane] =
                        Some(Running { index, track, sides, counted: 0, last_met: (0, 0), told });
                    return;
                }
                Err(problem) => {
                    track.problem = Some(problem.clone());
                    self.done.push((index, track));
                    progress(1.0);
                }
            }
        }
    }

    /// Collects the crossings of the present piece. Returns whether the motion is done.
    fn crosses(&mut self, lane: usize, ends: &Ends<T>) -> bool {
        let Some(running) = &mut self.running[lane] else { return false };
        if let Err(problem) = self.stepper.check(lane) {
            let time = self.stepper.time(lane).hi;
            running.track.problem = Some(match problem {
                // The step is cut before a branch point, which the surface may have.
                FlowError::Singular { .. }
                | FlowError::RunsAway { .. }
                | FlowError::TooShort { .. }
                    if self.stepper.is_cut(lane)
                        || field_goes_on(self.task, &self.stepper, lane) =>
                {
                    FlowError::SectionEnds { time }
                }
                other => other,
            });
            return true;
        }
        let steps = self.stepper.steps(lane);
        if self.stepper.rests(lane) {
            running.track.problem = Some(FlowError::AtRest);
            return true;
        }
        let ends_at_turn = self.stepper.ends_at_turn(lane);
        if ends_at_turn || !running.sides.pass(ends, lane) {
            let piece = self.stepper.piece(lane);
            let polynomial = piece.output(0);
            if !polynomial.iter().all(|coefficient| coefficient.is_finite()) {
                let time = self.stepper.time(lane).hi;
                running.track.problem = Some(FlowError::SectionEnds { time });
                return true;
            }
            if polynomial.iter().all(|coefficient| *coefficient == 0.0) {
                running.track.problem = Some(FlowError::InSurface);
                return true;
            }
            let doubt = || self.task.program.rounding::<f64>(0, &self.stepper.pairs(lane), 0.0);
            let length = piece.length().abs();
            let reach = polynomial.iter().rev().fold(0.0, |sum, x| sum * length + x.abs());
            if steps == 0 {
                running.track.is_close = reach <= ROUNDINGS * doubt();
            }
            let sides = &mut running.sides;
            for event in sides.events_up_to_turn(&polynomial, piece.length(), &doubt, ends_at_turn)
            {
                if running.meet(event, &piece, self.task, steps, &mut self.observe) {
                    return true;
                }
            }
        }
        let others = running.track.others - running.last_met.1;
        let is_lost = steps - running.last_met.0 > MAX_STEPS_BETWEEN || others > MAX_OTHERS;
        if is_lost || self.stepper.is_done(lane) {
            let (time, crossings) = (self.stepper.time(lane).hi, running.counted);
            running.track.problem = Some(FlowError::NeverCrossed { time, crossings, others });
            return true;
        }
        false
    }

    fn finish(&mut self, lane: usize, progress: &(dyn Fn(f64) + Sync)) {
        let Some(mut running) = self.running[lane].take() else { return };
        running.track.steps = self.stepper.steps(lane);
        let end = self.stepper.pairs(lane);
        running.track.end = end.iter().all(|x| x.is_finite()).then_some(end);
        running.told.finish(progress);
        self.done.push((running.index, running.track));
    }
}

/// Whether the field without the surface's function has steps of a usual length where the motion with
/// it ends.
fn field_goes_on<T: SeriesNumber>(
    task: &CrossingTask<'_>,
    motion: &Stepper<T>,
    lane: usize,
) -> bool {
    let program = task.program.without_outputs();
    let mut alone = Stepper::<f64>::new(&program, Accuracy::FLOAT);
    alone.start_open(0, &motion.pairs(lane), task.backwards);
    alone.expand();
    let longest = motion.longest_step(lane);
    alone.check(0).is_ok() && alone.step(0).abs() > USUAL * longest
}

impl<P> Running<P> {
    /// Records an event. Returns whether the motion has all its crossings.
    fn meet<T: SeriesNumber<One = f64>>(
        &mut self,
        event: Event<f64>,
        piece: &MotionPiece<'_, T>,
        task: &CrossingTask<'_>,
        steps: u64,
        observe: &mut impl FnMut(DoubleDouble, &[DoubleDouble]) -> P,
    ) -> bool {
        let (after, rising) = match event {
            Event::Tangency { .. } => {
                self.track.tangencies += 1;
                return false;
            }
            Event::Crossing { after, rising } => (after, rising),
        };
        if task.has_side && value(&piece.output(1), after).0 <= 0.0 {
            return false;
        }
        let counts = match task.direction {
            Direction::Both => true,
            Direction::Up => rising,
            Direction::Down => !rising,
        };
        if !counts {
            self.track.others += 1;
            return false;
        }
        self.counted += 1;
        self.last_met = (steps, self.track.others);
        if self.counted > task.skip {
            let time = piece.time(after);
            let at = observe(time, &piece.state(after));
            self.track.crossings.push(Met { at, time: time.hi, rising });
        }
        self.counted >= task.skip + task.crossings
    }
}
