//! Statements behind proofs in prime fields, as programs over the draws of states: for certificates
//! that are checked outside the program.

use super::judging::Judging;
use super::recorded::SharedTerms;
use super::sampler::Sampler;
use super::{JudgeError, Options};
use crate::case::Case;
use crate::claim::LevelSubset;
use crate::graph::{Expr, Graph, record};
use crate::mechanics::calculus::DualPoint;
use crate::mechanics::{Draw, Phase, combinations, components};
use crate::number::rational::Rational;

/// The values that vanish identically if a claim holds.
pub struct Residuals {
    /// Index of the claim in its case.
    pub claim: usize,
    /// One program for each choice of listed values and of the signs ±1 that are drawn; empty if
    /// there are too many choices, or if the states are not made by a formula.
    pub programs: Vec<Composed>,
}

/// Parameters, state, and the values that vanish, as functions of uniform draws.
pub struct Composed {
    /// All operations.
    pub graph: Graph,
    /// Draws that are fixed, by index.
    pub fixed: Vec<(usize, Rational)>,
    /// Free parameters with their components.
    pub parameters: Vec<(String, Vec<Expr>)>,
    /// State variables with their components.
    pub state: Vec<(String, Vec<Expr>)>,
    /// Residual of the claim.
    pub residual: Vec<Expr>,
    /// Values that vanish if each ∫ of the claim is a function of its variable.
    pub quadratures: Vec<Expr>,
    /// Level functions on the domain of the claim.
    pub level: Vec<Expr>,
    /// Rates of the level functions along the motion, or their values at the image of a map.
    pub level_rates: Vec<Expr>,
}

/// Values of a claim before they are composed with the draws.
struct RecordedValues {
    residual: Vec<Expr>,
    quadratures: Vec<Expr>,
}

/// Composes the statements of some claims of a case, by index.
pub fn statements(case: &Case, claims: &[usize], seed: u64) -> Result<Vec<Residuals>, JudgeError> {
    let model = &case.model;
    let free = model.free_components();
    let (graph, (inputs, recorded, common)) = record(free + model.dimension(), |inputs| {
        let (parameters, state) = inputs.split_at(free);
        let jet = DualPoint::new(Phase::new(model, parameters, state));
        let recorded: Vec<RecordedValues> = claims
            .iter()
            .map(|index| {
                let claim = &case.claims[*index];
                RecordedValues {
                    residual: claim.kind.residual(&jet, &claim.place.kept),
                    quadratures: claim.kind.quadrature_defects(&jet, &claim.place.kept),
                }
            })
            .collect();
        (inputs.to_vec(), recorded, SharedTerms::of(&jet))
    })?;
    let (level, rates) = (&common.level, &common.level_rates);
    let options = Options { seed, ..Options::default() };
    let bench = Judging::new(case, &common, &options, &graph, inputs.len());
    let mut samplers: Vec<(&LevelSubset, Vec<Sampler>)> = Vec::new();
    let mut all = Vec::new();
    for (index, own) in claims.iter().zip(&recorded) {
        let place = &case.claims[*index].place;
        if !samplers.iter().any(|(known, _)| *known == place) {
            samplers.push((place, bench.all_samplers(place)?));
        }
        let Some((_, own_samplers)) = samplers.iter().find(|(known, _)| *known == place) else {
            continue;
        };
        let kept = |values: &[Expr]| -> Vec<Expr> {
            let pairs = values.iter().zip(&place.kept).filter(|(_, kept)| **kept);
            pairs.map(|(value, _)| *value).collect()
        };
        let groups = vec![
            inputs.clone(),
            own.residual.clone(),
            own.quadratures.clone(),
            kept(level),
            kept(rates),
        ];
        let compose = |sampler: &Sampler, choice: &[Option<Rational>]| {
            let (composed, groups) = sampler.compose(&graph, &groups, choice)?;
            let mut groups = groups.into_iter();
            let mut next = || groups.next().unwrap_or_default();
            let made = next();
            let (parameters, state) = made.split_at(free.min(made.len()));
            let fixed = choice.iter().enumerate();
            Ok(Composed {
                graph: composed,
                fixed: fixed.filter_map(|(k, x)| Some((k, x.clone()?))).collect(),
                parameters: {
                    let own = model.free_parameters().map(|p| (&p.name, components(p.kind)));
                    grouped(own, parameters)
                },
                state: grouped(model.state.iter().map(|own| (&own.name, own.len())), state),
                residual: next(),
                quadratures: next(),
                level: next(),
                level_rates: next(),
            })
        };
        let mut programs: Vec<Composed> = Vec::new();
        for sampler in own_samplers {
            let choices = match sampler.is_numerical() {
                true => None,
                false => combinations(&with_signs(sampler.recipes())),
            };
            // Without all programs of a part there is no statement of the whole.
            let Some(choices) = choices else {
                programs.clear();
                break;
            };
            let own = choices.iter().map(|choice| compose(sampler, choice));
            programs.extend(own.collect::<Result<Vec<Composed>, JudgeError>>()?);
        }
        all.push(Residuals { claim: *index, programs });
    }
    Ok(all)
}

/// Draws with each sign as a list of two values.
fn with_signs(recipes: &[Draw]) -> Vec<Draw> {
    let listed = |recipe: &Draw| match recipe {
        Draw::Sign => Draw::OneOf(vec![Rational::from(1), Rational::from(-1)]),
        other => other.clone(),
    };
    recipes.iter().map(listed).collect()
}

/// Splits values by names with numbers of components.
fn grouped<'n>(
    names: impl Iterator<Item = (&'n String, usize)>,
    values: &[Expr],
) -> Vec<(String, Vec<Expr>)> {
    let mut rest = values;
    names
        .map(|(name, count)| {
            let (own, others) = rest.split_at(count.min(rest.len()));
            rest = others;
            (name.clone(), own.to_vec())
        })
        .collect()
}
