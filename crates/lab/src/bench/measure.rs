//! Measurement of times by interleaved rounds, and of errors against a reference.

use std::hint::black_box;
use std::time::Duration;

use super::candidate::Candidate;
use super::reference::reference;
use super::subject::{BenchCandidate, BenchClaim};
use super::{BenchError, BenchOptions, MethodMeasurements, Selection};
use crate::clock::thread_time;
use liouville::number::arb::Approximation;
use liouville::verdict::TAPE_LANES;

/// Minimum run time of a candidate in a round, so that the clock's overhead is negligible.
const ROUND: Duration = Duration::from_micros(100);
/// Run time after which a candidate skips the remaining rounds.
const ENOUGH: Duration = Duration::from_millis(40);
/// Minimum number of rounds: a burst of other work may spoil a few.
const FEWEST: usize = 9;
/// Number of blocks at which errors are measured where only engines run.
const FEW_BLOCKS: usize = 4;

/// Measures all rows of a subject.
pub fn measure(
    subject: &BenchClaim<'_>,
    options: &BenchOptions,
    progress: &dyn Fn(f64),
) -> Result<Vec<MethodMeasurements>, BenchError> {
    let blocks = subject.states().len();
    let compared = match options.selection {
        Selection::All => blocks,
        Selection::Engines => blocks.min(FEW_BLOCKS),
    };
    let truth = reference(subject.residual(), &subject.states()[..compared]);
    let scales = subject.scales(compared)?.concat();
    let mut entries = subject.entries(options.selection);
    let times = times(&mut entries, blocks, options.rounds, progress);
    let rows = entries.iter_mut().zip(times).map(|(entry, samples)| {
        let found = values(entry.candidate.as_mut(), compared);
        let errors =
            sorted(found.iter().zip(&truth).zip(&scales).map(|((found, truth), scale)| {
                let (value, truth) = (found.0.as_ref()?, truth.as_ref()?);
                Some(value.add(&truth.neg(), u32::MAX).enclosure().0.abs() / scale)
            }));
        let bounds = sorted(found.iter().zip(&scales).map(|(found, scale)| Some(found.1? / scale)));
        MethodMeasurements {
            method: entry.method,
            domain: entry.domain,
            ns_per_state: samples.get(samples.len() / 2).copied().unwrap_or(f64::NAN),
            least_ns_per_state: samples.first().copied().unwrap_or(f64::NAN),
            operations: entry.operations,
            setup_us: entry.set_up.as_secs_f64() * 1e6,
            max_error: errors.last().copied(),
            median_error: errors.get(errors.len() / 2).copied(),
            max_bound: bounds.last().copied(),
            states: errors.len(),
        }
    });
    Ok(rows.collect())
}

/// Finite numbers in increasing order; all others are dropped.
fn sorted(values: impl Iterator<Item = Option<f64>>) -> Vec<f64> {
    let mut values: Vec<f64> = values.flatten().filter(|value| value.is_finite()).collect();
    values.sort_by(f64::total_cmp);
    values
}

/// Results of a candidate at every state, with their bounds.
fn values(
    candidate: &mut dyn Candidate,
    blocks: usize,
) -> Vec<(Option<Approximation>, Option<f64>)> {
    let mut values = Vec::with_capacity(blocks * TAPE_LANES);
    for block in 0..blocks {
        candidate.run(block);
        values.extend((0..TAPE_LANES).map(|lane| (candidate.value(lane), candidate.bound(lane))));
    }
    values
}

/// Nanoseconds per state in increasing order, a list for each candidate. In each round every
/// candidate runs in turn, so that a change of the machine's speed affects them all.
fn times(
    entries: &mut [BenchCandidate<'_>],
    blocks: usize,
    rounds: usize,
    progress: &dyn Fn(f64),
) -> Vec<Vec<f64>> {
    let repeats: Vec<u32> = entries.iter_mut().map(|entry| calibrate(entry, blocks)).collect();
    let mut samples: Vec<Vec<f64>> = vec![Vec::with_capacity(rounds); entries.len()];
    let mut spent = vec![Duration::ZERO; entries.len()];
    for round in 0..rounds {
        for (k, entry) in entries.iter_mut().enumerate() {
            if round >= FEWEST && spent[k] > ENOUGH {
                continue;
            }
            let time = pass(entry.candidate.as_mut(), repeats[k], blocks);
            spent[k] += time;
            let states = f64::from(repeats[k]) * TAPE_LANES as f64;
            samples[k].push(time.as_secs_f64() * 1e9 / states);
        }
        progress(1.0 / rounds as f64);
    }
    samples.iter_mut().for_each(|samples| samples.sort_by(f64::total_cmp));
    samples
}

/// Number of blocks that fill a round. The first pass warms caches, the second counts.
fn calibrate(entry: &mut BenchCandidate<'_>, blocks: usize) -> u32 {
    pass(entry.candidate.as_mut(), 1, blocks);
    let once = pass(entry.candidate.as_mut(), 1, blocks).as_nanos().max(1);
    u32::try_from(ROUND.as_nanos().div_ceil(once)).unwrap_or(u32::MAX)
}

/// Runs `repeats` blocks, one after the other.
fn pass(candidate: &mut dyn Candidate, repeats: u32, blocks: usize) -> Duration {
    let started = thread_time();
    for block in (0..blocks).cycle().take(repeats as usize) {
        black_box(&mut *candidate).run(black_box(block));
    }
    thread_time().saturating_sub(started)
}
