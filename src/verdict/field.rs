//! Proofs of residuals in prime fields: the claim's graph as a function of the draws, passed to the
//! prover.

use std::sync::Arc;

use super::judging::Judging;
use super::sampler::Sampler;
use crate::graph::{Expr, Fault, Graph};
use crate::mechanics::combinations;
use crate::number::rational::Rational;
use crate::proof::{Certificate, Group, GroupOutcome, InputRegions, Prover};

/// Message for a larger number of combinations.
pub const TOO_MANY_COMBINATIONS: &str = "the lists of parameter values have too many combinations";

/// The states of one place, for proofs in prime fields.
pub struct PrimeFieldStates<'a> {
    bench: &'a Judging<'a>,
    sampler: &'a Sampler,
}

/// Values to be proved zero together.
#[derive(Clone, Debug, Default)]
pub struct Query {
    /// Values to be proved zero.
    pub outputs: Vec<Expr>,
    /// Values that exist at the states that count, besides those that exist at every state.
    pub requirement: Vec<Expr>,
    /// Values that have to exist at the states that count.
    pub presence: Vec<Expr>,
}

impl Query {
    /// Makes a query for which all states count.
    pub fn of(outputs: Vec<Expr>) -> Self {
        Self { outputs, ..Self::default() }
    }
}

/// Answer to a query.
#[derive(Clone, Debug)]
pub enum Answer {
    /// All values are zero wherever they exist.
    Zero(Certificate),
    /// Some value is not identically zero, on any of these sets of states.
    NonZero(Vec<Where>),
    /// Undecided, with the reason.
    Silent(String),
    /// All values are zero wherever they exist, but do not exist everywhere that the written
    /// formulas do.
    Partial,
    /// All values exist together at no state.
    Void,
}

/// A set of states on which a value is not identically zero.
#[derive(Clone, Debug)]
pub struct Where {
    /// Choice of listed parameter values.
    pub fixed: Vec<Option<Rational>>,
    /// Parts of the states.
    pub parts: InputRegions,
    /// Values and what they require, as functions of the draws.
    pub drawn: DrawnGroup,
}

/// Values and what they require, as functions of the draws.
#[derive(Clone, Debug)]
pub struct DrawnGroup {
    /// Graph of the values.
    pub graph: Arc<Graph>,
    /// The values.
    pub group: Group,
}

impl Answer {
    /// Whether some value is not identically zero on all of the states for some choice of listed
    /// values, provided that there are states.
    pub fn is_nonzero(&self) -> bool {
        let is_whole = |found: &Where| found.parts.proper().is_none();
        matches!(self, Answer::NonZero(found) if found.iter().any(is_whole))
    }
}

impl<'a> PrimeFieldStates<'a> {
    /// Makes the prime-field side of a place.
    pub fn new(bench: &'a Judging<'a>, sampler: &'a Sampler) -> Self {
        Self { bench, sampler }
    }

    /// Tests whether each group of values is zero at all states of the place, for all parameters.
    pub fn test(&self, queries: &[Query]) -> Result<Vec<Answer>, Fault> {
        self.test_telling(queries, &|_| ())
    }

    /// Tests the same, and tells each time how many groups more are decided.
    pub fn test_telling(
        &self,
        queries: &[Query],
        decided: &(dyn Fn(usize) + Sync),
    ) -> Result<Vec<Answer>, Fault> {
        let silent = |reason: &str| Ok(vec![Answer::Silent(reason.to_string()); queries.len()]);
        if queries.is_empty() {
            return Ok(Vec::new());
        }
        if self.sampler.is_numerical() {
            return silent("the level set has no parametrisation");
        }
        let Some(combinations) = combinations(self.sampler.recipes()) else {
            return silent(TOO_MANY_COMBINATIONS);
        };
        let (extents, sources) = (self.sampler.extents(), self.sampler.sources());
        let seed = self.bench.options.seed;
        let prover = Prover { sources: &sources, extents: &extents, seed };
        let graph = self.bench.graph;
        let common = self.bench.common.required_at(self.sampler.kept());
        let group = |query: &Query| Group {
            outputs: query.outputs.clone(),
            required: [&query.requirement[..], &common].concat(),
            presence: query.presence.clone(),
            ..Group::default()
        };
        let groups: Vec<Group> = queries.iter().map(group).collect();
        let mut answers: Vec<Option<Answer>> = vec![None; queries.len()];
        for fixed in combinations {
            let (graph, groups) = self.sampler.compose_groups(graph, &groups, &fixed)?;
            let outcomes = prover.prove_telling(&graph, &groups, decided)?;
            let graph = Arc::new(graph);
            for ((all, one), group) in answers.iter_mut().zip(outcomes).zip(&groups) {
                let is_void = group.required.iter().any(|value| graph.is_nowhere_defined(*value));
                let one = match one {
                    // For these listed values there is no state.
                    _ if is_void => Answer::Void,
                    GroupOutcome::Zero(certificate) => Answer::Zero(certificate),
                    GroupOutcome::NonZero(parts) => {
                        let drawn = DrawnGroup { graph: Arc::clone(&graph), group: group.clone() };
                        Answer::NonZero(vec![Where { fixed: fixed.clone(), parts, drawn }])
                    }
                    GroupOutcome::Silent(reason) => Answer::Silent(reason),
                    GroupOutcome::Partial => Answer::Partial,
                    GroupOutcome::Void => Answer::Void,
                };
                *all = Some(match all.take() {
                    None => one,
                    Some(before) => both(before, one),
                });
            }
        }
        Ok(answers.into_iter().flatten().collect())
    }

    /// Finds the ranks of the first `n` rows of a matrix of values, for each n in `heights`, at a
    /// random state of the place; the least over listed parameter values.
    pub fn ranks(
        &self,
        rows: &[Vec<Expr>],
        heights: &[usize],
    ) -> Result<Option<Vec<usize>>, Fault> {
        let mut least: Option<Vec<usize>> = None;
        if self.sampler.is_numerical() {
            return Ok(None);
        }
        let (extents, sources) = (self.sampler.extents(), self.sampler.sources());
        for fixed in combinations(self.sampler.recipes()).unwrap_or_default() {
            let (graph, rows) = self.sampler.compose(self.bench.graph, rows, &fixed)?;
            let seed = self.bench.options.seed;
            let prover = Prover { sources: &sources, extents: &extents, seed };
            let Some(found) = prover.ranks(&graph, &rows, heights)? else { return Ok(None) };
            least = Some(match least {
                None => found,
                Some(before) => before.into_iter().zip(found).map(|(a, b)| a.min(b)).collect(),
            });
        }
        Ok(least)
    }
}

/// Combines the answers for two choices of listed values; a choice for which nothing exists is
/// ignored.
fn both(a: Answer, b: Answer) -> Answer {
    match (a, b) {
        (Answer::Void, other) | (other, Answer::Void) => other,
        (Answer::Zero(a), Answer::Zero(b)) => Answer::Zero(a.and(b)),
        (Answer::NonZero(mut a), Answer::NonZero(b)) => {
            a.extend(b);
            Answer::NonZero(a)
        }
        (Answer::NonZero(found), _) | (_, Answer::NonZero(found)) => Answer::NonZero(found),
        (Answer::Silent(reason), _) | (_, Answer::Silent(reason)) => Answer::Silent(reason),
        (Answer::Partial, _) | (_, Answer::Partial) => Answer::Partial,
    }
}
