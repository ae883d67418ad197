//! Is a value identically zero? Tested at random points modulo random primes.
//!
//! Theorem 1 of docs/soundness.md. Let n bound the degree of the numerator of R, let its roots
//! multiply degrees by g (2 for each square root, b for each root of odd index b), d = g n, and let H
//! bound the bits of the coefficients of the numerator of its norm. If R ≠ 0, then for K primes
//! drawn independently from a pool of N, each with T accepted points among at most M draws,
//!
//! ```text
//! P(R = 0 at all points) ≤ ( H/(60 N) + (M d/2^60)^T )^K
//! ```

use std::cell::{OnceCell, RefCell};

use crate::graph::{Evaluator, Expr, Step, Tape};
use crate::number::Function;
use crate::number::prime::{Modulus, Prime, UNDEFINED};

use super::algebraic::{Algebraic, Root};
use super::bounds::{Bounds, Source};
use super::chance::Chance;
use super::digest::Digest;

/// Points that are tried at once.
pub const LANES: usize = 8;
/// Primes, as many lanes having the same one as there are points to each.
const PRIMES: usize = 4;
/// Accepted points for each prime.
const POINTS: usize = LANES / PRIMES;
/// Draws for each prime, where no root rejects any.
const DRAWS: u64 = 64;
/// More roots reject too many draws.
pub const MOST_ROOTS: usize = 8;
/// What primes are drawn for.
const TESTS: u64 = 0;
const SEARCHES: u64 = 7;
/// Log₂ of the number of primes p = 3 mod 4 between 2^60 and 2^61, rounded down.
const POOL: f64 = 53.0;
/// Log₂ of the error that a proof stays below.
pub const TARGET: f64 = -100.0;

/// What a test found.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// Zero at all points.
    Zero(Certificate),
    /// Not zero at an accepted point.
    NonZero,
    /// Nothing can be said, and why.
    Silent(String),
}

/// How sure it is that a value is zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Certificate {
    /// Primes used.
    pub primes: usize,
    /// Accepted points, all primes together.
    pub points: usize,
    /// Points that were drawn.
    pub draws: u64,
    /// The bound d on the degree of the norm's numerator.
    pub degree: f64,
    /// The bound H on the bits of its coefficients.
    pub height: f64,
    /// Square roots and roots of odd index.
    pub roots: usize,
    /// Log₂ of the error probability.
    pub error_log2: f64,
}

impl Certificate {
    /// What is certain when both are needed.
    pub fn and(self, other: Self) -> Self {
        // log₂(2^a + 2^b) ≤ max + 1
        Self {
            primes: self.primes.max(other.primes),
            points: self.points.min(other.points),
            draws: self.draws.max(other.draws),
            degree: self.degree.max(other.degree),
            height: self.height.max(other.height),
            roots: self.roots.max(other.roots),
            error_log2: self.error_log2.max(other.error_log2) + 1.0,
        }
    }
}

/// An algebraic graph ready to be tested: its bounds, and primes that suit it.
pub struct Trial<'a> {
    algebraic: &'a Algebraic,
    bounds: OnceCell<Bounds>,
    moduli: [Modulus; LANES],
    digest: Digest,
}

impl<'a> Trial<'a> {
    /// Draws primes; values are bounded when that is first asked for.
    pub fn new(algebraic: &'a Algebraic, digest: Digest) -> Self {
        let moduli = suitable_moduli(digest, TESTS, algebraic);
        Self { algebraic, bounds: OnceCell::new(), moduli, digest }
    }

    fn bounds(&self) -> &Bounds {
        self.bounds.get_or_init(|| {
            let reached = vec![true; self.algebraic.graph.len()];
            Bounds::of(&self.algebraic.graph, &reached, &self.algebraic.sources)
        })
    }

    /// The moduli of the lanes.
    pub fn moduli(&self) -> &[Modulus; LANES] {
        &self.moduli
    }

    /// Other moduli, to look for an identity: it has to be tested modulo primes that had no part in
    /// finding it.
    pub fn moduli_for_search(&self) -> [Modulus; LANES] {
        suitable_moduli(self.digest, SEARCHES, self.algebraic)
    }

    /// Are all outputs identically zero?
    ///
    /// `roots` are the roots among them that are known to be independent; their signs are random.
    /// `signs` fixes the others: inputs with their values.
    pub fn test(&self, outputs: &[Expr], roots: &[Root], signs: &[(usize, bool)]) -> Outcome {
        if roots.len() > MOST_ROOTS {
            return Outcome::Silent(format!("{} independent roots are too many", roots.len()));
        }
        let most = DRAWS << roots.len();
        let Some(mut certificate) = self.certificate(outputs, roots, most) else {
            return Outcome::Silent("a function has no value in a prime field".to_string());
        };
        if certificate.error_log2 >= TARGET || certificate.error_log2.is_nan() {
            return Outcome::Silent(format!(
                "the degree bound {:.1e} and {:.1e} bits leave an error above 2^{TARGET}",
                certificate.degree, certificate.height
            ));
        }
        let tape = Tape::new(&self.algebraic.graph, outputs);
        let mut evaluator = Evaluator::new(&tape, Prime::new(self.moduli));
        let mut chance = Chance::of(self.digest, 1);
        let mut accepted = [0usize; PRIMES];
        let mut draws = 0;
        while draws < most && accepted.iter().any(|count| *count < POINTS) {
            evaluator.run(&points(&self.moduli, &self.algebraic.sources, signs, &mut chance));
            let values: Vec<[u64; LANES]> = evaluator.outputs().copied().collect();
            draws += POINTS as u64;
            for lane in 0..LANES {
                if values.iter().any(|block| block[lane] == UNDEFINED) {
                    continue;
                }
                if values.iter().any(|block| block[lane] != 0) {
                    return Outcome::NonZero;
                }
                accepted[lane * PRIMES / LANES] += 1;
            }
        }
        if accepted.iter().any(|count| *count < POINTS) {
            return Outcome::Silent(format!(
                "only {} of {} random points have a value: a denominator is always 0, or a root \
                 never exists",
                accepted.iter().sum::<usize>(),
                draws * PRIMES as u64
            ));
        }
        certificate.points = accepted.iter().sum();
        certificate.draws = draws * PRIMES as u64;
        Outcome::Zero(certificate)
    }

    /// Is there a point at which some output is not zero, whatever choice of signs is made?
    pub fn is_nonzero_for_all(&self, outputs: &[Expr], choices: &[Vec<(usize, bool)>]) -> bool {
        let tape = Tape::new(&self.algebraic.graph, outputs);
        let mut evaluator = Evaluator::new(&tape, Prime::new(self.moduli));
        let mut before = Chance::of(self.digest, 1);
        (0..DRAWS as usize / POINTS).any(|_| {
            let mut nonzero = [true; LANES];
            let mut after = before.clone();
            for signs in choices {
                // The same point for each choice.
                after = before.clone();
                evaluator.run(&points(&self.moduli, &self.algebraic.sources, signs, &mut after));
                for (lane, nonzero) in nonzero.iter_mut().enumerate() {
                    let mut values = evaluator.outputs().map(|block| block[lane]);
                    let defined = evaluator.outputs().all(|block| block[lane] != UNDEFINED);
                    *nonzero &= defined && values.any(|value| value != 0);
                }
            }
            before = after;
            nonzero.contains(&true)
        })
    }

    /// What zeros at all points would be worth.
    fn certificate(&self, outputs: &[Expr], roots: &[Root], most: u64) -> Option<Certificate> {
        let (mut degree, mut height) = (0f64, 0f64);
        for output in outputs {
            let bound = self.bounds().at(self.algebraic.graph.place(*output))?;
            (degree, height) = (degree.max(bound.degree), height.max(bound.height));
        }
        let reached = self.algebraic.graph.reached(outputs.iter().copied());
        let at = |expr: Expr| reached[self.algebraic.graph.place(expr)];
        let odd = self.algebraic.odd.iter().filter(|(base, _)| at(*base));
        let (mut conjugates, mut count) = (2f64.powi(roots.len() as i32), roots.len());
        for (_, index) in odd {
            conjugates *= *index as f64;
            count += 1;
        }
        // Roots of prime numbers are independent of everything; each halves the pool.
        let graph = &self.algebraic.graph;
        let is_constant_root = |step: Step<'_>| match step {
            Step::Unary(Function::Sqrt, a) => matches!(graph.step(a), Step::Constant(_)),
            _ => false,
        };
        let steps = graph.steps().zip(&reached);
        let constants =
            steps.filter(|(step, reached)| **reached && is_constant_root(*step)).count();
        conjugates *= 2f64.powi(constants as i32);
        let pool =
            POOL - self.algebraic.squares.len() as f64 - self.algebraic.odd_indices().len() as f64;
        let (d, h) = (degree * conjugates, height.max(1.0) * conjugates);
        let unlucky_prime = h / 60.0 * (-pool).exp2();
        let unlucky_points = (most as f64 * d * (-60f64).exp2()).powi(POINTS as i32);
        // A union over the outputs: one that is not zero is enough.
        let error_log2 = PRIMES as f64 * (unlucky_prime + unlucky_points).log2();
        Some(Certificate {
            primes: PRIMES,
            points: 0,
            draws: 0,
            degree: d,
            height: h,
            roots: count + constants,
            error_log2,
        })
    }
}

/// Primes with unique odd roots and square roots of constants where a graph has them, lane by lane.
///
/// The last ones are kept: one claim after the other asks for the same.
fn suitable_moduli(digest: Digest, purpose: u64, algebraic: &Algebraic) -> [Modulus; LANES] {
    type Known = (Digest, u64, Vec<u64>, Vec<u64>, [Modulus; LANES]);
    thread_local! {
        static LAST: RefCell<Option<Known>> = const { RefCell::new(None) };
    }
    let (odd, squares) = (algebraic.odd_indices(), &*algebraic.squares);
    LAST.with_borrow_mut(|last| {
        if let Some((d, p, o, s, moduli)) = last
            && (*d, *p, &*o, &**s) == (digest, purpose, &odd, squares)
        {
            return *moduli;
        }
        let mut chance = Chance::of(digest, purpose);
        let primes: [Modulus; PRIMES] = std::array::from_fn(|_| chance.prime(&odd, squares));
        let moduli = std::array::from_fn(|lane| primes[lane * PRIMES / LANES]);
        *last = Some((digest, purpose, odd, squares.to_vec(), moduli));
        moduli
    })
}

impl Algebraic {
    /// Each odd root index once.
    pub fn odd_indices(&self) -> Vec<u64> {
        let mut primes = Vec::new();
        for (_, index) in &self.odd {
            let mut rest = *index;
            for divisor in (3..).step_by(2) {
                if divisor * divisor > rest {
                    break;
                }
                while rest % divisor == 0 {
                    rest /= divisor;
                    primes.push(divisor);
                }
            }
            if rest > 1 {
                primes.push(rest);
            }
        }
        primes.sort_unstable();
        primes.dedup();
        primes
    }

    /// The roots that these outputs contain, in order.
    pub fn roots_of(&self, outputs: &[Expr]) -> impl Iterator<Item = Root> {
        let reached = self.graph.reached(outputs.iter().copied());
        let mut signs = vec![false; self.sources.len()];
        for (place, step) in self.graph.steps().enumerate() {
            if let Step::Input(input) = step {
                signs[input] = reached[place];
            }
        }
        self.roots.iter().copied().filter(move |root| signs[root.sign])
    }

    /// Do these outputs contain a symbol that stands for a transcendental function?
    pub fn has_symbols(&self, outputs: &[Expr]) -> bool {
        let reached = self.graph.reached(outputs.iter().copied());
        self.graph.steps().enumerate().any(|(place, step)| match step {
            Step::Input(input) => {
                reached[place]
                    && input >= self.original_inputs
                    && self.sources[input] != Source::Sign
            }
            _ => false,
        })
    }
}

/// The inputs of one block of random points.
pub fn points(
    moduli: &[Modulus; LANES],
    sources: &[Source],
    signs: &[(usize, bool)],
    chance: &mut Chance,
) -> Vec<[u64; LANES]> {
    let mut point = |input: usize, source: &Source| {
        let fixed = signs.iter().find(|(sign, _)| *sign == input);
        moduli.map(|m| match source {
            Source::Uniform => chance.element(&m),
            Source::Square => {
                let element = chance.element(&m);
                m.mul(element, element)
            }
            Source::Sign => {
                let positive = fixed.map_or_else(|| chance.coin(), |(_, positive)| *positive);
                if positive { m.one() } else { m.sub(0, m.one()) }
            }
        })
    };
    sources.iter().enumerate().map(|(input, source)| point(input, source)).collect()
}
