//! Values that are combinations of others with rational multiples.

use crate::graph::{Evaluator, Expr, Fault, Graph, Tape, record};
use crate::number::prime::{Prime, UNDEFINED};
use crate::number::rational::Rational;
use crate::scalar::Scalar;

use super::digest::SeedDigest;
use super::elimination::reduce;
use super::reconstruct::reconstruct;
use super::rng::{ProofRng, ProofStream};
use super::{Group, Prover};

/// Number of points beyond the number of multiples.
const SPARE_POINTS: usize = 4;

/// Expresses each value as Σ mᵢ bᵢ with the same values b and rational multiples m, one row for
/// each value; `None` unless all are proved to be such sums at all inputs.
///
/// The multiples are found at random points modulo a prime, and the sums are proved as any other
/// identity.
pub fn combinations(
    graph: &Graph,
    values: &[Expr],
    basis: &[Expr],
    seed: u64,
) -> Result<Option<Vec<Vec<Rational>>>, Fault> {
    let Some(multiples) = guessed(graph, values, basis, seed) else { return Ok(None) };
    let all = [values, basis].concat();
    let reached = graph.reached(all.iter().copied());
    let (graph, defects) = record(graph.inputs(), |inputs| {
        let made = graph.repeated(&reached, inputs);
        let at = |value: &Expr| made[graph.place(*value)];
        let defect = |(value, multiples): (&Expr, &Vec<Rational>)| {
            basis.iter().zip(multiples).try_fold(at(value)?, |rest, (element, multiple)| {
                Some(rest - at(element)? * Expr::rational(multiple))
            })
        };
        values.iter().zip(&multiples).map(defect).collect::<Option<Vec<Expr>>>()
    })?;
    let Some(defects) = defects else { return Ok(None) };
    let prover = Prover { sources: &[], extents: &[], seed };
    let outcomes = prover.prove(&graph, &[Group::of(defects)])?;
    Ok(outcomes.iter().all(|outcome| outcome.is_zero()).then_some(multiples))
}

/// Finds multiples at random points modulo a prime.
fn guessed(
    graph: &Graph,
    values: &[Expr],
    basis: &[Expr],
    seed: u64,
) -> Option<Vec<Vec<Rational>>> {
    let all = [basis, values].concat();
    let mut rng = ProofRng::of(
        SeedDigest::of(seed, graph, std::slice::from_ref(&all)),
        ProofStream::Relations,
    );
    let modulus = rng.prime(&[], &[]);
    let tape = Tape::new(graph, &all);
    let mut evaluator = Evaluator::new(&tape, Prime::new([modulus]));
    let mut rows = Vec::new();
    for _ in 0..basis.len() + SPARE_POINTS {
        let point: Vec<[u64; 1]> = (0..graph.inputs()).map(|_| [rng.element(&modulus)]).collect();
        evaluator.run(&point);
        let row: Vec<u64> = evaluator.outputs().map(|[value]| *value).collect();
        if row.contains(&UNDEFINED) {
            return None;
        }
        rows.push(row);
    }
    let (pivots, rows) = reduce(rows, basis.len(), &modulus);
    let of_value = |k: usize| {
        let mut multiples = vec![Rational::from(0); basis.len()];
        for (pivot, row) in pivots.iter().zip(&rows) {
            multiples[*pivot] = reconstruct(row[basis.len() + k], &modulus)?;
        }
        Some(multiples)
    };
    (0..values.len()).map(of_value).collect()
}
