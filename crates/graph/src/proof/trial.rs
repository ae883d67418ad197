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

use std::cell::{OnceCell, RefCell};

use crate::graph::{Evaluator, Expr, Tape};
use crate::number::Domain;
use crate::number::prime::{Modulus, Prime, UNDEFINED};
use crate::number::quadratic::{Element, Quadratic};

use super::bounds::{Bounds, Source};
use super::chance::{Chance, Stream, Wanted};
use super::digest::Digest;
use super::lower::Algebraic;

/// Number of points evaluated at once.
pub const LANES: usize = 8;
/// Number of primes; each is shared by as many lanes as it has points.
pub const PRIMES: usize = 4;
/// Number of accepted points for each prime.
const POINTS: usize = LANES / PRIMES;
/// Largest number of draws for each prime, without nested roots, which refuse draws.
const DRAWS: u64 = 64;
/// Largest number of nested roots; more would refuse too many draws.
pub const MOST_NESTED: u32 = 10;
/// Log₂ of the number of primes p = 3 mod 4 between 2^60 and 2^61, rounded down.
const POOL: f64 = 53.0;
/// Log₂ of the largest error probability of a proof.
const TARGET: f64 = -100.0;

/// Returns the index of the prime that a lane computes modulo.
pub fn prime_of(lane: usize) -> usize {
    lane * PRIMES / LANES
}

/// The finding of a test.
#[derive(Clone, Debug, PartialEq)]
pub enum Finding {
    /// Zero at all points.
    Zero(Certificate),
    /// Nonzero at an accepted point.
    NonZero,
    /// Undecided, with the reason.
    Silent(String),
}

/// A bound on the probability that a value found zero at all points is not identically zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Certificate {
    /// Number of primes used.
    pub primes: usize,
    /// Number of accepted points, all primes together.
    pub points: usize,
    /// Number of points drawn.
    pub draws: u64,
    /// Bound βn on the degree.
    pub degree: f64,
    /// Bound H on the bits of the coefficients.
    pub height: f64,
    /// Number of roots of any index.
    pub roots: usize,
    /// Log₂ of the error probability.
    pub error_log2: f64,
}

impl Certificate {
    /// Returns the bound for the case that both certificates are needed.
    pub fn and(self, other: Self) -> Self {
        // log₂(2^a + 2^b) ≤ max + 1
        Self {
            primes: self.primes.max(other.primes),
            points: fewest(self.points, other.points),
            draws: self.draws.max(other.draws),
            degree: self.degree.max(other.degree),
            height: self.height.max(other.height),
            roots: self.roots.max(other.roots),
            error_log2: self.error_log2.max(other.error_log2) + 1.0,
        }
    }
}

/// Returns the smaller number of points; 0 counts as missing.
fn fewest(a: usize, b: usize) -> usize {
    if a == 0 || b == 0 { a.max(b) } else { a.min(b) }
}

/// Returns the bound for all certificates present.
pub fn both(a: Option<Certificate>, b: Option<Certificate>) -> Option<Certificate> {
    match (a, b) {
        (Some(a), Some(b)) => Some(a.and(b)),
        (a, b) => a.or(b),
    }
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
    moduli: [Modulus; LANES],
    digest: Digest,
}

impl<'a> Trial<'a> {
    /// Draws primes; bounds are computed on first use.
    pub fn new(algebraic: &'a Algebraic<'a>, digest: Digest) -> Self {
        let moduli = suitable_moduli(digest, Stream::Primes, algebraic);
        Self { algebraic, bounds: OnceCell::new(), moduli, digest }
    }

    fn bounds(&self) -> &Bounds {
        self.bounds.get_or_init(|| {
            let reached = vec![true; self.algebraic.graph.len()];
            Bounds::of(&self.algebraic.graph, &reached, &self.algebraic.sources)
        })
    }

    /// Returns the moduli of the lanes.
    pub fn moduli(&self) -> &[Modulus; LANES] {
        &self.moduli
    }

    /// Tests for each group of outputs whether all of them vanish identically.
    ///
    /// All roots that the groups contain must be independent modulo the primes, or have their signs
    /// among the fixed ones; the signs of the others are random.
    pub fn test(&self, groups: &[&[Expr]], roots: Roots<'_>) -> Vec<Finding> {
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
        let mut chance = Chance::of(self.digest, Stream::Points);
        let mut lacking = [0; PRIMES];
        for _ in (0..DRAWS << roots.nested.min(MOST_NESTED)).step_by(POINTS) {
            evaluator.run(&F::blocks(&self.points(roots.fixed, &mut chance)));
            for lane in 0..LANES {
                let mut exists = evaluator.outputs().map(|block| F::is_zero(block, lane).is_some());
                if exists.by_ref().take(given.len()).all(|exists| exists) {
                    if exists.all(|exists| exists) {
                        return false;
                    }
                    lacking[prime_of(lane)] += 1;
                }
            }
            if lacking.iter().all(|count| *count >= POINTS) {
                return true;
            }
        }
        false
    }

    fn test_in<F: Residues>(&self, field: F, groups: &[&[Expr]], roots: Roots<'_>) -> Vec<Finding> {
        let draws = DRAWS << roots.nested.min(MOST_NESTED);
        let mut findings: Vec<Option<Finding>> = Vec::new();
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
            findings.push(silence.map(Finding::Silent));
            certificates.push(certificate);
        }
        let mut chance = Chance::of(self.digest, Stream::Points);
        let mut accepted = vec![[0usize; PRIMES]; groups.len()];
        let mut drawn = 0;
        while drawn < draws {
            let open: Vec<usize> =
                (0..groups.len()).filter(|index| findings[*index].is_none()).collect();
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
                let points = self.points(roots.fixed, &mut chance);
                evaluator.run(&F::blocks(&points));
                drawn += POINTS as u64;
                let mut values = evaluator.outputs();
                for index in &open {
                    let own: Vec<&F::Block> = values.by_ref().take(groups[*index].len()).collect();
                    let finding = &mut findings[*index];
                    let accepted = &mut accepted[*index];
                    if is_nonzero::<F>(&own, accepted) {
                        *finding = Some(Finding::NonZero);
                    } else if accepted.iter().all(|count| *count >= POINTS) {
                        *finding = certificates[*index].map(|certificate| {
                            Finding::Zero(Certificate {
                                points: accepted.iter().sum(),
                                draws: drawn * PRIMES as u64,
                                ..certificate
                            })
                        });
                    }
                    unsettled &= finding.is_none();
                }
            }
        }
        findings
            .into_iter()
            .zip(accepted)
            .map(|(finding, accepted)| {
                finding.unwrap_or_else(|| {
                    Finding::Silent(format!(
                        "only {} of {} random points have a value: a denominator is always 0, or a \
                         root never exists",
                        accepted.iter().sum::<usize>(),
                        drawn * PRIMES as u64
                    ))
                })
            })
            .collect()
    }

    /// Computes the bound that zeros at all points would give.
    fn certificate(&self, outputs: &[Expr], roots: Roots<'_>, draws: u64) -> Option<Certificate> {
        let algebraic = self.algebraic;
        let (mut degree, mut height) = (0f64, 0f64);
        for output in outputs {
            let bound = self.bounds().at(algebraic.graph.place(*output))?;
            (degree, height) = (degree.max(bound.degree), height.max(bound.height));
        }
        let reached = algebraic.graph.reached(outputs.iter().copied());
        let odd = algebraic.odd.iter().filter(|(base, _)| reached[algebraic.graph.place(*base)]);
        let mask = algebraic.mask_of(outputs);
        Some(self.bounded(degree, height, odd, mask, roots, draws))
    }

    /// Computes the bound for the difference of any two values that are equal at all points of one
    /// block; `None` if it would not be below the target.
    pub fn of_differences(&self) -> Option<Certificate> {
        let (degree, height) = self.bounds().of_differences();
        let odd = self.algebraic.odd.iter();
        let bound = self.bounded(degree, height, odd, u128::MAX, Roots::default(), DRAWS);
        (bound.error_log2 < TARGET).then_some(bound)
    }

    fn bounded<'o>(
        &self,
        degree: f64,
        height: f64,
        odd: impl Iterator<Item = &'o (Expr, u64)>,
        mask: u128,
        roots: Roots<'_>,
        draws: u64,
    ) -> Certificate {
        let algebraic = self.algebraic;
        let (mut degree, mut count) = (degree, 0);
        for (_, index) in odd {
            degree *= *index as f64;
            count += 1;
        }
        for base in &algebraic.bases {
            let signs = base.links.iter().filter(|(_, sign)| mask & algebraic.bit(*sign) != 0);
            count += signs.count();
        }
        let numbers: u32 = algebraic.numbers.iter().map(|(_, length)| length).sum();
        count += numbers as usize;
        let is_met = |(sign, _): &&(usize, bool)| mask & algebraic.bit(*sign) != 0;
        let loose = roots.fixed.iter().filter(is_met).count();
        // Conjugates over the rationals multiply heights, as do all choices of dependent signs.
        let height = (height.max(1.0) + 1.0) * 2f64.powi((numbers as usize + loose) as i32);
        // Each condition at most halves the pool.
        let chains = algebraic.depth().saturating_sub(2) as usize;
        let conditions = algebraic.odd_indices().len() + algebraic.numbers.len() + chains;
        let pool = POOL - conditions as f64;
        let unlucky_prime = height / 60.0 * (-pool).exp2();
        let unlucky_points = (draws as f64 * degree * (-60f64).exp2()).powi(POINTS as i32);
        // Union bound over the outputs: one nonzero output is enough.
        let error_log2 = PRIMES as f64 * (unlucky_prime + unlucky_points).log2();
        Certificate {
            primes: PRIMES,
            points: 0,
            draws: 0,
            degree,
            height,
            roots: count,
            error_log2: if error_log2.is_nan() { 0.0 } else { error_log2 },
        }
    }

    /// Draws the inputs of one block of random points.
    pub fn points(&self, fixed: &[(usize, bool)], chance: &mut Chance) -> Vec<[u64; LANES]> {
        points(&self.moduli, &self.algebraic.sources, fixed, chance)
    }
}

/// Whether some value of a group is nonzero at an accepted point; counts the accepted ones.
fn is_nonzero<F: Residues>(values: &[&F::Block], accepted: &mut [usize; PRIMES]) -> bool {
    for lane in 0..LANES {
        let zeros = values.iter().map(|block| F::is_zero(block, lane));
        let Some(zeros) = zeros.collect::<Option<Vec<bool>>>() else { continue };
        if zeros.contains(&false) {
            return true;
        }
        accepted[prime_of(lane)] += 1;
    }
    false
}

/// A domain with a finite field in each lane.
pub trait Residues: Domain + Clone {
    /// Converts elements of the prime fields into the domain's form.
    fn blocks(points: &[[u64; LANES]]) -> Vec<Self::Block>;

    /// Whether the value in a lane is 0; `None` where it is undefined.
    fn is_zero(block: &Self::Block, lane: usize) -> Option<bool>;
}

impl Residues for Prime<LANES> {
    fn blocks(points: &[[u64; LANES]]) -> Vec<[u64; LANES]> {
        points.to_vec()
    }

    fn is_zero(block: &[u64; LANES], lane: usize) -> Option<bool> {
        (block[lane] != UNDEFINED).then_some(block[lane] == 0)
    }
}

impl Residues for Quadratic<LANES> {
    fn blocks(points: &[[u64; LANES]]) -> Vec<[Element; LANES]> {
        points.iter().map(|block| block.map(|x| [x, 0])).collect()
    }

    fn is_zero(block: &[Element; LANES], lane: usize) -> Option<bool> {
        (block[lane][0] != UNDEFINED).then_some(block[lane] == [0, 0])
    }
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
