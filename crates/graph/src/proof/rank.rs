//! The rank of a matrix of values, by its rank at random points modulo random primes.

use crate::graph::{Evaluator, Expr, Fault, Graph, Tape};
use crate::number::prime::{Prime, UNDEFINED};

use super::Prover;
use super::digest::SeedDigest;
use super::elimination::reduce;
use super::lower::Algebraic;
use super::rng::{ProofRng, ProofStream};
use super::symbols::Symbols;
use super::trial::{TRIAL_LANES, Trial};

/// Largest number of blocks of points tried until all entries have values.
const MOST_BLOCKS: usize = 1 << 12;

impl Prover<'_> {
    /// Finds the rank of the first `n` rows for each n in `heights`.
    ///
    /// The rank at a point is a rigorous lower bound, and at a random point the rank itself except
    /// with a probability of about its degree over 2^60. `None` if no point was found at which all
    /// entries have a value.
    pub fn ranks(
        &self,
        graph: &Graph,
        rows: &[Vec<Expr>],
        heights: &[usize],
    ) -> Result<Option<Vec<usize>>, Fault> {
        let digest = SeedDigest::of(self.seed, graph, rows);
        let entries = rows.concat();
        let reached = graph.reached(entries.iter().copied());
        let sources = self.sources_of(graph);
        let symbols = Symbols::opaque(graph, &reached);
        let algebraic = Algebraic::of(graph, &reached, &sources, &symbols)?;
        let outputs = entries.iter().map(|entry| algebraic.values[graph.place(*entry)]);
        let Some(outputs) = outputs.collect::<Option<Vec<Expr>>>() else { return Ok(None) };
        let trial = Trial::new(&algebraic, digest);
        let tape = Tape::new(&algebraic.graph, &outputs);
        let mut evaluator = Evaluator::new(&tape, Prime::new(*trial.moduli()));
        let mut rng = ProofRng::of(digest, ProofStream::Ranks);
        let width = rows.first().map_or(0, Vec::len);
        let mut ranks: Option<Vec<usize>> = None;
        for _ in 0..MOST_BLOCKS {
            evaluator.run(&trial.points(&[], &mut rng));
            for lane in 0..TRIAL_LANES {
                let values: Vec<u64> = evaluator.outputs().map(|block| block[lane]).collect();
                if values.contains(&UNDEFINED) {
                    continue;
                }
                let matrix: Vec<Vec<u64>> =
                    values.chunks(width.max(1)).map(<[u64]>::to_vec).collect();
                let found = heights.iter().map(|height| {
                    let rows = matrix[..(*height).min(matrix.len())].to_vec();
                    reduce(rows, width, &trial.moduli()[lane]).0.len()
                });
                let found: Vec<usize> = found.collect();
                ranks = Some(match ranks {
                    None => found,
                    Some(before) => before.into_iter().zip(found).map(|(a, b)| a.max(b)).collect(),
                });
            }
            if ranks.is_some() {
                break;
            }
        }
        Ok(ranks)
    }
}
