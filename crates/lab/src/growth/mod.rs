//! Growth of time and memory with the size of a problem.
//!
//! Each [`CaseFamily`] is judged at sizes that double, within a limit of time. What matters is the
//! exponent in the number of operations of the residuals: a residual of m operations should take
//! O(m) to record.

mod families;
mod memory;

use std::time::{Duration, Instant};

use liouville::case::{Case, CaseError};
use liouville::graph::Fault;
use liouville::verdict::{JudgeError, Options, Trust, Verdict, judge, recorded_size};

pub use families::{CaseFamily, FAMILIES};

/// Measurements of one family at increasing sizes.
#[derive(Clone, Debug, serde::Serialize)]
pub struct FamilyGrowth {
    /// Name of the family.
    pub family: &'static str,
    /// Quantity that the size counts.
    pub counts: &'static str,
    /// Measurements, by size.
    pub points: Vec<SizePoint>,
    /// Exponents fitted to them.
    pub exponents: GrowthExponents,
    /// Reason why the next size was not measured, unless it was the limit of time.
    pub problem: Option<String>,
}

/// Measurements at one size.
#[derive(Clone, Copy, Debug, serde::Deserialize, serde::Serialize)]
pub struct SizePoint {
    /// Size n.
    pub size: u64,
    /// Number of operations of the residuals of all claims together.
    pub operations: usize,
    /// Number of nodes of the graph.
    pub nodes: usize,
    /// Seconds from the text to the case.
    pub read: f64,
    /// Seconds to record all claims.
    pub record: f64,
    /// Seconds of the judgement after that.
    pub judge: f64,
    /// Largest resident memory in bytes, where the system tells.
    pub memory: Option<u64>,
    /// Number of claims.
    pub claims: usize,
    /// Number of claims proved or confirmed; all claims of all families hold.
    pub holding: usize,
}

/// Exponents of growth, fitted to the larger half of the sizes; none from fewer than two.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct GrowthExponents {
    /// Operations of the residuals, in the size.
    pub operations: Option<f64>,
    /// Time to record, in the operations.
    pub record: Option<f64>,
    /// Time of the whole judgement, in the operations (of `states`: in their number).
    pub judge: Option<f64>,
    /// Time of the whole judgement, in the size.
    pub size: Option<f64>,
}

/// Reason why a member of a family was not measured.
#[derive(Debug, thiserror::Error)]
pub enum GrowthError {
    /// The case is refused.
    #[error("{0}")]
    Case(Box<CaseError>),
    /// The case cannot be recorded.
    #[error(transparent)]
    Fault(#[from] Fault),
    /// The case cannot be judged.
    #[error(transparent)]
    Judge(#[from] JudgeError),
}

/// Measures a family at sizes that double, until the next is expected to end after `within`;
/// `at_size` measures one size, or gives the reason why it cannot.
///
/// Memory that was freed stays with a process, so that the peak of each size is known only where
/// each has a process to itself.
pub fn measure(
    family: &CaseFamily,
    within: Duration,
    at_size: impl Fn(&CaseFamily, u64) -> Result<SizePoint, String>,
) -> FamilyGrowth {
    let started = Instant::now();
    let mut points: Vec<SizePoint> = Vec::new();
    let mut size = family.first;
    let mut last = Duration::ZERO;
    let mut problem = None;
    while size <= family.last {
        let begun = Instant::now();
        match at_size(family, size) {
            Ok(point) => points.push(point),
            Err(error) => {
                problem = Some(format!("size {size}: {error}"));
                break;
            }
        }
        let (before, taken) = (last, begun.elapsed());
        last = taken;
        // A doubling costs at least what it did the last time, and not less than twice as much.
        let factor = match before.as_secs_f64() {
            0.0 => 2.0,
            before => (taken.as_secs_f64() / before).max(2.0),
        };
        if started.elapsed() + taken.mul_f64(factor) > within {
            break;
        }
        size *= 2;
    }
    FamilyGrowth {
        family: family.name,
        counts: family.size,
        exponents: exponents(&points, family.counts_states),
        points,
        problem,
    }
}

/// Measures one size of a family alone.
pub fn measure_one(family: &CaseFamily, size: u64) -> FamilyGrowth {
    let only = CaseFamily { first: size, last: size, ..*family };
    let own = |family: &CaseFamily, size| at_size(family, size).map_err(|error| error.to_string());
    measure(&only, Duration::ZERO, own)
}

/// Measures one member of a family.
pub fn at_size(family: &CaseFamily, size: u64) -> Result<SizePoint, GrowthError> {
    memory::forget_peak();
    let text = family.case(size);
    let read = || Case::parse(&text, &[]).map_err(|error| GrowthError::Case(Box::new(error)));
    let (read, case) = least(read)?;
    let (record, recorded) = least(|| Ok(recorded_size(&case)?))?;
    let options = match family.counts_states {
        true => Options { states: size, trust: Trust::Float, ..Options::default() },
        false => Options::default(),
    };
    let (judged, report) = least(|| Ok(judge(&case, &options)?))?;
    let holds = |verdict| matches!(verdict, Verdict::Proved | Verdict::Confirmed);
    Ok(SizePoint {
        size,
        operations: recorded.operations,
        nodes: recorded.nodes,
        read: read.as_secs_f64(),
        record: record.as_secs_f64(),
        judge: judged.saturating_sub(record).as_secs_f64(),
        memory: memory::peak(),
        claims: report.claims.len(),
        holding: report.claims.iter().filter(|claim| holds(claim.verdict)).count(),
    })
}

/// Runs `work`, some times over if it is quick, and returns the least duration and the result.
fn least<R>(work: impl Fn() -> Result<R, GrowthError>) -> Result<(Duration, R), GrowthError> {
    const ENOUGH: Duration = Duration::from_millis(50);
    let started = Instant::now();
    let mut least = Duration::MAX;
    loop {
        let begun = Instant::now();
        let result = work()?;
        least = least.min(begun.elapsed());
        if started.elapsed() >= ENOUGH {
            return Ok((least, result));
        }
    }
}

/// A quantity of a measurement.
type Measure = fn(&SizePoint) -> f64;

/// Fits the exponents to the larger half of the sizes.
fn exponents(points: &[SizePoint], by_size: bool) -> GrowthExponents {
    let larger = &points[points.len() / 2..];
    let larger = if larger.len() < 2 { points } else { larger };
    let fit = |x: Measure, y: Measure| {
        let logarithms = larger.iter().map(|point| (x(point).ln(), y(point).ln()));
        slope(&logarithms.collect::<Vec<_>>())
    };
    let (size, operations): (Measure, Measure) =
        (|point| point.size as f64, |point| point.operations as f64);
    let whole: Measure = |point| point.record + point.judge;
    GrowthExponents {
        operations: fit(size, operations).filter(|_| !by_size),
        record: fit(operations, |point| point.record).filter(|_| !by_size),
        judge: fit(if by_size { size } else { operations }, whole),
        size: fit(size, whole),
    }
}

/// Slope of the line of least squares through some points, if they do not lie above each other.
fn slope(points: &[(f64, f64)]) -> Option<f64> {
    let count = points.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / count;
    let (x, y) = (mean(|point| point.0), mean(|point| point.1));
    let across: f64 = points.iter().map(|point| (point.0 - x) * (point.1 - y)).sum();
    let along: f64 = points.iter().map(|point| (point.0 - x) * (point.0 - x)).sum();
    Some(across / along).filter(|slope| slope.is_finite())
}
