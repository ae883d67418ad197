//! Values of other graphs as functions of draws.

use num_traits::Zero;

use crate::graph::{Expr, Fault, Graph, literally, record};
use crate::number::rational::Rational;
use crate::proof::Group;
use crate::scalar::Scalar;

use super::Sampler;
use super::ranges::guarded;

impl Sampler {
    /// Composes values of `graph`, a function of parameters and states, with the map from draws,
    /// replacing the draws in `fixed` by constants.
    ///
    /// Further inputs of `graph` (antiderivatives) follow the draws.
    pub fn compose(
        &self,
        graph: &Graph,
        groups: &[Vec<Expr>],
        fixed: &[Option<Rational>],
    ) -> Result<(Graph, Vec<Vec<Expr>>), Fault> {
        let (composed, values) = record(self.draws.len(), |draws| {
            let (inputs, _) = self.inputs_from(graph, draws, fixed)?;
            let reached = graph.reached(groups.iter().flatten().copied());
            let values = graph.repeated(&reached, &inputs);
            let group = |group: &Vec<Expr>| {
                group.iter().map(|value| values[graph.place(*value)]).collect::<Option<Vec<Expr>>>()
            };
            groups.iter().map(group).collect::<Option<Vec<Vec<Expr>>>>()
        })?;
        values.map(|values| (composed, values)).ok_or(Fault::ForeignValue)
    }

    /// Composes the same; the values have none where a variable that the level is solved for is out of
    /// its range, and the first of them has none where some required values have none.
    pub fn compose_in_ranges(
        &self,
        graph: &Graph,
        values: &[Expr],
        required: &[Expr],
    ) -> Result<(Graph, Vec<Expr>), Fault> {
        let fixed = vec![None; self.draws.len()];
        let (composed, values) = record(self.draws.len(), |draws| {
            let (inputs, own) = self.inputs_from(graph, draws, &fixed)?;
            let as_made = self.as_made(draws, &fixed, &inputs)?;
            let reached = graph.reached(values.iter().copied());
            let made = graph.repeated(&reached, &inputs);
            let values = values.iter().map(|value| made[graph.place(*value)]);
            let values = values.collect::<Option<Vec<Expr>>>()?;
            let facts = self.facts.iter().map(|value| own[self.graph.place(*value)]);
            let facts = facts.collect::<Option<Vec<Expr>>>()?;
            let guard = |value: &Expr| guarded(&[*value], facts.iter().copied());
            let mut values: Vec<Expr> = values.iter().flat_map(guard).collect();
            literally(|| {
                let all = values.iter_mut();
                all.for_each(|value| as_made.iter().for_each(|own| *value += *own * Expr::zero()));
            });
            let reached = graph.reached(required.iter().copied());
            let made = literally(|| graph.repeated(&reached, &inputs));
            let required = required.iter().map(|value| made[graph.place(*value)]);
            let required = required.collect::<Option<Vec<Expr>>>()?;
            if let Some(first) = values.first_mut() {
                literally(|| required.into_iter().for_each(|value| *first += value * Expr::zero()));
            }
            Some(values)
        })?;
        values.map(|values| (composed, values)).ok_or(Fault::ForeignValue)
    }

    /// Composes groups of values; states, too, are defined wherever the values matter.
    pub fn compose_groups(
        &self,
        graph: &Graph,
        groups: &[Group],
        fixed: &[Option<Rational>],
    ) -> Result<(Graph, Vec<Group>), Fault> {
        let (composed, groups) = record(self.draws.len(), |draws| {
            let (inputs, own) = self.inputs_from(graph, draws, fixed)?;
            let as_made = self.as_made(draws, fixed, &inputs)?;
            let values_of = |needed: &mut dyn Iterator<Item = Expr>| {
                graph.repeated(&graph.reached(needed), &inputs)
            };
            let outputs = values_of(&mut groups.iter().flat_map(|group| &group.outputs).copied());
            // √x √x is x where x ≥ 0, and the required value is undefined elsewhere.
            let written = |group: &'_ Group| [&group.required[..], &group.presence].concat();
            let required = literally(|| values_of(&mut groups.iter().flat_map(written)));
            let all = |some: &[Expr], values: &[Option<Expr>]| {
                some.iter().map(|value| values[graph.place(*value)]).collect::<Option<Vec<Expr>>>()
            };
            let facts = self.facts.iter().map(|value| own[self.graph.place(*value)]);
            let facts: Vec<Expr> = facts.collect::<Option<_>>()?;
            let group = |group: &Group| {
                let presence = all(&group.presence, &required)?;
                let mut required = all(&group.required, &required)?;
                required.extend(inputs[..self.made.len()].iter().chain(&as_made));
                let outputs = all(&group.outputs, &outputs)?;
                Some(Group { outputs, required, facts: facts.clone(), presence })
            };
            groups.iter().map(group).collect::<Option<Vec<Group>>>()
        })?;
        groups.map(|groups| (composed, groups)).ok_or(Fault::ForeignValue)
    }

    /// Records parameters, states and further inputs of `graph` as functions of draws, with all
    /// intermediate values.
    fn inputs_from(
        &self,
        graph: &Graph,
        draws: &[Expr],
        fixed: &[Option<Rational>],
    ) -> Option<(Vec<Expr>, Vec<Option<Expr>>)> {
        let reached = self.graph.reached(self.made.iter().chain(&self.facts).copied());
        let values = self.graph.repeated(&reached, &with_fixed(draws, fixed));
        let made = self.made.iter().map(|value| values[self.graph.place(*value)]);
        let mut inputs = made.collect::<Option<Vec<Expr>>>()?;
        inputs.extend((inputs.len()..graph.inputs()).map(|_| Expr::input()));
        Some((inputs, values))
    }

    /// Records parameters and states once more as they are made, (√u)² as such, where `folded` has something else:
    /// there is no state where one of them has no value.
    fn as_made(
        &self,
        draws: &[Expr],
        fixed: &[Option<Rational>],
        folded: &[Expr],
    ) -> Option<Vec<Expr>> {
        let pairs = self.made.iter().zip(folded);
        let open: Vec<(&Expr, &Expr)> =
            pairs.filter(|(own, _)| !self.graph.is_always_defined(**own)).collect();
        if open.is_empty() {
            return Some(Vec::new());
        }
        let reached = self.graph.reached(open.iter().map(|(own, _)| **own));
        let values = literally(|| self.graph.repeated(&reached, &with_fixed(draws, fixed)));
        let made = open.iter().map(|(own, _)| values[self.graph.place(**own)]);
        let made = made.collect::<Option<Vec<Expr>>>()?;
        let is_other = |(own, folded): &(Expr, &Expr)| own != *folded && !own.is_always_defined();
        let others = made.into_iter().zip(open.iter().map(|(_, folded)| *folded)).filter(is_other);
        Some(others.map(|(own, _)| own).collect())
    }
}

/// Draws, some of them replaced by constants.
fn with_fixed(draws: &[Expr], fixed: &[Option<Rational>]) -> Vec<Expr> {
    let pairs = draws.iter().zip(fixed);
    pairs.map(|(draw, fixed)| fixed.as_ref().map_or(*draw, Expr::rational)).collect()
}
