//! Agreement of the branches of roots and moduli in prime fields with those of real numbers.
//!
//! Modulo p = 3 mod 4 the root of x is the one that is itself a square, and for the same reason |x|
//! is x or -x. For independent roots both signs are equivalent; but √(x²) is x for half of all x
//! modulo p, and for all real x > 0.

use crate::graph::{Evaluator, Expr, Fault, Graph, Tape, record};
use crate::number::prime::{Modulus, Prime, UNDEFINED};

use super::cells::with_signs;
use super::digest::SeedDigest;
use super::rng::{ProofRng, ProofStream};
use super::trial::{TRIAL_LANES, TrialResult, points};
use super::{Group, Prover, QuestionData, buckets};

/// Number of points at which values have to be compared: those of other branches agree at one of them with a chance
/// of a half.
const LEAST_COMPARED: usize = 100;
/// Largest number of blocks of points that are drawn for that: a root has a value at half of them.
const MOST_BLOCKS: usize = 1 << 12;

impl Prover<'_> {
    /// Whether the values modulo primes agree with those that some choice of signs of independent roots gives at all
    /// real inputs of the extents: they are the same by their form, or agree at random points. `false` if too few of
    /// these have values.
    pub fn is_true_to_branches(&self, graph: &Graph, outputs: &[Expr]) -> Result<bool, Fault> {
        let digest = SeedDigest::of(self.seed, graph, &[outputs.to_vec()]);
        let asked = QuestionData { graph, sources: self.sources_of(graph), digest };
        let group = Group::of(outputs.to_vec());
        let Some(bucket) = buckets(graph, &[group], &asked.sources).pop() else { return Ok(true) };
        if bucket.special.is_empty() {
            return Ok(true);
        }
        let mut rng = ProofRng::of(digest, ProofStream::Primes);
        let moduli: [Modulus; TRIAL_LANES] = [rng.prime(&[3, 5], &[2, 3]); TRIAL_LANES];
        let reached = graph.reached(outputs.iter().copied());
        for leaf in self.explore(&asked, &[outputs], &bucket)?.leaves {
            let cell = &leaf.cell;
            let is_settled = matches!(
                leaf.results.first(),
                Some(Some(TrialResult::Zero(_) | TrialResult::NonZero))
            );
            if !is_settled || cell.signs().next().is_some() {
                return Ok(false);
            }
            let (there, (naive, made)) = record(graph.inputs(), |inputs| {
                let inputs = with_signs(inputs, cell.fixed.iter().copied());
                let own = cell.graph.reached(cell.values.iter().copied());
                let values = cell.graph.repeated(&own, &inputs);
                let special = bucket.special.iter().zip(&cell.values);
                let special: Vec<(usize, Option<Expr>)> = special
                    .map(|(place, value)| (*place, values[cell.graph.place(*value)]))
                    .collect();
                let all = graph.replay(&reached, &inputs, |place, _, _| {
                    special.iter().find(|(own, _)| *own == place).and_then(|(_, value)| *value)
                });
                let naive = graph.repeated(&reached, &inputs);
                let of = |all: Vec<Option<Expr>>| {
                    outputs
                        .iter()
                        .map(|output| all[graph.place(*output)])
                        .collect::<Option<Vec<_>>>()
                };
                (of(naive), of(all))
            })?;
            let (Some(naive), Some(made)) = (naive, made) else { return Ok(false) };
            let (naive, made): (Vec<Expr>, Vec<Expr>) =
                naive.into_iter().zip(made).filter(|(naive, made)| naive != made).unzip();
            let domain = Prime::new(moduli);
            let tapes = [Tape::new(&there, &naive), Tape::new(&there, &made)];
            let mut evaluators = tapes.each_ref().map(|tape| Evaluator::new(tape, domain.clone()));
            let mut compared = vec![0; made.len()];
            for _ in 0..MOST_BLOCKS {
                if compared.iter().all(|count| *count >= LEAST_COMPARED) {
                    break;
                }
                let point = points(&moduli, &asked.sources, &cell.fixed, &mut rng);
                let [ours, theirs] = evaluators.each_mut().map(|evaluator| {
                    evaluator.run(&point);
                    evaluator.outputs().copied().collect::<Vec<_>>()
                });
                for (count, (ours, theirs)) in compared.iter_mut().zip(ours.iter().zip(&theirs)) {
                    let lanes = ours.iter().zip(theirs);
                    let mut both = lanes.filter(|(a, b)| **a != UNDEFINED && **b != UNDEFINED);
                    if both.clone().any(|(a, b)| a != b) {
                        return Ok(false);
                    }
                    *count += both.by_ref().count();
                }
            }
            if compared.iter().any(|count| *count < LEAST_COMPARED) {
                return Ok(false);
            }
        }
        Ok(true)
    }
}
