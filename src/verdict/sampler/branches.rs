//! Levels into which a place falls by the form of its equations.

use std::sync::Arc;

use crate::case::Case;
use crate::claim::LevelSubset;
use crate::graph::{Expr, Fault, record};
use crate::level::{self, Order, Solution};
use crate::mechanics::{Draw, Model, Phase};
use crate::proof::{Extent, is_nowhere_zero};

use super::Sampler;
use super::extent;

/// One of the levels whose union a place is: the model with factors of its equations.
#[derive(Clone)]
pub struct Branch {
    /// Place of the branch among all.
    pub number: usize,
    /// The model.
    pub model: Arc<Model>,
}

impl Sampler {
    /// Returns the levels that the place falls into, but for those known to have no points in the ranges;
    /// `None` if it does not fall apart.
    pub fn branches(&self, case: &Case) -> Result<Option<Vec<Branch>>, Fault> {
        let Some(models) = level::branches(&case.model, &self.kept) else { return Ok(None) };
        let mut found = Vec::new();
        for (number, model) in models.into_iter().enumerate() {
            if !self.is_empty(case, &model)? {
                found.push(Branch { number, model: Arc::new(model) });
            }
        }
        Ok((!found.is_empty()).then_some(found))
    }

    /// Makes samplers of the same place, or of a branch of it, from solutions in several orders.
    pub fn solved(&self, case: &Case, branch: Option<&Branch>) -> Result<Vec<Self>, Fault> {
        let place = LevelSubset { kept: self.kept.clone() };
        let model = branch.map_or(&case.model, |branch| &branch.model);
        let mut solutions: Vec<Solution> = Vec::new();
        for order in [Order::Usual, Order::Jointly, Order::ByRoots] {
            let found = level::solve(model, &self.kept, order);
            solutions.extend(found.filter(|found| !solutions.contains(found)));
        }
        let of = |solution| {
            Self::of_solution(case, branch.cloned(), &place, self.seed, false, Some(solution))
        };
        solutions.into_iter().map(of).collect()
    }

    /// Whether the level of a model is known to have no point in the ranges.
    fn is_empty(&self, case: &Case, model: &Model) -> Result<bool, Fault> {
        let first = self.parameter_draws;
        let (graph, level) = record(first + model.dimension(), |inputs| {
            let (parameters, state) = model.make_parameters(inputs);
            let phase = Phase::new(model, &parameters, state);
            let kept = model.level.iter().zip(&self.kept).filter(|(_, kept)| **kept);
            kept.map(|(equation, _)| phase.level_function(&equation.function))
                .collect::<Vec<Expr>>()
        })?;
        let (extents, mut facts) = (self.space_extents(case), Vec::new());
        if graph.inputs() > extents.len() {
            return Ok(false);
        }
        let (graph, signed) = {
            let reached = graph.reached(level.iter().copied());
            record(graph.inputs(), |inputs| {
                let made = graph.repeated(&reached, inputs);
                let at = |value: &Expr| made[graph.place(*value)].map(|value| [value, -value]);
                level.iter().map(at).collect::<Option<Vec<[Expr; 2]>>>()
            })?
        };
        let Some(signed) = signed else { return Ok(false) };
        facts.extend(signed.iter().flatten().copied());
        Ok(signed.iter().any(|[value, _]| is_nowhere_zero(&graph, &extents, &facts, &[*value])))
    }

    /// Returns the ranges of the draws of the parameters and of the coordinates of phase space. Listed values
    /// lie between the smallest and the largest.
    pub fn space_extents(&self, case: &Case) -> Vec<Extent> {
        let of_parameter = |draw: &Draw| match draw {
            Draw::OneOf(values) => match (values.iter().min(), values.iter().max()) {
                (Some(least), Some(most)) => Extent::between(least, most),
                _ => extent(draw),
            },
            draw => extent(draw),
        };
        let parameters = self.recipes.iter().take(self.parameter_draws).map(of_parameter);
        parameters.chain(case.free_draws.iter().map(extent)).collect()
    }
}
