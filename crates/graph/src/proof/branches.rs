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

/// Number of blocks of points at which values are compared.
const BLOCKS: usize = 16;

impl Prover<'_> {
    /// Whether the values modulo primes agree, at random points, with those that some choice of
    /// signs of independent roots gives at all real inputs of the extents.
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
            let (there, made) = record(graph.inputs(), |inputs| {
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
                outputs.iter().map(|output| all[graph.place(*output)]).collect::<Option<Vec<_>>>()
            })?;
            let Some(made) = made else { return Ok(false) };
            let domain = Prime::new(moduli);
            let tapes = [Tape::new(graph, outputs), Tape::new(&there, &made)];
            let mut evaluators = tapes.each_ref().map(|tape| Evaluator::new(tape, domain.clone()));
            for _ in 0..BLOCKS {
                let point = points(&moduli, &asked.sources, &cell.fixed, &mut rng);
                let [ours, theirs] = evaluators.each_mut().map(|evaluator| {
                    evaluator.run(&point);
                    evaluator.outputs().copied().collect::<Vec<_>>()
                });
                let lanes = ours.iter().flatten().zip(theirs.iter().flatten());
                let differs = |(a, b): (&u64, &u64)| *a != UNDEFINED && *b != UNDEFINED && a != b;
                if lanes.into_iter().any(differs) {
                    return Ok(false);
                }
            }
        }
        Ok(true)
    }
}
