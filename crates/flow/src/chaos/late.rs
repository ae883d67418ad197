//! Samples of many motions at late times, in the lanes of several threads.

use crate::chaos::attractors::SAMPLES;
use crate::error::FlowError;
use crate::motion::columns::{Columns, Gauge};
use crate::motion::recorded::program;
use crate::motion::start::Start;
use crate::taylor::batch::{MOTION_LANES, Queue, in_batches};
use crate::taylor::lanes::Lanes;
use crate::taylor::program::TaylorProgram;
use crate::taylor::stepper::{Accuracy, Stepper};
use crate::told::ToldShare;
use liouville::case::Case;
use liouville::number::double_double::DoubleDouble;
use liouville::number::rational::Rational;

/// Share of the time after which samples are taken.
const LATE: f64 = 0.5;
/// Part of a step after which a sample is taken again, for its rate.
const BESIDE: f64 = 1e-4;
/// Increment and factors of a counter's hash (SplitMix64; Steele, Lea, Flood 2014).
const COUNTER: u64 = 0x9e37_79b9_7f4a_7c15;
const FACTORS: [u64; 2] = [0xbf58_476d_1ce4_e5b9, 0x94d0_49bb_1331_11eb];

/// Samples of a motion.
pub struct LateSamples {
    /// Values at the start.
    pub first: Vec<f64>,
    /// Values at late times.
    pub rows: Vec<Vec<f64>>,
    /// Their rates there, times the mean time between two samples.
    pub ways: Vec<Vec<f64>>,
    /// State at the end.
    pub end: Vec<DoubleDouble>,
}

/// Samples of a motion, or the reason why there are none.
pub type Late = Result<LateSamples, FlowError>;

/// Equations of all motions, and the values that are sampled.
pub struct LateMotions {
    program: TaylorProgram,
    gauge: Gauge,
    titles: Vec<String>,
}

impl LateMotions {
    /// Compiles the field of a case with these parameters.
    pub fn new(case: &Case, columns: &Columns, parameters: &[Rational]) -> Result<Self, FlowError> {
        let program = program(&case.model, parameters, |_| Vec::new())?;
        let titles = columns.titles().to_vec();
        Ok(Self { program, gauge: columns.recorded(parameters)?, titles })
    }

    /// Follows motions, and takes samples of each at late times. Calls `progress` with shares of a
    /// motion as they are done.
    pub fn follow(
        &self,
        starts: &[Result<Start, FlowError>],
        time: f64,
        threads: usize,
        progress: &(dyn Fn(f64) + Sync),
    ) -> Vec<Late> {
        in_batches(starts.len(), threads, |queue, _| {
            let stepper = Stepper::new(&self.program, Accuracy::FLOAT);
            let running = (0..MOTION_LANES).map(|_| None).collect();
            let done = Vec::new();
            Worker { motions: self, starts, time, stepper, running, done }.run(queue, progress)
        })
    }
}

impl LateMotions {
    /// Title of a column that has no value at the start or in a sample.
    fn missing(&self, running: &Running) -> Option<String> {
        let rows = || [&running.first].into_iter().chain(&running.rows);
        let lacks = |place: usize| rows().any(|row| !row.get(place).is_some_and(|x| x.is_finite()));
        let place = (0..self.titles.len()).find(|place| lacks(*place))?;
        self.titles.get(place).cloned()
    }
}

/// Motion in a lane.
struct Running {
    index: usize,
    first: Vec<f64>,
    rows: Vec<Vec<f64>>,
    ways: Vec<Vec<f64>>,
    /// Share of the motion that was told.
    told: ToldShare,
}

/// Motions of one thread.
struct Worker<'w> {
    motions: &'w LateMotions,
    starts: &'w [Result<Start, FlowError>],
    time: f64,
    stepper: Stepper<Lanes<MOTION_LANES>>,
    running: Vec<Option<Running>>,
    done: Vec<(usize, Late)>,
}

impl Worker<'_> {
    fn run(mut self, queue: &Queue, progress: &(dyn Fn(f64) + Sync)) -> Vec<(usize, Late)> {
        let mut row = self.motions.gauge.rows();
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
                            let first = row(DoubleDouble::default(), &start.state);
                            let (rows, ways, told) = (Vec::new(), Vec::new(), ToldShare::default());
                            self.running[lane] = Some(Running { index, first, rows, ways, told });
                        }
                        Err(problem) => {
                            self.done.push((index, Err(problem.clone())));
                            progress(1.0);
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
                    Ok(()) => take(&self.stepper, lane, self.time, running, &mut row),
                    Err(problem) => {
                        self.done.push((running.index, Err(problem)));
                        running.told.finish(progress);
                        self.running[lane] = None;
                    }
                }
            }
            self.stepper.advance();
            for lane in 0..MOTION_LANES {
                if !self.stepper.is_done(lane) {
                    if let Some(running) = &mut self.running[lane] {
                        running.told.reach(self.stepper.time(lane).hi / self.time, progress);
                    }
                    continue;
                }
                let Some(mut running) = self.running[lane].take() else { continue };
                let end = self.stepper.pairs(lane);
                // The last sample may have been due within rounding of the end.
                running.rows.resize_with(SAMPLES, || row(self.stepper.time(lane), &end));
                running.ways.resize(SAMPLES, vec![0.0; running.first.len()]);
                let missing = self.motions.missing(&running);
                let Running { index, first, rows, ways, mut told } = running;
                let late = match missing {
                    None => Ok(LateSamples { first, rows, ways, end }),
                    Some(column) => Err(FlowError::NoColumnValue { column }),
                };
                self.done.push((index, late));
                told.finish(progress);
            }
        }
    }
}

/// Takes the samples that are due in the present step.
fn take(
    stepper: &Stepper<Lanes<MOTION_LANES>>,
    lane: usize,
    time: f64,
    running: &mut Running,
    row: &mut dyn FnMut(DoubleDouble, &[DoubleDouble]) -> Vec<f64>,
) {
    let piece = stepper.piece(lane);
    let beside = BESIDE * piece.length();
    let beside_time = piece.duration(beside).hi;
    let spacing = time * (1.0 - LATE) / SAMPLES as f64;
    while running.rows.len() < SAMPLES {
        let (now, due) = (piece.begin(), due(time, running.rows.len()));
        let after = piece.after(DoubleDouble::from_f64(due) - now).hi;
        if after.abs() > piece.length().abs() {
            return;
        }
        let state = piece.state(after);
        let own = row(DoubleDouble::from_f64(due), &state);
        let next = row(DoubleDouble::from_f64(due + beside_time), &piece.state(after + beside));
        let way = own.iter().zip(&next).map(|(x, y)| (y - x) / beside_time * spacing).collect();
        running.ways.push(way);
        running.rows.push(own);
    }
}

/// Time of a sample: within the part of its index, at a place as by chance. Places in any regular order
/// are in step with some period, and all samples of a cycle of that period come to few places of it.
fn due(time: f64, index: usize) -> f64 {
    let part = (index as f64 + chance(index)) / SAMPLES as f64;
    time * (LATE + (1.0 - LATE) * part)
}

/// Number from 0 to 1 for an index.
pub fn chance(index: usize) -> f64 {
    let mut bits = (index as u64 + 1).wrapping_mul(COUNTER);
    bits = (bits ^ (bits >> 30)).wrapping_mul(FACTORS[0]);
    bits = (bits ^ (bits >> 27)).wrapping_mul(FACTORS[1]);
    ((bits ^ (bits >> 31)) >> 11) as f64 / (1u64 << 53) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_are_due_in_order_in_the_later_half() {
        let times: Vec<f64> = (0..SAMPLES).map(|k| due(-10.0, k)).collect();
        assert!(times[0] <= -5.0 && times[0] > -5.1);
        assert!(times.windows(2).all(|pair| pair[1] < pair[0]) && times[SAMPLES - 1] > -10.0);
    }
}
