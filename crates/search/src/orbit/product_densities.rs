//! Densities that are products of powers, those with numbers as exponents first.

use super::super::SearchError;
use super::super::SearchReport;
use super::super::ansatz::system::PrimePoint;
use super::claims::{self, OrbitStatement};
use super::exponents::{ExponentSystem, RateTerm};
use super::images::{self, Images};
use crate::FoundKind;

/// Number of further choices of the parameters for exponents that are numbers.
const CHOICES: u64 = 3;

impl ExponentSystem<'_, '_> {
    /// The density that is a product of powers of factors with numbers as exponents, for all values of the
    /// parameters: others are its products with integrals.
    fn numeric_density(
        &self,
    ) -> Result<Option<(Vec<usize>, images::ParametricVector)>, SearchError> {
        if self.setting.coordinates().is_empty() {
            return Ok(None);
        }
        let is_own =
            |k: &usize| matches!(self.columns[*k], RateTerm::Factor(_) | RateTerm::Divergence);
        let columns: Vec<usize> = (0..self.columns.len()).filter(is_own).collect();
        let several = |at: &PrimePoint, columns: &[usize]| {
            let others = (1..=CHOICES).map_while(|index| self.setting.at(0, index));
            let same = others.filter(|own| own.modulus.prime() == at.modulus.prime());
            let all: Vec<PrimePoint> = [at.clone()].into_iter().chain(same).collect();
            self.common(&all, columns)
        };
        let Some(at) = self.setting.at(0, 0) else { return Ok(None) };
        let of_density = |own: &Vec<u64>| own.last().is_some_and(|last| *last != 0);
        let Some(found) = several(&at, &columns)?.into_iter().find(of_density) else {
            return Ok(None);
        };
        let support: Vec<usize> =
            (0..columns.len()).filter(|k| found[*k] != 0).map(|k| columns[k]).collect();
        if support.len() < 2 {
            return Ok(None);
        }
        let make = |at: &PrimePoint| several(at, &support).ok()?.pop();
        let images = Images { setting: self.setting, width: support.len(), is_split: false, make };
        Ok(images::vector(&images)?.map(|vector| (support, vector)))
    }

    /// Tells the density of a null vector, or one with numbers as exponents.
    pub fn density(&self, support: &[usize], report: &mut SearchReport) -> Result<(), SearchError> {
        if report.formulas(FoundKind::Density).next().is_some() {
            return Ok(());
        }
        let numeric = self.numeric_density()?;
        let support = numeric.as_ref().map_or(support, |(own, _)| own.as_slice());
        let general = match &numeric {
            Some(_) => None,
            None => self.vector(support)?,
        };
        let found = numeric.as_ref().map(|(_, vector)| vector).or(general.as_ref());
        let Some(vector) = found else { return Ok(()) };
        for style in self.styles(support) {
            let Some(formula) = self.product(support, vector, style)? else { continue };
            let statement = OrbitStatement::Density(formula.clone());
            let setting = self.setting;
            if claims::other(setting, FoundKind::Density, &formula, &statement, None, report)? {
                break;
            }
        }
        Ok(())
    }
}
