//! Values of the rates of a motion as they are written, where parameters have values.

use liouville::case::Case;
use liouville::graph::{Evaluator, Tape, literally, record};
use liouville::mechanics::Phase;
use liouville::number::prime::{Prime, UNDEFINED};
use liouville::proof::root_numbers;

use super::hypersurface::Hypersurface;
use super::solved;
use super::split::SplitCase;
use crate::SearchError;
use crate::streams::SearchStream;

/// Number of points at a time, and of rounds.
const LANES: usize = 16;
const ROUNDS: usize = 4;

/// Whether rates that have values in general have none where some equations hold, as 0/0 has none, though
/// (a − b)/(a − b) cancels while it is recorded. `false` as well if the equations are not solved.
pub fn is_undefined(
    split: &SplitCase,
    equations: &[Hypersurface],
    seed: u64,
) -> Result<bool, SearchError> {
    let fixed = solved::with_equations(split, equations).unwrap_or_default();
    if fixed.is_empty() {
        return Ok(false);
    }
    let general = defined(&split.case, seed)?;
    for own in &fixed {
        let own = defined(&own.case, seed)?;
        if general.iter().zip(own).any(|(general, own)| *general && !own) {
            return Ok(true);
        }
    }
    Ok(false)
}

/// Tells which rates have values at random points modulo a prime.
fn defined(case: &Case, seed: u64) -> Result<Vec<bool>, SearchError> {
    let model = &case.model;
    let inputs = model.free_components() + model.dimension();
    let (graph, rates) = record(inputs, |inputs| {
        let (parameters, state) = inputs.split_at(model.free_components());
        literally(|| Phase::new(model, parameters, state).field().to_vec())
    })?;
    let mut rng = SearchStream::Residuals.under(seed.wrapping_add(60));
    let modulus = rng.prime_for(&root_numbers(&graph));
    let tape = Tape::new(&graph, &rates);
    let mut evaluator: Evaluator<'_, Prime<LANES>> =
        Evaluator::new(&tape, Prime::new([modulus; LANES]));
    let mut found = vec![false; rates.len()];
    for _ in 0..ROUNDS {
        let inputs: Vec<[u64; LANES]> =
            (0..graph.inputs()).map(|_| std::array::from_fn(|_| rng.element(&modulus))).collect();
        evaluator.run(&inputs);
        for (found, own) in found.iter_mut().zip(evaluator.outputs()) {
            *found |= own.iter().any(|x| *x != UNDEFINED);
        }
    }
    Ok(found)
}
