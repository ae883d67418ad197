//! Parts of the states: a value that is not 0 at one state may still be 0 on an open set of others,
//! if it contains moduli, or roots that depend on each other.

use super::claim_state::ClaimState;
use super::evidence::Verdict;
use super::judging::Judging;
use super::ladder::Open;
use super::recorded::RecordedClaim;
use super::sampler::Sampler;
use crate::graph::{Expr, Fault, Graph, Step};
use crate::mechanics::{Draw, combinations};
use crate::number::{BinaryOperation, UnaryFunction};
use crate::proof::Prover;

impl Judging<'_> {
    /// Notes which of the claims that a value does not vanish are shown on a part of the states only,
    /// as far as is known (docs/soundness.md, "Independence").
    pub(super) fn settle_parts(
        &self,
        sampler: &Sampler,
        open: &mut Open<'_, '_>,
    ) -> Result<(), Fault> {
        let is_shown = |item: &RecordedClaim<'_>, status: &ClaimState| {
            item.claim.kind.is_negated() && status.settled == Some(Verdict::Refuted)
        };
        for (item, status) in open.iter_mut().filter(|(item, status)| is_shown(item, status)) {
            status.is_on_a_part = !self.is_nonzero_on_all_parts(sampler, &item.residual)?;
        }
        Ok(())
    }

    /// Whether one of some values is known to vanish on no open set of states.
    fn is_nonzero_on_all_parts(&self, sampler: &Sampler, values: &[Expr]) -> Result<bool, Fault> {
        // A level without a solution may have several branches.
        if sampler.is_numerical() {
            return Ok(false);
        }
        let Some(combinations) = combinations(sampler.recipes()) else { return Ok(false) };
        let (extents, sources) = (sampler.extents(), sampler.sources());
        let prover = Prover { sources: &sources, extents: &extents, seed: self.options.seed };
        for fixed in combinations {
            let (graph, groups) = sampler.compose(self.graph, &[values.to_vec()], &fixed)?;
            let values = groups.concat();
            if is_one_function(&graph, &values, sampler.recipes()) {
                continue;
            }
            let mut is_nonzero = false;
            for value in values {
                is_nonzero |= prover.is_nonzero_on_all_cells(&graph, value)?;
            }
            if !is_nonzero {
                return Ok(false);
            }
        }
        Ok(true)
    }
}

/// Whether values are restrictions of one analytic function on a connected complex domain: they are built
/// by arithmetic, exp, sin, cos, and by roots, logarithms and powers of affine functions.
fn is_one_function(graph: &Graph, values: &[Expr], inputs: &[Draw]) -> bool {
    let reached = graph.reached(values.iter().copied());
    let mut is_affine = vec![false; reached.len()];
    for (place, step) in graph.steps().enumerate().filter(|(place, _)| reached[*place]) {
        let is_constant = |place: usize| matches!(graph.step(place), Step::Constant(_));
        is_affine[place] = match step {
            Step::Constant(_) | Step::Input(_) => true,
            Step::Unary(UnaryFunction::Neg, a) => is_affine[a],
            Step::Binary(BinaryOperation::Add | BinaryOperation::Sub, a, b) => {
                is_affine[a] && is_affine[b]
            }
            Step::Binary(BinaryOperation::Mul, a, b) => {
                (is_constant(a) && is_affine[b]) || (is_constant(b) && is_affine[a])
            }
            _ => false,
        };
        let is_single_valued = match step {
            Step::Input(input) => !matches!(inputs.get(input), Some(Draw::Sign)),
            Step::Unary(UnaryFunction::Abs | UnaryFunction::Atan, _) => false,
            Step::Unary(UnaryFunction::Sqrt | UnaryFunction::Ln, a) => is_affine[a],
            Step::Power(a, exponent) => exponent.to_integer().is_some() || is_affine[a],
            Step::Binary(BinaryOperation::Pow, a, _) => is_affine[a],
            _ => true,
        };
        if !is_single_valued {
            return false;
        }
    }
    true
}
