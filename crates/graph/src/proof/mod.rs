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
//! | `chance`, `digest` | random primes and points, drawn from the seed and the statement |
//! | `trial` | the test of Theorem 1 |
//! | `tower`, `characters` | certificates of independence for roots |
//! | `roots`, `squares`, `nested`, `polynomial` | dependent roots and their expressions |
//! | `explore`, `next`, `cells`, `rewrite` | the cells of signs, and proofs on each |
//! | `domain`, `fact`, `classes`, `extent` | signs of values over the ranges of the inputs |
//! | `elimination`, `rank`, `reconstruct`, `coprime` | linear algebra and polynomials modulo a prime |

mod bounds;
mod branches;
mod cells;
mod chance;
mod characters;
mod classes;
mod coprime;
mod digest;
mod domain;
mod elimination;
mod explore;
mod extent;
mod fact;
mod logarithms;
mod lower;
mod nested;
mod next;
mod numbers;
mod plain;
mod polynomial;
mod rank;
mod reconstruct;
mod refusals;
mod relations;
mod rewrite;
mod roots;
mod squares;
mod symbols;
mod tower;
mod trial;

#[cfg(test)]
mod tests;

use std::sync::Arc;

pub use bounds::Source;
pub use chance::Chance;
pub use coprime::{are_coprime, are_polynomials};
pub use domain::{is_nowhere_zero, sign};
pub use elimination::reduce;
pub use extent::Extent;
pub use fact::Fact;
pub use plain::plain_bounds;
pub use reconstruct::reconstruct;
pub use rewrite::conditions;
pub use trial::Certificate;

use crate::graph::{Expr, Fault, Graph, Step};
use crate::number::{Function, Operation};

use cells::{Cell, Leaf};
use digest::Digest;
use explore::{Explored, Explorer, Question};
use lower::Algebraic;
use relations::Relations;
use symbols::Symbols;
use trial::{Finding, Roots, Trial};

/// A prover of statements about values of a graph.
pub struct Prover<'a> {
    /// Distributions of the inputs of the graph in order; further inputs are uniform.
    pub sources: &'a [Source],
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
}

impl Group {
    /// Makes a group of values without further requirements.
    pub fn of(outputs: Vec<Expr>) -> Self {
        Self { outputs, required: Vec::new() }
    }
}

/// The outcome for a group.
#[derive(Clone, Debug)]
pub enum Outcome {
    /// All values are zero wherever they exist.
    Zero(Certificate),
    /// One value is not identically zero on the given parts of the real inputs, and hence at some
    /// real inputs if one of the parts is not empty.
    NonZero(Parts),
    /// Undecided, with the reason.
    Silent(String),
    /// The values are zero wherever they exist, but do not exist on a part of the inputs at which
    /// the required values do.
    Partial,
    /// The values exist for no real inputs.
    Void,
}

/// Parts of the real inputs.
#[derive(Clone, Debug, Default)]
pub struct Parts(Option<Vec<Arc<Part>>>);

/// A part of the real inputs on which some inputs have given signs and some values are positive.
pub struct Part {
    /// Graph of the computation.
    pub graph: Graph,
    /// Values that are positive on the part.
    pub positive: Vec<Expr>,
    /// Sign inputs, and whether each is 1.
    pub signs: Vec<(usize, bool)>,
}

impl std::fmt::Debug for Part {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(out, "{} signs, {} of inputs", self.positive.len(), self.signs.len())
    }
}

impl Part {
    /// Searches for a point of the part inside the extents of the inputs.
    pub fn point(&self, extents: &[Extent]) -> Option<Vec<f64>> {
        let mut inputs = extents.to_vec();
        for (input, positive) in &self.signs {
            if let Some(extent) = inputs.get_mut(*input) {
                *extent = extent.within(*positive);
            }
        }
        let positive: Vec<usize> =
            self.positive.iter().map(|value| self.graph.place(*value)).collect();
        domain::point(&self.graph, &inputs, &positive)
    }
}

impl Parts {
    /// Returns the parts; `None` if they are all real inputs.
    pub fn proper(&self) -> Option<&[Arc<Part>]> {
        self.0.as_deref()
    }
}

impl Outcome {
    /// Whether all values were proved zero.
    pub fn is_zero(&self) -> bool {
        matches!(self, Outcome::Zero(_))
    }

    /// Whether one value was proved not to vanish identically.
    pub fn is_nonzero(&self) -> bool {
        matches!(self, Outcome::NonZero(_))
    }
}

impl Prover<'_> {
    /// Decides for each group of outputs whether all of them vanish identically.
    pub fn prove(&self, graph: &Graph, groups: &[Group]) -> Result<Vec<Outcome>, Fault> {
        let outputs: Vec<Vec<Expr>> = groups.iter().map(|group| group.outputs.clone()).collect();
        let digest = Digest::of(self.seed, graph, &outputs);
        let question = Asked { graph, sources: self.sources_of(graph), digest };
        let mut outcomes: Vec<Option<Outcome>> = vec![None; groups.len()];
        for bucket in buckets(graph, groups, &question.sources) {
            let members = &bucket.members;
            let asked: Vec<&[Expr]> =
                members.iter().map(|index| groups[*index].outputs.as_slice()).collect();
            let found = match bucket.special.is_empty() {
                true => self.prove_plain(&question, &asked),
                false => combined(self.explore(&question, &asked, &bucket)?, members.len()),
            };
            for (index, (outcome, is_partial)) in members.iter().zip(found) {
                outcomes[*index] = Some(match (is_partial, &outcome) {
                    (true, Outcome::Zero(_) | Outcome::Void) => {
                        self.on_all_parts(&question, &groups[*index], outcome)?
                    }
                    _ => outcome,
                });
            }
        }
        Ok(outcomes.into_iter().flatten().collect())
    }

    fn explore(
        &self,
        question: &Asked<'_>,
        groups: &[&[Expr]],
        bucket: &Bucket,
    ) -> Result<Explored, Fault> {
        let Asked { graph, sources, digest } = question;
        let cell = Cell::whole(graph, &bucket.special, &bucket.facts)?;
        let question = &Question { graph, groups: groups.to_vec(), special: &bucket.special };
        Explorer { question, prover: self, sources, digest: *digest }.explore(cell)
    }

    /// Proves values that are undefined on a part of the inputs, as a derivative is where the
    /// radicand of a root vanishes. The outcome stands if the required values are undefined there
    /// too.
    fn on_all_parts(
        &self,
        question: &Asked<'_>,
        group: &Group,
        outcome: Outcome,
    ) -> Result<Outcome, Fault> {
        let Asked { graph, sources, .. } = question;
        if group.required.is_empty() {
            return Ok(outcome);
        }
        let both = [&group.outputs[..], &group.required[..]].concat();
        let wide = Group { outputs: both, required: group.required.clone() };
        let leaves = match buckets(graph, &[wide], sources).pop() {
            Some(bucket) => {
                self.explore(question, &[&group.outputs, &group.required], &bucket)?.leaves
            }
            None => Vec::new(),
        };
        let is_missing = |leaf: &Leaf| matches!(&leaf.findings[..], [None, Some(_)]);
        Ok(match leaves.iter().any(is_missing) {
            true => Outcome::Partial,
            false => outcome,
        })
    }

    /// Proves groups of rational functions.
    fn prove_plain(&self, question: &Asked<'_>, groups: &[&[Expr]]) -> Vec<(Outcome, bool)> {
        let Asked { graph, sources, digest } = question;
        let algebraic = Algebraic::plain(graph, sources);
        let trial = Trial::new(&algebraic, *digest);
        let is_void = |group: &&[Expr]| group.iter().any(|x| graph.is_nowhere_defined(*x));
        let findings = trial.test(groups, Roots::default());
        groups
            .iter()
            .zip(findings)
            .map(|(group, finding)| match finding {
                _ if is_void(group) => (Outcome::Void, true),
                Finding::Zero(certificate) => (Outcome::Zero(certificate), false),
                Finding::NonZero => (Outcome::NonZero(Parts::default()), false),
                Finding::Silent(reason) => (Outcome::Silent(reason), false),
            })
            .collect()
    }

    fn sources_of(&self, graph: &Graph) -> Vec<Source> {
        let mut sources = self.sources.to_vec();
        sources.resize(graph.inputs(), Source::Uniform);
        sources
    }

    /// Replaces non-rational operations in the steps that some outputs need; also returns the error
    /// of the relations used between arguments.
    fn lower(
        &self,
        graph: &Graph,
        outputs: &[Expr],
        sources: &[Source],
        digest: Digest,
    ) -> Result<(Algebraic<'static>, Option<Certificate>), Fault> {
        let reached = graph.reached(outputs.iter().copied());
        let opaque = Symbols::opaque(graph, &reached);
        if !symbols::any(graph, &reached) {
            return Ok((Algebraic::of(graph, &reached, sources, &opaque)?, None));
        }
        let formal = Algebraic::formal(graph, &reached, sources, &opaque)?;
        let mut relations = Relations::new(graph, sources, formal, digest);
        let symbols = Symbols::by_basis(graph, &reached, &mut relations);
        Ok((Algebraic::of(graph, &reached, sources, &symbols)?, relations.certificate))
    }
}

/// Data shared by all groups of a question.
struct Asked<'q> {
    graph: &'q Graph,
    sources: Vec<Source>,
    digest: Digest,
}

/// Groups that are proved together.
struct Bucket {
    /// Places of the non-rational steps that they need.
    special: Vec<usize>,
    /// Facts about values, wherever the claim is to hold.
    facts: Vec<(Expr, Fact)>,
    /// Indices of the groups.
    members: Vec<usize>,
}

/// Sorts groups by the non-rational steps that they need and by the facts; in the order of the
/// first member of each.
fn buckets(graph: &Graph, groups: &[Group], sources: &[Source]) -> Vec<Bucket> {
    let is_special = |step: Step<'_>| match step {
        Step::Constant(_) => false,
        Step::Input(input) => sources.get(input) == Some(&Source::Sign),
        Step::Unary(function, _) => !matches!(function, Function::Neg | Function::Recip),
        Step::Binary(operation, ..) => operation == Operation::Pow,
        Step::Power(_, exponent) => exponent.to_integer().is_none(),
    };
    let special: Vec<usize> =
        (0..graph.len()).filter(|place| is_special(graph.step(*place))).collect();
    let mut buckets: Vec<Bucket> = Vec::new();
    for (index, group) in groups.iter().enumerate() {
        let own: Vec<usize> = match special.is_empty() {
            true => Vec::new(),
            false => {
                let reached = graph.reached(group.outputs.iter().copied());
                special.iter().copied().filter(|place| reached[*place]).collect()
            }
        };
        let is_same = |bucket: &&mut Bucket| {
            let required = |index: &usize| &groups[*index].required;
            bucket.special == own
                && (own.is_empty() || required(&bucket.members[0]) == &group.required)
        };
        match buckets.iter_mut().find(is_same) {
            Some(bucket) => bucket.members.push(index),
            None => {
                let facts = match own.is_empty() {
                    true => Vec::new(),
                    false => {
                        let reached = graph.reached(group.required.iter().copied());
                        let facts = conditions(graph, &reached).into_iter();
                        facts.map(|(place, fact)| (graph.at(place), fact)).collect()
                    }
                };
                buckets.push(Bucket { special: own, facts, members: vec![index] });
            }
        }
    }
    buckets
}

/// Combines the findings on all cells for each group; the flag tells whether the group is undefined
/// on some cell.
fn combined(explored: Explored, count: usize) -> Vec<(Outcome, bool)> {
    let Explored { leaves, certificate } = explored;
    let of_group = |index: usize| {
        let findings = || leaves.iter().filter_map(move |leaf| leaf.findings[index].as_ref());
        let is_nonzero = |finding: &Option<Finding>| matches!(finding, Some(Finding::NonZero));
        if leaves.iter().any(|leaf| is_nonzero(&leaf.findings[index])) {
            return Outcome::NonZero(Parts::default());
        }
        let mut all: Option<Certificate> = None;
        for finding in findings() {
            match finding {
                Finding::Zero(certificate) => all = trial::both(all, Some(*certificate)),
                Finding::Silent(reason) => return Outcome::Silent(reason.clone()),
                Finding::NonZero => {}
            }
        }
        match all {
            Some(all) => Outcome::Zero(certificate.map_or(all, |dropped| all.and(dropped))),
            None => Outcome::Void,
        }
    };
    let mut outcomes: Vec<Outcome> = (0..count).map(of_group).collect();
    // A group that is not zero on the whole needs no parts; others keep those on which they are not
    // zero.
    let is_nonzero = |leaf: &Leaf, index: usize| {
        leaf.cell.is_part() && matches!(leaf.findings[index], Some(Finding::NonZero))
    };
    let of_group = |index: usize| {
        let numbers = (0..leaves.len()).filter(|number| is_nonzero(&leaves[*number], index));
        numbers.collect::<Vec<usize>>()
    };
    let parts: Vec<Vec<usize>> = (0..count).map(of_group).collect();
    let is_partial: Vec<bool> =
        (0..count).map(|index| leaves.iter().any(|leaf| leaf.findings[index].is_none())).collect();
    let shared: Vec<Arc<Part>> = leaves.into_iter().map(|leaf| Arc::new(part(leaf.cell))).collect();
    for (outcome, own) in outcomes.iter_mut().zip(parts) {
        if outcome.is_nonzero() && !own.is_empty() {
            let parts = own.into_iter().map(|number| Arc::clone(&shared[number])).collect();
            *outcome = Outcome::NonZero(Parts(Some(parts)));
        }
    }
    outcomes.into_iter().zip(is_partial).collect()
}

fn part(cell: Cell) -> Part {
    let positive = cell.signs().map(|place| cell.graph.at(place)).collect();
    Part { positive, signs: cell.fixed, graph: cell.graph }
}
