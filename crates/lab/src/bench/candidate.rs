//! Interface of the methods that compute a residual, timed as black boxes.

use liouville::number::arb::Approximation;
use liouville::verdict::{Sampler, TAPE_LANES, antiderivative_value};

/// Block of states: one entry for each input of the tape, one f64 for each lane.
pub type Block = Vec<[f64; TAPE_LANES]>;

/// Method that computes the residual at blocks of states.
pub trait Candidate {
    /// Computes the residual at the states of block `block`.
    fn run(&mut self, block: usize);

    /// Residual of the last run in `lane`, exactly as it was computed; `None` where it is
    /// undefined.
    fn value(&self, lane: usize) -> Option<Approximation>;

    /// Error bound computed along with the residual, if any.
    fn bound(&self, _lane: usize) -> Option<f64> {
        None
    }
}

/// Parameters, states and antiderivatives in f64: from here on they are exact, and the same for all
/// candidates. They are the midpoints of the states of a verdict, and so off the level by rounding.
///
/// A lane without a state repeats another one; `None` when a block has no state at all.
pub fn states(sampler: &Sampler, blocks: u64, antiderivatives: usize) -> Option<Vec<Block>> {
    (0..blocks)
        .map(|block| {
            let balls = sampler.balls(block * TAPE_LANES as u64);
            let whole: Vec<usize> = (0..TAPE_LANES)
                .filter(|lane| balls.iter().all(|input| input.is_defined(*lane)))
                .collect();
            let first = *whole.first()?;
            let source = |lane: usize| if whole.contains(&lane) { lane } else { first };
            let values =
                balls.iter().map(|input| std::array::from_fn(|lane| input.mid[source(lane)]));
            let constants =
                (0..antiderivatives).map(|k| [antiderivative_value(k).to_f64().0; TAPE_LANES]);
            Some(values.chain(constants).collect())
        })
        .collect()
}
