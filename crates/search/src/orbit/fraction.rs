//! Fractions of polynomials as formulas that are judged.

use liouville::formula::{Formula, FormulaResult};
use num_bigint::BigInt;
use num_integer::Integer;

use super::super::ansatz::coefficients::{Polynomial, PrimitiveVector};
use super::super::terms::is_one;
use super::super::{SearchError, SearchReport};
use super::claims;
use super::known::IndependentIntegrals;
use super::rational::RationalSearch;

/// A fraction P/Q by the monomials of both.
pub struct MonomialFraction {
    /// Monomials of P.
    pub above: Vec<Vec<u32>>,
    /// Monomials of Q.
    pub below: Vec<Vec<u32>>,
}

impl RationalSearch<'_, '_> {
    /// Writes a fraction and has it judged.
    pub fn tell(
        &self,
        fraction: &MonomialFraction,
        coefficients: Option<PrimitiveVector>,
        known: &mut IndependentIntegrals,
        report: &mut SearchReport,
    ) -> Result<bool, SearchError> {
        self.setting.effort.halt.check()?;
        let Some(mut coefficients) = coefficients else { return Ok(false) };
        let (above, below) = coefficients.polynomials.split_at_mut(fraction.above.len());
        [above, &mut below[..fraction.below.len()]].into_iter().for_each(reduce_whole);
        let written = |own: &[Vec<u32>], start: usize| -> FormulaResult {
            let functions = self.setting.functions(own)?;
            let places: Vec<usize> = (start..start + own.len()).collect();
            let sum = coefficients.sum(&places, &functions)?;
            Ok(sum.unwrap_or_else(|| Formula::number(0)))
        };
        let above = written(&fraction.above, 0)?;
        let below = written(&fraction.below, fraction.above.len())?;
        if below.constant().is_some_and(|value| value.is_zero()) {
            return Ok(false);
        }
        let degree = |own: &[Vec<u32>]| own.iter().map(|a| a.iter().sum()).max().unwrap_or(0);
        let degrees = [degree(&fraction.above), degree(&fraction.below)];
        // Of two integrals P and Q the fraction is none that a person would write.
        if degrees.iter().all(|own| *own > 0) {
            let mut is_new = false;
            for (part, degree) in [(&above, degrees[0]), (&below, degrees[1])] {
                if claims::integral(self.setting, part, report)? {
                    known.add(part.clone(), Some(degree), self.variables);
                    is_new = true;
                }
            }
            if is_new {
                return Ok(true);
            }
        }
        let formula = match is_one(&below) {
            true => above.clone(),
            false => (&above / &below)?,
        };
        let is_new = claims::integral(self.setting, &formula, report)?;
        if is_new {
            known.add(formula, None, self.variables);
            let parts = [above, below].into_iter().zip(degrees);
            known.parts.extend(parts.into_iter().filter(|(_, degree)| *degree > 0));
        }
        Ok(is_new)
    }
}

/// Divides polynomials by the common divisor of all their coefficients.
fn reduce_whole(polynomials: &mut [Polynomial]) {
    let all = polynomials.iter().flatten();
    let common = all.fold(BigInt::ZERO, |gcd, (_, value)| gcd.gcd(value));
    if common != BigInt::ZERO {
        polynomials.iter_mut().flatten().for_each(|(_, value)| *value /= &common);
    }
}
