//! Which radicands are squares at random points: characters of those without roots, refusals of
//! those with roots.

use crate::graph::{Evaluator, Expr, Tape};
use crate::number::prime::{Prime, UNDEFINED};
use crate::number::quadratic::Quadratic;

use super::chance::{Chance, Stream};
use super::digest::Digest;
use super::lower::Algebraic;
use super::tower::Standing;
use super::trial::{LANES, MOST_NESTED, PRIMES, Residues, Trial, prime_of};

/// Points beyond the number of radicands at which characters are taken.
const SPARE: usize = 20;
/// More radicands without roots than this are not told apart.
pub const MOST_FIRST: usize = u128::BITS as usize - SPARE;
/// Blocks of points that are tried for characters, for each that is needed.
const PATIENCE: usize = 8;
/// Points for each prime without a refusal after which a nested root is taken to be dependent.
const ACCEPTED: usize = 32;

/// The squares among the values of one radicand.
pub enum Character<'c> {
    /// For each prime, a bit a point: whether the value is no square.
    Residues(&'c [u128; PRIMES]),
    /// The value is 0 at all points.
    Zero,
    /// It hardly ever has a value.
    Unreached,
}

/// The characters of some radicands without roots at common points.
pub struct Characters {
    /// For each prime, the number of points.
    pub counts: [u32; PRIMES],
    /// By radicand; `None` where it was left out.
    residues: Vec<Option<[u128; PRIMES]>>,
    /// Whether it is 0 at all points, by radicand.
    zero: Vec<bool>,
}

impl Characters {
    /// Takes the characters of `radicands`.
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
        // What is 0, or has no value, at all points of two blocks is left out.
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

    /// The character of a radicand, by number.
    pub fn of_radicand(&self, index: usize) -> Character<'_> {
        match &self.residues[index] {
            Some(residues) => Character::Residues(residues),
            None if self.zero[index] => Character::Zero,
            None => Character::Unreached,
        }
    }
}

/// A space of vectors over the field of two elements, each with the radicands it is a product of.
#[derive(Clone)]
pub struct Space {
    /// Vectors with a leading bit of their own, and the members they are sums of.
    rows: Vec<(u128, u128)>,
}

impl Space {
    /// The space of the character of -1, which is no square at any of `count` points.
    pub fn of_minus_one(count: u32) -> Self {
        let all = u128::MAX.checked_shr(u128::BITS - count).unwrap_or(0);
        Self { rows: vec![(all, 0)] }
    }

    /// Adds a vector; where it is a sum of others, the members of that sum in place of it.
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

/// Where nested radicands are no squares, at points at which those before them are.
pub struct Refusals {
    /// By radicand and prime: whether it was refused.
    refused: Vec<[bool; PRIMES]>,
    /// By radicand: how often it was accepted.
    accepted: Vec<usize>,
}

impl Refusals {
    /// Tries the radicands of the bases `nested` in their order.
    pub fn of(
        algebraic: &Algebraic<'_>,
        trial: &Trial<'_>,
        nested: &[usize],
        digest: Digest,
    ) -> Self {
        // By base: its radicand, and those of its links whose own roots are links.
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
                    // All roots before the next have to exist, √√A among them: it is independent
                    // where √A is, as -1 is a square.
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

    /// The standing of a radicand, by its number among those that were tried.
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
