//! Tests for identical vanishing at random points modulo random primes.
//!
//! Theorem 1 of docs/soundness.md. Let n bound the degree of the numerator of R, a root of X
//! counting half of X, β the product of the indices of its odd roots, H the bits of its
//! coefficients and e the number of roots of integers in it. If R ≠ 0 and its roots are independent
//! modulo K primes drawn from a pool of N, each with T accepted points among at most M draws with
//! random signs of all roots,
//!
//! ```text
//! P(R = 0 at all points) ≤ ( 2^e H/(60 N) + (M β n/2^60)^T )^K
//! ```

mod bound;
mod certificate;
mod draw;
mod residues;

pub use certificate::{Certificate, both, fewest, sum_log2};
pub use draw::{PRIMES, TRIAL_LANES, points, prime_of, suitable_moduli};
pub use residues::Residues;

use std::cell::OnceCell;

use crate::graph::{Evaluator, Expr, Tape};
use crate::number::prime::{Modulus, Prime};
use crate::number::quadratic::Quadratic;

use super::bounds::Bounds;
use super::digest::SeedDigest;
use super::lower::Algebraic;
use super::rng::{ProofRng, ProofStream};

/// Number of accepted points for each prime.
const PRIME_POINTS: usize = TRIAL_LANES / PRIMES;
/// Largest number of draws for each prime, without nested roots, which refuse draws.
const DRAWS: u64 = 64;
/// Largest number of nested roots; more would refuse too many draws.
pub const MOST_NESTED: u32 = 10;
/// Log₂ of the largest error probability of a proof.
const TARGET: f64 = -100.0;

/// The finding of a test.
#[derive(Clone, Debug, PartialEq)]
pub enum TrialResult {
    /// Zero at all points.
    Zero(Certificate),
    /// Nonzero at an accepted point.
    NonZero,
    /// Undecided, with the reason.
    Silent(String),
}

/// Roots other than the independent ones of the first layer that take part in a test.
#[derive(Clone, Copy, Debug, Default)]
pub struct Roots<'r> {
    /// Number of roots whose radicand contains others.
    pub nested: u32,
    /// Signs that are not random: inputs with their values.
    pub fixed: &'r [(usize, bool)],
}

/// An algebraic graph ready to be tested, with its bounds and suitable primes.
pub struct Trial<'a> {
    algebraic: &'a Algebraic<'a>,
    bounds: OnceCell<Bounds>,
    moduli: [Modulus; TRIAL_LANES],
    digest: SeedDigest,
}

impl<'a> Trial<'a> {
    /// Draws primes; bounds are computed on first use.
    pub fn new(algebraic: &'a Algebraic<'a>, digest: SeedDigest) -> Self {
        let moduli = suitable_moduli(digest, ProofStream::Primes, algebraic);
        Self { algebraic, bounds: OnceCell::new(), moduli, digest }
    }

    fn bounds(&self) -> &Bounds {
        self.bounds.get_or_init(|| {
            let reached = vec![true; self.algebraic.graph.len()];
            Bounds::of(&self.algebraic.graph, &reached, &self.algebraic.sources)
        })
    }

    /// Returns the moduli of the lanes.
    pub fn moduli(&self) -> &[Modulus; TRIAL_LANES] {
        &self.moduli
    }

    /// Tests for each group of outputs whether all of them vanish identically.
    ///
    /// All roots that the groups contain must be independent modulo the primes, or have their signs
    /// among the fixed ones; the signs of the others are random.
    pub fn test(&self, groups: &[&[Expr]], roots: Roots<'_>) -> Vec<TrialResult> {
        let outputs: Vec<Expr> = groups.iter().flat_map(|group| group.iter().copied()).collect();
        match self.algebraic.mask_of(&outputs) {
            0 => self.test_in(Prime::new(self.moduli), groups, roots),
            _ => self.test_in(Quadratic::new(self.moduli), groups, roots),
        }
    }

    /// Whether a value of a group is undefined at every random point at which some given values
    /// exist: it divides by an expression that vanishes identically, except with a probability
    /// below that of a certificate.
    pub fn is_void(&self, group: &[Expr], given: &[Expr], roots: Roots<'_>) -> bool {
        match self.algebraic.mask_of(&[group, given].concat()) {
            0 => self.is_void_in(Prime::new(self.moduli), group, given, roots),
            _ => self.is_void_in(Quadratic::new(self.moduli), group, given, roots),
        }
    }

    fn is_void_in<F: Residues>(
        &self,
        field: F,
        group: &[Expr],
        given: &[Expr],
        roots: Roots<'_>,
    ) -> bool {
        let tape = Tape::new(&self.algebraic.graph, &[given, group].concat());
        let mut evaluator = Evaluator::new(&tape, field);
        let mut rng = ProofRng::of(self.digest, ProofStream::Points);
        let mut lacking = [0; PRIMES];
        for _ in (0..DRAWS << roots.nested.min(MOST_NESTED)).step_by(PRIME_POINTS) {
            evaluator.run(&F::blocks(&self.points(roots.fixed, &mut rng)));
            for lane in 0..TRIAL_LANES {
                let mut exists = evaluator.outputs().map(|block| F::is_zero(block, lane).is_some());
                if exists.by_ref().take(given.len()).all(|exists| exists) {
                    if exists.all(|exists| exists) {
                        return false;
                    }
                    lacking[prime_of(lane)] += 1;
                }
            }
            if lacking.iter().all(|count| *count >= PRIME_POINTS) {
                return true;
            }
        }
        false
    }

    fn test_in<F: Residues>(
        &self,
        field: F,
        groups: &[&[Expr]],
        roots: Roots<'_>,
    ) -> Vec<TrialResult> {
        let draws = DRAWS << roots.nested.min(MOST_NESTED);
        let mut results: Vec<Option<TrialResult>> = Vec::new();
        let mut certificates: Vec<Option<Certificate>> = Vec::new();
        for group in groups {
            let certificate = self.certificate(group, roots, draws);
            let silence = match &certificate {
                None => Some("a function has no value in a prime field".to_string()),
                Some(bound) if bound.error_log2 < TARGET => None,
                Some(bound) => Some(format!(
                    "the degree bound {:.1e} and {:.1e} bits leave an error above 2^{TARGET}",
                    bound.degree, bound.height
                )),
            };
            results.push(silence.map(TrialResult::Silent));
            certificates.push(certificate);
        }
        let mut rng = ProofRng::of(self.digest, ProofStream::Points);
        let mut accepted = vec![[0usize; PRIMES]; groups.len()];
        let mut drawn = 0;
        while drawn < draws {
            let open: Vec<usize> =
                (0..groups.len()).filter(|index| results[*index].is_none()).collect();
            if open.is_empty() {
                break;
            }
            let outputs: Vec<Expr> =
                open.iter().flat_map(|index| groups[*index].iter().copied()).collect();
            let tape = Tape::new(&self.algebraic.graph, &outputs);
            let mut evaluator = Evaluator::new(&tape, field.clone());
            // Until a group is settled, the tape need not be laid out anew.
            let mut unsettled = true;
            while unsettled && drawn < draws {
                let points = self.points(roots.fixed, &mut rng);
                evaluator.run(&F::blocks(&points));
                drawn += PRIME_POINTS as u64;
                let mut values = evaluator.outputs();
                for index in &open {
                    let own: Vec<&F::Block> = values.by_ref().take(groups[*index].len()).collect();
                    let result = &mut results[*index];
                    let accepted = &mut accepted[*index];
                    if is_nonzero::<F>(&own, accepted) {
                        *result = Some(TrialResult::NonZero);
                    } else if accepted.iter().all(|count| *count >= PRIME_POINTS) {
                        *result = certificates[*index].map(|certificate| {
                            TrialResult::Zero(Certificate {
                                points: accepted.iter().sum(),
                                draws: drawn * PRIMES as u64,
                                ..certificate
                            })
                        });
                    }
                    unsettled &= result.is_none();
                }
            }
        }
        results
            .into_iter()
            .zip(accepted)
            .map(|(result, accepted)| {
                result.unwrap_or_else(|| {
                    TrialResult::Silent(format!(
                        "only {} of {} random points have a value: a denominator is always 0, or a \
                         root never exists",
                        accepted.iter().sum::<usize>(),
                        drawn * PRIMES as u64
                    ))
                })
            })
            .collect()
    }

    /// Draws the inputs of one block of random points.
    pub fn points(&self, fixed: &[(usize, bool)], rng: &mut ProofRng) -> Vec<[u64; TRIAL_LANES]> {
        points(&self.moduli, &self.algebraic.sources, fixed, rng)
    }
}

/// Whether some value of a group is nonzero at an accepted point; counts the accepted ones.
fn is_nonzero<F: Residues>(values: &[&F::Block], accepted: &mut [usize; PRIMES]) -> bool {
    for lane in 0..TRIAL_LANES {
        let zeros = values.iter().map(|block| F::is_zero(block, lane));
        let Some(zeros) = zeros.collect::<Option<Vec<bool>>>() else { continue };
        if zeros.contains(&false) {
            return true;
        }
        accepted[prime_of(lane)] += 1;
    }
    false
}
