//! States of the first block at which a required value is undefined in f64: whether it exists there, and
//! what the claim says then.

use super::claim_state::ClaimState;
use super::examine::BlockValues;
use super::judging::Judging;
use super::ladder::{FEW_OPERATIONS, LADDER_BITS, Open};
use super::recorded::RecordedClaim;
use super::sampler::{Sampler, TAPE_LANES};
use super::voids::Choice;
use crate::mechanics::Draw;
use crate::number::Enclosing;
use crate::number::arb::Approximation;
use crate::number::ball::{Ball, Balls};
use crate::number::mixed::{Mixed, Number};
use crate::number::prime::Modulus;
use crate::number::rational::Rational;
use crate::proof::{ProofRng, ProofStream};

/// Largest number of states without a value in f64 that are examined further, for residuals of
/// many operations.
const MOST_MISSING: usize = 16;
/// Number of steps through a range, of which states beside another are a few away.
const NEAR: i64 = 1 << 30;
/// Number of directions to neighbours.
const DIRECTIONS: u64 = 3;
/// Number of bits of the components of a direction.
const SHARE_BITS: u32 = 40;
/// Share of doubtful states above which a claim is not confirmed: one in this many.
const MAX_DOUBTFUL: usize = 4;

/// Lists draws of states near a drawn one; none if a draw is not exact.
pub(super) fn neighbours(sampler: &Sampler, index: u64) -> Vec<Vec<Rational>> {
    let drawn = sampler.drawn(&Mixed::new(LADDER_BITS[0]), 1, index).into_iter();
    let exact = drawn.map(|value| match value {
        Number::Exact(value) => Some(value),
        Number::Ball(_) | Number::Nothing | Number::Doubtful => None,
    });
    exact.collect::<Option<Vec<Rational>>>().map_or_else(Vec::new, |own| around(sampler, &own))
}

/// Lists draws on opposite sides of given ones in several directions, in the ranges.
pub(super) fn around(sampler: &Sampler, numbers: &[Rational]) -> Vec<Vec<Rational>> {
    let on_side = |(direction, side): (u64, i64)| {
        let shares = shares(direction, numbers.len());
        let moved = |(k, (value, draw)): (usize, (&Rational, &Draw))| {
            let step = &Rational::new(side * shares[k], 1 << SHARE_BITS) * &Rational::new(1, NEAR);
            match draw {
                Draw::Within(range) => {
                    let away = &step * &(&range.high - &range.low);
                    let moved = value + &away;
                    let is_inside = moved >= range.low && moved <= range.high;
                    if is_inside { moved } else { value - &away }
                }
                Draw::Of(..) => value + &step,
                Draw::OneOf(_) | Draw::Sign => value.clone(),
            }
        };
        numbers.iter().zip(sampler.recipes()).enumerate().map(moved).collect()
    };
    let sides = (0..DIRECTIONS).flat_map(|direction| [(direction, 1), (direction, -1)]);
    sides.map(on_side).collect()
}

/// Components of a direction, hashed: no plane with short coefficients contains all directions.
fn shares(direction: u64, count: usize) -> Vec<i64> {
    let modulus = Modulus::new((1 << 61) - 1);
    let mut rng = ProofRng::new(direction, ProofStream::Neighbours as u64);
    let share = |_| (rng.element(&modulus) >> (61 - SHARE_BITS)) as i64 + 1;
    (0..count).map(share).collect()
}

impl Judging<'_> {
    /// Examines states of the first block at which a required value is undefined in f64: √0 exists.
    pub(super) fn missing_states(&self, sampler: &Sampler, open: &mut Open<'_, '_>) {
        let is_asked = |status: &ClaimState| status.settled.is_none() && !status.missing.is_empty();
        if !open.iter().any(|(_, status)| is_asked(status)) {
            return;
        }
        let found = sampler.is_numerical().then(|| sampler.balls(0));
        let unsettled = open.iter_mut().filter(|(_, status)| status.settled.is_none());
        for (item, status) in unsettled {
            let mut missing = status.missing.clone();
            // Where Newton's method fails there is no state.
            if let Some(found) = &found {
                missing.retain(|lane| found.iter().all(|block| block.is_defined(*lane)));
            }
            if missing.is_empty() {
                continue;
            }
            let (run, layout) = self.lay_out(sampler, std::iter::once(*item), false);
            let (span, domain) = (&layout.spans[0], Mixed::new(LADDER_BITS[0]));
            let is_small = status.evidence.operations <= FEW_OPERATIONS;
            let looked = if is_small { missing.len() } else { missing.len().min(MOST_MISSING) };
            let (mut doubtful, mut unjudged, mut partial, mut supposed) = (0, 0, None, None);
            for lane in &missing[..looked] {
                let index = *lane as u64;
                let state = match &found {
                    Some(found) => found.iter().map(|block| number(block, *lane)).collect(),
                    None => sampler.states(&domain, 1, index),
                };
                let values = run.at(&domain, &state);
                let existing = layout.existing(&values, span);
                let required = [layout.common.clone(), span.requirement.clone()];
                let mut required = required.into_iter().flat_map(|range| values.range(range));
                let is_doubtful = required.any(|value| *value == Number::Doubtful);
                doubtful += usize::from(is_doubtful);
                unjudged += usize::from(is_doubtful);
                if (supposed.is_none() || found.is_some()) && is_doubtful && !status.is_zero {
                    let domain = Mixed::supposing_roots(LADDER_BITS[0]);
                    let state = match &found {
                        Some(_) => state.clone(),
                        None => sampler.states(&domain, 1, index),
                    };
                    let values = run.at(&domain, &state);
                    let residual = values.range(span.residual.clone());
                    let fails = residual.iter().any(|value| Mixed::excludes_zero(value, 0));
                    let exists = layout.existing(&values, span)[0];
                    let is_judged = exists && residual.iter().all(|value| is_known(value));
                    unjudged -= usize::from(is_judged && !fails);
                    supposed = supposed.or((fails && exists).then_some(index));
                }
                if found.is_some() {
                    let residual = values.existing(std::slice::from_ref(&span.residual))[0];
                    if existing[0] && !residual {
                        partial = partial.or(Some(index));
                    }
                    continue;
                }
                // √0 may exist at this state alone, which then does not count.
                if existing[0] && !self.has_neighbour(sampler, index, &run, &layout) {
                    continue;
                }
                let seen = BlockValues { values: &values, existing: &existing };
                let residual = span.residual.clone();
                if self.seek_witness(
                    sampler,
                    index,
                    residual.clone(),
                    &seen,
                    LADDER_BITS[0],
                    status,
                ) {
                    break;
                }
                let residual = values.existing(&[residual]);
                match (existing[0], residual[0]) {
                    (true, true) => status.undefined = None,
                    // Where √X is 0 on an open set, its derivative is not X'/(2√X).
                    (true, false) => partial = partial.or(Some(index)),
                    (false, _) => {}
                }
            }
            if let Some(index) = supposed.filter(|_| status.settled.is_none()) {
                status.blurred.get_or_insert_with(|| {
                    format!(
                        "at state {index} it is not known whether a root has a value, as what is under \
                         it is 0 up to rounding; if it has one, the claim fails there"
                    )
                });
            }
            if let Some(index) = partial.filter(|_| !status.is_zero) {
                status.blurred.get_or_insert_with(|| {
                    format!(
                        "at state {index} all that is written has a value, but the residual has none"
                    )
                });
            }
            // A part of a level that is not divided may have few of the states.
            let is_dark = match &found {
                Some(_) => unjudged > 0,
                None => doubtful * missing.len() * MAX_DOUBTFUL >= looked * TAPE_LANES,
            };
            if is_dark && !status.is_zero {
                let doubtful = if found.is_some() { unjudged } else { doubtful };
                status.blurred.get_or_insert_with(|| {
                    format!(
                        "at {doubtful} of {looked} states it is not known whether the formula has a \
                         value"
                    )
                });
            }
        }
    }
}

impl Judging<'_> {
    /// Remarks of a claim that holds, or of whose residual no value is known, at how many of the states of the first
    /// block it says nothing, as a formula of it has no value there; states with listed values that are named
    /// already are left out.
    pub(super) fn remark_missing(
        &self,
        sampler: &Sampler,
        (item, status): (&RecordedClaim<'_>, &mut ClaimState),
        voids: &[Choice],
    ) {
        let is_asked = status.holds() || status.is_unseen;
        if status.missing.is_empty() || !is_asked || item.claim.kind.is_negated() {
            return;
        }
        let (run, layout) = self.lay_out(sampler, std::iter::once(item), false);
        let (span, domain) = (&layout.spans[0], Mixed::new(LADDER_BITS[0]));
        let blocks = sampler.balls(0);
        let values = run.at(&Ball::<TAPE_LANES>, &blocks);
        let mut is_counted = values.existing(std::slice::from_ref(&layout.common));
        let (mut count, mut doubtful) = (0, 0);
        for (lane, is_counted) in is_counted.iter_mut().enumerate().filter(|(_, own)| **own) {
            let index = lane as u64;
            let is_void = |numbers: &[Number]| voids.iter().any(|void| has(numbers, void));
            if !voids.is_empty() && is_void(&sampler.drawn(&domain, 1, index)) {
                *is_counted = false;
                continue;
            }
            if !status.missing.contains(&lane) {
                continue;
            }
            let state = match sampler.is_numerical() {
                true => blocks.iter().map(|block| number(block, lane)).collect(),
                false => sampler.states(&domain, 1, index),
            };
            let values = run.at(&domain, &state);
            let required = values.range(span.requirement.clone());
            let is_any = |number: Number| required.iter().any(|value| **value == number);
            match is_any(Number::Nothing) {
                true => count += 1,
                false => doubtful += usize::from(is_any(Number::Doubtful)),
            }
        }
        let states = is_counted.into_iter().filter(|own| *own).count();
        if count == 0 && status.holds() && doubtful * MAX_DOUBTFUL >= states.max(1) {
            status.evidence.add_remark(format!(
                "at {doubtful} of {states} states it is not known whether a formula has a value"
            ));
        }
        if count > 0 {
            status.is_silent = count == states;
            let remark = format!(
                "nothing is said at {count} of {states} states, where a formula has no value"
            );
            status.evidence.add_remark(remark);
        }
    }
}

/// Whether drawn numbers have these values, as far as they are given.
fn has(numbers: &[Number], choice: &Choice) -> bool {
    numbers.iter().zip(choice).all(|(number, value)| match (number, value) {
        (_, None) => true,
        (Number::Exact(own), Some(value)) => own == value,
        _ => false,
    })
}

/// Whether a number is known to exist.
fn is_known(value: &Number) -> bool {
    matches!(value, Number::Exact(_) | Number::Ball(_))
}

/// Number enclosed by a ball in f64.
fn number<const N: usize>(block: &Balls<N>, lane: usize) -> Number {
    Approximation::from_double_double(block.mid[lane], 0.0, block.rad[lane])
        .map_or(Number::Doubtful, Number::Ball)
}
