//! Proofs that a map takes no two states to one image, but for states of measure 0.

use super::field::combinations;
use super::judging::Judging;
use super::sampler::Sampler;
use crate::graph::{Expr, Fault, Graph, Step, record};
use crate::mechanics::Phase;
use crate::mechanics::calculus::DualPoint;
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};
use crate::proof::{Determination, Group, Prover, is_nowhere_zero};

impl Judging<'_> {
    /// Whether the map is proved to be one-to-one on the states of a place, for each choice of
    /// listed values: its image determines the state, or it is monotone in one variable.
    pub(super) fn is_one_to_one(&self, sampler: &Sampler) -> Result<bool, Fault> {
        // Each part of a level would have a relation of its own, and parts may have common images.
        let is_whole = !sampler.is_numerical()
            && self.missed_part(sampler)?.is_none()
            && self.pieces(sampler)?.is_none();
        if !is_whole {
            return Ok(false);
        }
        let Some(combinations) = combinations(sampler.recipes()) else { return Ok(false) };
        for fixed in combinations {
            if !self.is_monotone(sampler, &fixed)? && !self.has_inverse(sampler, &fixed)? {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Whether the state is proved to be a function of its image and the parameters.
    fn has_inverse(&self, sampler: &Sampler, fixed: &[Option<Rational>]) -> Result<bool, Fault> {
        let model = &self.case.model;
        let mut inputs: Vec<Option<Expr>> = vec![None; self.graph.inputs()];
        for (place, step) in self.graph.steps().enumerate() {
            if let Step::Input(input) = step {
                inputs[input] = Some(self.graph.at(place));
            }
        }
        let inputs: Vec<Expr> = inputs.into_iter().flatten().collect();
        // Antiderivatives are further inputs.
        if inputs.len() != self.inputs || self.graph.inputs() > self.inputs {
            return Ok(false);
        }
        let (constants, state) = inputs.split_at(model.free_components());
        let group = |outputs: &[Expr]| Group::of(outputs.to_vec());
        let states = Group { required: self.common.required_at(sampler.kept()), ..group(state) };
        let groups = [states, group(&self.common.field), group(constants)];
        let (graph, groups) = sampler.compose_groups(self.graph, &groups, fixed)?;
        let [states, images, constants] = groups.try_into().map_err(|_| Fault::ForeignValue)?;
        let question = Determination {
            wanted: states.outputs,
            given: images.outputs,
            constants: constants.outputs,
            required: states.required,
            facts: states.facts,
        };
        let (extents, sources) = (sampler.extents(), sampler.sources());
        let prover = Prover { sources: &sources, extents: &extents, seed: self.options.seed };
        prover.is_determined(&graph, &question)
    }

    /// Whether the map of one variable is proved to be monotone on its range: it is differentiable
    /// there, and its slope is not 0.
    fn is_monotone(&self, sampler: &Sampler, fixed: &[Option<Rational>]) -> Result<bool, Fault> {
        let model = &self.case.model;
        if model.dimension() != 1 || sampler.kept().contains(&true) {
            return Ok(false);
        }
        let free = model.free_components();
        let (graph, values) = record(free + 1, |inputs| {
            let (parameters, state) = inputs.split_at(free);
            let jet = DualPoint::new(Phase::new(model, parameters, state));
            let slopes = jet.derivative().concat();
            [jet.phase.field().to_vec(), slopes]
        })?;
        let (graph, values) = sampler.compose(&graph, &values, fixed)?;
        let extents = sampler.extents();
        let is_nonzero = |value: Expr| is_nowhere_zero(&graph, &extents, &[], &[value]);
        let Some(edges) = edges(&graph, &values[0]) else { return Ok(false) };
        Ok(edges.into_iter().chain(values[1].iter().copied()).all(is_nonzero))
    }
}

/// Lists the values that must not be 0 for others to be differentiable on the whole range; `None`
/// if they contain moduli.
fn edges(graph: &Graph, values: &[Expr]) -> Option<Vec<Expr>> {
    let reached = graph.reached(values.iter().copied());
    let mut edges = Vec::new();
    for (step, _) in graph.steps().zip(&reached).filter(|(_, reached)| **reached) {
        match step {
            Step::Unary(UnaryFunction::Abs, _) => return None,
            Step::Unary(UnaryFunction::Recip | UnaryFunction::Ln | UnaryFunction::Sqrt, a)
            | Step::Binary(BinaryOperation::Pow, a, _) => edges.push(graph.at(a)),
            Step::Power(a, exponent)
                if exponent.is_negative() || exponent.to_integer().is_none() =>
            {
                edges.push(graph.at(a));
            }
            _ => {}
        }
    }
    Some(edges)
}
