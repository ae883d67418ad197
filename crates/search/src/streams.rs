//! Streams of random numbers of the searches: one for each purpose, disjoint from those of proofs.

use liouville::proof::{ProofRng, ProofStream};

/// Purpose of random numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SearchStream {
    /// Points at which Taylor coefficients are taken.
    Jets = 40,
    /// Points for relations between terms.
    Relations = 41,
    /// Points and lines for products of known integrals.
    Products = 42,
    /// Lines in the space of parameters.
    Lines = 43,
    /// Points for residuals on a variety.
    Residuals = 44,
    /// Points for small polynomials.
    SmallPolynomials = 45,
    /// Choices of minors.
    Minors = 46,
    /// Parameters at which orbits are expanded.
    Orbits = 47,
    /// Points through which orbits are expanded.
    OrbitPoints = 48,
    /// Lines on which Darboux polynomials are looked for.
    OrbitLines = 49,
    /// Points at which constraints are solved for velocities.
    Constraints = 50,
    /// Points for gradients.
    Gradients = 51,
    /// Points at which exponents are compared.
    Exponents = 52,
    /// Points for the characters of an ansatz.
    Characters = 57,
    /// Points for the equations of an ansatz.
    Equations = 58,
    /// Combinations of the equations of an ansatz.
    Combinations = 59,
    /// Primes of an ansatz; each of its moduli has the next stream.
    Moduli = 60,
}

// The streams of proofs come before the first of these, and those of moduli, without end, are the last.
const _: () =
    assert!(ProofStream::LAST < SearchStream::Jets as u64, "streams of proofs come first");
const _: () = assert!(
    (SearchStream::Combinations as u64) < SearchStream::Moduli as u64,
    "the streams of moduli come last"
);

impl SearchStream {
    /// Makes the random numbers for this purpose under a seed.
    pub fn under(self, seed: u64) -> ProofRng {
        ProofRng::new(seed, self as u64)
    }

    /// Makes the random numbers of stream `number` from this one on.
    pub fn numbered(self, seed: u64, number: u64) -> ProofRng {
        ProofRng::new(seed, self as u64 + number)
    }
}
