//! Poincaré sections: many orbits, several in the lanes of each of several threads.
//!
//! An orbit that has all its crossings gives its lane to the next one.

use super::andoyer::{Chart, applies, coordinates, section_functions};
use super::error::FlowError;
use super::event::{Event, Sides, value};
use super::lanes::Lanes;
use super::motion::{point, program};
use super::number::Number;
use super::orbit::energy_drift;
use super::program::Program;
use super::start::{Start, fixed_parameters};
use super::stepper::{Accuracy, Piece, Stepper};
use super::swarm::{Abreast, LANES, Queue, swarm};
use liouville::case::{Angle, Case, Direction};
use liouville::graph::{Evaluator, Tape, record};
use liouville::number::pair::{Pair, Pairs};
use liouville::number::rational::Rational;

/// Number of steps without a crossing after which an orbit counts as lost.
const MAX_STEPS_BETWEEN: u64 = 100_000;
/// Number of crossings in the other direction alone after which an orbit counts as lost.
const MAX_OTHERS: usize = 1000;
/// Time limit, far later than any crossing.
const NEVER: f64 = 1e15;

/// Request for a section.
#[derive(Clone, Debug)]
pub struct SectionRequest {
    /// Angle g₀ of the section.
    pub g0: Angle,
    /// Energy of the orbits.
    pub energy: Rational,
    /// Direction of the crossings that count.
    pub direction: Direction,
    /// Number of crossings to collect for each orbit.
    pub crossings: usize,
    /// Number of crossings left out at the beginning.
    pub skip: usize,
    /// Starts of the orbits: (l, L/G).
    pub starts: Vec<[f64; 2]>,
    /// Whether to follow the orbits backwards in time.
    pub backwards: bool,
    /// Seed of the free parameters.
    pub seed: u64,
    /// Index of the free parameters among the draws.
    pub index: u64,
}

/// A crossing of the section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Position: l and L/G.
    pub at: [f64; 2],
    /// Time of the crossing.
    pub time: f64,
    /// Whether g grows with time there.
    pub rising: bool,
}

/// Crossings of one orbit.
#[derive(Clone, Debug)]
pub struct SectionOrbit {
    /// Start of the orbit.
    pub start: [f64; 2],
    /// Crossings that count, without those at the beginning.
    pub crossings: Vec<Crossing>,
    /// Number of crossings in the other direction, which are not drawn.
    pub others: usize,
    /// Number of points where the orbit touches the section without crossing it.
    pub tangencies: usize,
    /// Number of steps taken.
    pub steps: u64,
    /// Relative change of the energy between start and end.
    pub drift: f64,
    /// Reason why the orbit ended early, or did not start.
    pub problem: Option<FlowError>,
}

/// Computes the section of a case: one entry for each start, in their order. Calls `progress` after
/// each orbit.
pub fn section(
    case: &Case,
    request: &SectionRequest,
    threads: usize,
    progress: &(dyn Fn() + Sync),
) -> Result<Vec<SectionOrbit>, FlowError> {
    if !applies(&case.model) {
        return Err(FlowError::NoAndoyer);
    }
    let parameters = fixed_parameters(case, request.seed, request.index)?;
    let program =
        program(&case.model, &parameters, |phase| section_functions(phase, &request.g0).to_vec())?;
    let chart = Chart::new(&case.model, &parameters, &request.g0, &request.energy)?;
    let starts: Vec<Result<Start, FlowError>> =
        request.starts.iter().map(|at| chart.start(*at)).collect();
    let orbits = swarm(starts.len(), threads, |queue, abreast| match abreast {
        Abreast::One => Worker::<f64>::new(&program, request, &starts, queue).run(progress),
        Abreast::Lanes => {
            Worker::<Lanes<LANES>>::new(&program, request, &starts, queue).run(progress)
        }
    });
    orbits
        .into_iter()
        .zip(&starts)
        .map(|((mut orbit, end), start)| {
            if let (Ok(start), Some(end)) = (start, end) {
                orbit.drift = energy_drift(&case.model, start, &end)?;
            }
            Ok(orbit)
        })
        .collect()
}

/// Returns the states over points (l, L/G) of a section.
pub fn section_starts(
    case: &Case,
    g0: &Angle,
    energy: &Rational,
    points: &[[f64; 2]],
    seed: u64,
) -> Result<Vec<Result<Start, FlowError>>, FlowError> {
    if !applies(&case.model) {
        return Err(FlowError::NoAndoyer);
    }
    let parameters = fixed_parameters(case, seed, 0)?;
    let chart = Chart::new(&case.model, &parameters, g0, energy)?;
    Ok(points.iter().map(|at| chart.start(*at)).collect())
}

/// Evaluates a claim's formula at each start; NaN where there is no state.
pub fn values_at_starts(
    case: &Case,
    request: &SectionRequest,
    claim: &str,
) -> Result<Vec<f64>, FlowError> {
    let formula = case.claim(claim).and_then(|claim| claim.kind.formula());
    let formula = formula.ok_or_else(|| FlowError::NoSuchClaim(claim.to_string()))?;
    let parameters = fixed_parameters(case, request.seed, request.index)?;
    let chart = Chart::new(&case.model, &parameters, &request.g0, &request.energy)?;
    let (graph, values) = record(case.model.dimension(), |state| {
        point(&case.model, &parameters, state).evaluate(formula).components()
    })?;
    let tape = Tape::new(&graph, &values[..1]);
    let mut evaluator = Evaluator::new(&tape, Pairs);
    let mut at = |start: Start| {
        evaluator.run(&start.state);
        evaluator.output(0).hi
    };
    Ok(request.starts.iter().map(|l_z| chart.start(*l_z).map_or(f64::NAN, &mut at)).collect())
}

/// Finished orbits by index, with their final states.
type Done = Vec<(usize, (SectionOrbit, Option<Vec<Pair>>))>;

/// Orbits of one thread.
struct Worker<'w, T: Number<One = f64>> {
    request: &'w SectionRequest,
    starts: &'w [Result<Start, FlowError>],
    queue: &'w Queue,
    stepper: Stepper<T>,
    running: Vec<Option<Running>>,
    done: Done,
}

/// Orbit in a lane.
struct Running {
    index: usize,
    orbit: SectionOrbit,
    sides: Sides,
    /// Number of crossings in the direction that counts, including those left out.
    counted: usize,
    /// Steps and crossings in the other direction at the last crossing that counts.
    last_met: (u64, usize),
}

impl<'w, T: Number<One = f64>> Worker<'w, T> {
    fn new(
        program: &Program,
        request: &'w SectionRequest,
        starts: &'w [Result<Start, FlowError>],
        queue: &'w Queue,
    ) -> Self {
        let stepper = Stepper::new(program, Accuracy::FLOAT);
        let running = (0..T::LANES).map(|_| None).collect();
        Self { request, starts, queue, stepper, running, done: Vec::new() }
    }

    fn run(&mut self, progress: &(dyn Fn() + Sync)) -> Done {
        loop {
            for lane in 0..T::LANES {
                if self.running[lane].is_none() {
                    self.fill(lane, progress);
                }
            }
            if self.running.iter().all(Option::is_none) {
                return std::mem::take(&mut self.done);
            }
            self.stepper.expand();
            for lane in 0..T::LANES {
                if self.look(lane) {
                    self.finish(lane);
                    progress();
                }
            }
            self.stepper.advance();
        }
    }

    /// Puts the next orbit into a lane; orbits without a start end immediately.
    fn fill(&mut self, lane: usize, progress: &(dyn Fn() + Sync)) {
        loop {
            let Some(index) = self.queue.take() else { return };
            let start = &self.starts[index];
            let orbit = SectionOrbit {
                start: self.request.starts[index],
                crossings: Vec::new(),
                others: 0,
                tangencies: 0,
                steps: 0,
                drift: 0.0,
                problem: None,
            };
            match start {
                Ok(start) => {
                    let until = if self.request.backwards { -NEVER } else { NEVER };
                    self.stepper.start(lane, &start.state, Pair::from_f64(until));
                    let sides = Sides::default();
                    let running = Running { index, orbit, sides, counted: 0, last_met: (0, 0) };
                    self.running[lane] = Some(running);
                    return;
                }
                Err(problem) => {
                    let orbit = SectionOrbit { problem: Some(problem.clone()), ..orbit };
                    self.done.push((index, (orbit, None)));
                    progress();
                }
            }
        }
    }

    /// Collects the crossings of the present piece. Returns whether the orbit is done.
    fn look(&mut self, lane: usize) -> bool {
        let Some(running) = &mut self.running[lane] else { return false };
        if let Err(problem) = self.stepper.check(lane) {
            running.orbit.problem = Some(problem);
            return true;
        }
        let steps = self.stepper.steps(lane);
        let piece = self.stepper.piece(lane);
        let polynomial = piece.output(0);
        for event in running.sides.events(&polynomial, piece.length()) {
            if running.meet(event, &piece, self.request, steps) {
                return true;
            }
        }
        let others = running.orbit.others - running.last_met.1;
        let is_lost = steps - running.last_met.0 > MAX_STEPS_BETWEEN || others > MAX_OTHERS;
        if is_lost || self.stepper.is_done(lane) {
            let (time, crossings) = (self.stepper.time(lane).hi, running.counted);
            running.orbit.problem = Some(FlowError::NeverCrossed { time, crossings, others });
            return true;
        }
        false
    }

    fn finish(&mut self, lane: usize) {
        let Some(mut running) = self.running[lane].take() else { return };
        running.orbit.steps = self.stepper.steps(lane);
        let end = self.stepper.pairs(lane);
        let end = end.iter().all(|x| x.is_finite()).then_some(end);
        self.done.push((running.index, (running.orbit, end)));
    }
}

impl Running {
    /// Records an event. Returns whether the orbit has all its crossings.
    fn meet<T: Number<One = f64>>(
        &mut self,
        event: Event<f64>,
        piece: &Piece<'_, T>,
        request: &SectionRequest,
        steps: u64,
    ) -> bool {
        let (after, rising) = match event {
            Event::Tangency { .. } => {
                self.orbit.tangencies += 1;
                return false;
            }
            Event::Crossing { after, rising } => (after, rising),
        };
        // The other half of the circle is g = g₀ + π, where g' has the other sign too.
        if value(&piece.output(1), after).0 <= 0.0 {
            return false;
        }
        let counts = match request.direction {
            Direction::Both => true,
            Direction::Up => rising,
            Direction::Down => !rising,
        };
        if !counts {
            self.orbit.others += 1;
            return false;
        }
        self.counted += 1;
        self.last_met = (steps, self.orbit.others);
        if self.counted > request.skip {
            let at = coordinates(&piece.state(after));
            self.orbit.crossings.push(Crossing { at, time: piece.begin().hi + after, rising });
        }
        self.counted >= request.skip + request.crossings
    }
}
