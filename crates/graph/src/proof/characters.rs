//! Quadratic residues among radicands at random points: characters of radicands without roots,
//! refusals of nested ones.

use crate::graph::{Evaluator, Expr, Tape};
use crate::number::prime::{Prime, UNDEFINED};
use crate::number::quadratic::Quadratic;

use super::chance::{Chance, Stream};
use super::digest::Digest;
use super::lower::Algebraic;
use super::tower::Standing;
use super::trial::{LANES, MOST_NESTED, PRIMES, Residues, Trial, prime_of};

/// Number of points beyond the number of radicands at which characters are taken.
const SPARE: usize = 20;
/// Largest number of radicands without roots that can be distinguished.
pub const MOST_FIRST: usize = u128::BITS as usize - SPARE;
/// Number of blocks of points to try for characters, for each block needed.
const PATIENCE: usize = 8;
/// Number of points for each prime without a refusal after which a nested root is taken to be
/// dependent.
const ACCEPTED: usize = 32;

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
        digest: Digest,
    ) -> Self {
        let tape = Tape::new(&algebraic.graph, radicands);
        let mut evaluator = Evaluator::new(&tape, Prime::new(*trial.moduli()));
        let mut chance = Chance::of(digest, Stream::Characters);
        let mut next = || {
            evaluator.run(&trial.points(&[], &mut chance));
            evaluator.outputs().copied().collect::<Vec<[u64; LANES]>>()
        };
        // Radicands that are 0, or undefined, at all points of two blocks are left out.
        let first = [next(), next()];
        let all = |index: usize, of: u64| first.iter().all(|block| block[index] == [of; LANES]);
        let zero: Vec<bool> = (0..radicands.len()).map(|index| all(index, 0)).collect();
        let is_used = |index: &usize| !zero[*index] && !all(*index, UNDEFINED);
        let used: Vec<usize> = (0..radicands.len()).filter(is_used).collect();
        let wanted = (used.len() + SPARE).min(u128::BITS as usize) as u32;
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

/// Non-squares among nested radicands, at points where the radicands before them are squares.
pub struct Refusals {
    /// Whether the radicand was refused, by radicand and prime.
    refused: Vec<[bool; PRIMES]>,
    /// Number of points that accepted the radicand, by radicand.
    accepted: Vec<usize>,
}

impl Refusals {
    /// Tests the radicands of the bases `nested` in order.
    pub fn of(
        algebraic: &Algebraic<'_>,
        trial: &Trial<'_>,
        nested: &[usize],
        digest: Digest,
    ) -> Self {
        // By base: its radicand, and the radicands of those of its links whose roots are links too.
        let chains = nested.iter().map(|index| {
            let base = &algebraic.bases[*index];
            let inner = base.links.len().saturating_sub(1);
            let links = base.links[..inner].iter().map(|(link, _)| *link);
            [base.radicand].into_iter().chain(links).collect::<Vec<Expr>>()
        });
        let chains: Vec<Vec<Expr>> = chains.collect();
        let tape = Tape::new(&algebraic.graph, &chains.concat());
        let field = Quadratic::new(*trial.moduli());
        let mut evaluator = Evaluator::new(&tape, field.clone());
        let mut chance = Chance::of(digest, Stream::Refusals);
        let mut found =
            Self { refused: vec![[false; PRIMES]; nested.len()], accepted: vec![0; nested.len()] };
        let roots: usize = chains.iter().map(Vec::len).sum();
        let most = (4 * ACCEPTED * PRIMES / LANES) << (roots as u32).min(MOST_NESTED);
        for _ in 0..most {
            let points = trial.points(&[], &mut chance);
            evaluator.run(&<Quadratic<LANES> as Residues>::blocks(&points));
            for lane in 0..LANES {
                let mut place = 0;
                for (index, chain) in chains.iter().enumerate() {
                    let (own, links) = (place, place + 1..place + chain.len());
                    place = links.end;
                    match field.is_square(evaluator.output(own), lane) {
                        Some(true) => found.accepted[index] += 1,
                        // 0 is the square of 0.
                        Some(false) if evaluator.output(own)[lane] == [0, 0] => break,
                        Some(false) => {
                            found.refused[index][prime_of(lane)] = true;
                            break;
                        }
                        None => break,
                    }
                    // All roots before the next must exist, √√A among them: it is independent where
                    // √A is, as -1 is a square.
                    let mut links = links.map(|at| field.is_square(evaluator.output(at), lane));
                    if links.any(|is_square| is_square != Some(true)) {
                        break;
                    }
                }
            }
            if (0..nested.len()).all(|index| found.standing(index) != Standing::Unreached) {
                break;
            }
        }
        found
    }

    /// Returns the standing of a radicand, by its index among those tested.
    pub fn standing(&self, index: usize) -> Standing {
        let refused = &self.refused[index];
        if refused.iter().all(|refused| *refused) {
            Standing::Independent
        } else if self.accepted[index] >= ACCEPTED && !refused.contains(&true) {
            Standing::Dependent(Vec::new())
        } else {
            Standing::Unreached
        }
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
        let mut chance = Chance::new(11, 0);
        for _ in 0..200 {
            let mut space = Space::of_minus_one(12);
            let mut vectors = Vec::new();
            for member in 0..20 {
                let vector = u128::from(chance.element(&modulus)) & 0xfff;
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
