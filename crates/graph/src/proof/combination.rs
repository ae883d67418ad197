//! Values that are combinations of others with rational multiples.

use crate::graph::{Evaluator, Expr, Fault, Graph, Tape, record};
use crate::number::prime::{Prime, UNDEFINED};
use crate::number::rational::Rational;
use crate::scalar::Scalar;

use super::digest::SeedDigest;
use super::elimination::reduce;
use super::reconstruct::reconstruct;
use super::rng::{ProofRng, ProofStream};
use super::trial::Certificate;
use super::{Group, GroupOutcome, Prover};

/// Number of points beyond the number of multiples.
const SPARE_POINTS: usize = 4;

/// Multiples, a row for each value, and a certificate of the sums.
type ProvedMultiples = (Vec<Vec<Rational>>, Certificate);

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
    Ok(proved(graph, values, basis, seed)?.map(|(multiples, _)| multiples))
}

/// Proves that each value is a sum Σ mᵢ bᵢ with rational multiples m; `None` where that is not known.
pub fn combination_certificate(
    graph: &Graph,
    values: &[Expr],
    basis: &[Expr],
    seed: u64,
) -> Result<Option<Certificate>, Fault> {
    Ok(proved(graph, values, basis, seed)?.map(|(_, certificate)| certificate))
}

/// Finds multiples, and a certificate of the sums.
fn proved(
    graph: &Graph,
    values: &[Expr],
    basis: &[Expr],
    seed: u64,
) -> Result<Option<ProvedMultiples>, Fault> {
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
    Ok(match prover.prove(&graph, &[Group::of(defects)])?.pop() {
        Some(GroupOutcome::Zero(certificate)) => Some((multiples, certificate)),
        _ => None,
    })
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
