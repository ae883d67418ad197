//! Absence of densities P^(1/α) and exp P with polynomials P in all variables of a field.

use super::super::SearchError;
use super::super::ansatz::coefficients::PrimitiveVector;
use super::super::leading::opposite;
use super::super::terms::{is_one, multiplied, numeric_exponent};
use super::polynomials::{Counting, nothing};
use super::{AbsenceOutcome, claimed_densities};
use crate::echelon::nonzero;
use liouville::formula::Formula;
use liouville::number::rational::Rational;

impl Counting<'_> {
    /// Judges the claim that there is no density P^(1/α) or exp P.
    pub(super) fn no_density(&self) -> Result<AbsenceOutcome, SearchError> {
        for (alpha, direction) in &self.weighted {
            self.asked.effort.halt.check()?;
            let columns = self.columns(*direction);
            let Some(found) = self.system.null_space(&self.at, &columns)? else {
                return Ok(nothing());
            };
            let Some(vector) = found.first() else { continue };
            let root = numeric_exponent(Rational::new(alpha.signum(), alpha.abs()))?;
            if let Some(polynomial) = self.written(vector, *direction)?
                && let Some(exhibit) = self.power(polynomial, *alpha, &root)?
            {
                return Ok(AbsenceOutcome::Exhibited(exhibit));
            }
            return Ok(AbsenceOutcome::Open(format!(
                "the count allows a density P^{root}, but none was found in closed form"
            )));
        }
        // L_vP + s div v = 0, without the constants: ln ρ = P/s.
        let columns = [&self.columns(0)[1..], &[self.divergence]].concat();
        let Some(found) = self.system.null_space(&self.at, &columns)? else { return Ok(nothing()) };
        if found.iter().any(|own| own.last().is_some_and(|last| *last != 0)) {
            return self.exponential(&found, &columns);
        }
        let Some(space) = self.space()? else { return Ok(nothing()) };
        if found.len() + 1 != space.dimension {
            let reason = "there are more integrals of this degree than are claimed, and the count does \
                          not tell them from densities: claim them as well";
            return Ok(AbsenceOutcome::Open(reason.to_string()));
        }
        let statement = format!(
            "there is no invariant density P^(1/α), α = ±1, ±2, ±3, ±4, and none of the form exp P, with \
             P {}",
            self.class()
        );
        Ok(AbsenceOutcome::Excluded {
            theorem: self.asked.theorem(&statement),
            counted: "0 are counted".to_string(),
        })
    }

    /// Judges P^(1/α) as a density, and (−P)^(1/α) where even roots leave the sign open.
    fn power(
        &self,
        polynomial: Formula,
        alpha: i64,
        root: &Formula,
    ) -> Result<Option<String>, SearchError> {
        let opposite = match alpha % 2 {
            0 => Some(opposite(self.asked.case, &polynomial)?),
            _ => None,
        };
        for base in std::iter::once(polynomial).chain(opposite) {
            let formula = multiplied(&[(base, root.clone())])?;
            if let Some(exhibit) = claimed_densities::exhibit(self.asked, &formula)? {
                return Ok(Some(exhibit));
            }
        }
        Ok(None)
    }

    /// Writes exp P and judges it as a density.
    fn exponential(
        &self,
        found: &[Vec<u64>],
        columns: &[usize],
    ) -> Result<AbsenceOutcome, SearchError> {
        let own = found.iter().find(|own| own.last().is_some_and(|last| *last != 0));
        let open = || {
            Ok(AbsenceOutcome::Open(
                "the count allows a density exp P, but none was found".to_string(),
            ))
        };
        let Some(vector) = own else { return open() };
        let support = nonzero(vector);
        let used: Vec<usize> = support.iter().map(|k| columns[*k]).collect();
        let Some(coefficients) = PrimitiveVector::of(&self.system, &used)? else { return open() };
        let last = support.len() - 1;
        let functions = self.functions(support[..last].iter().map(|k| columns[*k]))?;
        let sum = coefficients.sum(&(0..last).collect::<Vec<_>>(), &functions)?;
        let sum = sum.unwrap_or_else(|| Formula::number(0));
        let below = coefficients.formula(last)?;
        let exponent = match is_one(&below) {
            true => sum,
            false => (sum.bracketed() / &below.bracketed())?,
        };
        let formula = Formula::call("exp", &[&exponent])?;
        match claimed_densities::exhibit(self.asked, &formula)? {
            Some(exhibit) => Ok(AbsenceOutcome::Exhibited(exhibit)),
            None => open(),
        }
    }
}
