//! Values that are not identically zero: on every cell of signs, and parts of the inputs where they are
//! not.

use super::buckets::{buckets, part};
use super::cells::Leaf;
use super::digest::SeedDigest;
use super::evident::with_evident_signs;
use super::outcome::InputRegion;
use super::trial::TrialResult;
use super::{Group, Prover, QuestionData};
use crate::graph::{Expr, Fault, Graph};

impl Prover<'_> {
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
