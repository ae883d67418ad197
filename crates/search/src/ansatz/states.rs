//! Values at random states, kept for the next system of equations at the same parameters.
//!
//! The classes of a search ask for the same states, one class after another.

use std::sync::{Mutex, PoisonError};

use super::system::PrimePoint;
use crate::streams::SearchStream;
use liouville::proof::ProofRng;

/// Largest number of values that are kept: 32 MB.
const MOST_KEPT: usize = 1 << 22;

/// Rows of values at the states of one stream, block by block.
pub struct States {
    at: PrimePoint,
    stream: u64,
    rng: ProofRng,
    rows: Vec<Vec<u64>>,
    /// Number of rows up to the end of each block.
    ends: Vec<usize>,
}

impl States {
    /// Returns the number of blocks that are known.
    pub fn blocks(&self) -> usize {
        self.ends.len()
    }

    /// Returns the random numbers of the next block.
    pub fn rng(&mut self) -> &mut ProofRng {
        &mut self.rng
    }

    /// Adds the rows of a block.
    pub fn push(&mut self, rows: impl Iterator<Item = Vec<u64>>) {
        self.rows.extend(rows);
        self.ends.push(self.rows.len());
    }

    /// Returns the rows of the first blocks.
    pub fn rows_before(&self, blocks: usize) -> &[Vec<u64>] {
        &self.rows[..blocks.checked_sub(1).map_or(0, |last| self.ends[last])]
    }
}

/// The states that were asked for last; whoever asks at the same time has states of his own.
#[derive(Default)]
pub struct KeptStates(Mutex<Option<States>>);

impl KeptStates {
    /// Takes the states of a stream, with those that are known.
    pub fn take(&self, at: &PrimePoint, stream: u64, seed: u64) -> States {
        let kept = self.0.lock().unwrap_or_else(PoisonError::into_inner).take();
        let is_same = |own: &States| {
            own.stream == stream
                && own.at.modulus == at.modulus
                && own.at.parameters == at.parameters
        };
        kept.filter(is_same).unwrap_or_else(|| States {
            at: at.clone(),
            stream,
            rng: SearchStream::Combinations.under(seed.wrapping_add(stream)),
            rows: Vec::new(),
            ends: Vec::new(),
        })
    }

    /// Keeps states unless they are very many.
    pub fn keep(&self, states: States) {
        if states.rows.iter().map(Vec::len).sum::<usize>() <= MOST_KEPT {
            *self.0.lock().unwrap_or_else(PoisonError::into_inner) = Some(states);
        }
    }
}
