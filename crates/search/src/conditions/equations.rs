//! Equations for the coefficients of polynomial integrals, as functions of the parameters.

use liouville::case::Case;

use crate::ansatz::system::{Column, LinearSystem, PrimePoint};
use crate::orbit::monomials;
use crate::terms::one;
use crate::{Effort, SearchError};

/// Largest number of unknowns.
const UNKNOWNS: usize = 220;

/// The rates of the monomials of at most a degree at random states, for any parameters.
pub struct ParametricEquations<'e> {
    /// One row for each state, one column for each monomial.
    pub system: LinearSystem,
    /// Limits of the search.
    pub effort: &'e Effort,
    columns: Vec<usize>,
    is_on_level: bool,
}

impl<'e> ParametricEquations<'e> {
    /// Sets up the equations; `None` if there are too many.
    pub fn new(case: &Case, degree: u32, effort: &'e Effort) -> Result<Option<Self>, SearchError> {
        let model = &case.model;
        let dimension = model.dimension();
        let terms = model.state_formulas()?;
        let count = monomials::count(dimension, degree);
        if count > UNKNOWNS {
            return Ok(None);
        }
        let mut system = LinearSystem::record(case, effort, |jet, recording| {
            recording.derive(jet.along_field(), &terms, &[one()]);
        })?;
        let variables: Vec<usize> = (0..dimension).collect();
        let product = |exponents| Column::Product { derivation: 0, factor: 0, exponents };
        let all = monomials::up_to(&variables, dimension, degree);
        // The constant is the first.
        system.columns = all.into_iter().skip(1).map(product).collect();
        let columns = (0..system.columns.len()).collect();
        let is_on_level = !model.level.is_empty();
        Ok(Some(Self { system, effort, columns, is_on_level }))
    }

    /// Selects monomials that are independent on the level; `None` if too few states have values.
    pub fn columns(&self, at: &PrimePoint) -> Result<Option<Vec<usize>>, SearchError> {
        match self.is_on_level {
            true => self.system.distinct(at, &self.columns),
            false => Ok(Some(self.columns.clone())),
        }
    }

    /// Number of independent integrals; `None` if too few states have values.
    pub fn nullity(&self, at: &PrimePoint) -> Result<Option<usize>, SearchError> {
        let Some(columns) = self.columns(at)? else { return Ok(None) };
        Ok(self.system.null_space(at, &columns)?.map(|vectors| vectors.len()))
    }
}
