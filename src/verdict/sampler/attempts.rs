//! Draws tried until they lead to a state.

use std::sync::{Arc, Mutex, PoisonError};

use rustc_hash::FxHashMap;

use crate::graph::{Evaluator, Tape};
use crate::number::ball::{Ball, Balls};
use crate::number::mixed::{Mixed, Number};
use crate::number::rational::Rational;

use super::{Sampler, TAPE_LANES};

/// Number of draws tried for a state that has to lie in given ranges.
const ATTEMPTS: u32 = 64;
/// Precision in bits for states that f64 cannot decide.
const EXACT_BITS: u32 = 256;

/// Number of states whose attempts are kept.
const MOST_KEPT: u64 = 1 << 12;

/// A state and the number of parameter sets that are shared.
type Asked = (u64, Option<usize>);

/// The first attempts that lead to states, or 0 where none does.
#[derive(Clone, Default)]
pub(super) struct KnownAttempts(Arc<Mutex<FxHashMap<Asked, u32>>>);

impl KnownAttempts {
    fn get(&self, index: u64, sets: Option<usize>) -> Option<u32> {
        let known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        known.get(&(index, sets)).copied()
    }

    fn keep(&self, index: u64, sets: Option<usize>, attempt: u32) {
        if index < MOST_KEPT {
            let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
            known.insert((index, sets), attempt);
        }
    }
}

/// Returns the set of parameters that a state has if so many sets are shared.
fn set_of(index: u64, sets: usize) -> usize {
    (index % TAPE_LANES as u64) as usize * sets / TAPE_LANES
}

impl Sampler {
    /// Finds, for each of some states, the first attempt at which the draws lead to a state, by
    /// enclosures in f64; the first of all if none does. With few parameter sets, each state uses
    /// those of its set.
    pub(super) fn attempts(&self, start: u64, lanes: usize, sets: Option<usize>) -> Vec<u32> {
        let mut attempts = vec![0; lanes];
        if !self.is_guarded {
            return attempts;
        }
        let mut evaluator = Evaluator::new(&self.tape, Ball::<TAPE_LANES>);
        let facts = Tape::new(&self.graph, if self.has_moduli { &self.facts } else { &[] });
        let mut facts = Evaluator::new(&facts, Ball::<TAPE_LANES>);
        for first in (0..lanes).step_by(TAPE_LANES) {
            let own = &mut attempts[first..lanes.min(first + TAPE_LANES)];
            let at = |lane: usize| start + (first + lane) as u64;
            // Exact numbers take long.
            let known = |lane: usize| self.attempts.get(at(lane), sets).filter(|_| self.has_moduli);
            let mut open = Vec::new();
            for (lane, own) in own.iter_mut().enumerate() {
                match known(lane) {
                    Some(attempt) => *own = attempt,
                    None => open.push(lane),
                }
            }
            let asked = open.clone();
            for attempt in 0..ATTEMPTS {
                if open.is_empty() {
                    break;
                }
                let numbers: Vec<Vec<(f64, bool)>> =
                    open.iter().map(|lane| self.nearest(at(*lane), attempt, sets)).collect();
                let last = open.len() - 1;
                let column = |k: usize| Balls::about(|lane| numbers[lane.min(last)][k]);
                let columns: Vec<Balls<TAPE_LANES>> = (0..self.draws.len()).map(column).collect();
                evaluator.run(&columns);
                let exists = |lane: usize| evaluator.outputs().all(|block| block.is_defined(lane));
                facts.run(&columns);
                // A value that is not negative at states is so, beyond rounding.
                let is_none = |lane: usize| {
                    let is_negative = |block: &Balls<TAPE_LANES>| {
                        block.excludes_zero(lane) && block.mid[lane] < 0.0
                    };
                    facts.outputs().any(is_negative)
                };
                let mut left = Vec::new();
                for (place, lane) in open.iter().enumerate() {
                    let is_state = exists(place)
                        || !is_none(place) && self.exists_exactly(at(*lane), attempt, sets);
                    match is_state {
                        true => own[*lane] = attempt,
                        false => left.push(*lane),
                    }
                }
                open = left;
            }
            if self.has_moduli {
                asked.iter().for_each(|lane| self.attempts.keep(at(*lane), sets, own[*lane]));
            }
        }
        attempts
    }

    /// Whether the draws lead to a state in exact numbers. Only these know that √(y + |y|) exists
    /// for y < 0, so they are asked where a modulus is involved.
    fn exists_exactly(&self, index: u64, attempt: u32, sets: Option<usize>) -> bool {
        if !self.has_moduli {
            return false;
        }
        let domain = Mixed::new(EXACT_BITS);
        let made = self.made_in(&domain, &[self.drawn_numbers(index, attempt, sets)]);
        made.iter().all(|value| matches!(value, Number::Exact(_) | Number::Ball(_)))
    }

    /// Returns the draws of a state, with the parameters of its set if there are few.
    pub(super) fn drawn_numbers(
        &self,
        index: u64,
        attempt: u32,
        sets: Option<usize>,
    ) -> Vec<Rational> {
        let mut own = self.draws.attempt(self.seed, index, attempt);
        if let Some(sets) = sets {
            let shared = self.draws.state(self.seed, set_of(index, sets) as u64);
            own[..self.parameter_draws].clone_from_slice(&shared[..self.parameter_draws]);
        }
        own
    }

    /// Returns the draws of a state in f64, with the parameters of its set if there are few.
    pub(super) fn nearest(
        &self,
        index: u64,
        attempt: u32,
        sets: Option<usize>,
    ) -> Vec<(f64, bool)> {
        let mut own = self.draws.nearest(self.seed, index, attempt);
        if let Some(sets) = sets {
            let shared = self.draws.nearest(self.seed, set_of(index, sets) as u64, 0);
            own[..self.parameter_draws].copy_from_slice(&shared[..self.parameter_draws]);
        }
        own
    }

    /// Replaces the parameters of the states from `start` on by those of few sets, as [`Self::nearest`]
    /// does.
    pub(super) fn share_parameters(
        &self,
        start: u64,
        sets: usize,
        columns: &mut [Balls<TAPE_LANES>],
    ) {
        let shared: Vec<Vec<(f64, bool)>> =
            (0..sets).map(|set| self.draws.nearest(self.seed, set as u64, 0)).collect();
        for (k, column) in columns.iter_mut().enumerate().take(self.parameter_draws) {
            *column = Balls::about(|lane| shared[set_of(start + lane as u64, sets)][k]);
        }
    }
}
