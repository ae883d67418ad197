//! The residual as it is, to far more digits than any candidate has.

use super::candidate::Block;
use super::candidate::Candidate;
use super::tapes::TapeRun;
use crate::graph::Tape;
use crate::number::exact::Exact;
use crate::number::rational::Rational;
use crate::verdict::LANES;

/// The residual at every state; `None` where it is undefined.
pub fn reference(tape: &Tape, states: &[Block]) -> Vec<Option<Rational>> {
    let mut run = TapeRun::new(tape, Exact, states);
    let mut values = Vec::with_capacity(states.len() * LANES);
    for block in 0..states.len() {
        run.run(block);
        values.extend((0..LANES).map(|lane| run.value(lane)));
    }
    values
}
