//! Sign changes of the state that preserve or reverse the motion: every integral is a sum of
//! integrals that they multiply by ±1, so that a linear system decomposes into blocks.

use crate::streams::SearchStream;
use std::collections::BTreeMap;

use super::super::SearchError;
use super::super::terms::recorded;
use super::monomials::AnsatzVariables;
use super::system::Column;
use liouville::case::Case;
use liouville::claim::LevelSubset;
use liouville::formula::Formula;
use liouville::graph::{Evaluator, Tape, record};
use liouville::number::prime::{Modulus, Prime, UNDEFINED};
use liouville::proof::root_numbers;
use liouville::verdict::Sampler;

/// Number of states at which a symmetry is tested.
const TEST_STATES: usize = 8;
/// Largest number of components for which sign changes are tried.
const MOST_COMPONENTS: usize = 10;

/// A sign change of the state and the factors.
struct SignChange {
    changed: Vec<bool>,
    factors: Vec<bool>,
}

/// The sign changes of a case that are symmetries or reversors.
pub struct SignChanges(Vec<SignChange>);

impl SignChanges {
    /// Finds the sign changes of the motion on the level that multiply each of the factors by ±1.
    pub fn of(
        case: &Case,
        variables: &AnsatzVariables,
        factors: &[Formula],
        seed: u64,
    ) -> Result<Self, SearchError> {
        let count = variables.count();
        if count > MOST_COMPONENTS {
            return Ok(Self(Vec::new()));
        }
        let model = &case.model;
        let inputs = model.free_components() + model.dimension();
        let (identity, same) = record(inputs, |inputs| inputs.to_vec())?;
        let sampler = Sampler::new(case, &LevelSubset::level(model), seed)?;
        let fixed = vec![None; sampler.recipes().len()];
        let (made, outputs) = sampler.compose(&identity, &[same], &fixed)?;
        let mut rng = SearchStream::Characters.under(seed);
        let modulus = rng.prime_for(&root_numbers(&made));
        let tape = Tape::new(&made, &outputs.concat());
        let mut states = Evaluator::new(&tape, Prime::new([modulus; TEST_STATES]));
        let draws: Vec<[u64; TEST_STATES]> =
            (0..made.inputs()).map(|_| std::array::from_fn(|_| rng.element(&modulus))).collect();
        states.run(&draws);
        let point: Vec<[u64; TEST_STATES]> = states.outputs().copied().collect();
        let (graph, (level, field)) = recorded(case, |jet| {
            let level = model.level.iter().map(|one| jet.phase.level_function(&one.function));
            let values = factors.iter().map(|term| jet.phase.scalar(term));
            let level: Vec<_> = level.collect();
            (level, jet.phase.field().iter().copied().chain(values).collect::<Vec<_>>())
        })?;
        let tape = Tape::new(&graph, &[level.clone(), field].concat());
        let mut evaluator = Evaluator::new(&tape, Prime::new([modulus; TEST_STATES]));
        let mut at = |changed: &[bool]| -> Vec<[u64; TEST_STATES]> {
            let mut inputs = point.clone();
            inputs.resize(graph.inputs(), [modulus.one(); TEST_STATES]);
            let first = model.free_components();
            for (block, _) in inputs[first..].iter_mut().zip(changed).filter(|(_, own)| **own) {
                *block = block.map(|x| negated(&modulus, x));
            }
            evaluator.run(&inputs);
            evaluator.outputs().copied().collect()
        };
        let still = at(&vec![false; count]);
        let found = (1..1u32 << count).filter_map(|pattern| {
            let changed: Vec<bool> = (0..count).map(|k| pattern >> k & 1 == 1).collect();
            let moved = at(&changed);
            let (on_level, moved) = moved.split_at(level.len());
            if on_level.iter().flatten().any(|value| *value != 0) {
                return None;
            }
            let (before, after) = (&still[level.len()..], moved);
            let ratio = |k: usize| ratio(&modulus, &before[k], &after[k]);
            let rates: Option<Vec<Option<bool>>> = (0..count).map(ratio).collect();
            // v(σx) = ±σ v(x), with the same sign for all components that move
            let mut signs = rates?.into_iter().zip(&changed);
            let mut signs = signs.by_ref().filter_map(|(rate, own)| Some(rate? != *own));
            let first = signs.next()?;
            if signs.any(|sign| sign != first) {
                return None;
            }
            let factors: Option<Vec<bool>> =
                (count..count + factors.len()).map(|k| Some(ratio(k)?.unwrap_or(false))).collect();
            Some(SignChange { changed, factors: factors? })
        });
        Ok(Self(found.collect()))
    }

    /// Groups the columns by their signs, in order.
    pub fn blocks(&self, columns: &[Column]) -> Vec<Vec<usize>> {
        let mut blocks: BTreeMap<Vec<bool>, Vec<usize>> = BTreeMap::new();
        for (index, column) in columns.iter().enumerate() {
            let character = match column {
                Column::Given(_) => Vec::new(),
                Column::Product { factor, exponents, .. } => {
                    let sign = |signs: &SignChange| {
                        let own = exponents.iter().zip(&signs.changed);
                        let odd: u32 = own.filter(|(_, changed)| **changed).map(|(a, _)| *a).sum();
                        (odd % 2 == 1) != signs.factors[*factor]
                    };
                    self.0.iter().map(sign).collect()
                }
            };
            blocks.entry(character).or_default().push(index);
        }
        blocks.into_values().collect()
    }
}

fn negated(m: &Modulus, x: u64) -> u64 {
    if x == UNDEFINED { x } else { m.sub(0, x) }
}

/// Whether y = -x (`Some(true)`) or y = x (`Some(false)`) in all lanes; `Some(None)` where both
/// are 0. The outer option is `None` where they are neither, or defined nowhere.
fn ratio(m: &Modulus, x: &[u64; TEST_STATES], y: &[u64; TEST_STATES]) -> Option<Option<bool>> {
    let defined: Vec<(u64, u64)> = x
        .iter()
        .copied()
        .zip(y.iter().copied())
        .filter(|(x, y)| ![*x, *y].contains(&UNDEFINED))
        .collect();
    if defined.len() < 2 {
        return None;
    }
    if defined.iter().all(|(x, y)| *x == 0 && *y == 0) {
        return Some(None);
    }
    for (sign, other) in [false, true].into_iter().zip([m.one(), m.sub(0, m.one())]) {
        if defined.iter().all(|(x, y)| *y == m.mul(*x, other)) {
            return Some(Some(sign));
        }
    }
    None
}
