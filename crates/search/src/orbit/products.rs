//! Π f^α e^(g + Σ h/f^m) and its logarithm, as formulas.

use liouville::formula::{Formula, FormulaError};

use super::super::SearchError;
use super::super::ansatz::coefficients::Ratio;
use super::super::ansatz::monomials::power_product;
use super::super::terms::{Power, is_one, multiplied, one};
use super::exponents::{ExponentSystem, RateTerm, Style};
use super::images;
use super::magnitude::magnitude;
use super::quotients::Quotient;

impl ExponentSystem<'_, '_> {
    /// Argument of a factor that is an exponential.
    fn exponent(&self, factor: usize) -> Option<&Formula> {
        let origin = self.setting.origin?;
        origin.extension.exponent(&self.factors[factor].formula)
    }

    /// A factor under a logarithm or a root.
    fn base(&self, factor: usize, style: Style) -> Result<Formula, SearchError> {
        let formula = &self.factors[factor].formula;
        match style.has_moduli {
            true => magnitude(self.setting, formula),
            false => Ok(formula.clone()),
        }
    }

    /// A monomial over a power of a factor.
    fn quotient(&self, own: &Quotient) -> Result<Ratio, FormulaError> {
        let formula = &self.factors[own.factor].formula;
        let below = match own.power {
            1 => formula.clone(),
            power => formula.raised(power)?,
        };
        let above = power_product(&self.setting.terms, &own.monomial)?;
        Ok(Ratio { above, below: Some(below) })
    }

    /// Makes the logarithm Σ α ln f + g + Σ h/f^m; `None` if an angle is not real.
    pub fn logarithm(
        &self,
        support: &[usize],
        vector: &images::ParametricVector,
        style: Style,
    ) -> Result<Option<Formula>, SearchError> {
        let mut functions = Vec::new();
        let mut places = Vec::new();
        for (place, column) in support.iter().enumerate() {
            let function = match &self.columns[*column] {
                RateTerm::Monomial(own) => power_product(&self.setting.terms, own)?,
                RateTerm::Quotient(own) => {
                    functions.push(self.quotient(own)?);
                    places.push(place);
                    continue;
                }
                RateTerm::Factor(own) => match self.exponent(*own) {
                    Some(argument) => argument.clone(),
                    None => Formula::call("ln", &[&self.base(*own, style)?])?,
                },
                RateTerm::Angle(own) => match self.pairs[*own].formula(style.angle)? {
                    Some(angle) => angle,
                    None => return Ok(None),
                },
                RateTerm::Constant | RateTerm::Divergence | RateTerm::Known(_) => continue,
            };
            functions.push(Ratio::of(function));
            places.push(place);
        }
        let sum = vector.coefficients.sum(&places, &functions)?;
        Ok(Some(sum.unwrap_or_else(|| Formula::number(0))))
    }

    /// Makes Π f^α e^(g + Σ h/f^m); `None` if an angle is not real.
    pub fn product(
        &self,
        support: &[usize],
        vector: &images::ParametricVector,
        style: Style,
    ) -> Result<Option<Formula>, SearchError> {
        let mut powers: Vec<Power> = Vec::new();
        let mut exponent = (Vec::new(), Vec::new());
        for (place, column) in support.iter().enumerate() {
            match &self.columns[*column] {
                RateTerm::Monomial(own) => {
                    exponent.0.push(place);
                    exponent.1.push(Ratio::of(power_product(&self.setting.terms, own)?));
                }
                RateTerm::Quotient(own) => {
                    exponent.0.push(place);
                    exponent.1.push(self.quotient(own)?);
                }
                RateTerm::Factor(own) => {
                    if let Some(argument) = self.exponent(*own) {
                        exponent.0.push(place);
                        exponent.1.push(Ratio::of(argument.clone()));
                        continue;
                    }
                    let base = match vector.is_whole(place) {
                        true => self.factors[*own].formula.clone(),
                        false => self.base(*own, style)?,
                    };
                    powers.push((base, vector.exponent(place)?));
                }
                RateTerm::Angle(own) => {
                    let Some(angle) = self.pairs[*own].formula(style.angle)? else {
                        return Ok(None);
                    };
                    exponent.0.push(place);
                    exponent.1.push(Ratio::of(angle));
                }
                RateTerm::Constant | RateTerm::Divergence | RateTerm::Known(_) => {}
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
            powers.push((Formula::call("exp", &[&whole])?, one()));
        }
        Ok(Some(multiplied(&powers)?))
    }
}
