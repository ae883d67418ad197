//! Quadratic characters of radicands without roots at random points.

use crate::graph::{Evaluator, Expr, Tape};
use crate::number::prime::{Prime, UNDEFINED};

use super::digest::SeedDigest;
use super::lower::Algebraic;
use super::rng::{ProofRng, ProofStream};
use super::trial::{PRIMES, TRIAL_LANES, Trial, prime_of};

/// Number of points beyond the number of radicands at which characters are taken.
const SPARE_POINTS: usize = 20;
/// Largest number of radicands without roots that can be distinguished.
pub const MOST_FIRST: usize = u128::BITS as usize - SPARE_POINTS;
/// Number of blocks of points to try for characters, for each block needed.
const PATIENCE: usize = 8;

/// Quadratic character of the values of one radicand.
pub enum Character<'c> {
    /// For each prime, one bit for each point: set if the value is not a square.
    Residues(&'c [u128; PRIMES]),
    /// Zero at all points.
    Zero,
    /// Without a value at almost all points.
    Unreached,
}

/// Quadratic characters of radicands without roots at common points.
pub struct Characters {
    /// Number of points for each prime.
    pub counts: [u32; PRIMES],
    /// Residues by radicand; `None` for one left out.
    residues: Vec<Option<[u128; PRIMES]>>,
    /// Whether the radicand is 0 at all points, by radicand.
    zero: Vec<bool>,
}

impl Characters {
    /// Computes the characters of `radicands`.
    pub fn of(
        algebraic: &Algebraic<'_>,
        trial: &Trial<'_>,
        radicands: &[Expr],
        digest: SeedDigest,
    ) -> Self {
        let tape = Tape::new(&algebraic.graph, radicands);
        let mut evaluator = Evaluator::new(&tape, Prime::new(*trial.moduli()));
        let mut rng = ProofRng::of(digest, ProofStream::Characters);
        let mut next = || {
            evaluator.run(&trial.points(&[], &mut rng));
            evaluator.outputs().copied().collect::<Vec<[u64; TRIAL_LANES]>>()
        };
        // Radicands that are 0, or undefined, at all points of two blocks are left out.
        let first = [next(), next()];
        let all =
            |index: usize, of: u64| first.iter().all(|block| block[index] == [of; TRIAL_LANES]);
        let zero: Vec<bool> = (0..radicands.len()).map(|index| all(index, 0)).collect();
        let is_used = |index: &usize| !zero[*index] && !all(*index, UNDEFINED);
        let used: Vec<usize> = (0..radicands.len()).filter(is_used).collect();
        let wanted = (used.len() + SPARE_POINTS).min(u128::BITS as usize) as u32;
        let mut residues = vec![None; radicands.len()];
        used.iter().for_each(|index| residues[*index] = Some([0u128; PRIMES]));
        let mut counts = [0; PRIMES];
        let mut blocks = first.into_iter();
        for _ in 0..PATIENCE * wanted as usize {
            if counts.iter().all(|count| *count >= wanted) {
                break;
            }
            let block = blocks.next().unwrap_or_else(&mut next);
            for (lane, modulus) in trial.moduli().iter().enumerate() {
                let prime = prime_of(lane);
                let exists = |index: &usize| !matches!(block[*index][lane], 0 | UNDEFINED);
                if counts[prime] >= wanted || !used.iter().all(exists) {
                    continue;
                }
                for index in &used {
                    let is_square = modulus.is_square(block[*index][lane]);
                    if let Some(bits) = &mut residues[*index] {
                        bits[prime] |= u128::from(!is_square) << counts[prime];
                    }
                }
                counts[prime] += 1;
            }
        }
        if counts.iter().any(|count| *count < wanted) {
            residues.iter_mut().for_each(|own| *own = None);
        }
        Self { counts, residues, zero }
    }

    /// Returns the character of a radicand, by index.
    pub fn of_radicand(&self, index: usize) -> Character<'_> {
        match &self.residues[index] {
            Some(residues) => Character::Residues(residues),
            None if self.zero[index] => Character::Zero,
            None => Character::Unreached,
        }
    }
}

/// A vector space over the field of two elements; each vector carries the radicands whose product
/// it is.
#[derive(Clone)]
pub struct Space {
    /// Vectors in echelon form, with the members they are sums of.
    rows: Vec<(u128, u128)>,
}

impl Space {
    /// Makes the space spanned by the character of -1, which is a non-square at all `count` points.
    pub fn of_minus_one(count: u32) -> Self {
        let all = u128::MAX.checked_shr(u128::BITS - count).unwrap_or(0);
        Self { rows: vec![(all, 0)] }
    }

    /// Adds a vector. If it is a sum of others, returns the members of that sum instead.
    pub fn insert(&mut self, mut vector: u128, member: usize) -> Option<u128> {
        let mut members = 0;
        for (row, others) in &self.rows {
            if vector ^ row < vector {
                vector ^= row;
                members ^= others;
            }
        }
        if vector == 0 {
            return Some(members);
        }
        self.rows.push((vector, members | 1 << member));
        self.rows.sort_unstable_by_key(|row| std::cmp::Reverse(row.0));
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_name_their_members() {
        let mut space = Space::of_minus_one(4);
        assert_eq!(space.insert(0b0011, 0), None);
        assert_eq!(space.insert(0b0101, 1), None);
        assert_eq!(space.insert(0b0110, 2), Some(0b11), "the sum of the first two");
        assert_eq!(space.insert(0b1001, 3), Some(0b11), "and of both with -1");
        assert_eq!(space.insert(0b1010, 4), Some(0b10), "of the second with -1");
        assert_eq!(space.insert(0b0001, 5), None);
        assert_eq!(space.insert(0, 6), Some(0), "nothing is a sum of nothing");
    }

    #[test]
    fn random_vectors_are_sums_of_what_they_are_said_to_be() {
        let modulus = crate::number::prime::Modulus::new((1 << 61) - 1);
        let mut rng = ProofRng::new(11, 0);
        for _ in 0..200 {
            let mut space = Space::of_minus_one(12);
            let mut vectors = Vec::new();
            for member in 0..20 {
                let vector = u128::from(rng.element(&modulus)) & 0xfff;
                vectors.push(vector);
                if let Some(sum) = space.insert(vector, member) {
                    let among = (0..member).filter(|k| sum >> k & 1 == 1);
                    let total = among.fold(0, |total, k| total ^ vectors[k]);
                    assert!(total == vector || total == vector ^ 0xfff, "up to -1");
                }
            }
        }
    }
}
