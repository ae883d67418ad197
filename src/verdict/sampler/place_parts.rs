//! Division of a place into parts on which states are made by formulas.

use crate::case::Case;
use crate::graph::Fault;
use crate::level::{Cover, Part};
use crate::mechanics::Draw;
use crate::number::rational::Rational;
use crate::proof::Extent;

use super::{Sampler, extent};

/// A place that is to be divided.
pub struct PlaceParts {
    /// Draws of the free parameters, followed by those of the state.
    pub draws: Vec<Draw>,
    kept: Vec<bool>,
    parameters: usize,
    extents: Vec<Extent>,
    seed: u64,
}

impl PlaceParts {
    /// Takes the place of a sampler.
    pub fn of(case: &Case, sampler: &Sampler) -> Self {
        let draws = [&case.model.parameter_draws()[..], &case.free_draws].concat();
        let extents = draws.iter().map(extent).collect();
        let (kept, parameters) = (sampler.kept().to_vec(), sampler.parameter_draws());
        Self { draws, kept, parameters, extents, seed: sampler.seed }
    }

    /// Divides the place for one choice of listed values; `None` if that does not succeed.
    pub fn divided(
        &self,
        case: &Case,
        fixed: &[Option<Rational>],
    ) -> Result<Option<Vec<Part>>, Fault> {
        let cover = Cover {
            model: &case.model,
            kept: &self.kept,
            draws: &self.draws,
            parameters: self.parameters,
            extents: &self.extents,
            fixed,
            seed: self.seed,
        };
        cover.parts()
    }

    /// Returns the draws for one choice of listed values.
    pub fn recipes(&self, fixed: &[Option<Rational>]) -> Vec<Draw> {
        let pairs = self.draws.iter().zip(fixed);
        pairs.map(|(draw, fixed)| draw.fixed(fixed.as_ref())).collect()
    }
}
