//! Results of a claim at a block of states, without values of single states and without allocation
//! for each state.

#![allow(clippy::needless_range_loop, reason = "loops over lanes become vectors")]

use std::ops::Range;

use super::recorded::OutputLayout;
use super::sampler::TAPE_LANES;
use crate::graph::{Kernel, with_widest_vectors};

/// Residuals of a claim at a block of states.
#[derive(Clone, Copy, Debug, Default)]
pub struct Passed {
    /// Number of states that count, with all residuals enclosed.
    pub states: usize,
    /// Largest midpoint, in magnitude.
    pub largest: f64,
    /// Largest ratio of a midpoint to its radius, in magnitude.
    pub scaled: f64,
    /// Whether some enclosure excludes 0.
    pub excludes_zero: bool,
}

/// Less than the smallest factor that roundings leave of a bound.
const MARGIN: f64 = 1.0 - 1.0 / (1 << 20) as f64;
/// Products at least as large have no part below the least f64; 2⁻⁹⁰⁰.
const LEAST: f64 = f64::from_bits((1023 - 900) << 52);

impl Passed {
    /// Ratio of a midpoint to its radius in units of the roundoff below which a state shows nothing
    /// new: its ratio to the radius is at most `known`, and its enclosure contains 0.
    pub fn limit(known: f64) -> f64 {
        let limit = known.min(1.0) * MARGIN * (f64::EPSILON / 2.0);
        // Also where nothing is known: then 0 alone is below.
        if limit >= LEAST { limit } else { 0.0 }
    }
}

/// Combined results of several blocks.
#[derive(Clone, Copy, Debug, Default)]
pub struct Total {
    /// Sum over the blocks.
    pub all: Passed,
    /// The last block.
    pub last: Passed,
}

impl Total {
    /// Adds a block.
    pub fn add(&mut self, block: &Passed) {
        self.all.states += block.states;
        self.all.largest = self.all.largest.max(block.largest);
        self.all.scaled = self.all.scaled.max(block.scaled);
        self.last = *block;
    }
}

/// Midpoints and radii of a block of balls.
pub type BallParts<'b> = [&'b [f64; TAPE_LANES]; 2];

/// Examines the values of all claims at one block of states, of which parts that may not exist are
/// given.
pub fn passed<'b>(
    states: impl Iterator<Item = BallParts<'b>>,
    output: impl Fn(usize) -> BallParts<'b>,
    layout: &OutputLayout,
) -> Vec<Passed> {
    let mut found = vec![Passed::default(); layout.spans.len()];
    with_widest_vectors(Pass { states, output, layout, found: &mut found });
    found
}

/// Examines midpoints and lower bounds of radii, in units of the roundoff, of the residuals of all
/// claims at one block of states that exist, claim after claim. `None` where a midpoint is not below
/// its bound times the limit of its claim, so that the radii matter.
pub fn passed_below<'b>(
    output: impl Fn(usize) -> Option<BallParts<'b>>,
    layout: &OutputLayout,
    limits: &[f64],
) -> Option<Vec<Passed>> {
    let count = layout.residuals().count();
    let outputs: Vec<BallParts<'b>> = (0..count).map(output).collect::<Option<_>>()?;
    let mut found = vec![Passed::default(); layout.spans.len()];
    let mut is_enough = true;
    let is_below = &mut is_enough;
    with_widest_vectors(PassBelow {
        outputs: &outputs,
        layout,
        limits,
        found: &mut found,
        is_below,
    });
    is_enough.then_some(found)
}

struct PassBelow<'p, 'b> {
    outputs: &'p [BallParts<'b>],
    layout: &'p OutputLayout,
    limits: &'p [f64],
    found: &'p mut [Passed],
    is_below: &'p mut bool,
}

impl Kernel for PassBelow<'_, '_> {
    #[inline(always)]
    fn run(self) {
        let Self { mut outputs, layout, limits, found, is_below } = self;
        let mut outside = [0.0; TAPE_LANES];
        for ((found, span), limit) in found.iter_mut().zip(&layout.spans).zip(limits) {
            let (own, others) = outputs.split_at(span.residual.len());
            outputs = others;
            let mut largest = [0.0; TAPE_LANES];
            for [mid, low] in own {
                for lane in 0..TAPE_LANES {
                    let mid = mid[lane].abs();
                    let bound = limit * low[lane] - LEAST;
                    let beyond = mid - if bound > 0.0 { bound } else { 0.0 };
                    largest[lane] = if mid > largest[lane] { mid } else { largest[lane] };
                    outside[lane] = if beyond > outside[lane] { beyond } else { outside[lane] };
                }
            }
            found.states = TAPE_LANES;
            found.largest = most(&largest);
        }
        *is_below = most(&outside) <= 0.0;
    }
}

struct Pass<'p, S, F> {
    states: S,
    output: F,
    layout: &'p OutputLayout,
    found: &'p mut [Passed],
}

/// For each lane, 0 if all values so far are finite, and NaN otherwise.
type Traces = [f64; TAPE_LANES];

impl<'b, S, F> Kernel for Pass<'_, S, F>
where
    S: Iterator<Item = BallParts<'b>>,
    F: Fn(usize) -> BallParts<'b>,
{
    #[inline(always)]
    fn run(self) {
        let Self { states, output, layout, found } = self;
        let mut common = [0.0; TAPE_LANES];
        for block in states {
            trace(&mut common, block);
        }
        trace_all(&mut common, &output, layout.common.clone());
        for (found, span) in found.iter_mut().zip(&layout.spans) {
            let mut traces = common;
            trace_all(&mut traces, &output, span.requirement.clone());
            trace_all(&mut traces, &output, span.residual.clone());
            found.states = traces.iter().map(|trace| usize::from(!trace.is_nan())).sum();
            let mut largest = [0.0; TAPE_LANES];
            let (mut scaled, mut outside) = (largest, largest);
            for index in span.residual.clone() {
                let [mid, rad] = output(index);
                for lane in 0..TAPE_LANES {
                    // NaN if the state does not count; maxima ignore it.
                    let mid = mid[lane].abs() + traces[lane];
                    let ratio = mid / rad[lane];
                    let ratio = if mid == 0.0 { 0.0 } else { ratio };
                    let beyond = mid - rad[lane];
                    largest[lane] = if mid > largest[lane] { mid } else { largest[lane] };
                    scaled[lane] = if ratio > scaled[lane] { ratio } else { scaled[lane] };
                    outside[lane] = if beyond > outside[lane] { beyond } else { outside[lane] };
                }
            }
            found.excludes_zero = most(&outside) > 0.0;
            (found.largest, found.scaled) = (most(&largest), most(&scaled));
        }
    }
}

/// Largest of some numbers of which none is NaN or negative: eight maxima side by side, and then theirs.
#[inline(always)]
fn most(lanes: &[f64; TAPE_LANES]) -> f64 {
    const AT_ONCE: usize = 8;
    const { assert!(TAPE_LANES.is_multiple_of(AT_ONCE), "no lane is left over") };
    let larger = |a: f64, b: f64| if b > a { b } else { a };
    let mut largest = [0.0; AT_ONCE];
    for start in (0..TAPE_LANES).step_by(AT_ONCE) {
        for lane in 0..AT_ONCE {
            largest[lane] = larger(largest[lane], lanes[start + lane]);
        }
    }
    largest.into_iter().fold(0.0, larger)
}

#[inline(always)]
fn trace_all<'b>(
    traces: &mut Traces,
    output: impl Fn(usize) -> BallParts<'b>,
    outputs: Range<usize>,
) {
    for index in outputs {
        trace(traces, output(index));
    }
}

/// Adds 0 where the lane is finite, and NaN elsewhere.
#[inline(always)]
fn trace(traces: &mut Traces, [mid, rad]: BallParts<'_>) {
    for lane in 0..TAPE_LANES {
        traces[lane] += mid[lane] * 0.0 + rad[lane] * 0.0;
    }
}

#[cfg(test)]
mod tests {
    use super::super::recorded::Span;
    use super::*;

    fn layout() -> OutputLayout {
        let none = 0..0;
        let span = |residual: Range<usize>| Span {
            residual,
            requirement: none.clone(),
            scale: none.clone(),
            value: none.clone(),
            slope: none.clone(),
            off_level: none.clone(),
            off_general: none.clone(),
            defects: none.clone(),
        };
        OutputLayout { common: 0..0, spans: vec![span(0..1), span(1..3)] }
    }

    #[test]
    fn lower_bounds_pass_no_ratio_above_the_known_one() {
        let layout = layout();
        let unit = f64::EPSILON / 2.0;
        let mut decided = [0, 0];
        for scale in [1.0, 1e-250, 1e-290, 1e-305, 5e-324, 0.0] {
            for known in [0.0, 1e-280, 1e-3, 0.5, 1.0, 7.0] {
                for ratio in [0.0, 0.5, 1.0 - 1e-5, 1.0 - 1e-16, 1.0, 1.0 + 1e-15, 1.5] {
                    // In one lane the midpoint is this multiple of what the known ratio allows.
                    let low = [scale / unit; TAPE_LANES];
                    let rad = low.map(|low| low * unit + f64::MIN_POSITIVE);
                    let mut mid = [0.0; TAPE_LANES];
                    mid[17] = -ratio * f64::min(known, 1.0) * scale;
                    let zero = [0.0; TAPE_LANES];
                    let parts = |index: usize, second| match index {
                        2 => [&mid, second],
                        _ => [&zero, second],
                    };
                    let limits = [Passed::limit(0.0), Passed::limit(known)];
                    let below = passed_below(|index| Some(parts(index, &low)), &layout, &limits);
                    let whole = passed([].into_iter(), |index| parts(index, &rad), &layout);
                    decided[usize::from(below.is_some())] += 1;
                    let Some(below) = below else { continue };
                    for ((below, whole), known) in below.iter().zip(&whole).zip([0.0, known]) {
                        let place = format!("{scale:e}, {known}, {ratio}");
                        assert_eq!(below.states, whole.states, "{place}");
                        assert_eq!(below.largest, whole.largest, "{place}");
                        assert!(whole.scaled <= known, "{place}: {}", whole.scaled);
                        assert!(!whole.excludes_zero, "{place}");
                    }
                }
            }
        }
        assert!(decided.iter().all(|count| *count > 20), "open and decided: {decided:?}");
    }
}
