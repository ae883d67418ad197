//! The pivots of a solved level as functions of the coordinates of phase space.

use num_traits::Zero;

use super::sampler::Sampler;
use crate::case::Case;
use crate::graph::{Expr, Fault, Graph, Step, record};
use crate::level::{Pivot, Solution};
use crate::mechanics::Phase;
use crate::mechanics::elimination::determinant;
use crate::number::rational::Rational;
use crate::proof::{Extent, are_polynomials, combinations, is_nowhere_zero};
use crate::scalar::Scalar;

/// The pivots of a solution, with the level.
///
/// Values at computed states do not suffice: these may approach a point of the level without
/// reaching it, as a stereographic projection approaches its pole.
pub struct PivotSpace {
    pub graph: Graph,
    pub pivots: Vec<Pivot>,
    /// Level functions and their negatives, neither of which is negative on the level.
    level: Vec<Expr>,
    extents: Vec<Extent>,
    /// Number of the inputs that are parameters; the others are the state.
    first: usize,
}

impl PivotSpace {
    pub fn of(case: &Case, sampler: &Sampler, solution: &Solution) -> Result<Self, Fault> {
        let model = sampler.branch().map_or(&case.model, |branch| &branch.model);
        let first = sampler.parameter_draws();
        let (graph, (pivots, level)) = record(first + model.dimension(), |inputs| {
            let (parameters, state) = model.make_parameters(inputs);
            let phase = Phase::new(model, &parameters, state);
            let equations = model.level.iter().zip(sampler.kept()).filter(|(_, kept)| **kept);
            let level = equations.flat_map(|(equation, _)| {
                let value = phase.level_function(&equation.function);
                [value, -value]
            });
            let level: Vec<Expr> = level.collect();
            (solution.pivots(model, &parameters, state), level)
        })?;
        let extents = sampler.space_extents(case);
        Ok(Self { graph, pivots, level, extents, first })
    }

    /// Whether a pivot is known to vanish at no real point of the level.
    pub fn is_definite(&self, pivot: &Pivot, seed: u64) -> Result<bool, Fault> {
        let slopes = [&pivot.minors[..], &[pivot.slope]].concat();
        Ok(self.have_no_zero(&slopes)
            || self.have_no_zero(&[pivot.whole])
            || self.has_regular_gram(pivot, seed)?)
    }

    /// Whether the Gram matrix of a pivot's slopes is on the level a matrix of functions of the
    /// parameters alone, and these make it regular. The products of orthonormal vectors are
    /// numbers, though no bound on boxes shows their determinant.
    fn has_regular_gram(&self, pivot: &Pivot, seed: u64) -> Result<bool, Fault> {
        let count = pivot.gram.len();
        let entries: Vec<Expr> =
            (0..count).flat_map(|i| pivot.gram[i][..=i].iter().copied()).collect();
        let Some((graph, entries)) = self.on_level(&entries, seed)? else { return Ok(false) };
        let entry = |i: usize, j: usize| entries[i.max(j) * (i.max(j) + 1) / 2 + i.min(j)];
        let reached = graph.reached(entries.iter().copied());
        let (graph, made) = record(graph.inputs(), |inputs| {
            let made = graph.repeated(&reached, inputs);
            let row = |i: usize| (0..count).map(|j| made[graph.place(entry(i, j))]).collect();
            let rows: Option<Vec<Vec<Expr>>> = (0..count).map(row).collect();
            Some(determinant(&rows?))
        })?;
        let extents = &self.extents[..self.first];
        Ok(made.is_some_and(|value| is_nowhere_zero(&graph, extents, &[], &[value])))
    }

    /// Writes values as functions of the parameters that they are equal to on the level; `None`
    /// unless each differs from one of these by a combination of level functions with rational
    /// multiples, in all of space.
    fn on_level(&self, values: &[Expr], seed: u64) -> Result<Option<(Graph, Vec<Expr>)>, Fault> {
        let level: Vec<Expr> = self.level.iter().step_by(2).copied().collect();
        let all = [values, &level].concat();
        if values.is_empty() || !are_polynomials(&self.graph, &all) {
            return Ok(None);
        }
        let (first, total) = (self.first, self.graph.inputs());
        let reached = self.graph.reached(all.iter().copied());
        let at = |inputs: &[Expr]| -> Option<Vec<Expr>> {
            let made = self.graph.repeated(&reached, inputs);
            all.iter().map(|value| made[self.graph.place(*value)]).collect()
        };
        // At two states with the same parameters the values differ as the combinations do.
        let (differences, made) = record(2 * total - first, |inputs| {
            let other = [&inputs[..first], &inputs[total..]].concat();
            let (one, other) = (at(&inputs[..total])?, at(&other)?);
            Some(one.iter().zip(&other).map(|(a, b)| *a - *b).collect::<Vec<Expr>>())
        })?;
        let Some(made) = made else { return Ok(None) };
        let (own, level) = made.split_at(values.len());
        let Some(multiples) = combinations(&differences, own, level, seed)? else {
            return Ok(None);
        };
        let (graph, made) = record(first, |inputs| {
            let origin = vec![Expr::zero(); total - first];
            let made = at(&[inputs, &origin].concat())?;
            let (own, level) = made.split_at(values.len());
            let rest = |(value, multiples): (&Expr, &Vec<Rational>)| {
                let terms = level.iter().zip(multiples).filter(|(_, multiple)| !multiple.is_zero());
                terms.fold(*value, |rest, (f, multiple)| rest - *f * Expr::rational(multiple))
            };
            Some(own.iter().zip(&multiples).map(rest).collect::<Vec<Expr>>())
        })?;
        Ok(made.map(|made| (graph, made)))
    }

    /// Whether values are known to have no common zero at any real point of the level.
    pub fn have_no_zero(&self, values: &[Expr]) -> bool {
        // Facts that are few and near first: each further input is one more to divide.
        let inputs: Vec<usize> = values.iter().flat_map(|x| self.inputs_of(*x)).collect();
        let within = |is_near: &dyn Fn(usize) -> bool| -> Vec<Expr> {
            let of = |x: &&Expr| self.inputs_of(**x).into_iter().all(is_near);
            self.level.iter().filter(of).copied().collect()
        };
        let near = within(&|k| inputs.contains(&k));
        let with_parameters = within(&|k| k < self.first || inputs.contains(&k));
        let mut tried = None;
        [&near, &with_parameters, &self.level].into_iter().any(|level| {
            let is_new = tried.replace(level.len()) != Some(level.len());
            is_new && is_nowhere_zero(&self.graph, &self.extents, level, values)
        })
    }

    fn inputs_of(&self, value: Expr) -> Vec<usize> {
        let reached = self.graph.reached([value]);
        let inputs = self.graph.steps().zip(reached).filter_map(|(step, reached)| match step {
            Step::Input(input) if reached => Some(input),
            _ => None,
        });
        inputs.collect()
    }
}
