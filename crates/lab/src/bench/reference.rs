//! Reference values of a residual, with far more digits than any candidate.

use super::candidate::{Block, Candidate};
use super::tapes::TapeRun;
use liouville::graph::Tape;
use liouville::number::arb::{Approximation, ArbBall};
use liouville::verdict::TAPE_LANES;

/// Twice the precision of the best candidate, and far beyond any cancellation.
const REFERENCE_BITS: u32 = 512;

/// Computes the residual at every state; `None` where it is undefined.
pub fn reference(tape: &Tape, states: &[Block]) -> Vec<Option<Approximation>> {
    let mut run = TapeRun::new(tape, ArbBall::new(REFERENCE_BITS), states);
    let mut values = Vec::with_capacity(states.len() * TAPE_LANES);
    for block in 0..states.len() {
        run.run(block);
        values.extend((0..TAPE_LANES).map(|lane| run.value(lane)));
    }
    values
}
