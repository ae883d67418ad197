//! What is left of a null space beside functions of what is known.

use super::system::{At, System};
use crate::proof::reduce;

/// Those of the vectors that are needed beside combinations of `products`, each a list of outputs
/// whose values are multiplied; nothing if too few states have values.
///
/// Each vector is 1 at its last column and the others are 0 there. A combination of them ends where
/// the last that it contains ends; so those at whose end no known combination ends are a basis of the
/// rest, the same for all parameters in general position.
pub fn complement(
    system: &System,
    at: &At,
    vectors: &[Vec<u64>],
    products: &[Vec<usize>],
) -> Option<Vec<Vec<u64>>> {
    if vectors.is_empty() {
        return Some(Vec::new());
    }
    let relations = system.combination_relations(at, vectors, products)?;
    let count = vectors.len();
    let reversed: Vec<Vec<u64>> =
        relations.iter().map(|own| own[..count].iter().rev().copied().collect()).collect();
    let (ends, _) = reduce(reversed, count, &at.modulus);
    let is_new = |k: &usize| !ends.contains(&(count - 1 - k));
    Some((0..count).filter(is_new).map(|k| vectors[k].clone()).collect())
}
