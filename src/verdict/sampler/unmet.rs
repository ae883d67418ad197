//! Factors of equations at whose zeros no state of a numerical level was found.

use std::sync::Arc;

use crate::case::Case;
use crate::graph::{Evaluator, Expr, Fault, Graph, Step, Tape, record};
use crate::mechanics::Phase;
use crate::number::UnaryFunction;
use crate::number::ball::{Ball, Balls};
use crate::proof::is_nowhere_zero;

use super::Sampler;

/// The factors of those equations of a level that have several.
#[derive(Clone)]
pub(super) struct LevelFactors {
    /// Graph over parameters and state.
    graph: Arc<Graph>,
    values: Vec<Expr>,
}

impl LevelFactors {
    /// Finds the factors of the equations selected by `kept`, by their form.
    pub(super) fn new(case: &Case, kept: &[bool]) -> Result<Self, Fault> {
        let model = &case.model;
        let parameters = model.free_components();
        let (graph, equations) = record(parameters + model.dimension(), |inputs| {
            let (parameters, state) = inputs.split_at(parameters);
            let phase = Phase::new(model, parameters, state);
            let kept = model.level.iter().zip(kept).filter(|(_, kept)| **kept);
            kept.map(|(own, _)| phase.level_function(&own.function)).collect::<Vec<Expr>>()
        })?;
        let mut values = Vec::new();
        for equation in equations {
            let factors = factors(&graph, equation);
            if factors.len() > 1 {
                values.extend(factors.into_iter().map(|place| graph.at(place)));
            }
        }
        Ok(Self { graph: Arc::new(graph), values })
    }

    /// Whether some factor may have zeros, and is 0 at none of the states.
    pub(super) fn has_unmet<const N: usize>(
        &self,
        sampler: &Sampler,
        states: &[Balls<N>],
    ) -> Result<bool, Fault> {
        if self.values.is_empty() {
            return Ok(false);
        }
        let tape = Tape::new(&self.graph, &self.values);
        let mut evaluator = Evaluator::new(&tape, Ball::<N>);
        evaluator.run(states);
        let may_vanish = |block: &Balls<N>| {
            (0..N).any(|lane| block.is_defined(lane) && !block.excludes_zero(lane))
        };
        let met: Vec<bool> = evaluator.outputs().map(may_vanish).collect();
        let unmet = self.values.iter().zip(met).filter(|(_, met)| !met);
        let unmet: Vec<Expr> = unmet.map(|(value, _)| *value).collect();
        let fixed = vec![None; sampler.recipes().len()];
        let (graph, values) = sampler.compose(&self.graph, &[unmet], &fixed)?;
        let extents = sampler.extents();
        let has_none = |value: &Expr| is_nowhere_zero(&graph, &extents, &[], &[*value]);
        Ok(!values.iter().flatten().all(has_none))
    }
}

/// Lists the places of different factors that may be 0.
fn factors(graph: &Graph, equation: Expr) -> Vec<usize> {
    let inside = |step: Step<'_>| match step {
        Step::Unary(UnaryFunction::Sqrt | UnaryFunction::Abs, a) => Some(a),
        _ => None,
    };
    let mut found = Vec::new();
    for (place, step) in graph.factors_at(graph.place(equation), inside) {
        match step {
            Step::Constant(_)
            | Step::Unary(UnaryFunction::Neg | UnaryFunction::Recip | UnaryFunction::Exp, _) => {}
            _ if found.contains(&place) => {}
            _ => found.push(place),
        }
    }
    found
}
