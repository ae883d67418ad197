//! Combinations of vectors with few entries.

use liouville::number::prime::Modulus;
use liouville::order::StableOrder;

/// Largest number of vectors that are combined.
const MOST: usize = 40;
/// Largest number of rounds.
const ROUNDS: usize = 6;

/// Replaces vectors by their sums with multiples of others as long as these have fewer entries, and puts
/// those with few entries first; the space that they span stays.
pub fn sparse(m: &Modulus, mut vectors: Vec<Vec<u64>>) -> Vec<Vec<u64>> {
    if vectors.len() <= MOST {
        let mut inverses: Vec<Vec<u64>> = vectors.iter().map(|own| inverses(m, own)).collect();
        for _ in 0..ROUNDS {
            let mut is_changed = false;
            for place in 0..vectors.len() {
                for other in (0..vectors.len()).filter(|other| *other != place) {
                    let by = (&vectors[other][..], &inverses[other][..]);
                    if let Some(made) = shorter(m, &vectors[place], by) {
                        inverses[place] = self::inverses(m, &made);
                        vectors[place] = made;
                        is_changed = true;
                    }
                }
            }
            if !is_changed {
                break;
            }
        }
    }
    vectors.order_by_key(|own| entries(own));
    vectors
}

fn entries(own: &[u64]) -> usize {
    own.iter().filter(|entry| **entry != 0).count()
}

/// Inverses of the entries that are not 0.
fn inverses(m: &Modulus, own: &[u64]) -> Vec<u64> {
    let mut inverses = vec![0; own.len()];
    m.inverses(own, &mut inverses);
    inverses
}

/// A vector minus the multiple of another, not longer one that removes most entries; `None` if it adds as
/// many. The inverses of the other's entries are given.
fn shorter(m: &Modulus, own: &[u64], (other, inverses): (&[u64], &[u64])) -> Option<Vec<u64>> {
    let pairs = || own.iter().zip(other);
    let added = pairs().filter(|(a, b)| **a == 0 && **b != 0).count();
    let both = pairs().filter(|(a, b)| **a != 0 && **b != 0).count();
    if both <= added || entries(other) > entries(own) {
        return None;
    }
    let ratio =
        |((a, b), inverse): ((&u64, &u64), &u64)| (*a != 0 && *b != 0).then(|| m.mul(*a, *inverse));
    let mut ratios: Vec<u64> = pairs().zip(inverses).filter_map(ratio).collect();
    ratios.sort_unstable();
    let runs = ratios.chunk_by(|a, b| a == b).map(|run| (run.len(), run[0]));
    let (removed, factor) = runs.max()?;
    let less = |(a, b): (&u64, &u64)| m.sub(*a, m.mul(factor, *b));
    (removed > added).then(|| pairs().map(less).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::streams::SearchStream;

    #[test]
    fn multiples_of_others_are_taken_out() {
        let m = SearchStream::Moduli.numbered(1, 0).prime(&[], &[]);
        let vector = |own: [u64; 6]| own.map(|entry| m.integer(entry)).to_vec();
        let (square, sum) = (vector([1, 2, 0, 4, 4, 4]), vector([1, 0, 3, 0, 0, 5]));
        let more: Vec<u64> =
            sum.iter().zip(&square).map(|(a, b)| m.add(*a, m.mul(m.integer(7), *b))).collect();
        let made = sparse(&m, vec![square.clone(), more]);
        assert_eq!(made, [sum, square]);
        let apart = vec![vector([1, 1, 0, 0, 0, 0]), vector([0, 0, 1, 0, 0, 0])];
        let turned: Vec<Vec<u64>> = apart.iter().rev().cloned().collect();
        assert_eq!(sparse(&m, apart), turned, "only sorted");
    }
}
