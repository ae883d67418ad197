//! Cells of signs on which the values that a claim requires have some: the others do not count.

use super::buckets::buckets;
use super::cells::Leaf;
use super::explore::Explored;
use super::trial::{self, TrialResult};
use super::{Group, GroupOutcome, Prover, QuestionData};
use crate::graph::{Expr, Fault};

impl Prover<'_> {
    /// Proves values that are undefined on a part of the inputs, as a derivative is where the
    /// radicand of a root vanishes. The outcome stands if the required values are undefined there too.
    pub(super) fn on_all_parts(
        &self,
        question: &QuestionData<'_>,
        group: &Group,
        outcome: GroupOutcome,
    ) -> Result<GroupOutcome, Fault> {
        let is_missing = |leaf: &Leaf| matches!(&leaf.results[..], [None] | [None, Some(_)]);
        let explored = self.with_required(question, group)?;
        Ok(match explored.is_some_and(|own| own.leaves.iter().any(is_missing)) {
            true => GroupOutcome::Partial,
            false => outcome,
        })
    }

    /// Proves values that are not 0 on some cell where they are on all cells on which the required values have some.
    pub(super) fn where_required(
        &self,
        question: &QuestionData<'_>,
        group: &Group,
        outcome: GroupOutcome,
    ) -> Result<GroupOutcome, Fault> {
        let Some(explored) = self.with_required(question, group)? else { return Ok(outcome) };
        let counts = |leaf: &&Leaf| !matches!(&leaf.results[..], [_, None]);
        let mut all = explored.certificate;
        let mut is_zero = false;
        for leaf in explored.leaves.iter().filter(counts) {
            match leaf.results.first() {
                Some(Some(TrialResult::Zero(certificate))) => {
                    all = trial::both(all, Some(*certificate));
                    is_zero = true;
                }
                _ => return Ok(outcome),
            }
        }
        Ok(match all {
            Some(certificate) if is_zero => GroupOutcome::Zero(certificate),
            _ => outcome,
        })
    }

    /// Explores the cells of a group together with its required values; `None` where nothing is required, or
    /// all is rational.
    fn with_required(
        &self,
        question: &QuestionData<'_>,
        group: &Group,
    ) -> Result<Option<Explored>, Fault> {
        let QuestionData { graph, sources, .. } = question;
        let Group { outputs, required, facts, .. } = group;
        if required.is_empty() {
            return Ok(None);
        }
        let wide = Group {
            outputs: [&outputs[..], required].concat(),
            required: required.clone(),
            facts: facts.clone(),
            presence: Vec::new(),
        };
        let asked: &[&[Expr]] = &[outputs, required];
        let bucket = buckets(graph, &[wide], sources).pop();
        bucket.map(|bucket| self.explore(question, asked, &bucket)).transpose()
    }
}
