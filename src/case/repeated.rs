//! Equations of a level with repeated factors, which have the zeros of simpler ones.

use super::equations::fresh_scalars;
use crate::formula::{Formula, Symbol};
use crate::graph::{Expr, literally, record};
use crate::mechanics::calculus::DualPoint;
use crate::mechanics::{
    ENTRY, LevelEquation, LevelFunction, Meaning, Model, ParameterOrigin, Phase, SamplerSpec,
};
use crate::proof::{Extent, InputDistribution, KnownSign, LinearDependence, Prover};

/// Largest number of times that what stands for an equation is simplified again.
const MOST_ROUNDS: usize = 3;

/// Seed of the points at which slopes are compared.
const SEED: u64 = 1;

/// Simpler equations in the place of one.
pub(super) struct Simpler {
    pub(super) functions: Vec<Formula>,
    /// Whether the equation was a sum of values of one sign.
    is_sum: bool,
}

impl Simpler {
    /// Says what stands for an equation.
    pub(super) fn remark(&self, text: &str) -> String {
        match (self.functions.len() == 1, self.is_sum) {
            (false, true) => format!(
                "`{text}` is a sum of values that are nowhere negative, and says that each of them is 0"
            ),
            (false, false) => {
                format!("`{text}` is a sum of squares, and says that each of them is 0")
            }
            (true, _) => format!(
                "each factor of `{text}` counts once: the zeros are the same, and slopes and densities are \
                 those of the simple factors"
            ),
        }
    }

    /// Lists the simpler equations as functions with their texts.
    pub(super) fn named(self, text: &str) -> Vec<(String, Formula)> {
        let is_alone = self.functions.len() == 1;
        let name = |index: usize| match is_alone {
            true => text.to_string(),
            false => format!("{text}{ENTRY}{index}"),
        };
        (1..).zip(self.functions).map(|(index, function)| (name(index), function)).collect()
    }
}

/// Puts simpler equations with the same zeros in the place of those in which a factor is repeated, as (x − y)² = 0, or
/// which are sums of values of one sign; returns a remark on each. Those that `is_given` does not accept stay.
pub fn count_factors_once(
    model: &mut Model,
    is_given: impl Fn(&LevelEquation) -> bool,
) -> Vec<String> {
    let (mut remarks, mut level) = (Vec::new(), Vec::new());
    for equation in &model.level {
        let found = match &equation.function {
            LevelFunction::Formula(function) if is_given(equation) => simpler(model, function),
            _ => None,
        };
        let Some(found) = found else {
            level.push(equation.clone());
            continue;
        };
        remarks.push(found.remark(&equation.text));
        level.extend(found.named(&equation.text).into_iter().map(|(text, function)| {
            LevelEquation {
                text,
                function: LevelFunction::Formula(function),
                root: None,
                lacks_entries: false,
            }
        }));
    }
    model.level = level;
    remarks
}

/// Finds simpler equations with the zeros of one.
pub(super) fn simpler(model: &Model, function: &Formula) -> Option<Simpler> {
    simpler_in(model, function, MOST_ROUNDS)
}

fn simpler_in(model: &Model, function: &Formula, rounds: usize) -> Option<Simpler> {
    let meaning = |own: Symbol| &model.vocabulary.entry(own).meaning;
    let is_coordinate = |own: Symbol| matches!(meaning(own), Meaning::State(_));
    let is_fixed = |own: Symbol| matches!(meaning(own), Meaning::Parameter(_));
    let is_total = |own: Symbol| match meaning(own) {
        Meaning::State(_) => true,
        Meaning::Parameter(index) => {
            let parameter = model.parameters.get(*index);
            parameter.is_some_and(|own| !matches!(own.origin, ParameterOrigin::Formula(_)))
        }
        _ => false,
    };
    let sign = |own: Symbol| match meaning(own) {
        Meaning::Parameter(index) => sign_of(&model.parameters.get(*index)?.origin),
        _ => None,
    };
    let simple = function.with_simple_factors(&is_coordinate, &is_fixed);
    let (functions, is_sum) = match simple {
        Some(functions) => (functions, false),
        None => {
            let all = function.as_definite_sum(&sign, &is_total)?;
            let kept = fresh_scalars(&all, &model.vocabulary)?;
            let kept = kept.into_iter().filter_map(|index| all.get(index).cloned());
            let kept: Vec<Formula> = kept.collect();
            // Equations that say the same of a variable, as sin x = 0 and cos x = 1, have no level of their own.
            are_independent(model, &kept).then_some((kept, true))?
        }
    };
    if rounds == 0 {
        return Some(Simpler { functions, is_sum });
    }
    let mut found = Simpler { functions: Vec::new(), is_sum };
    for function in functions {
        match simpler_in(model, &function, rounds - 1) {
            Some(own) => {
                found.is_sum |= own.is_sum;
                found.functions.extend(own.functions);
            }
            None => found.functions.push(function),
        }
    }
    Some(found)
}

/// Whether the slopes of functions, without those that follow from others, are independent at almost every state.
fn are_independent(model: &Model, functions: &[Formula]) -> bool {
    let free = model.free_components();
    let recorded = record(free + model.dimension(), |inputs| {
        let (parameters, state) = inputs.split_at(free);
        let jet = DualPoint::new(Phase::new(model, parameters, state));
        let values = functions.iter().map(|own| jet.phase.scalar(own));
        let values: Vec<Expr> = literally(|| values.collect());
        (values, functions.iter().flat_map(|own| jet.gradients(own)).collect::<Vec<Vec<Expr>>>())
    });
    let Ok((graph, (values, rows))) = recorded else { return false };
    let found = LinearDependence::of(&graph, &values, &vec![true; values.len()]);
    if found.contradiction.is_some() {
        // The reader of the level tells it.
        return true;
    }
    let kept = rows.into_iter().enumerate().filter(|(index, _)| !found.implied.contains(index));
    let rows: Vec<Vec<Expr>> = kept.map(|(_, row)| row).collect();
    let sources = vec![InputDistribution::Uniform; graph.inputs()];
    let extents = vec![Extent::ALL; graph.inputs()];
    let prover = Prover { sources: &sources, extents: &extents, seed: SEED };
    let ranks = prover.ranks(&graph, &rows, &[rows.len()]);
    ranks.is_ok_and(|ranks| ranks.is_some_and(|ranks| ranks == [rows.len()]))
}

/// Returns the sign of a parameter, or of all of its components.
fn sign_of(origin: &ParameterOrigin) -> Option<KnownSign> {
    let extent = match origin {
        ParameterOrigin::Fixed(values) => {
            let (least, greatest) = (values.iter().min()?, values.iter().max()?);
            Extent::between(least, greatest)
        }
        ParameterOrigin::Free(SamplerSpec::Scalar(draw) | SamplerSpec::Vector(_, draw)) => {
            draw.extent()
        }
        _ => return None,
    };
    let may_vanish = !extent.excludes_zero();
    extent.sign().map(|is_positive| KnownSign { is_positive, may_vanish })
}
