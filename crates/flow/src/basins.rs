//! Basins of attraction: the set to which each motion of a grid of starts keeps at late times.

use super::attractors::{SAMPLES, Sets, Tail};
use super::axis::{AxisMistake, range};
use super::batch::{MOTION_LANES, Queue, in_batches};
use super::columns::{Columns, Gauge};
use super::error::FlowError;
use super::lanes::Lanes;
use super::launch::Launches;
use super::lyapunov::Exponents;
use super::motion::program;
use super::program::TaylorProgram;
use super::shadow::{ShadowStart, Shadowed};
use super::start::{Start, two_sided};
use super::stepper::{Accuracy, Stepper};
use liouville::case::Case;
use liouville::formula::canonical_name;
use liouville::number::double_double::DoubleDouble;
use liouville::number::rational::Rational;

/// Number of motions whose samples are kept at once.
const WAVE: usize = 4096;
/// Share of the time after which samples are taken.
const LATE: f64 = 0.5;
/// Fraction of the golden section: the times of samples are in step with no period.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// Component of the state that varies over a grid.
#[derive(Clone, Debug)]
pub struct StateAxis {
    /// Name of the component.
    pub name: String,
    /// Its index in the state.
    pub component: usize,
    /// Lower end.
    pub from: Rational,
    /// Upper end.
    pub to: Rational,
    /// Number of points; the first and the last are half a step inside.
    pub count: usize,
}

impl StateAxis {
    /// Reads an axis `NAME=a..b` of `count` points.
    pub fn read(case: &Case, text: &str, count: usize) -> Result<Self, AxisMistake> {
        let (name, from, to) = range(text)?;
        let name = canonical_name(name).unwrap_or_else(|| name.to_string());
        let known: Vec<String> =
            (0..case.model.dimension()).map(|k| case.model.component_name(k)).collect();
        let component = known.iter().position(|known| *known == name).ok_or_else(|| {
            let message = format!("`{name}` is not a component of the state");
            AxisMistake { message, help: format!("vary two of {}", known.join(", ")) }
        })?;
        Ok(Self { name, component, from, to, count })
    }

    /// Value at a point of the axis.
    pub fn value(&self, index: usize) -> Rational {
        let share = Rational::new(2 * index as i64 + 1, 2 * self.count as i64);
        &self.from + &(&(&self.to - &self.from) * &share)
    }
}

/// Request for the basins of a grid of starts.
pub struct BasinRequest<'r> {
    /// Components that vary, across and upwards.
    pub axes: &'r [StateAxis; 2],
    /// State that gives the other components; starts are moved to the level.
    pub base: &'r [Rational],
    /// Energy of the starts; by default each has that of its state.
    pub energy: Option<&'r Rational>,
    /// Values by which sets are told apart.
    pub columns: &'r Columns,
    /// Time for which each motion is followed; the later half counts.
    pub time: f64,
    /// Seed of the free parameters.
    pub seed: u64,
}

/// End of a motion.
#[derive(Clone, Debug, PartialEq)]
pub enum Destiny {
    /// It keeps to the set with this index.
    Set(usize),
    /// It keeps to a set beyond the largest number of them.
    Further,
    /// It does not return to where it was: it drifts, leaves, or needs more time.
    Unsettled,
    /// It has no start, or ended early.
    Ended(FlowError),
}

/// Set to which motions keep.
#[derive(Clone, Debug)]
pub struct Attractor {
    /// Number of motions that keep to it.
    pub count: usize,
    /// Smallest and largest value of each column on its first motion.
    pub ranges: Vec<[f64; 2]>,
    /// Whether it is a single point.
    pub is_point: bool,
    /// State of its first motion at the end.
    pub state: Vec<f64>,
    /// Exponents of its first motion, from its end on.
    pub exponents: Result<Exponents, FlowError>,
}

/// Basins of a grid of starts.
#[derive(Clone, Debug)]
pub struct Basins {
    /// End of each motion, row by row from the least value of the second axis.
    pub ends: Vec<Destiny>,
    /// Sets, the one with the most motions first.
    pub attractors: Vec<Attractor>,
}

/// Follows a motion from each point of the grid, and finds the sets to which they keep. Calls
/// `progress` after each motion.
pub fn basins(
    case: &Case,
    request: &BasinRequest<'_>,
    threads: usize,
    progress: &(dyn Fn() + Sync),
) -> Result<Basins, FlowError> {
    two_sided(case)?;
    let [across, up] = request.axes;
    let count = across.count * up.count;
    let order = Order::of(count);
    let launches =
        Launches { case, energy: request.energy, pad: None, seed: request.seed, index: 0 };
    let state = |place: usize| {
        let mut state = request.base.to_vec();
        for (axis, index) in [(across, place % across.count), (up, place / across.count)] {
            state[axis.component] = axis.value(index);
        }
        state
    };
    let mut found = Found::new(count);
    let mut equations = None;
    for wave in (0..count).step_by(WAVE) {
        let places: Vec<usize> =
            (wave..count.min(wave + WAVE)).map(|index| order.place(index)).collect();
        let starts = launches.starts(places.iter().map(|place| state(*place)).collect())?;
        let equations = match &mut equations {
            Some(known) => known,
            none => {
                let Some(first) = starts.iter().flatten().next() else {
                    found.fail(&places, &starts);
                    continue;
                };
                none.insert(Equations::of(case, request, first)?)
            }
        };
        let tails = equations.follow(&starts, request.time, threads, progress);
        if tails.iter().any(|tail| matches!(tail, Err(FlowError::Stopped))) {
            return Err(FlowError::Stopped);
        }
        found.add(&places, tails);
    }
    match equations {
        Some(equations) => found.told(case, &equations.parameters, request.time, threads),
        None => Err(found.first_problem()),
    }
}

/// Order of the motions: the first ones are spread over the grid.
struct Order {
    count: usize,
    stride: usize,
}

impl Order {
    fn of(count: usize) -> Self {
        let first = ((count as f64 * GOLDEN) as usize).max(1);
        let stride = (first..=first + count).find(|stride| common(*stride, count) == 1);
        Self { count, stride: stride.unwrap_or(1) }
    }

    fn place(&self, index: usize) -> usize {
        (index as u128 * self.stride as u128 % self.count as u128) as usize
    }
}

/// Greatest common divisor.
fn common(a: usize, b: usize) -> usize {
    if b == 0 { a } else { common(b, a % b) }
}

/// Samples of a motion, with the state at its end.
type Late = Result<(Vec<Vec<f64>>, Vec<DoubleDouble>), FlowError>;

/// First motion of a set.
struct First {
    ranges: Vec<[f64; 2]>,
    end: Vec<DoubleDouble>,
}

/// Ends found so far.
struct Found {
    ends: Vec<Destiny>,
    sets: Sets,
    firsts: Vec<First>,
    widths: Vec<f64>,
}

impl Found {
    fn new(count: usize) -> Self {
        let ends = vec![Destiny::Unsettled; count];
        Self { ends, sets: Sets::default(), firsts: Vec::new(), widths: Vec::new() }
    }

    /// Notes motions without a start.
    fn fail(&mut self, places: &[usize], starts: &[Result<Start, FlowError>]) {
        for (place, start) in places.iter().zip(starts) {
            if let Err(problem) = start {
                self.ends[*place] = Destiny::Ended(problem.clone());
            }
        }
    }

    fn first_problem(&self) -> FlowError {
        let problem = self.ends.iter().find_map(|end| match end {
            Destiny::Ended(problem) => Some(problem.clone()),
            _ => None,
        });
        problem.unwrap_or(FlowError::NoStart)
    }

    fn add(&mut self, places: &[usize], tails: Vec<Late>) {
        if self.widths.is_empty() {
            self.widths = widths(tails.iter().flatten().flat_map(|(rows, _)| rows));
        }
        for (place, late) in places.iter().zip(tails) {
            let (rows, end) = match late {
                Ok(late) => late,
                Err(problem) => {
                    self.ends[*place] = Destiny::Ended(problem);
                    continue;
                }
            };
            let tail = Tail::new(&rows, &self.widths);
            if !tail.is_settled() {
                continue;
            }
            self.ends[*place] = match self.sets.place(tail) {
                Some(index) => Destiny::Set(index),
                None => Destiny::Further,
            };
            if self.firsts.len() < self.sets.tails().len() {
                self.firsts.push(First { ranges: ranges(&rows), end });
            }
        }
    }

    /// Measures the sets, and brings them into the order of their sizes.
    fn told(
        self,
        case: &Case,
        parameters: &[Rational],
        time: f64,
        threads: usize,
    ) -> Result<Basins, FlowError> {
        let shadowed = Shadowed::new(&case.model, parameters, &[])?;
        let begins: Vec<Result<ShadowStart, FlowError>> = self
            .firsts
            .iter()
            .map(|first| Ok(ShadowStart { state: first.end.clone(), loose: Vec::new() }))
            .collect();
        let exponents = shadowed.follow(&begins, time, threads, &|| {});
        let mut counts = vec![0; self.firsts.len()];
        for end in &self.ends {
            if let Destiny::Set(index) = end {
                counts[*index] += 1;
            }
        }
        let mut order: Vec<usize> = (0..counts.len()).collect();
        order.sort_by_key(|index| std::cmp::Reverse(counts[*index]));
        let attractor = |index: &usize| Attractor {
            count: counts[*index],
            ranges: self.firsts[*index].ranges.clone(),
            is_point: self.sets.tails()[*index].is_point(),
            state: self.firsts[*index].end.iter().map(|x| x.hi).collect(),
            exponents: exponents[*index].clone(),
        };
        let attractors = order.iter().map(attractor).collect();
        let renamed = |end: Destiny| match end {
            Destiny::Set(index) => {
                Destiny::Set(order.iter().position(|own| *own == index).unwrap_or(index))
            }
            other => other,
        };
        Ok(Basins { ends: self.ends.iter().cloned().map(renamed).collect(), attractors })
    }
}

/// Smallest and largest value of each component.
fn ranges<'r>(rows: impl IntoIterator<Item = &'r Vec<f64>>) -> Vec<[f64; 2]> {
    let mut ranges: Vec<[f64; 2]> = Vec::new();
    for row in rows {
        ranges.resize(row.len(), [f64::INFINITY, f64::NEG_INFINITY]);
        for (range, x) in ranges.iter_mut().zip(row) {
            *range = [range[0].min(*x), range[1].max(*x)];
        }
    }
    ranges
}

/// Widths of the components; 1 where there is none.
fn widths<'r>(rows: impl Iterator<Item = &'r Vec<f64>>) -> Vec<f64> {
    let width = |[from, to]: &[f64; 2]| {
        let size = from.abs().max(to.abs());
        let width = to - from;
        if width.is_finite() && width > size * f64::EPSILON * 1e3 { width } else { size.max(1.0) }
    };
    ranges(rows).iter().map(width).collect()
}

/// Equations of all motions.
struct Equations {
    program: TaylorProgram,
    gauge: Gauge,
    parameters: Vec<Rational>,
}

impl Equations {
    fn of(case: &Case, request: &BasinRequest<'_>, first: &Start) -> Result<Self, FlowError> {
        let parameters = first.parameters.clone();
        let program = program(&case.model, &parameters, |_| Vec::new())?;
        let gauge = request.columns.recorded(&parameters)?;
        Ok(Self { program, gauge, parameters })
    }

    /// Follows motions, and takes samples of each at late times.
    fn follow(
        &self,
        starts: &[Result<Start, FlowError>],
        time: f64,
        threads: usize,
        progress: &(dyn Fn() + Sync),
    ) -> Vec<Late> {
        in_batches(starts.len(), threads, |queue, _| {
            let stepper = Stepper::new(&self.program, Accuracy::FLOAT);
            let running = (0..MOTION_LANES).map(|_| None).collect();
            let done = Vec::new();
            Worker { equations: self, starts, time, stepper, running, done }.run(queue, progress)
        })
    }
}

/// Motion in a lane.
struct Running {
    index: usize,
    rows: Vec<Vec<f64>>,
}

/// Motions of one thread.
struct Worker<'w> {
    equations: &'w Equations,
    starts: &'w [Result<Start, FlowError>],
    time: f64,
    stepper: Stepper<Lanes<MOTION_LANES>>,
    running: Vec<Option<Running>>,
    done: Vec<(usize, Late)>,
}

impl Worker<'_> {
    fn run(mut self, queue: &Queue, progress: &(dyn Fn() + Sync)) -> Vec<(usize, Late)> {
        let mut row = self.equations.gauge.rows();
        let mut row = |time: DoubleDouble, state: &[DoubleDouble]| -> Vec<f64> {
            row(time, state).into_iter().map(|x| x.hi).collect()
        };
        loop {
            for lane in 0..MOTION_LANES {
                while self.running[lane].is_none() {
                    let Some(index) = queue.take() else { break };
                    match &self.starts[index] {
                        Ok(start) => {
                            let until = DoubleDouble::from_f64(self.time);
                            self.stepper.start(lane, &start.state, until);
                            self.running[lane] = Some(Running { index, rows: Vec::new() });
                        }
                        Err(problem) => {
                            self.done.push((index, Err(problem.clone())));
                            progress();
                        }
                    }
                }
            }
            if self.running.iter().all(Option::is_none) {
                return self.done;
            }
            self.stepper.expand();
            for lane in 0..MOTION_LANES {
                let Some(running) = &mut self.running[lane] else { continue };
                match self.stepper.check(lane) {
                    Ok(()) => take(&self.stepper, lane, self.time, &mut running.rows, &mut row),
                    Err(problem) => {
                        self.done.push((running.index, Err(problem)));
                        self.running[lane] = None;
                        progress();
                    }
                }
            }
            self.stepper.advance();
            for lane in 0..MOTION_LANES {
                if !self.stepper.is_done(lane) {
                    continue;
                }
                let Some(mut running) = self.running[lane].take() else { continue };
                let end = self.stepper.pairs(lane);
                // The last sample may have been due within rounding of the end.
                running.rows.resize_with(SAMPLES, || row(self.stepper.time(lane), &end));
                let values = running.rows.iter().flatten();
                let late = match values.copied().all(f64::is_finite) {
                    true => Ok((running.rows, end)),
                    false => Err(FlowError::Singular {
                        time: self.time,
                        state: end.iter().map(|x| x.hi).collect(),
                    }),
                };
                self.done.push((running.index, late));
                progress();
            }
        }
    }
}

/// Takes the samples that are due in the present step.
fn take(
    stepper: &Stepper<Lanes<MOTION_LANES>>,
    lane: usize,
    time: f64,
    rows: &mut Vec<Vec<f64>>,
    row: &mut dyn FnMut(DoubleDouble, &[DoubleDouble]) -> Vec<f64>,
) {
    let piece = stepper.piece(lane);
    while rows.len() < SAMPLES {
        let (now, due) = (piece.begin(), due(time, rows.len()));
        let after = (DoubleDouble::from_f64(due) - now).hi;
        if after.abs() > piece.length().abs() {
            return;
        }
        let state = piece.state(after);
        rows.push(row(DoubleDouble::from_f64(due), &state));
    }
}

/// Time of a sample.
fn due(time: f64, index: usize) -> f64 {
    let part = (index as f64 + (index as f64 * GOLDEN).fract()) / SAMPLES as f64;
    time * (LATE + (1.0 - LATE) * part)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_motions_have_their_turn() {
        for count in [1, 2, 3, 10, 64, 2500, 4097] {
            let order = Order::of(count);
            let mut places: Vec<usize> = (0..count).map(|index| order.place(index)).collect();
            places.sort_unstable();
            assert!(places.into_iter().eq(0..count), "{count}");
        }
    }

    #[test]
    fn samples_are_due_in_order_in_the_later_half() {
        let times: Vec<f64> = (0..SAMPLES).map(|k| due(-10.0, k)).collect();
        assert_eq!(times[0], -5.0);
        assert!(times.windows(2).all(|pair| pair[1] < pair[0]) && times[SAMPLES - 1] > -10.0);
    }
}
