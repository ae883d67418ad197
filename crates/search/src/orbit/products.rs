//! Π f^α e^g and its logarithm, as formulas.

use liouville::formula::{Formula, FormulaError};

use super::super::ansatz::coefficients::Ratio;
use super::super::ansatz::monomials::power_product;
use super::super::terms::{is_one, one};
use super::exponents::{ExponentSystem, RateTerm, Style};
use super::images;

impl ExponentSystem<'_, '_> {
    /// Argument of a factor that is an exponential.
    fn exponent(&self, factor: usize) -> Option<&Formula> {
        let origin = self.setting.origin?;
        origin.extension.exponent(&self.factors[factor].formula)
    }

    /// Makes the logarithm Σ α ln f + g; `None` if an angle is not real.
    pub fn logarithm(
        &self,
        support: &[usize],
        vector: &images::ParametricVector,
        style: Style,
    ) -> Result<Option<Formula>, FormulaError> {
        let mut functions = Vec::new();
        let mut places = Vec::new();
        for (place, column) in support.iter().enumerate() {
            let function = match &self.columns[*column] {
                RateTerm::Monomial(own) => power_product(&self.setting.terms, own)?,
                RateTerm::Factor(own) => match self.exponent(*own) {
                    Some(argument) => argument.clone(),
                    None if style.has_moduli => {
                        Formula::call("ln", &[&self.factors[*own].formula.modulus()?])?
                    }
                    None => Formula::call("ln", &[&self.factors[*own].formula])?,
                },
                RateTerm::Angle(own) => match self.pairs[*own].formula(style.angle)? {
                    Some(angle) => angle,
                    None => return Ok(None),
                },
                RateTerm::Constant | RateTerm::Divergence => continue,
            };
            functions.push(Ratio::of(function));
            places.push(place);
        }
        let sum = vector.coefficients.sum(&places, &functions)?;
        Ok(Some(sum.unwrap_or_else(|| Formula::number(0))))
    }

    /// Makes Π f^α e^g; `None` if an angle is not real.
    pub fn product(
        &self,
        support: &[usize],
        vector: &images::ParametricVector,
        style: Style,
    ) -> Result<Option<Formula>, FormulaError> {
        let mut powers: Vec<Formula> = Vec::new();
        let mut exponent = (Vec::new(), Vec::new());
        for (place, column) in support.iter().enumerate() {
            match &self.columns[*column] {
                RateTerm::Monomial(own) => {
                    exponent.0.push(place);
                    exponent.1.push(Ratio::of(power_product(&self.setting.terms, own)?));
                }
                RateTerm::Factor(own) => {
                    if let Some(argument) = self.exponent(*own) {
                        exponent.0.push(place);
                        exponent.1.push(Ratio::of(argument.clone()));
                        continue;
                    }
                    let formula = &self.factors[*own].formula;
                    let base = match style.has_moduli && !vector.is_whole(place) {
                        true => formula.modulus()?,
                        false => formula.clone(),
                    };
                    let power = vector.exponent(place)?;
                    powers.push(match is_one(&power) {
                        true => base,
                        false => base.power(&power)?,
                    });
                }
                RateTerm::Angle(own) => {
                    let Some(angle) = self.pairs[*own].formula(style.angle)? else {
                        return Ok(None);
                    };
                    exponent.0.push(place);
                    exponent.1.push(Ratio::of(angle));
                }
                RateTerm::Constant | RateTerm::Divergence => {}
            }
        }
        if !exponent.0.is_empty() {
            let above = vector.coefficients.sum(&exponent.0, &exponent.1)?;
            let above = above.unwrap_or_else(|| Formula::number(0));
            let below = vector.below()?;
            let whole = match is_one(&below) {
                true => above,
                false => (above / &below)?,
            };
            powers.push(Formula::call("exp", &[&whole])?);
        }
        let product = match powers.split_first() {
            None => one(),
            Some((first, others)) => others.iter().try_fold(first.clone(), |all, own| all * own)?,
        };
        Ok(Some(product))
    }
}
