//! Π f^α e^g and its logarithm, as formulas.

use liouville::formula::{Formula, FormulaResult};

use super::super::ansatz::coefficients::Ratio;
use super::super::ansatz::monomials::power_product;
use super::super::terms::{is_one, one};
use super::exponents::{ExponentSystem, RateTerm};
use super::images;

impl ExponentSystem<'_, '_> {
    /// Makes the logarithm Σ α ln f + g.
    pub fn logarithm(
        &self,
        support: &[usize],
        vector: &images::ParametricVector,
        has_moduli: bool,
    ) -> FormulaResult {
        let mut functions = Vec::new();
        let mut places = Vec::new();
        for (place, column) in support.iter().enumerate() {
            let function = match &self.columns[*column] {
                RateTerm::Monomial(own) => power_product(&self.setting.terms, own)?,
                RateTerm::Factor(own) if has_moduli => {
                    Formula::call("ln", &[&self.factors[*own].formula.modulus()?])?
                }
                RateTerm::Factor(own) => Formula::call("ln", &[&self.factors[*own].formula])?,
                RateTerm::Constant | RateTerm::Divergence => continue,
            };
            functions.push(Ratio::of(function));
            places.push(place);
        }
        let sum = vector.coefficients.sum(&places, &functions)?;
        Ok(sum.unwrap_or_else(|| Formula::number(0)))
    }

    /// Makes Π f^α e^g.
    pub fn product(
        &self,
        support: &[usize],
        vector: &images::ParametricVector,
        has_moduli: bool,
    ) -> FormulaResult {
        let mut powers: Vec<Formula> = Vec::new();
        let mut exponent = (Vec::new(), Vec::new());
        for (place, column) in support.iter().enumerate() {
            match &self.columns[*column] {
                RateTerm::Monomial(own) => {
                    exponent.0.push(place);
                    exponent.1.push(Ratio::of(power_product(&self.setting.terms, own)?));
                }
                RateTerm::Factor(own) => {
                    let formula = &self.factors[*own].formula;
                    let base = match has_moduli && !vector.is_whole(place) {
                        true => formula.modulus()?,
                        false => formula.bracketed(),
                    };
                    let power = vector.exponent(place)?;
                    powers.push(match is_one(&power) {
                        true => base,
                        false => base.power(&power.bracketed())?,
                    });
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
                false => (above.bracketed() / &below.bracketed())?,
            };
            powers.push(Formula::call("exp", &[&whole])?);
        }
        match powers.split_first() {
            None => Ok(one()),
            Some((first, others)) => others.iter().try_fold(first.clone(), |all, own| all * own),
        }
    }
}
