//! Values at random states, kept for the next system of equations at the same parameters.
//!
//! The classes of a search ask for the same states, one class after another or several at a time.

use std::sync::{Arc, Mutex, PoisonError};

use super::system::PrimePoint;
use crate::streams::SearchStream;
use liouville::proof::ProofRng;

/// Largest number of values that are kept: 32 MB.
const MOST_KEPT: usize = 1 << 22;

/// Rows of values at the states of one block.
pub type StateBlock = Arc<[Vec<u64>]>;

/// Rows of values at the states of one stream, block by block, for any number of threads.
pub struct States {
    at: PrimePoint,
    stream: u64,
    blocks: Mutex<Blocks>,
}

/// The blocks that have been made, and the random numbers of the next one.
struct Blocks {
    rng: ProofRng,
    made: Vec<StateBlock>,
    /// Number of values of all blocks.
    values: usize,
}

impl States {
    /// Returns a block, whose predecessors have been asked for; `make` computes its rows from random
    /// numbers if nobody has.
    pub fn block(
        &self,
        number: usize,
        make: impl FnOnce(&mut ProofRng) -> Vec<Vec<u64>>,
    ) -> StateBlock {
        let mut blocks = self.blocks.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = blocks.made.get(number) {
            return Arc::clone(known);
        }
        let rows: StateBlock = make(&mut blocks.rng).into();
        blocks.values += rows.iter().map(Vec::len).sum::<usize>();
        blocks.made.push(Arc::clone(&rows));
        rows
    }

    fn values(&self) -> usize {
        self.blocks.lock().unwrap_or_else(PoisonError::into_inner).values
    }
}

/// The states that were asked for last.
#[derive(Default)]
pub struct KeptStates(Mutex<Option<Arc<States>>>);

impl KeptStates {
    /// Returns the states of a stream, with those that are known.
    pub fn of(&self, at: &PrimePoint, stream: u64, seed: u64) -> Arc<States> {
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let is_same = |own: &&Arc<States>| {
            own.stream == stream
                && own.at.modulus == at.modulus
                && own.at.parameters == at.parameters
        };
        if let Some(known) = kept.as_ref().filter(is_same) {
            return Arc::clone(known);
        }
        let rng = SearchStream::Combinations.under(seed.wrapping_add(stream));
        let blocks = Mutex::new(Blocks { rng, made: Vec::new(), values: 0 });
        let made = Arc::new(States { at: at.clone(), stream, blocks });
        *kept = Some(Arc::clone(&made));
        made
    }

    /// Forgets states that are very many.
    pub fn trim(&self) {
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if kept.as_ref().is_some_and(|own| own.values() > MOST_KEPT) {
            *kept = None;
        }
    }
}
