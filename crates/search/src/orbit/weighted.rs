//! Integrals ρP of a field in the plane with a density ρ and a polynomial P.
//!
//! ρ is a multiplier: dF = ρ (x' dy − y' dx) is closed, and F is an integral. Where F is ρP, L_v(ρP) = 0
//! is v(P) = div v P, which is linear in the coefficients of P and solved at random states modulo a prime.

use liouville::formula::{Formula, FormulaError};
use liouville::graph::Tape;

use super::super::ansatz::coefficients::Ratio;
use super::super::ansatz::monomials::power_product;
use super::super::ansatz::system::PrimePoint;
use super::super::echelon::Echelon;
use super::super::terms::is_one;
use super::super::{FoundKind, SearchError, SearchReport};
use super::claims;
use super::exponents::divergence;
use super::images::{self, Images};
use super::monomials::{self, value};
use super::quotients::rate_of_monomial;
use super::setting::{OrbitSetting, SPARE_ORDERS, run};

/// Largest number of monomials of P.
const MONOMIALS: usize = 100;
/// Largest degree of P.
const DEGREE: u32 = 8;

/// Searches a field in the plane of which a density, and no integral, is known; what is proved goes
/// into the report.
pub fn search(setting: &OrbitSetting<'_>, report: &mut SearchReport) -> Result<(), SearchError> {
    let dimension =
        setting.origin.map_or(setting.dimension(), |origin| origin.case.model.dimension());
    if dimension != 2 || report.formulas(FoundKind::Integral).next().is_some() {
        return Ok(());
    }
    let density = report.functions(FoundKind::Density).find(|own| !is_one(own)).cloned();
    let (Some(density), Some(at)) = (density, setting.at(0, 0)) else { return Ok(()) };
    let rates = WeightedRates { setting, divergence: divergence(setting)? };
    let variables: Vec<usize> = (0..setting.dimension()).collect();
    for degree in 1..=DEGREE {
        let mut all = monomials::up_to(&variables, setting.dimension(), degree);
        all = setting.standard(all);
        if all.len() > MONOMIALS {
            break;
        }
        for vector in rates.null_vectors(&at, &all)? {
            let Some(polynomial) = rates.polynomial(&all, &vector)? else { continue };
            if claims::weighted_integral(setting, &density, &polynomial, report)? {
                return Ok(());
            }
        }
    }
    Ok(())
}

/// The linear equations v(P) = div v P.
struct WeightedRates<'s, 'c> {
    setting: &'s OrbitSetting<'c>,
    divergence: Tape,
}

impl WeightedRates<'_, '_> {
    /// Null vectors on some monomials, each with its last nonzero entry, 1, in a different column.
    fn null_vectors(
        &self,
        at: &PrimePoint,
        all: &[Vec<u32>],
    ) -> Result<Vec<Vec<u64>>, SearchError> {
        let m = at.modulus;
        let mut echelon = Echelon::new(all.len(), m);
        let mut dependent = 0;
        for number in 0..4 * (all.len() + SPARE_ORDERS) as u64 {
            self.setting.effort.halt.check()?;
            let Some((point, orbit)) = self.setting.orbit(at, number, 2)? else { continue };
            let inputs = [point.parameters.as_slice(), &point.state].concat();
            let Some(growth) = run(&self.divergence, m, &inputs) else { continue };
            let rates = |k: usize| orbit[k][1];
            let entry = |own: &Vec<u32>| {
                let lost = m.mul(growth[0], value(&m, &point.state, own));
                m.sub(rate_of_monomial(at, &point, &rates, own), lost)
            };
            dependent =
                if echelon.push(all.iter().map(entry).collect()) { 0 } else { dependent + 1 };
            if dependent == SPARE_ORDERS {
                return Ok(echelon.null_space());
            }
        }
        Ok(Vec::new())
    }

    /// The polynomial with the monomials of a null vector, for all values of the parameters.
    fn polynomial(&self, all: &[Vec<u32>], vector: &[u64]) -> Result<Option<Formula>, SearchError> {
        let own = all.iter().zip(vector).filter(|(_, entry)| **entry != 0);
        let support: Vec<Vec<u32>> = own.map(|(own, _)| own.clone()).collect();
        let make = |at: &PrimePoint| self.null_vectors(at, &support).ok()?.pop();
        let images = Images { setting: self.setting, width: support.len(), is_split: false, make };
        let Some(coefficients) = images::coefficients(&images)? else { return Ok(None) };
        let terms = &self.setting.terms;
        let functions: Vec<Ratio> = support
            .iter()
            .map(|own| power_product(terms, own).map(Ratio::of))
            .collect::<Result<_, FormulaError>>()?;
        let places: Vec<usize> = (0..support.len()).collect();
        Ok(coefficients.sum(&places, &functions)?)
    }
}
