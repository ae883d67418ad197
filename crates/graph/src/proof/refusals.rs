//! Nested radicands that are not squares at random points.
//!
//! At a point at which the roots before it exist, a radicand A that is not a square in F_p(i) is
//! refused: it is not the square of a function. Where all these roots lie in F_p, A lies in F_p
//! and is a square in F_p(i) in any case. If it is one in F_p at some of these points and not at
//! others, neither A nor -A is the square of a function over F_p, so that A is not the square of a
//! function over F_p(i) either. Points at which a root before it vanishes are left out.

use crate::graph::{Evaluator, Expr, Tape};
use crate::number::prime::{Modulus, UNDEFINED};
use crate::number::quadratic::{Element, Quadratic};

use super::digest::SeedDigest;
use super::lower::{Algebraic, Base};
use super::rng::{ProofRng, ProofStream};
use super::tower::RootStatus;
use super::trial::{MOST_NESTED, PRIMES, Residues, TRIAL_LANES, Trial, prime_of};

/// Number of points without a refusal after which a nested root is taken to be dependent.
const ACCEPTED: usize = 32;

/// The observations on one nested radicand.
#[derive(Clone, Default)]
struct NestedObservations {
    /// Whether the radicand was refused, by prime.
    refused: [bool; PRIMES],
    /// Whether it was no square in F_p, and one, where all roots before it lie in F_p; by prime.
    characters: [[bool; 2]; PRIMES],
    /// Number of points that accepted the radicand and might have refused it.
    accepted: usize,
    /// Number of points at which it lies in F_p, and roots before it do not.
    silent: usize,
}

impl NestedObservations {
    fn is_refused(&self, prime: usize) -> bool {
        self.refused[prime] || self.characters[prime] == [true, true]
    }

    fn is_refused_by_some(&self) -> bool {
        (0..PRIMES).any(|prime| self.is_refused(prime))
    }

    fn is_refused_by_all(&self) -> bool {
        (0..PRIMES).all(|prime| self.is_refused(prime))
    }
}

/// The nested radicands of a computation, with the observations on each.
pub struct Refusals {
    seen: Vec<NestedObservations>,
}

impl Refusals {
    /// Tests the radicands of the bases `nested` in order, over the roots of `bases`.
    pub fn of(
        algebraic: &Algebraic<'_>,
        trial: &Trial<'_>,
        bases: &[usize],
        nested: &[usize],
        digest: SeedDigest,
    ) -> Self {
        let links = bases.iter().flat_map(|index| algebraic.bases[*index].links.iter());
        let first: Vec<Expr> = links.map(|(link, _)| *link).collect();
        let chains: Vec<Vec<Expr>> =
            nested.iter().map(|index| chain(&algebraic.bases[*index])).collect();
        let tape = Tape::new(&algebraic.graph, &[first.clone(), chains.concat()].concat());
        let field = Quadratic::new(*trial.moduli());
        let mut evaluator = Evaluator::new(&tape, field.clone());
        let mut rng = ProofRng::of(digest, ProofStream::Refusals);
        let mut found = Self { seen: vec![NestedObservations::default(); nested.len()] };
        // A base without even roots has no links.
        let chained = first.len().saturating_sub(bases.len());
        let roots = chained + chains.iter().map(Vec::len).sum::<usize>();
        let most = (4 * ACCEPTED * PRIMES / TRIAL_LANES) << (roots as u32).min(MOST_NESTED);
        for _ in 0..most {
            let points = trial.points(&[], &mut rng);
            evaluator.run(&<Quadratic<TRIAL_LANES> as Residues>::blocks(&points));
            for lane in 0..TRIAL_LANES {
                let modulus = &trial.moduli()[lane];
                let mut values = evaluator.outputs().map(|block| block[lane]);
                let roots: Vec<Element> = values.by_ref().take(first.len()).collect();
                // Where a root vanishes, g may have two values: √(x²y)/x at x = 0.
                if roots.iter().any(|root| root[0] == UNDEFINED || *root == [0, 0]) {
                    continue;
                }
                let mut in_field = roots.iter().all(|root| root[1] == 0);
                for (seen, chain) in found.seen.iter_mut().zip(&chains) {
                    let values: Vec<Element> = values.by_ref().take(chain.len()).collect();
                    if !seen.look(modulus, prime_of(lane), &values, &mut in_field) {
                        break;
                    }
                }
            }
            if (0..nested.len()).all(|index| found.is_settled(index)) {
                break;
            }
        }
        found
    }

    /// Whether further points would not change the standing of a radicand.
    fn is_settled(&self, index: usize) -> bool {
        let seen = &self.seen[index];
        seen.is_refused_by_all() || seen.accepted >= ACCEPTED && !seen.is_refused_by_some()
    }

    /// Returns the standing of a radicand, by its index among those tested.
    pub fn standing(&self, index: usize) -> RootStatus {
        let seen = &self.seen[index];
        if seen.is_refused_by_all() {
            RootStatus::Independent
        } else if seen.accepted + seen.silent >= ACCEPTED && !seen.is_refused_by_some() {
            RootStatus::Dependent(Vec::new())
        } else {
            RootStatus::Unreached
        }
    }
}

/// Lists the radicand of a base, and the radicands of those of its links whose roots are links too.
fn chain(base: &Base) -> Vec<Expr> {
    let inner = base.links.len().saturating_sub(1);
    let links = base.links[..inner].iter().map(|(link, _)| *link);
    [base.radicand].into_iter().chain(links).collect()
}

impl NestedObservations {
    /// Observes the values of a chain at one point; returns whether all of its roots exist there.
    /// `in_field` tells whether all roots so far lie in F_p.
    fn look(
        &mut self,
        modulus: &Modulus,
        prime: usize,
        chain: &[Element],
        in_field: &mut bool,
    ) -> bool {
        let is_square = |value: &Element| Quadratic::<1>::new([*modulus]).is_square(&[*value], 0);
        let Some(radicand) = chain.first() else { return false };
        match is_square(radicand) {
            Some(true) if radicand[1] != 0 => self.accepted += 1,
            Some(true) if *in_field => {
                self.characters[prime][usize::from(modulus.is_square(radicand[0]))] = true;
                self.accepted += 1;
            }
            Some(true) => self.silent += 1,
            // 0 is the square of 0.
            Some(false) => {
                self.refused[prime] |= *radicand != [0, 0];
                return false;
            }
            None => return false,
        }
        *in_field &= chain.iter().all(|value| value[1] == 0 && modulus.is_square(value[0]));
        // All roots before the next must exist, √√A among them: it is independent where √A is, as
        // -1 is a square.
        chain[1..].iter().all(|value| is_square(value) == Some(true))
    }
}
