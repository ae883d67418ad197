//! Levels that one solution fills.

use super::judge::{JudgeError, Options};
use super::judging::Judging;
use super::recorded::SharedTerms;
use super::sampler::Sampler;
use crate::case::Case;
use crate::claim::LevelSubset;
use crate::graph::record;
use crate::mechanics::Phase;
use crate::mechanics::calculus::DualPoint;

/// Whether the states that are drawn of a case are known to fill its level: x y = 0 is not filled by y = 0/x.
///
/// # Errors
///
/// Recording failed.
pub fn is_filled(case: &Case, options: &Options) -> Result<bool, JudgeError> {
    let model = &case.model;
    if model.level.is_empty() {
        return Ok(true);
    }
    let inputs = model.free_components() + model.dimension();
    let (graph, common) = record(inputs, |all| {
        let (parameters, state) = all.split_at(model.free_components());
        SharedTerms::of(&DualPoint::new(Phase::new(model, parameters, state)))
    })?;
    let judging = Judging::new(case, &common, options, &graph, inputs);
    let sampler = Sampler::new(case, &LevelSubset::level(model), options.seed)?;
    Ok(!sampler.is_numerical() && judging.missed_part(&sampler)?.is_none())
}
