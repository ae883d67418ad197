//! Complement of the functions of known integrals in a null space.

use super::super::SearchError;
use super::super::echelon::Echelon;
use super::system::{LinearSystem, PrimePoint};

/// Selects the vectors that, together with combinations of `products`, span the null space; each
/// product is a list of outputs whose values are multiplied. `None` if too few states have values.
///
/// Each vector is 1 at its last column and the others are 0 there. A combination of them ends where
/// the last vector that it contains ends; so those at whose end no known combination ends are a
/// basis of the complement, the same for all parameters in general position.
pub fn complement(
    system: &LinearSystem,
    at: &PrimePoint,
    vectors: &[Vec<u64>],
    products: &[Vec<usize>],
) -> Result<Option<Vec<Vec<u64>>>, SearchError> {
    if vectors.is_empty() {
        return Ok(Some(Vec::new()));
    }
    let Some(relations) = system.combination_relations(at, vectors, products)? else {
        return Ok(None);
    };
    let count = vectors.len();
    let mut ends = Echelon::new(count, at.modulus);
    for own in relations {
        system.halt().check()?;
        ends.push(own[..count].iter().rev().copied().collect());
    }
    let is_new = |k: &usize| !ends.has_pivot(count - 1 - k);
    Ok(Some((0..count).filter(is_new).map(|k| vectors[k].clone()).collect()))
}
