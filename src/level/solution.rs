//! A solved level: its steps, and the points they make.

use super::equation::PartialPoint;
use super::steps::{Pivot, SolutionStep};
use crate::graph::Expr;
use crate::mechanics::{Draw, Half, Model, NumberLine, Phase, Range};
use crate::proof::SignFact;

/// A sequence of steps that makes points of a level.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution {
    pub(super) steps: Vec<SolutionStep>,
}

/// A recorded point of a level.
pub struct Solved {
    /// Components of the free parameters, followed by those of the state.
    pub made: Vec<Expr>,
    /// Signs of values at the point.
    pub facts: Vec<(Expr, SignFact)>,
    /// Values that must not vanish at any real point, or part of the level is missed.
    pub pivots: Vec<Pivot>,
}

impl Solution {
    /// Number of choices between two signs.
    pub fn signs(&self) -> usize {
        self.steps.iter().filter(|step| step.has_sign()).count()
    }

    /// Returns the components of the state that are solved for rather than drawn.
    pub fn components(&self) -> Vec<usize> {
        self.steps.iter().flat_map(SolutionStep::components).collect()
    }

    /// Returns the components of the free parameters that are solved for.
    pub fn parameters(&self) -> Vec<usize> {
        let component = |step: &SolutionStep| match step {
            SolutionStep::Parameter { component, .. } => Some(*component),
            _ => None,
        };
        self.steps.iter().filter_map(component).collect()
    }

    /// Whether some states are made from directions rather than from numbers in the declared ranges.
    pub fn has_directions(&self) -> bool {
        self.steps.iter().any(|step| !step.directions().is_empty())
    }

    /// Lists the halves of the level in which all its points lie.
    pub fn halves(&self) -> Vec<Half> {
        let half = |step: &SolutionStep| match step {
            SolutionStep::Frame(frame) => frame.half.clone(),
            _ => None,
        };
        self.steps.iter().filter_map(half).collect()
    }

    /// Returns the draws of the state's components and of the signs, given those of the components.
    pub fn draws(&self, free: &[Draw]) -> Vec<Draw> {
        let mut draws = free.to_vec();
        for component in self.steps.iter().flat_map(SolutionStep::directions) {
            draws[component] = Draw::Of(NumberLine::Directions, Range::between((-8, 5), (8, 5)));
        }
        draws.extend(vec![Draw::Sign; self.signs()]);
        draws
    }

    /// Returns the values that must not vanish at any point of the level, from the coordinates of
    /// the point and the free parameters.
    pub fn pivots(&self, model: &Model, parameters: &[Expr], state: &[Expr]) -> Vec<Pivot> {
        let point = PartialPoint { model, parameters: parameters.to_vec(), state: state.to_vec() };
        self.steps.iter().filter_map(|step| step.pivot(&point)).collect()
    }

    /// Makes the point from the free parameters and the draws.
    pub fn point(&self, model: &Model, parameters: Vec<Expr>, draws: &[Expr]) -> Solved {
        let (state, signs) = draws.split_at(model.dimension());
        let mut signs = signs.iter().copied();
        let mut point = PartialPoint { model, parameters, state: state.to_vec() };
        let mut pivots = Vec::new();
        for step in &self.steps {
            let sign = if step.has_sign() { signs.next() } else { None };
            pivots.extend(step.complete(&mut point, sign));
        }
        let phase = Phase::new(model, &point.parameters, &point.state);
        let equations = self.steps.iter().flat_map(SolutionStep::equations);
        let facts = equations.filter_map(|equation| equation.other_side(&phase));
        let facts = facts.map(|value| (value, SignFact::NotNegative)).collect();
        let made = point.parameters.iter().chain(&point.state).copied().collect();
        Solved { made, facts, pivots }
    }
}
