//! Equations for integrals Σ c m of a map, or Σ c m ρ with a density ρ, for monomials m.
//!
//! One row for each random point modulo a prime holds the changes of all m, or m ρ, along the map.

use liouville::formula::Formula;
use liouville::graph::Tape;

use super::super::SearchError;
use super::super::ansatz::system::PrimePoint;
use super::super::echelon::Echelon;
use super::images::{self, Images};
use super::monomials::value;
use super::setting::{OrbitSetting, SPARE_ORDERS, run};

/// A map with the weight of its monomials.
#[derive(Clone, Copy)]
pub struct MapRows<'s, 'c> {
    pub setting: &'s OrbitSetting<'c>,
    /// Images of the state, and then the density, if there is one.
    pub tape: &'s Tape,
    pub has_density: bool,
}

impl MapRows<'_, '_> {
    /// Changes at random points, reduced; `None` if the map has too few points modulo the prime.
    pub fn echelon(
        &self,
        at: &PrimePoint,
        monomials: &[Vec<u32>],
    ) -> Result<Option<Echelon>, SearchError> {
        let (m, dimension) = (at.modulus, self.setting.dimension());
        let mut echelon = Echelon::new(monomials.len(), m);
        let wanted = monomials.len() + SPARE_ORDERS;
        let mut rows = 0;
        // A root exists at half of all points.
        for number in 0..4 * wanted as u64 {
            self.setting.effort.halt.check()?;
            let Some(point) = self.setting.point(at, number) else { continue };
            let inputs = [point.parameters.as_slice(), &point.state].concat();
            let Some(here) = run(self.tape, m, &inputs) else { continue };
            let image = &here[..dimension];
            let weights = match self.has_density {
                false => Some([m.one(), m.one()]),
                true => {
                    let inputs = [point.parameters.as_slice(), image].concat();
                    let there = run(self.tape, m, &inputs);
                    there.map(|there| [here[dimension], there[dimension]])
                }
            };
            let Some([before, after]) = weights else { continue };
            let change = |own: &Vec<u32>| {
                let after = m.mul(after, value(&m, image, own));
                m.sub(after, m.mul(before, value(&m, &point.state, own)))
            };
            echelon.push(monomials.iter().map(change).collect());
            rows += 1;
            if rows == wanted {
                return Ok(Some(echelon));
            }
        }
        Ok(None)
    }

    /// The one solution for some monomials, as a formula in these; `None` where its coefficients are not written.
    pub fn solution(&self, monomials: &[Vec<u32>]) -> Result<Option<Formula>, SearchError> {
        let make = |at: &PrimePoint| {
            let vector = self.echelon(at, monomials).ok()??.null_space().pop()?;
            (vector.last() == Some(&at.modulus.one())).then_some(vector)
        };
        let (setting, width) = (self.setting, monomials.len());
        let images = Images { setting, width, is_split: false, make };
        let Some(coefficients) = images::coefficients(&images)? else { return Ok(None) };
        let functions = setting.functions(monomials)?;
        let places: Vec<usize> = (0..width).collect();
        Ok(coefficients.sum(&places, &functions)?)
    }
}
