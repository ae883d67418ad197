//! Values that are not identically zero: on every cell of signs, and parts of the inputs where they are
//! not.

use super::buckets::{buckets, part};
use super::cells::Leaf;
use super::digest::SeedDigest;
use super::evident::with_evident_signs;
use super::outcome::InputRegion;
use super::trial::TrialResult;
use super::{Group, GroupOutcome, Prover, QuestionData};
use crate::graph::{Expr, Fault, Graph};

/// Knowledge of the sets of inputs on which a value is 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Zeros {
    /// None of them is open.
    Thin,
    /// One is a cell of signs that may contain inputs.
    OnACell,
    /// Neither is known.
    Unknown,
}

impl Prover<'_> {
    /// Finds whether a value is 0 on a cell of signs that may contain inputs at which all required values
    /// of a group exist and its facts hold. `one` is the constant 1, which is 0 on none: so every cell is
    /// looked at until it is known to be empty, or is divided no more.
    pub fn zeros(
        &self,
        graph: &Graph,
        value: Expr,
        one: Expr,
        group: &Group,
    ) -> Result<Zeros, Fault> {
        let Group { required, facts, .. } = group;
        let outputs = vec![value];
        let digest = SeedDigest::of(self.seed, graph, std::slice::from_ref(&outputs));
        let question = QuestionData { graph, sources: self.sources_of(graph), digest };
        let wide = Group {
            outputs: [&outputs[..], required].concat(),
            required: required.clone(),
            facts: facts.clone(),
            ..Group::default()
        };
        let Some(bucket) = buckets(graph, &[wide], &question.sources).pop() else {
            return Ok(Zeros::Unknown);
        };
        if bucket.special.is_empty() {
            let found = self.prove_plain(&question, &[&outputs]);
            return Ok(match &found[..] {
                [(GroupOutcome::NonZero(_), _)] => Zeros::Thin,
                [(GroupOutcome::Zero(_), _)] => Zeros::OnACell,
                _ => Zeros::Unknown,
            });
        }
        let asked: &[&[Expr]] = &[&outputs, &[one], required];
        let mut zeros = Zeros::Thin;
        for leaf in self.explore(&question, asked, &bucket)?.leaves {
            match &leaf.results[..] {
                // Where nothing required has a value there are no inputs that count.
                [_, _, None] | [Some(TrialResult::NonZero), ..] => {}
                [Some(TrialResult::Zero(_)), ..] => return Ok(Zeros::OnACell),
                _ => zeros = Zeros::Unknown,
            }
        }
        Ok(zeros)
    }

    /// Whether a value is proved to be not identically zero on every cell of signs that may contain
    /// inputs.
    pub fn is_nonzero_on_all_cells(&self, graph: &Graph, value: Expr) -> Result<bool, Fault> {
        let outputs = vec![value];
        let digest = SeedDigest::of(self.seed, graph, std::slice::from_ref(&outputs));
        let question = QuestionData { graph, sources: self.sources_of(graph), digest };
        let groups = [Group::of(outputs)];
        let Some(bucket) = buckets(graph, &groups, &question.sources).pop() else {
            return Ok(false);
        };
        let asked = [groups[0].outputs.as_slice()];
        if bucket.special.is_empty() {
            let found = self.prove_plain(&question, &asked);
            return Ok(found.iter().all(|(outcome, _)| outcome.is_nonzero()));
        }
        let leaves = self.explore(&question, &asked, &bucket)?.leaves;
        let is_nonzero =
            |leaf: &Leaf| matches!(leaf.results.first(), Some(Some(TrialResult::NonZero)));
        Ok(!leaves.is_empty() && leaves.iter().all(is_nonzero))
    }

    /// Finds parts of the inputs on which some value of a group is not identically zero, and on which
    /// the signs of all moduli in the required values are fixed; none if that is not known.
    pub fn nonzero_parts(&self, graph: &Graph, group: &Group) -> Result<Vec<InputRegion>, Fault> {
        let Group { outputs, required, facts, .. } = group;
        let digest = SeedDigest::of(self.seed, graph, std::slice::from_ref(outputs));
        let question = QuestionData { graph, sources: self.sources_of(graph), digest };
        let outputs_and_required = [&outputs[..], required].concat();
        let wide = Group {
            outputs: outputs_and_required,
            required: required.clone(),
            facts: facts.clone(),
            ..Group::default()
        };
        let Some(bucket) = buckets(graph, &[wide], &question.sources).pop() else {
            return Ok(Vec::new());
        };
        let bucket = with_evident_signs(graph, outputs, self.extents, &bucket).unwrap_or(bucket);
        let leaves = self.explore(&question, &[outputs.as_slice()], &bucket)?.leaves;
        let is_nonzero =
            |leaf: &Leaf| matches!(leaf.results.first(), Some(Some(TrialResult::NonZero)));
        let parts = leaves.into_iter().filter(is_nonzero);
        Ok(parts.map(|leaf| part(leaf.cell)).collect())
    }
}
