//! Random primes and points for the lanes of a test.

use std::cell::RefCell;

use crate::number::prime::Modulus;
use crate::proof::bounds::InputDistribution;
use crate::proof::digest::SeedDigest;
use crate::proof::lower::Algebraic;
use crate::proof::rng::{ProofRng, ProofStream, RequiredRoots};

/// Number of points evaluated at once.
pub const TRIAL_LANES: usize = 8;
/// Number of primes; each is shared by as many lanes as it has points.
pub const PRIMES: usize = 4;

/// Returns the index of the prime that a lane computes modulo.
pub fn prime_of(lane: usize) -> usize {
    lane * PRIMES / TRIAL_LANES
}

/// Draws primes with the unique odd roots and the chains of square roots that a graph needs, lane
/// by lane.
///
/// The last primes are cached, since successive claims often need the same ones.
pub fn suitable_moduli(
    digest: SeedDigest,
    stream: ProofStream,
    algebraic: &Algebraic<'_>,
) -> [Modulus; TRIAL_LANES] {
    type Known = (SeedDigest, ProofStream, RequiredRoots, [Modulus; TRIAL_LANES]);
    thread_local! {
        static LAST: RefCell<[Option<Known>; 2]> = const { RefCell::new([None, None]) };
    }
    let wanted = RequiredRoots {
        odd: algebraic.odd_indices(),
        squares: algebraic.squares(),
        depth: algebraic.depth(),
    };
    LAST.with_borrow_mut(|last| {
        // Those of tests and those of searches take turns.
        let last = &mut last[usize::from(stream == ProofStream::Squares)];
        if let Some((d, s, known, moduli)) = last
            && (*d, *s, &*known) == (digest, stream, &wanted)
        {
            return *moduli;
        }
        let mut rng = ProofRng::of(digest, stream);
        let primes: [Modulus; PRIMES] = std::array::from_fn(|_| rng.prime_with_roots(&wanted));
        let moduli = std::array::from_fn(|lane| primes[prime_of(lane)]);
        *last = Some((digest, stream, wanted, moduli));
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
