//! Division of a place into parts on which states are made by formulas.

use std::sync::Arc;

use crate::case::Case;
use crate::graph::Fault;
use crate::level::{Cover, Part};
use crate::mechanics::{Draw, Model};
use crate::number::rational::Rational;
use crate::proof::Extent;

use super::{Sampler, extent};

/// A place that is to be divided.
pub struct PlaceParts {
    /// Draws of the free parameters, followed by those of the state.
    pub draws: Vec<Draw>,
    /// Models of the levels whose union the place is.
    models: Vec<Arc<Model>>,
    kept: Vec<bool>,
    parameters: usize,
    extents: Vec<Extent>,
    seed: u64,
}

impl PlaceParts {
    /// Takes the place of a sampler.
    pub fn of(case: &Case, sampler: &Sampler) -> Result<Self, Fault> {
        let models = match sampler.branches(case)? {
            Some(branches) => branches.into_iter().map(|branch| branch.model).collect(),
            None => vec![Arc::new(case.model.clone())],
        };
        let draws = [&case.model.parameter_draws()[..], &case.free_draws].concat();
        let extents = draws.iter().map(extent).collect();
        let (kept, parameters) = (sampler.kept().to_vec(), sampler.parameter_draws());
        Ok(Self { draws, models, kept, parameters, extents, seed: sampler.seed })
    }

    /// Divides the place for one choice of listed values; `None` if that does not succeed.
    pub fn divided(&self, fixed: &[Option<Rational>]) -> Result<Option<Vec<Part>>, Fault> {
        let mut all = Vec::new();
        for model in &self.models {
            let cover = Cover {
                model,
                kept: &self.kept,
                draws: &self.draws,
                parameters: self.parameters,
                extents: &self.extents,
                fixed,
                seed: self.seed,
            };
            let Some(parts) = cover.parts()? else { return Ok(None) };
            all.extend(parts);
        }
        Ok(Some(all))
    }

    /// Returns the draws for one choice of listed values.
    pub fn recipes(&self, fixed: &[Option<Rational>]) -> Vec<Draw> {
        let pairs = self.draws.iter().zip(fixed);
        pairs.map(|(draw, fixed)| draw.fixed(fixed.as_ref())).collect()
    }
}
