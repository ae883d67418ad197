//! Proofs of algebraic identities by computation in prime fields.
//!
//! The input is a graph, some of its values, and the distributions of its inputs. The result is
//! that all values vanish identically, with a bound on the probability of an error, or that one of
//! them does not, or the reason why neither is known. The theorems are in docs/soundness.md, and
//! implemented in these files:
//!
//! | | |
//! |---|---|
//! | `lower`, `numbers` | functions that fields lack are replaced by signs and symbols |
//! | `symbols`, `relations` | one symbol for each element of a basis of arguments |
//! | `bounds`, `plain` | degree and height on the graph, denominators kept in factors |
//! | `rng`, `root_numbers`, `digest` | random primes and points, drawn from the seed and the statement |
//! | `trial` | the test of Theorem 1 |
//! | `tower`, `characters` | certificates of independence for roots |
//! | `roots`, `squares`, `partners`, `nested`, `polynomial` | dependent roots and their expressions |
//! | `logarithms`, `powers` | rules of logarithms, powers and exponentials |
//! | `angles`, `arctangents` | sines and cosines of arctangents, arctangents of tangents |
//! | `free_symbols` | symbols in the place of very many roots, moduli and functions |
//! | `buckets` | values that are proved together |
//! | `nonzero` | values that are not identically zero on any cell |
//! | `required` | cells on which what is required has a value |
//! | `explore`, `division`, `next`, `cells`, `rewrite` | the cells of signs, and proofs on each |
//! | `domain`, `fact`, `classes`, `extent` | signs of values over the ranges of the inputs |
//! | `elimination`, `rank`, `reconstruct`, `coprime` | linear algebra and polynomials modulo a prime |
//! | `determined` | values that others determine |

mod alike;
mod angles;
mod arctangent_sums;
mod arctangents;
mod balanced;
mod bounded;
mod bounds;
mod branches;
mod buckets;
mod cells;
mod characters;
mod choices;
mod classes;
mod collected;
mod combination;
mod coprime;
mod determined;
mod digest;
mod division;
mod domain;
mod elimination;
mod emptiness;
mod evident;
mod explore;
mod exponentials;
mod extent;
mod fact;
mod factored;
mod factors;
mod flat;
mod forms;
mod free_symbols;
mod inverse;
mod logarithms;
mod lower;
mod monomial_roots;
mod monotone;
mod nested;
mod next;
mod nonzero;
mod normal;
mod numbers;
mod opposed;
mod outcome;
mod paired;
mod partners;
mod plain;
mod polynomial;
mod polynomials;
mod powers;
mod presence;
mod products;
mod rank;
mod rationalised;
mod reconstruct;
mod refusals;
mod relations;
mod required;
mod rewrite;
mod rng;
mod root_numbers;
mod roots;
mod squares;
mod symbols;
mod tower;
mod trial;
mod vanishing;
mod void;
mod volterra;

pub use angles::{arguments as angle_arguments, without_arctangents};
pub use bounds::InputDistribution;
pub use collected::{NamedPolynomial, SimplerForm, reduced_value, simpler_forms};
pub use combination::{combination_certificate, combinations};
pub use coprime::{are_coprime, are_polynomials, is_single_valued};
pub use determined::Determination;
pub use digest::statement_seed;
pub use domain::{
    KnownSign, is_missing, is_nowhere_zero, is_seen_nowhere_zero, narrowed, point, sign,
};
pub use elimination::reduce;
pub use evident::is_never_negative;
pub use extent::Extent;
pub use fact::SignFact;
pub use factored::factored_sum;
pub use factors::{Factors, LinearDependence, is_square};
pub use flat::has_flat_factor;
pub use forms::completed_squares;
pub use inverse::Inverted;
pub use nested::SquareRoot;
pub use nonzero::Zeros;
pub use outcome::{GroupOutcome, InputRegion, InputRegions};
pub use plain::plain_bounds;
pub use polynomial::{MOST_WORK as MOST_POLYNOMIAL_WORK, Polynomial};
pub use polynomials::{PolynomialBounds, polynomial_bounds};
pub use rationalised::{Rationalised, vanishing_root};
pub use reconstruct::reconstruct;
pub use rewrite::conditions;
pub use rng::{ProofRng, ProofStream};
pub use root_numbers::root_numbers;
pub use trial::{Certificate, fewest, sum_log2};
pub use volterra::volterra_sum;

use rayon::prelude::*;

use crate::graph::{Expr, Fault, Graph};

use buckets::{Bucket, buckets, combined};
use cells::Cell;
use digest::SeedDigest;
use evident::{has_roots, with_evident_signs};
use explore::{Explored, Explorer, Question};
use lower::Algebraic;
use symbols::Symbols;
use trial::{Roots, Trial, TrialResult};

/// Reason why a value that is not zero decides nothing.
const NOT_PRESENT: &str =
    "it is not known whether what the claim is read off has a value at almost all states";
/// Number of steps, counted once for each bucket, from which on threads share the buckets.
const LARGE: usize = 1 << 14;

/// A prover of statements about values of a graph.
pub struct Prover<'a> {
    /// Distributions of the inputs of the graph in order; further inputs are uniform.
    pub sources: &'a [InputDistribution],
    /// Extents of the inputs at real states, in order; further inputs are unbounded.
    pub extents: &'a [Extent],
    /// Seed of primes and points, which also depend on the statement to be proved.
    pub seed: u64,
}

/// Values to be proved zero together.
#[derive(Clone, Debug, Default)]
pub struct Group {
    /// Values to be proved identically zero.
    pub outputs: Vec<Expr>,
    /// Values that exist wherever the claim is to hold.
    pub required: Vec<Expr>,
    /// Values that are not negative wherever the claim is to hold.
    pub facts: Vec<Expr>,
    /// Values without which the claim has no meaning; they need not be zero.
    pub presence: Vec<Expr>,
}

impl Group {
    /// Makes a group of values without further requirements.
    pub fn of(outputs: Vec<Expr>) -> Self {
        Self { outputs, ..Self::default() }
    }
}

impl Prover<'_> {
    /// Decides for each group of outputs whether all of them vanish identically.
    pub fn prove(&self, graph: &Graph, groups: &[Group]) -> Result<Vec<GroupOutcome>, Fault> {
        self.prove_telling(graph, groups, &|_| ())
    }

    /// Decides the same, and tells each time how many groups more are decided. Large graphs are
    /// proved on all threads; the outcomes are those of one.
    pub fn prove_telling(
        &self,
        graph: &Graph,
        groups: &[Group],
        decided: &(dyn Fn(usize) + Sync),
    ) -> Result<Vec<GroupOutcome>, Fault> {
        let outputs: Vec<Vec<Expr>> = groups.iter().map(|group| group.outputs.clone()).collect();
        let digest = SeedDigest::of(self.seed, graph, &outputs);
        let question = QuestionData { graph, sources: self.sources_of(graph), digest };
        let mut outcomes: Vec<Option<GroupOutcome>> = vec![None; groups.len()];
        let buckets = buckets(graph, groups, &question.sources);
        let prove = |bucket: &Bucket| {
            let found = self.prove_bucket(&question, groups, bucket);
            decided(bucket.members.len());
            found
        };
        let is_large = buckets.len() > 1 && buckets.len() * graph.len() >= LARGE;
        let found: Vec<_> = match is_large {
            true => buckets.par_iter().with_max_len(1).map(prove).collect(),
            false => buckets.iter().map(prove).collect(),
        };
        for (bucket, found) in buckets.iter().zip(found) {
            for (index, outcome) in bucket.members.iter().zip(found?) {
                outcomes[*index] = Some(outcome);
            }
        }
        Ok(outcomes.into_iter().flatten().collect())
    }

    /// Decides the groups of a bucket, in the order of its members.
    fn prove_bucket(
        &self,
        question: &QuestionData<'_>,
        groups: &[Group],
        bucket: &Bucket,
    ) -> Result<Vec<GroupOutcome>, Fault> {
        let members = bucket.members.iter().map(|index| &groups[*index]);
        let asked: Vec<&[Expr]> = members.clone().map(|group| group.outputs.as_slice()).collect();
        let found = match bucket.special.is_empty() {
            true => self.prove_plain(question, &asked),
            false => self.prove_special(question, &asked, bucket)?,
        };
        let outcome = |(group, (outcome, is_partial)): (&Group, (GroupOutcome, bool))| {
            let is_settled = matches!(outcome, GroupOutcome::Zero(_) | GroupOutcome::NonZero(_));
            if is_settled && !group.presence.is_empty() && !self.are_present(question, group)? {
                return Ok(match outcome {
                    GroupOutcome::NonZero(_) => GroupOutcome::Silent(NOT_PRESENT.to_string()),
                    _ => GroupOutcome::Partial,
                });
            }
            // Unless the claim says nothing anyway, what it presupposes is missing.
            if matches!(outcome, GroupOutcome::Void) && !group.presence.is_empty() {
                let nothing = question.graph.at(0);
                let asked = Group { outputs: vec![nothing], presence: Vec::new(), ..group.clone() };
                let alone = self.prove(question.graph, &[asked])?;
                let is_void = alone.iter().any(|own| matches!(own, GroupOutcome::Void));
                return Ok(if is_void { outcome } else { GroupOutcome::Partial });
            }
            match (is_partial, &outcome) {
                (true, GroupOutcome::Zero(_) | GroupOutcome::Void) => {
                    self.on_all_parts(question, group, outcome)
                }
                (_, GroupOutcome::NonZero(_)) => self.where_required(question, group, outcome),
                _ => Ok(outcome),
            }
        };
        members.zip(found).map(outcome).collect()
    }

    /// Decides groups with non-rational steps; those that do not vanish on all cells are tried again
    /// with the signs of sums, which may show that some of these are empty.
    fn prove_special(
        &self,
        question: &QuestionData<'_>,
        asked: &[&[Expr]],
        bucket: &Bucket,
    ) -> Result<Vec<(GroupOutcome, bool)>, Fault> {
        let mut found = combined(self.explore(question, asked, bucket)?, bucket);
        let is_open = |(outcome, _): &(GroupOutcome, bool)| {
            !matches!(outcome, GroupOutcome::Zero(_) | GroupOutcome::Void)
        };
        if !found.iter().any(is_open) || !has_roots(question.graph, &bucket.special) {
            return Ok(found);
        }
        let wider = with_evident_signs(question.graph, &asked.concat(), self.extents, bucket);
        if let Some(wider) = wider {
            let again = combined(self.explore(question, asked, &wider)?, &wider);
            for (own, again) in found.iter_mut().zip(again) {
                if is_open(own) {
                    *own = again;
                }
            }
        }
        Ok(found)
    }

    fn explore(
        &self,
        question: &QuestionData<'_>,
        groups: &[&[Expr]],
        bucket: &Bucket,
    ) -> Result<Explored, Fault> {
        let QuestionData { graph, sources, digest } = question;
        let cell = Cell::whole(graph, &bucket.special, &bucket.facts)?;
        let (special, required) = (&bucket.special, &bucket.required);
        let question = &Question { graph, groups: groups.to_vec(), special, required };
        Explorer { question, prover: self, sources, digest: *digest }.explore(cell)
    }

    /// Proves groups of rational functions.
    fn prove_plain(
        &self,
        question: &QuestionData<'_>,
        groups: &[&[Expr]],
    ) -> Vec<(GroupOutcome, bool)> {
        let QuestionData { graph, sources, digest } = question;
        let algebraic = Algebraic::plain(graph, sources);
        let trial = Trial::new(&algebraic, *digest);
        let is_void = |group: &&[Expr]| group.iter().any(|x| graph.is_nowhere_defined(*x));
        let results = trial.test(groups, Roots::default());
        groups
            .iter()
            .zip(results)
            .map(|(group, result)| match result {
                _ if is_void(group) => (GroupOutcome::Void, true),
                TrialResult::Zero(certificate) => (GroupOutcome::Zero(certificate), false),
                TrialResult::NonZero => (GroupOutcome::NonZero(InputRegions::default()), false),
                TrialResult::Silent(reason) => (GroupOutcome::Silent(reason), false),
            })
            .collect()
    }

    fn sources_of(&self, graph: &Graph) -> Vec<InputDistribution> {
        let mut sources = self.sources.to_vec();
        sources.resize(graph.inputs(), InputDistribution::Uniform);
        sources
    }

    /// Replaces non-rational operations in the steps that some outputs need; also returns the error
    /// of the relations used between arguments.
    fn lower(
        &self,
        graph: &Graph,
        outputs: &[Expr],
        sources: &[InputDistribution],
        digest: SeedDigest,
    ) -> Result<(Algebraic<'static>, Option<Certificate>), Fault> {
        let reached = graph.reached(outputs.iter().copied());
        if !symbols::any(graph, &reached) {
            let none = Symbols::opaque(graph, &reached);
            return Ok((Algebraic::of(graph, &reached, sources, &none)?, None));
        }
        let (symbols, certificate) = relations::symbols(graph, &reached, sources, digest)?;
        Ok((Algebraic::of(graph, &reached, sources, &symbols)?, certificate))
    }
}

/// Data shared by all groups of a question.
struct QuestionData<'q> {
    graph: &'q Graph,
    sources: Vec<InputDistribution>,
    digest: SeedDigest,
}
