//! Proofs that a map is one-to-one, by a reversor of it.
//!
//! Where Φ∘σ∘Φ = σ and σ∘σ is the identity, two states with one image have one σ(x), and are the same. The
//! equation is proved at all states that count, at almost all of which its sides have values.

use super::judging::Judging;
use super::sampler::Sampler;
use crate::claim::ClaimKind;
use crate::graph::{Expr, Fault, record};
use crate::mechanics::calculus::DualPoint;
use crate::mechanics::{Phase, combinations};
use crate::number::rational::Rational;
use crate::proof::{Group, Prover, sign};

impl Judging<'_> {
    /// Whether a reversor that the case claims is proved at almost all states of a place.
    pub(super) fn has_reversor(&self, sampler: &Sampler) -> Result<bool, Fault> {
        let Some(combinations) = combinations(sampler.recipes()) else { return Ok(false) };
        // Other parameters belong to another map.
        let is_own =
            |kind: &&ClaimKind| matches!(kind, ClaimKind::Reversor(_)) && kind.changes().is_empty();
        for kind in self.case.claims.iter().map(|claim| &claim.kind).filter(is_own) {
            let mut is_proved = true;
            for fixed in &combinations {
                is_proved = is_proved && self.is_reversed(sampler, fixed, kind)?;
            }
            if is_proved {
                return Ok(true);
            }
        }
        Ok(false)
    }

    fn is_reversed(
        &self,
        sampler: &Sampler,
        fixed: &[Option<Rational>],
        reversor: &ClaimKind,
    ) -> Result<bool, Fault> {
        let model = &self.case.model;
        let (free, dimension) = (model.free_components(), model.dimension());
        let (graph, group) = record(free + dimension, |inputs| {
            let (parameters, state) = inputs.split_at(free);
            let jet = DualPoint::new(Phase::new(model, parameters, state));
            let outputs = reversor.residual(&jet, sampler.kept());
            let written =
                [reversor.presence(&jet, sampler.kept()), reversor.further_requirement(&jet)]
                    .concat();
            Group { outputs, required: written, ..Group::default() }
        })?;
        // The constant of an antiderivative is open.
        if graph.inputs() > free + dimension {
            return Ok(false);
        }
        let (graph, groups) = sampler.compose_groups(&graph, &[group], fixed)?;
        let (extents, sources) = (sampler.extents(), sampler.sources());
        let prover = Prover { sources: &sources, extents: &extents, seed: self.options.seed };
        let Some(group) = groups.first() else { return Ok(false) };
        let values = [&group.outputs[..], &group.required].concat();
        let reached = graph.reached(values.iter().copied());
        for (place, need) in graph.needs(&reached) {
            let value: Expr = graph.at(place);
            let is_positive = || {
                let known = sign(&graph, &extents, &[], &group.facts, value);
                known.is_some_and(|known| known.is_positive)
            };
            if need.not_negative && !is_positive()
                || need.nonzero && !prover.is_nonzero_on_all_cells(&graph, value)?
            {
                return Ok(false);
            }
        }
        Ok(prover.prove(&graph, &groups)?.iter().all(|outcome| outcome.is_zero()))
    }
}
