//! Random primes and random elements, reproducible from a seed.

use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::ToPrimitive;

use super::digest::SeedDigest;
use super::root_numbers::SMALL_PRIMES;
use crate::number::prime::{Modulus, is_prime};
use crate::number::rational::Rational;

/// Purpose of the random numbers of a proof; each purpose has a separate stream.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ProofStream {
    /// Primes for tests.
    Primes = 0,
    /// Points for tests.
    Points = 1,
    /// Points for the search for linear relations.
    Relations = 2,
    /// Points for characters of radicands.
    Characters = 3,
    /// Points for refusals of nested roots.
    Refusals = 4,
    /// Points for ranks.
    Ranks = 5,
    /// Points for the search for squares.
    Squares = 7,
    /// Points for the classes of equal values in a graph.
    Classes = 8,
    /// Points for the search for products of powers.
    Logarithms = 9,
    /// Primes and lines for common factors.
    Factors = 10,
    /// Points for relations that determine values.
    Inverses = 11,
    /// Points and polynomials for the factors of polynomials.
    Divisors = 12,
    /// Directions to the neighbours of a state.
    Neighbours = 13,
}

impl ProofStream {
    /// Number of the last stream; those of other purposes have higher ones.
    pub const LAST: u64 = Self::Neighbours as u64;
}

/// Random numbers for tests in fields, disjoint from all streams of states.
pub struct ProofRng(ChaCha8Rng);

/// Roots that a prime field must contain.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RequiredRoots {
    /// Odd prime factors of the indices of unique roots: p ≠ 1 modulo each.
    pub odd: Vec<u64>,
    /// Integers that must be squares modulo p.
    pub squares: Vec<Rational>,
    /// Exponent with 2^depth, at least 4, dividing p + 1: then 2^depth-th roots exist in the
    /// quadratic extension.
    pub depth: u32,
}

impl RequiredRoots {
    /// Depth that every prime has which is drawn.
    pub const SHORT: u32 = 2;
}

/// Computes Jacobi's symbol of an integer over an odd number.
fn jacobi(integer: &Rational, odd: u64) -> i32 {
    let remainder = match integer.to_integer() {
        Some(small) => match small.unsigned_abs() % odd {
            rest if rest != 0 && small < 0 => odd - rest,
            rest => rest,
        },
        None => integer.parts().0.mod_floor(&BigInt::from(odd)).to_u64().unwrap_or(0),
    };
    let (mut a, mut n) = (remainder, odd);
    let mut symbol = 1;
    while a != 0 {
        let twos = a.trailing_zeros();
        a >>= twos;
        if twos % 2 == 1 && matches!(n % 8, 3 | 5) {
            symbol = -symbol;
        }
        if a % 4 == 3 && n % 4 == 3 {
            symbol = -symbol;
        }
        (a, n) = (n % a, a);
    }
    if n == 1 { symbol } else { 0 }
}

/// Number of odd primes modulo which residues of random primes are chosen: up to 23.
const CHOSEN: usize = 8;
/// Product of these and 8.
const STEP: u64 = step();
/// For each of them, and at last for 8, a number with the residue 1 modulo it, and 0 modulo the others.
const UNITS: [u64; CHOSEN + 1] = units();
/// Squares other than 0 modulo the small primes, as bits.
const SQUARES: [u64; SMALL_PRIMES.len()] = squares();

const fn step() -> u64 {
    let (mut step, mut k) = (8, 1);
    while k <= CHOSEN {
        step *= SMALL_PRIMES[k];
        k += 1;
    }
    step
}

const fn units() -> [u64; CHOSEN + 1] {
    let (mut units, mut k) = ([0; CHOSEN + 1], 0);
    while k <= CHOSEN {
        let own = if k == CHOSEN { 8 } else { SMALL_PRIMES[k + 1] };
        units[k] = STEP / own;
        while units[k] % own != 1 {
            units[k] += STEP / own;
        }
        k += 1;
    }
    units
}

const fn squares() -> [u64; SMALL_PRIMES.len()] {
    let (mut squares, mut k) = ([0; SMALL_PRIMES.len()], 0);
    while k < squares.len() {
        let mut root = 1;
        while root < SMALL_PRIMES[k] {
            squares[k] |= 1 << (root * root % SMALL_PRIMES[k]);
            root += 1;
        }
        k += 1;
    }
    squares
}

/// Whether Jacobi's symbol (q/n) of an odd small prime q, by its index, is 1 for an n = 3 mod 4 with this
/// residue modulo q: it is (n/q), with the other sign if q = 3 mod 4.
const fn is_root_of(index: usize, residue: u64) -> bool {
    let is_square = SQUARES[index] >> residue & 1 == 1;
    residue != 0 && is_square == (SMALL_PRIMES[index] % 4 == 1)
}
/// Lower bound of the random primes.
const LEAST: u64 = 1 << 60;

impl ProofRng {
    /// Makes the random numbers of a seed; different values of `purpose` give independent streams.
    pub fn new(seed: u64, purpose: u64) -> Self {
        Self::in_stream(ChaCha8Rng::seed_from_u64(seed), purpose)
    }

    /// Makes the random numbers for a statement to be proved, so that nobody can choose the
    /// statement with regard to them.
    pub fn of(digest: SeedDigest, stream: ProofStream) -> Self {
        Self::in_stream(ChaCha8Rng::from_seed(digest.0), stream as u64)
    }

    /// Makes random numbers that are the same for every statement, for what a search tries: its finds are
    /// proved in other ways.
    pub fn for_trials(stream: ProofStream) -> Self {
        Self::new(0, stream as u64)
    }

    fn in_stream(mut stream: ChaCha8Rng, purpose: u64) -> Self {
        stream.set_stream((1 << 63) | purpose);
        Self(stream)
    }

    /// Draws a random prime p = 3 mod 4 between 2^60 and 2^61 with p ≠ 1 modulo each of `odd` and
    /// all of `squares` squares modulo p.
    pub fn prime(&mut self, odd: &[u64], squares: &[u64]) -> Modulus {
        loop {
            let wanted = RequiredRoots { odd: odd.to_vec(), ..RequiredRoots::default() };
            let modulus = self.prime_with_roots(&wanted);
            if squares.iter().all(|n| modulus.is_square(modulus.integer(*n))) {
                return modulus;
            }
        }
    }

    /// Draws a random prime between 2^60 and 2^61 whose field contains the wanted roots.
    pub fn prime_with_roots(&mut self, wanted: &RequiredRoots) -> Modulus {
        let low = (1u64 << wanted.depth.max(RequiredRoots::SHORT)) - 1;
        loop {
            let candidate = LEAST | (self.0.next_u64() >> 4) | low;
            if wanted.odd.iter().any(|index| candidate % index == 1) {
                continue;
            }
            // Jacobi symbols are faster than primality tests.
            let has_root = |n: &Rational| jacobi(n, candidate) == 1;
            if wanted.squares.iter().all(has_root) && is_prime(candidate) {
                return Modulus::new(candidate);
            }
        }
    }

    /// Draws a random prime between 2^60 and 2^61 modulo which cube roots and fifth roots are unique,
    /// and the roots of a graph with these [`root_numbers`](super::root_numbers()) keep their ratios: the
    /// numbers and all primes up to 47 are squares, and −1 is none.
    pub fn prime_for(&mut self, numbers: &[Rational]) -> Modulus {
        if numbers.is_empty() {
            return self.prime(&[3, 5], &[2, 3]);
        }
        // The residues modulo 8 and the first odd primes are chosen, those of the others are tested.
        loop {
            let mut residue = 7 * UNITS[CHOSEN];
            for (index, unit) in UNITS[..CHOSEN].iter().enumerate() {
                residue += self.residue(index + 1) * unit;
            }
            let candidate =
                LEAST - LEAST % STEP + residue % STEP + STEP * (self.0.next_u64() % (LEAST / STEP));
            let is_root = |index: usize| is_root_of(index, candidate % SMALL_PRIMES[index]);
            let has_root = |n: &Rational| jacobi(n, candidate) == 1;
            if candidate >= LEAST
                && (CHOSEN + 1..SMALL_PRIMES.len()).all(is_root)
                && numbers.iter().all(has_root)
                && is_prime(candidate)
            {
                return Modulus::new(candidate);
            }
        }
    }

    /// Draws a residue modulo an odd small prime q, by its index, of the primes p = 3 mod 4 modulo which q is
    /// a square; other than 1 for q = 5.
    fn residue(&mut self, index: usize) -> u64 {
        let q = SMALL_PRIMES[index];
        loop {
            let residue = 1 + self.0.next_u64() % (q - 1);
            if is_root_of(index, residue) && (q, residue) != (5, 1) {
                return residue;
            }
        }
    }

    /// Draws a uniform element, in Montgomery form (which is a permutation of the elements).
    pub fn element(&mut self, modulus: &Modulus) -> u64 {
        loop {
            let value = self.0.next_u64() >> 3;
            if value < modulus.prime() {
                return value;
            }
        }
    }

    /// Draws one of `count` numbers from 0 on, all of nearly the same probability where they are few.
    pub fn below(&mut self, count: u64) -> u64 {
        self.0.next_u64() % count
    }

    /// Draws a fair coin.
    pub fn coin(&mut self) -> bool {
        self.0.next_u64() >> 63 == 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn symbols_of_small_primes_are_those_of_jacobi() {
        for n in (3..20_000u64).step_by(4) {
            for (index, q) in SMALL_PRIMES.into_iter().enumerate().skip(1) {
                let symbol = jacobi(&Rational::from(q as i64), n);
                assert_eq!(is_root_of(index, n % q), symbol == 1, "({q}/{n})");
            }
        }
        for (k, unit) in UNITS.into_iter().enumerate() {
            for (own, q) in SMALL_PRIMES[1..=CHOSEN].iter().chain([&8]).enumerate() {
                assert_eq!(unit % q, u64::from(own == k), "{unit} modulo {q}");
            }
        }
        assert_eq!(jacobi(&Rational::from(-3), 7), 1, "4 = 2²");
        assert_eq!(jacobi(&Rational::from(-14), 7), 0);
    }

    #[test]
    fn primes_are_as_asked() {
        let mut rng = ProofRng::new(1, 0);
        let primes: Vec<u64> = (0..6).map(|_| rng.prime(&[3, 5], &[2, 3]).prime()).collect();
        for p in &primes {
            assert!(is_prime(*p) && p % 4 == 3 && *p > LEAST && *p < 2 * LEAST, "{p}");
            assert!(p % 3 == 2 && p % 5 != 1, "cube and fifth roots are unique");
            let m = Modulus::new(*p);
            assert!(m.is_square(m.integer(2)) && m.is_square(m.integer(3)), "√2 and √3 exist");
        }
        for numbers in [vec![2], vec![2, 53, 1_000_003]] {
            let numbers: Vec<Rational> = numbers.into_iter().map(Rational::from).collect();
            let m = rng.prime_for(&numbers);
            let p = m.prime();
            assert!(is_prime(p) && p % 8 == 7 && p % 3 == 2 && p % 5 == 4, "{p}");
            assert!((LEAST..2 * LEAST).contains(&p), "{p}");
            for k in SMALL_PRIMES.iter().copied().chain([53]).take(14 + numbers.len()) {
                let square = m.integer(k * k);
                assert_eq!(m.root(square), Some(m.integer(k)), "√{k}² modulo {p}");
            }
        }
        let again = ProofRng::new(1, 0).prime(&[3, 5], &[2, 3]).prime();
        assert_eq!(again, primes[0], "the same seed gives the same primes");
        assert_ne!(
            ProofRng::new(2, 0).prime(&[3, 5], &[2, 3]).prime(),
            again,
            "another seed others"
        );
        let squares: Vec<Rational> = [5, 6, 7, 11].map(Rational::from).to_vec();
        let wanted = RequiredRoots { squares, depth: 5, ..RequiredRoots::default() };
        let m = ProofRng::new(1, 0).prime_with_roots(&wanted);
        assert!(is_prime(m.prime()) && m.prime() % 32 == 31, "2^5 divides p + 1");
        assert!([5, 6, 7, 11].iter().all(|n| m.is_square(m.integer(*n))), "all are squares");
    }
}
