//! Ascent from drawn states to one at which an inequality fails, for claims that no other state refutes: a rate
//! that is positive on a thin part of the states.

use super::existence::AtNumbers;
use super::judging::Judging;
use super::ladder::{FEW_OPERATIONS, Open};
use super::recorded::RecordedClaim;
use super::run::Run;
use super::sampler::{Sampler, TAPE_LANES};
use crate::claim::Excess;
use crate::mechanics::Draw;
use crate::number::ball::Ball;
use crate::number::rational::Rational;
use crate::order::StableOrder;

/// Number of states that each height is climbed from.
const STARTS: usize = 8;
/// Largest number of steps of one ascent.
const MOST_STEPS: usize = 96;
/// First step and last, as shares of a range.
const FIRST_STEP: f64 = 0.25;
const LAST_STEP: f64 = 1e-9;
/// Share of a range between its end and the nearest state.
const END: f64 = 1e-6;
/// Numbers of steps through a range to which a found state is rounded, as powers of 2.
const ROUNDINGS: [i32; 4] = [4, 8, 16, 30];

impl Judging<'_> {
    /// Looks for a witness against inequalities that are still open, by climbing to larger values.
    pub(super) fn ascend(&self, sampler: &Sampler, open: &mut Open<'_, '_>) {
        for (item, status) in open.iter_mut() {
            let is_open = status.settled.is_none() && status.undefined.is_none() && !status.is_zero;
            let Some(excess) = &item.context.excess else { continue };
            if !is_open || status.evidence.operations > FEW_OPERATIONS {
                continue;
            }
            let ascent = Ascent::new(self, sampler, item, excess);
            for numbers in ascent.tops() {
                if self.examined_at(item, sampler, &numbers, status) == AtNumbers::Refuted {
                    break;
                }
            }
        }
    }
}

/// Ascent by steps along one draw after another.
struct Ascent<'s> {
    sampler: &'s Sampler,
    run: Run,
    /// Number of values that exist at each state; the excess and its scale follow.
    required: usize,
    /// Lower end and width of the range of each draw that may move.
    ranges: Vec<(usize, f64, f64)>,
}

/// The height that is climbed.
#[derive(Clone, Copy, Debug)]
enum Height {
    Value,
    /// Share of the value in the sum of the moduli of its terms.
    Share,
}

/// A list of draws with its height.
#[derive(Clone, Debug)]
struct Reached {
    draws: Vec<f64>,
    height: f64,
}

impl<'s> Ascent<'s> {
    fn new(
        judging: &Judging<'_>,
        sampler: &'s Sampler,
        item: &RecordedClaim<'_>,
        excess: &Excess,
    ) -> Self {
        let mut outputs = judging.common.required_at(sampler.kept());
        outputs.extend(&item.requirement);
        let required = outputs.len();
        outputs.extend([excess.value, excess.scale]);
        let range = |(k, draw): (usize, &Draw)| match draw {
            Draw::Within(range) | Draw::Of(_, range) => {
                let (low, high) = (range.low.to_f64().0, range.high.to_f64().0);
                Some((k, low, high - low))
            }
            Draw::OneOf(_) | Draw::Sign => None,
        };
        let ranges = sampler.recipes().iter().enumerate().filter_map(range).collect();
        Self { sampler, run: judging.run(&outputs), required, ranges }
    }

    /// Returns draws at which the value is likely to be positive, with few digits first.
    fn tops(&self) -> Vec<Vec<Rational>> {
        let mut all = Vec::new();
        for height in [Height::Value, Height::Share] {
            for start in self.starts(height) {
                let top = self.climbed(start, height);
                if top.height > 0.0 {
                    all.extend(self.rounded(&top.draws));
                    return all;
                }
            }
        }
        all
    }

    /// Returns the highest of the first states.
    fn starts(&self, height: Height) -> Vec<Reached> {
        let drawn = |lane: usize| -> Vec<f64> {
            self.sampler.nearest_draws(lane as u64).into_iter().map(|(value, _)| value).collect()
        };
        let mut all = self.reached((0..TAPE_LANES).map(drawn).collect(), height);
        all.order_by(|a, b| b.height.total_cmp(&a.height));
        all.truncate(STARTS);
        all
    }

    /// Climbs until the value is positive, or no step leads higher.
    fn climbed(&self, start: Reached, height: Height) -> Reached {
        let (mut top, mut step) = (start, FIRST_STEP);
        let mut last: Option<Vec<f64>> = None;
        for _ in 0..MOST_STEPS {
            if top.height > 0.0 || step < LAST_STEP {
                break;
            }
            let along = |(k, low, width): &(usize, f64, f64)| {
                [step, -step].map(|share| {
                    let mut draws = top.draws.clone();
                    draws[*k] = inside(draws[*k] + share * width, *low, *width);
                    draws
                })
            };
            let mut next: Vec<Vec<f64>> = self.ranges.iter().flat_map(along).collect();
            next.extend(last.take().map(|before| self.further(&before, &top.draws)));
            let best =
                self.reached(next, height).into_iter().max_by(|a, b| a.height.total_cmp(&b.height));
            match best.filter(|best| best.height > top.height) {
                Some(best) => last = Some(std::mem::replace(&mut top, best).draws),
                None => step /= 2.0,
            }
        }
        top
    }

    /// Goes on from one list of draws through another.
    fn further(&self, before: &[f64], now: &[f64]) -> Vec<f64> {
        let mut draws = now.to_vec();
        for (k, low, width) in &self.ranges {
            draws[*k] = inside(2.0 * now[*k] - before[*k], *low, *width);
        }
        draws
    }

    /// Computes heights where all that is required has a value.
    fn reached(&self, all: Vec<Vec<f64>>, height: Height) -> Vec<Reached> {
        let mut reached = Vec::with_capacity(all.len());
        for block in all.chunks(TAPE_LANES) {
            let lanes = std::array::from_fn(|lane| block[lane.min(block.len() - 1)].clone());
            let values = self.run.at(&Ball::<TAPE_LANES>, &self.sampler.balls_from(&lanes));
            let existing = values.existing(std::slice::from_ref(&(0..self.required)));
            for (lane, draws) in block.iter().enumerate().filter(|(lane, _)| existing[*lane]) {
                let [value, scale] = [0, 1].map(|k| values.output(self.required + k).mid[lane]);
                let height = match height {
                    Height::Value => value,
                    Height::Share => value / scale,
                };
                if height.is_finite() {
                    reached.push(Reached { draws: draws.clone(), height });
                }
            }
        }
        reached
    }

    /// Rounds draws to fewer and to more digits, those of a list to none.
    fn rounded(&self, draws: &[f64]) -> Vec<Vec<Rational>> {
        let recipes = self.sampler.recipes();
        let exact = |(draw, x): (&Draw, &f64)| match draw {
            Draw::OneOf(values) => values.iter().find(|value| value.to_f64().0 == *x).cloned(),
            _ => Rational::from_f64(*x),
        };
        let exactly = |draws: &[f64]| recipes.iter().zip(draws).map(exact).collect();
        let with = |bits: i32| {
            let mut draws = draws.to_vec();
            for (k, low, width) in &self.ranges {
                let unit = 2f64.powi(width.log2().ceil() as i32 - bits);
                draws[*k] = inside((draws[*k] / unit).round() * unit, *low, *width);
            }
            exactly(&draws)
        };
        ROUNDINGS.into_iter().filter_map(with).chain(exactly(draws)).collect()
    }
}

/// Moves a number that left its range to a state near the end.
fn inside(value: f64, low: f64, width: f64) -> f64 {
    match (low..=low + width).contains(&value) {
        true => value,
        false => value.clamp(low + END * width, low + (1.0 - END) * width),
    }
}
