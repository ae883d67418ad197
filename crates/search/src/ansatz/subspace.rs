//! Complement of the functions of known integrals in a null space.

use super::system::{At, System};
use liouville::proof::reduce;

/// Selects the vectors that, together with combinations of `products`, span the null space; each
/// product is a list of outputs whose values are multiplied. `None` if too few states have values.
///
/// Each vector is 1 at its last column and the others are 0 there. A combination of them ends where
/// the last vector that it contains ends; so those at whose end no known combination ends are a
/// basis of the complement, the same for all parameters in general position.
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
