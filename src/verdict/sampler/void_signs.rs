//! Signs of roots for which an equation of the level, as it is written, has no value.

use super::Sampler;
use crate::case::Case;
use crate::graph::{Expr, Fault, Step, record};
use crate::mechanics::{Draw, LevelFunction, Phase};
use crate::number::UnaryFunction;
use crate::number::rational::Rational;
use crate::proof::Group;

/// Largest number of signs of roots that are tried one by one.
const MOST_SIGNS: usize = 8;

impl Sampler {
    /// Leaves out the signs of roots for which an equation of the level, as it is written, has no value: y(y − 1) = 0
    /// has two zeros, and x/y = 0 a value at one of them.
    pub(super) fn without_void_signs(self, case: &Case) -> Result<Self, Fault> {
        let signs = self.recipes.iter().enumerate();
        let signs = signs.filter(|(_, draw)| matches!(draw, Draw::Sign)).map(|(draw, _)| draw);
        let signs: Vec<usize> = signs.take(MOST_SIGNS).collect();
        if signs.is_empty() {
            return Ok(self);
        }
        let model = &case.model;
        let (graph, required) = record(self.made.len(), |inputs| {
            let (parameters, state) = inputs.split_at(inputs.len() - model.dimension());
            let phase = Phase::new(model, parameters, state);
            let kept = model.level.iter().zip(&self.kept).filter(|(_, kept)| **kept);
            let written = kept.flat_map(|(equation, _)| match &equation.function {
                LevelFunction::Formula(formula) => phase.literal_values([formula]),
                _ => Vec::new(),
            });
            written.collect::<Vec<Expr>>()
        })?;
        let is_divisor = |step: Step<'_>| matches!(step, Step::Unary(UnaryFunction::Recip, _));
        if !graph.has_step(&required, is_divisor) {
            return Ok(self);
        }
        let group = Group { required, ..Group::default() };
        let mut fixed = vec![None; self.recipes.len()];
        for draw in signs {
            let is_void = |sign: i64| {
                let mut chosen = fixed.clone();
                chosen[draw] = Some(Rational::from(sign));
                let (graph, groups) =
                    self.compose_groups(&graph, std::slice::from_ref(&group), &chosen)?;
                let mut values = groups.iter().flat_map(|group| &group.required);
                Ok::<bool, Fault>(values.any(|value| graph.is_nowhere_defined(*value)))
            };
            fixed[draw] = match (is_void(1)?, is_void(-1)?) {
                (true, false) => Some(Rational::from(-1)),
                (false, true) => Some(Rational::from(1)),
                _ => None,
            };
        }
        Ok(self.with(&fixed))
    }
}
