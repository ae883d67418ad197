//! Functions whose rate is a combination of known integrals.

use super::super::ansatz::system::PrimePoint;
use super::super::terms::{TermSum, is_one};
use super::super::{SearchError, SearchReport};
use super::claims::{self, OrbitStatement};
use super::exponents::{ExponentSystem, RateTerm};
use super::factor::RatedPolynomial;
use super::images;
use super::known::IndependentIntegrals;
use crate::echelon::nonzero;
use liouville::formula::Formula;
use liouville::verdict::Flaw;

/// Largest number of integrals of which a rate may be a combination.
const MOST_KNOWN: usize = 12;
/// Largest number of functions of such rates.
const MOST_RATES: usize = 4;

impl ExponentSystem<'_, '_> {
    /// Searches for functions whose rate is a combination of known integrals: with G' = 0 and F' = G, F − tG
    /// is an integral, whether or not another function has a constant rate.
    pub fn search_rates(
        mut self,
        known: &IndependentIntegrals,
        report: &mut SearchReport,
    ) -> Result<(), SearchError> {
        for formula in known.formulas() {
            self.known.extend(RatedPolynomial::of(self.setting, formula, 1)?);
        }
        if self.known.is_empty() || self.known.len() > MOST_KNOWN {
            return Ok(());
        }
        let is_function = |column: &RateTerm| {
            matches!(column, RateTerm::Monomial(_) | RateTerm::Factor(_) | RateTerm::Angle(_))
        };
        self.columns.retain(is_function);
        let first = self.columns.len();
        self.columns.extend((0..self.known.len()).map(RateTerm::Known));
        self.columns.push(RateTerm::Constant);
        let Some(at) = self.setting.at(0, 0) else { return Ok(()) };
        let all: Vec<usize> = (0..self.columns.len()).collect();
        let mut told = 0;
        for vector in self.relations(&at, &all)? {
            self.setting.effort.halt.check()?;
            let support = nonzero(&vector);
            let is_known = |column: &usize| matches!(self.columns[*column], RateTerm::Known(_));
            let is_driven = support.iter().any(is_known);
            // Integrals that depend on each other have no function.
            if !is_driven || support[0] >= first || told == MOST_RATES {
                continue;
            }
            let Some(vector) = self.vector(&support)? else { continue };
            let Some(rate) = self.combination(&support, first, &vector)? else { continue };
            // An integral that jumps is not constant along a motion across.
            let statement = OrbitStatement::Integral(rate.clone());
            let Some(judged) = claims::proved(self.setting, &statement)? else { continue };
            if judged.evidence.flaws.contains(&Flaw::Jumps) {
                continue;
            }
            for style in self.styles(&support) {
                let Some(function) = self.logarithm(&support, &vector, style)? else { continue };
                if self.is_time_by_rate(&at, &function)? {
                    break;
                }
                if claims::rate(self.setting, &function, &rate, report)? {
                    told += 1;
                    break;
                }
            }
        }
        Ok(())
    }

    /// Whether a function is t v(F) for a variable t with v(t) = 1, which says no more than v(v(F)) = 0.
    fn is_time_by_rate(&self, at: &PrimePoint, function: &Formula) -> Result<bool, SearchError> {
        let setting = self.setting;
        let Some(own) = RatedPolynomial::of(setting, function, 1)? else { return Ok(false) };
        let Some(point) = setting.point(at, 1 << 42) else { return Ok(false) };
        let Some(orbit) = setting.along(at, &point, 2)? else { return Ok(false) };
        let Some((value, rate)) = own.at(at, &point) else { return Ok(false) };
        let m = &at.modulus;
        let mut times = orbit.iter().filter(|series| series[1] == m.one());
        Ok(times.any(|series| m.mul(series[0], rate) == value))
    }

    /// The combination of known integrals, and a number, in a null vector.
    fn combination(
        &self,
        support: &[usize],
        first: usize,
        vector: &images::ParametricVector,
    ) -> Result<Option<Formula>, SearchError> {
        let mut sum = TermSum::default();
        for (place, column) in support.iter().enumerate().filter(|(_, column)| **column >= first) {
            let factor = vector.coefficients.formula(place)?;
            let is_below = factor.constant().is_some_and(|own| own.is_negative());
            let factor = if is_below { -&factor } else { factor };
            match &self.columns[*column] {
                RateTerm::Known(own) if is_one(&factor) => {
                    sum.add(is_below, &self.known[*own].formula)?;
                }
                RateTerm::Known(own) => {
                    sum.add(is_below, &(&factor * &self.known[*own].formula)?)?
                }
                _ => sum.add(!is_below, &factor)?,
            }
        }
        Ok(sum.total())
    }
}
