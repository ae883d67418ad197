//! Notation of Π f^α e^g and of its logarithm.

use super::super::ansatz::monomials::power_product;
use super::exponents::{Column, Exponents};
use super::images;

impl Exponents<'_, '_> {
    /// Writes the logarithm Σ α ln f + g.
    pub fn logarithm(
        &self,
        support: &[usize],
        vector: &images::Vector,
        has_moduli: bool,
    ) -> String {
        let names: Vec<&str> = self.setting.terms.iter().map(|term| term.text.as_str()).collect();
        let mut functions = Vec::new();
        let mut places = Vec::new();
        for (place, column) in support.iter().enumerate() {
            let function = match &self.columns[*column] {
                Column::Monomial(own) => power_product(&names, own),
                Column::Factor(own) if has_moduli => format!("ln|{}|", self.factors[*own].formula),
                Column::Factor(own) => format!("ln({})", self.factors[*own].formula),
                Column::Constant | Column::Divergence => continue,
            };
            functions.push(function);
            places.push(place);
        }
        vector.coefficients.sum(&places, &functions)
    }

    /// Writes Π f^α e^g.
    pub fn product(&self, support: &[usize], vector: &images::Vector, has_moduli: bool) -> String {
        let names: Vec<&str> = self.setting.terms.iter().map(|term| term.text.as_str()).collect();
        let mut powers = Vec::new();
        let mut exponent = (Vec::new(), Vec::new());
        for (place, column) in support.iter().enumerate() {
            match &self.columns[*column] {
                Column::Monomial(own) => {
                    exponent.0.push(place);
                    exponent.1.push(power_product(&names, own));
                }
                Column::Factor(own) => {
                    let formula = &self.factors[*own].formula;
                    let is_whole = vector.is_whole(place);
                    let is_name = self.setting.terms.iter().any(|term| &term.text == formula);
                    let base = match (has_moduli && !is_whole, is_name) {
                        (true, _) => format!("|{formula}|"),
                        (false, true) => formula.clone(),
                        (false, false) => format!("({formula})"),
                    };
                    powers.push(match vector.exponent(place).as_str() {
                        "1" => base,
                        power => format!("{base}^{power}"),
                    });
                }
                Column::Constant | Column::Divergence => {}
            }
        }
        if !exponent.0.is_empty() {
            let above = vector.coefficients.sum(&exponent.0, &exponent.1);
            powers.push(match vector.below().as_str() {
                "1" => format!("exp({above})"),
                below => format!("exp({})", images::quotient(&above, below)),
            });
        }
        powers.join("*")
    }
}
