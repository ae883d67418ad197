//! Cofactors of invariant relations, which must have values where F = 0: x' = 1 = (1/x)·x does not
//! preserve x = 0.

use std::rc::Rc;

use super::field::{Answer, PrimeFieldStates, Query};
use super::judging::Judging;
use super::recorded::RecordedClaim;
use super::sampler::Sampler;
use super::zero_sets::vanishes_nowhere_openly_on;
use crate::claim::LevelSubset;
use crate::graph::{Expr, Fault, Graph, Need, record};
use crate::mechanics::{Chart, Draw, System, combinations};
use crate::proof::{Extent, are_coprime, is_nowhere_zero, sign};

/// A cofactor, or a part of it that must have a value.
pub(super) struct Cofactor {
    /// Its value, recorded literally.
    pub factor: Expr,
    /// Reciprocal of the value; none of an entry of a matrix.
    pub inverse: Option<Expr>,
}

/// States that are a whole place with no exception.
pub(super) struct Filling {
    pub sampler: Rc<Sampler>,
    /// Intervals of the draws, in which the states of interest lie.
    pub extents: Vec<Extent>,
}

impl Judging<'_> {
    /// Returns the sampler, if its states are a whole place with no exception, or else that of all of
    /// space, if it is so: a chart may miss exactly the zeros of a function, as the rational one of the
    /// circle misses those of 1 + y.
    pub(super) fn filling(&self, sampler: &Sampler) -> Result<Option<Filling>, Fault> {
        if sampler.misses_nothing(self.case) {
            let extents = sampler.extents();
            return Ok(Some(Filling { sampler: Rc::new(sampler.clone()), extents }));
        }
        let space = self.sampler_at(&LevelSubset::everywhere(&self.case.model))?;
        if !space.misses_nothing(self.case) {
            return Ok(None);
        }
        let mut extents = space.extents();
        // Ranges of [state] do not restrict the states of the file's own chart, or of a sphere.
        if !matches!(self.case.chart, Chart::Equations) {
            let parameters = self.case.model.parameter_draws().len();
            extents.iter_mut().skip(parameters).for_each(|extent| *extent = Extent::ALL);
        }
        Ok(Some(Filling { sampler: space, extents }))
    }

    /// Whether a cofactor is known to have a value at every zero of F at which the field has one.
    ///
    /// Its poles are poles of the field as written, at which no motion passes; or no zeros of F; or F and its denominator
    /// have no common factor in lowest terms: with L_vF = A/B and κ = C/D in lowest terms, AD = BCF, so that D
    /// divides B.
    pub(super) fn has_value_on_zeros(
        &self,
        sampler: &Sampler,
        item: &RecordedClaim<'_>,
        (function, components): (Expr, &[Expr]),
        cofactor: &Cofactor,
    ) -> Result<bool, Fault> {
        // For almost all parameters a function of them alone is not 0.
        let parameters = self.case.model.free_components();
        let moves =
            |pole: &Expr| self.graph.inputs_of(*pole).into_iter().any(|input| input >= parameters);
        let mut poles = poles_of(self.graph, &[cofactor.factor]);
        // Elimination of many velocities divides by what may be 0 on a surface that motions cross.
        let of_field = match &self.case.model.system {
            System::Lagrangian(own) if !own.has_exact_divisors() => Vec::new(),
            _ => poles_of(self.graph, &self.common.required_at(sampler.kept())),
        };
        let misses_some = !sampler.misses_nothing(self.case);
        // In space a pole in other variables than F is not 0 wherever F is.
        let of_function = self.graph.inputs_of(function);
        let is_apart = |pole: &Expr| {
            let own = self.graph.inputs_of(*pole).into_iter().filter(|input| *input >= parameters);
            own.into_iter().all(|input| !of_function.contains(&input))
        };
        // A pole that is 0 on all of F = 0 is none of a motion from there.
        let has_other_zeros = |pole: &Expr| {
            let both = [function, *pole];
            *pole != function
                && (!is_rational(self.graph, &both)
                    || are_coprime(self.graph, &both, self.options.seed))
        };
        let may_miss = misses_some && cofactor.inverse.is_some();
        let is_of_field = |pole: &Expr| {
            of_field.contains(pole) && (is_apart(pole) || may_miss && has_other_zeros(pole))
        };
        poles.retain(|pole| (moves(pole) || !misses_some) && !is_of_field(pole));
        if !misses_some {
            // For a listed value a pole may be another one.
            let is_listed = |value: &Expr| {
                let inputs = self.graph.inputs_of(*value).into_iter();
                let made = inputs
                    .filter(|own| *own < parameters)
                    .filter_map(|own| sampler.made().get(own));
                let mut draws = made.flat_map(|own| sampler.graph().inputs_of(*own));
                draws.any(|draw| matches!(sampler.recipes()[draw], Draw::OneOf(_)))
            };
            let has_lists = components.iter().any(is_listed);
            // Where F = 0 lies in no pole of the field, most of its states have motions.
            let is_on_few = |pole: &Expr| -> Result<bool, Fault> {
                let seed = self.options.seed;
                Ok(of_field.contains(pole)
                    && !has_lists
                    && !is_listed(pole)
                    && vanishes_nowhere_openly_on(self.graph, components, *pole, parameters, seed)?)
            };
            let mut open = Vec::new();
            for pole in poles {
                if !is_on_few(&pole)? {
                    open.push(pole);
                }
            }
            poles = open;
        }
        // What is under a root may be negative where F = 0: the cofactor then says nothing of F = 0.
        let roots_of_field = roots_of(self.graph, &self.common.required_at(sampler.kept()));
        let mut roots = roots_of(self.graph, &[cofactor.factor]);
        roots.retain(|root| moves(&root.0) && !roots_of_field.contains(root));
        let mut open = Vec::new();
        for root in roots {
            if !self.is_nowhere_negative(sampler, root)? {
                open.push(root);
            }
        }
        let roots = open;
        if poles.is_empty() && roots.is_empty() {
            return Ok(true);
        }
        let Some(Filling { sampler: filling, extents }) = self.filling(sampler)? else {
            return Ok(false);
        };
        // What is divided by in lowest terms follows from an identity in the same variables, of scalars.
        let is_identity = cofactor.inverse.is_some()
            && (filling.kept() == sampler.kept() || self.holds_in_space(&filling, item)?);
        let only = |roots: &[(Expr, Need)]| roots.iter().map(|root| root.0).collect::<Vec<Expr>>();
        let (radicands, known) = (only(&roots), only(&roots_of_field));
        let inverse = cofactor.inverse.unwrap_or(function);
        let outputs = [&[function, inverse][..], &poles, &radicands, &known].concat();
        let Some(combinations) = combinations(filling.recipes()) else { return Ok(false) };
        for fixed in combinations {
            let (graph, groups) =
                filling.compose(self.graph, std::slice::from_ref(&outputs), &fixed)?;
            let group = groups.concat();
            let (function, (poles, others)) = (group[0], group[2..].split_at(poles.len()));
            let (radicands, known) = others.split_at(roots.len());
            for (radicand, (_, need)) in radicands.iter().zip(&roots) {
                if !has_root_on_zeros(&graph, &extents, (function, known), (*radicand, *need))? {
                    return Ok(false);
                }
            }
            let are_coprime =
                |values: &[Expr]| is_identity && are_coprime(&graph, values, self.options.seed);
            let is_apart = |pole: &Expr| {
                are_coprime(&[function, *pole]) || are_apart(&graph, &extents, function, *pole)
            };
            // In lowest terms the denominator may be smaller than written.
            if !poles.is_empty() && !are_coprime(&group[..2]) && !poles.iter().all(is_apart) {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Whether what is under a root is not negative at any state of a place, and so, by continuity, at points that its
    /// states miss; a logarithm needs more.
    fn is_nowhere_negative(
        &self,
        sampler: &Sampler,
        (radicand, need): (Expr, Need),
    ) -> Result<bool, Fault> {
        let Some(combinations) = combinations(sampler.recipes()) else { return Ok(false) };
        if need.nonzero || sampler.is_numerical() {
            return Ok(false);
        }
        let extents = sampler.extents();
        for fixed in combinations {
            let (graph, groups) = sampler.compose(self.graph, &[vec![radicand]], &fixed)?;
            let is_known = groups.concat().into_iter().all(|own| {
                sign(&graph, &extents, &[], &[], own).is_some_and(|own| own.is_positive)
            });
            if !is_known {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Whether the equation of a claim is proved at all states of space.
    fn holds_in_space(&self, space: &Sampler, item: &RecordedClaim<'_>) -> Result<bool, Fault> {
        let Some(wider) = item.wider.iter().find(|wider| wider.place.kept == space.kept()) else {
            return Ok(false);
        };
        let query = Query {
            outputs: [&wider.residual[..], &wider.defects].concat(),
            requirement: item.requirement.clone(),
            ..Query::default()
        };
        let answers = PrimeFieldStates::new(self, space).test(&[query])?;
        Ok(matches!(answers[..], [Answer::Zero(_)]))
    }
}

/// Whether values contain sums, products and quotients alone.
fn is_rational(graph: &Graph, values: &[Expr]) -> bool {
    let reached = graph.reached(values.iter().copied());
    graph.steps().zip(reached).all(|(step, reached)| !reached || step.is_rational())
}

/// Whether two values are known to have no common zero, and the first to have one.
fn are_apart(graph: &Graph, extents: &[Extent], function: Expr, pole: Expr) -> bool {
    let vanish_nowhere = |values: &[Expr]| is_nowhere_zero(graph, extents, &[], values);
    // A divisor of few variables is seen sooner alone.
    (vanish_nowhere(&[pole]) || vanish_nowhere(&[function, pole]))
        && !is_nowhere_zero(graph, extents, &[], &[function])
}

/// Whether what is under a root or a logarithm is known to be as needed at all zeros of a function, where what is
/// under the roots of the field is not negative.
fn has_root_on_zeros(
    graph: &Graph,
    extents: &[Extent],
    (function, known): (Expr, &[Expr]),
    (radicand, need): (Expr, Need),
) -> Result<bool, Fault> {
    let all = [&[function, radicand][..], known].concat();
    let reached = graph.reached(all.iter().copied());
    let (made, values) = record(graph.inputs(), |inputs| {
        let values = graph.repeated(&reached, inputs);
        let made: Option<Vec<Expr>> = all.iter().map(|own| values[graph.place(*own)]).collect();
        let made = made?;
        let (function, radicand) = (made[0], made[1]);
        Some(([&[function, -function][..], &made[2..]].concat(), radicand))
    })?;
    let Some((facts, radicand)) = values else { return Ok(false) };
    let found = sign(&made, extents, &[], &facts, radicand);
    Ok(found.is_some_and(|own| own.is_positive && !(own.may_vanish && need.nonzero)))
}

/// Lists what is under roots and logarithms in some values, with what is needed of it.
fn roots_of(graph: &Graph, values: &[Expr]) -> Vec<(Expr, Need)> {
    let reached = graph.reached(values.iter().copied());
    let roots = graph.needs(&reached).filter(|(_, need)| need.not_negative);
    roots.map(|(place, need)| (graph.at(place), need)).collect()
}

/// Lists the values that must not be 0 for others to be bounded nearby.
fn poles_of(graph: &Graph, values: &[Expr]) -> Vec<Expr> {
    let reached = graph.reached(values.iter().copied());
    let poles = graph.needs(&reached).filter(|(_, need)| need.is_pole);
    poles.map(|(place, _)| graph.at(place)).collect()
}
