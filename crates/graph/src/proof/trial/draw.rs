//! Random primes and points for the lanes of a test.

use std::cell::RefCell;
use std::collections::VecDeque;

use crate::number::prime::Modulus;
use crate::proof::bounds::InputDistribution;
use crate::proof::digest::SeedDigest;
use crate::proof::lower::Algebraic;
use crate::proof::rng::{ProofRng, ProofStream, RequiredRoots};

/// Number of points evaluated at once.
pub const TRIAL_LANES: usize = 8;
/// Number of primes; each is shared by as many lanes as it has points.
pub const PRIMES: usize = 4;

/// Number of sets of primes that are kept.
const KEPT: usize = 8;

/// Returns the index of the prime that a lane computes modulo.
pub fn prime_of(lane: usize) -> usize {
    lane * PRIMES / TRIAL_LANES
}

/// Draws primes with the unique odd roots and the chains of square roots that a graph needs, lane
/// by lane.
///
/// The last primes are kept, since a statement is tested in many ways that need the same ones.
pub fn suitable_moduli(
    digest: SeedDigest,
    stream: ProofStream,
    algebraic: &Algebraic<'_>,
) -> [Modulus; TRIAL_LANES] {
    type Known = (SeedDigest, ProofStream, RequiredRoots, [Modulus; TRIAL_LANES]);
    thread_local! {
        static LAST: RefCell<VecDeque<Known>> = const { RefCell::new(VecDeque::new()) };
    }
    let wanted = RequiredRoots {
        odd: algebraic.odd_indices(),
        squares: algebraic.squares(),
        // Shorter chains need the same primes.
        depth: algebraic.depth().max(RequiredRoots::SHORT),
    };
    LAST.with_borrow_mut(|last| {
        let is_wanted = |(d, s, known, _): &&Known| (*d, *s, known) == (digest, stream, &wanted);
        if let Some((.., moduli)) = last.iter().find(is_wanted) {
            return *moduli;
        }
        let mut rng = ProofRng::of(digest, stream);
        let primes: [Modulus; PRIMES] = std::array::from_fn(|_| rng.prime_with_roots(&wanted));
        let moduli = std::array::from_fn(|lane| primes[prime_of(lane)]);
        last.truncate(KEPT - 1);
        last.push_front((digest, stream, wanted, moduli));
        moduli
    })
}

/// Draws the inputs of one block of random points.
pub fn points(
    moduli: &[Modulus; TRIAL_LANES],
    sources: &[InputDistribution],
    fixed: &[(usize, bool)],
    rng: &mut ProofRng,
) -> Vec<[u64; TRIAL_LANES]> {
    let mut point = |input: usize, source: &InputDistribution| {
        let fixed = fixed.iter().find(|(sign, _)| *sign == input);
        moduli.map(|m| match source {
            InputDistribution::Uniform => rng.element(&m),
            InputDistribution::Sign => {
                let positive = fixed.map_or_else(|| rng.coin(), |(_, positive)| *positive);
                if positive { m.one() } else { m.sub(0, m.one()) }
            }
        })
    };
    sources.iter().enumerate().map(|(input, source)| point(input, source)).collect()
}
