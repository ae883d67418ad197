//! Samples of motions at equal intervals of time, from the polynomials of their steps.

use crate::error::FlowError;
use crate::motion::columns::{Columns, Gauge};
use crate::motion::orbit::{Orbit, Precision, sampled};
use crate::motion::start::Start;
use crate::taylor::batch::each;
use crate::taylor::number::SeriesNumber;
use crate::taylor::stepper::MotionPiece;
use crate::told::ToldShare;
use liouville::case::Case;
use liouville::number::double_double::DoubleDouble;
use liouville::number::rational::Rational;

/// Columns and interval of samples: at the times 0, Δ, 2Δ, … up to the end.
pub struct Sampling<'s> {
    /// Columns of each row.
    pub columns: &'s Columns,
    /// Interval Δ, above 0 also backwards in time.
    pub every: Rational,
    /// Whether samples are taken within steps too, as a picture needs them where a motion is fast.
    pub with_steps: bool,
}

/// A motion with its samples.
pub struct SampledOrbit {
    /// Motion as a whole, or the reason why it ended early or did not start.
    pub orbit: Result<Orbit, FlowError>,
    /// Rows of samples, up to the end or to where the motion ended early.
    pub rows: Vec<Vec<DoubleDouble>>,
}

/// Follows several motions, each with samples if these are requested. Calls `progress` with
/// shares of a motion as they are done.
pub fn orbits(
    case: &Case,
    starts: &[Result<Start, FlowError>],
    (time, precision): (&Rational, Precision),
    sampling: Option<&Sampling<'_>>,
    threads: usize,
    progress: &(dyn Fn(f64) + Sync),
) -> Vec<SampledOrbit> {
    each(starts.len(), threads, &|index| {
        let mut told = ToldShare::default();
        let mut reach = |share| told.reach(share, progress);
        let found = one(case, &starts[index], (time, precision), sampling, &mut reach);
        told.finish(progress);
        found
    })
}

fn one(
    case: &Case,
    start: &Result<Start, FlowError>,
    (time, precision): (&Rational, Precision),
    sampling: Option<&Sampling<'_>>,
    reach: &mut dyn FnMut(f64),
) -> SampledOrbit {
    let failed = |problem| SampledOrbit { orbit: Err(problem), rows: Vec::new() };
    let start = match start {
        Ok(start) => start.clone(),
        Err(problem) => return failed(problem.clone()),
    };
    let gauge = sampling.map(|sampling| sampling.columns.recorded(&start.parameters));
    let gauge = match gauge.transpose() {
        Ok(gauge) => gauge,
        Err(problem) => return failed(problem),
    };
    let mut samples = match sampling.zip(gauge.as_ref()) {
        Some((sampling, gauge)) => Samples::new(gauge, sampling, time),
        None => Samples::nothing(),
    };
    let until = DoubleDouble::from_rational(time);
    let orbit = sampled(case, start, until, precision, (&mut samples, reach));
    SampledOrbit { orbit, rows: samples.rows }
}

/// Number of samples within a step, halved after each of so many of them, down to 1.
const PARTS: u32 = 8;
const MANY: usize = 24_000;

/// Function from a time and a state to a row.
type Row<'s> = Box<dyn FnMut(DoubleDouble, &[DoubleDouble]) -> Vec<DoubleDouble> + 's>;

/// Samples taken so far.
pub(crate) struct Samples<'s> {
    row: Option<Row<'s>>,
    /// Interval, negative backwards in time, and number of samples at its multiples.
    every: Rational,
    count: i64,
    /// Number of samples in the present step; 0 for none within steps.
    parts: u32,
    rows: Vec<Vec<DoubleDouble>>,
}

impl<'s> Samples<'s> {
    /// Takes no samples.
    pub fn nothing() -> Self {
        Self { row: None, every: Rational::from(0), count: 0, parts: 0, rows: Vec::new() }
    }

    fn new(gauge: &'s Gauge, sampling: &Sampling<'_>, time: &Rational) -> Self {
        let sign = Rational::from(if time.to_f64().0 < 0.0 { -1 } else { 1 });
        let every = &sampling.every * &sign;
        let parts = if sampling.with_steps { PARTS } else { 0 };
        Self { row: Some(Box::new(gauge.rows())), every, count: 0, parts, rows: Vec::new() }
    }

    /// Time of the next sample, rounded once.
    fn next(&self) -> DoubleDouble {
        DoubleDouble::from_rational(&(&self.every * &Rational::from(self.count)))
    }

    /// Takes the samples of a piece of the motion that begins at a time.
    pub fn piece<T: SeriesNumber<One = T>>(
        &mut self,
        begin: DoubleDouble,
        piece: &MotionPiece<'_, T>,
        length: T,
    ) {
        let Some(mut row) = self.row.take() else { return };
        let forwards = length.leading() >= 0.0;
        let is_fast = self.is_fast(piece.duration(length));
        loop {
            let next = self.next();
            let after = piece.after(next - begin);
            let beyond = after - length.pair();
            if beyond.hi != 0.0 && (beyond.hi > 0.0) == forwards {
                break;
            }
            if !is_fast {
                self.rows.push(row(next, &piece.state(T::split(after).0)));
            }
            self.count += 1;
            // Steps of length 0 do not move on.
            if length.leading() == 0.0 {
                break;
            }
        }
        for part in (1..=self.parts).filter(|_| is_fast) {
            let after = length * T::float(f64::from(part) / f64::from(self.parts));
            self.rows.push(row(begin + piece.duration(after), &piece.state(after)));
        }
        if self.parts > 0 {
            self.parts = (PARTS >> (self.rows.len() / MANY).min(31)).max(1);
        }
        self.row = Some(row);
    }

    /// Whether samples within a piece are nearer to each other than those at intervals.
    fn is_fast(&self, duration: DoubleDouble) -> bool {
        let least = duration.hi.abs() / f64::from(self.parts.max(1));
        self.parts > 0 && duration.hi != 0.0 && least < self.every.to_f64().0.abs()
    }

    /// Takes the sample at the end, where one is due.
    pub fn end(&mut self, time: DoubleDouble, state: &[DoubleDouble]) {
        let next = self.next();
        let Some(row) = &mut self.row else { return };
        if (next - time).hi == 0.0 {
            self.rows.push(row(time, state));
        }
    }
}
