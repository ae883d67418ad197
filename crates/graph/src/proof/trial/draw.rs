//! Random primes and points for the lanes of a test.

use std::cell::RefCell;

use crate::number::prime::Modulus;
use crate::proof::bounds::Source;
use crate::proof::chance::{Chance, Stream, Wanted};
use crate::proof::digest::Digest;
use crate::proof::lower::Algebraic;

/// Number of points evaluated at once.
pub const LANES: usize = 8;
/// Number of primes; each is shared by as many lanes as it has points.
pub const PRIMES: usize = 4;

/// Returns the index of the prime that a lane computes modulo.
pub fn prime_of(lane: usize) -> usize {
    lane * PRIMES / LANES
}

/// Draws primes with the unique odd roots and the chains of square roots that a graph needs, lane
/// by lane.
///
/// The last primes are cached, since successive claims often need the same ones.
pub fn suitable_moduli(
    digest: Digest,
    stream: Stream,
    algebraic: &Algebraic<'_>,
) -> [Modulus; LANES] {
    type Known = (Digest, Stream, Wanted, [Modulus; LANES]);
    thread_local! {
        static LAST: RefCell<[Option<Known>; 2]> = const { RefCell::new([None, None]) };
    }
    let wanted = Wanted {
        odd: algebraic.odd_indices(),
        squares: algebraic.squares(),
        depth: algebraic.depth(),
    };
    LAST.with_borrow_mut(|last| {
        // Those of tests and those of searches take turns.
        let last = &mut last[usize::from(stream == Stream::Squares)];
        if let Some((d, s, known, moduli)) = last
            && (*d, *s, &*known) == (digest, stream, &wanted)
        {
            return *moduli;
        }
        let mut chance = Chance::of(digest, stream);
        let primes: [Modulus; PRIMES] = std::array::from_fn(|_| chance.prime_with_roots(&wanted));
        let moduli = std::array::from_fn(|lane| primes[prime_of(lane)]);
        *last = Some((digest, stream, wanted, moduli));
        moduli
    })
}

/// Draws the inputs of one block of random points.
pub fn points(
    moduli: &[Modulus; LANES],
    sources: &[Source],
    fixed: &[(usize, bool)],
    chance: &mut Chance,
) -> Vec<[u64; LANES]> {
    let mut point = |input: usize, source: &Source| {
        let fixed = fixed.iter().find(|(sign, _)| *sign == input);
        moduli.map(|m| match source {
            Source::Uniform => chance.element(&m),
            Source::Sign => {
                let positive = fixed.map_or_else(|| chance.coin(), |(_, positive)| *positive);
                if positive { m.one() } else { m.sub(0, m.one()) }
            }
        })
    };
    sources.iter().enumerate().map(|(input, source)| point(input, source)).collect()
}
