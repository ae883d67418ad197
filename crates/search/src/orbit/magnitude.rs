//! The rule for what stands under a logarithm or a root: f where f is known not to be negative at any
//! state of the declared ranges, and |f| elsewhere.

use liouville::case::Case;
use liouville::claim::LevelSubset;
use liouville::formula::Formula;
use liouville::mechanics::Draw;
use liouville::proof::{Extent, KnownSign, sign};
use liouville::verdict::Sampler;

use super::super::terms::recorded;
use super::super::{Effort, SearchError};
use super::claims;
use super::setting::OrbitSetting;

/// Makes f or |f|.
pub fn magnitude(setting: &OrbitSetting<'_>, formula: &Formula) -> Result<Formula, SearchError> {
    match is_never_negative(setting, formula)? {
        true => Ok(formula.clone()),
        false => Ok(formula.modulus()?),
    }
}

/// The same in the names of a case.
pub fn of_case(case: &Case, effort: &Effort, formula: &Formula) -> Result<Formula, SearchError> {
    match is_positive(case, effort, formula)? {
        true => Ok(formula.clone()),
        false => Ok(formula.modulus()?),
    }
}

/// Whether a formula is known not to be negative in the declared ranges.
fn is_never_negative(setting: &OrbitSetting<'_>, formula: &Formula) -> Result<bool, SearchError> {
    match claims::written(setting, formula) {
        Some(own) => is_positive(claims::judged_case(setting), setting.effort, &own),
        None => Ok(false),
    }
}

fn is_positive(case: &Case, effort: &Effort, own: &Formula) -> Result<bool, SearchError> {
    let sampler = Sampler::new(case, &LevelSubset::level(&case.model), effort.options.seed)?;
    if sampler.is_numerical() {
        return Ok(false);
    }
    let (graph, value) = recorded(case, |jet| jet.phase.scalar(own))?;
    let fixed = vec![None; sampler.recipes().len()];
    let (graph, groups) = sampler.compose(&graph, &[vec![value]], &fixed)?;
    let extents: Vec<Extent> = sampler.recipes().iter().map(Draw::extent).collect();
    let known = groups.iter().flatten().map(|value| sign(&graph, &extents, &[], &[], *value));
    Ok(known.flatten().any(|KnownSign { is_positive, .. }| is_positive))
}
