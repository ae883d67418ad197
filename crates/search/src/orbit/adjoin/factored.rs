//! Factors of polynomials in the state: each factor of a Darboux polynomial is one.

use liouville::case::Case;
use liouville::formula::Formula;
use liouville::proof::Polynomial;

use super::super::super::SearchError;
use super::super::cleared::input_names;
use super::derivations::scale;
use super::plain::polynomials;
use super::polynomial::{Monomial, RingPolynomial};
use super::write;

/// Divides a polynomial into factors over the rational numbers and the parameters, each once and with its degree
/// in the state; those without the state are left out. Empty if it is none, or if it is not divided.
pub fn polynomial_factors(
    case: &Case,
    formula: &Formula,
) -> Result<Vec<(Formula, u32)>, SearchError> {
    let read = polynomials(case, std::slice::from_ref(formula))?;
    let Some(own) = read.and_then(|all| all.into_iter().next().flatten()) else {
        return Ok(Vec::new());
    };
    let narrow = |(variable, power): &(usize, u32)| Some((u32::try_from(*variable).ok()?, *power));
    let mut made = Polynomial::default();
    for (monomial, value) in own.terms() {
        let Some(exponents) = monomial.iter().map(narrow).collect::<Option<Vec<_>>>() else {
            return Ok(Vec::new());
        };
        made = made.plus(&Polynomial::of_term(value, exponents));
    }
    let parameters = case.model.free_components();
    let degree = |monomial: &Monomial| -> u32 {
        monomial
            .iter()
            .filter(|(variable, _)| *variable >= parameters)
            .map(|(_, power)| power)
            .sum()
    };
    let names = input_names(case);
    let mut found = Vec::new();
    for factor in made.factors() {
        let mut ring = RingPolynomial::default();
        for (value, exponents) in factor.terms() {
            let monomial = exponents.iter().map(|(own, power)| (*own as usize, *power)).collect();
            let term = RingPolynomial::term(monomial, value.clone());
            let Some(sum) = ring.plus(&term, &1.into()) else { return Ok(Vec::new()) };
            ring = sum;
        }
        let most = ring.terms().map(|(monomial, _)| degree(monomial)).max().unwrap_or(0);
        if most == 0 {
            continue;
        }
        let whole = scale(&ring).map_or_else(|| ring.clone(), |scale| ring.times_number(&scale));
        let Ok(formula) = case.formula(&write::written(&whole, &names)) else {
            return Ok(Vec::new());
        };
        found.push((formula, most));
    }
    // A polynomial that is not divided keeps the form that it was found in.
    let is_whole = |all: &[(Formula, u32)]| {
        let most = own.terms().map(|(monomial, _)| degree(monomial)).max().unwrap_or(0);
        matches!(all, [(_, only)] if *only == most)
    };
    Ok(if is_whole(&found) { Vec::new() } else { found })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn factors_over_the_parameters_are_found() {
        let text = "title = 'a'\n[parameters]\nk = '1..2'\n[state]\nx = '-1..1'\nv = '-1..1'\n[field]\n\
                    \"x'\" = 'v'\n\"v'\" = '-3*k*x*v - k^2*x^3'\n";
        let case = Case::parse(text, &[]).expect("a case");
        let of = |text: &str| {
            let formula = case.formula(text).expect("a formula");
            let found = polynomial_factors(&case, &formula).expect("an answer");
            let mut texts: Vec<(String, u32)> =
                found.iter().map(|(own, degree)| (own.text().to_string(), *degree)).collect();
            texts.sort();
            texts
        };
        let found = of("2*v^2 + 3*k*x^2*v + k^2*x^4");
        assert_eq!(found.len(), 2, "{found:?}");
        assert!(found.iter().all(|(_, degree)| *degree == 2), "{found:?}");
        assert_eq!(of("9 + 41*v^2 + 32*v^4").len(), 2);
        assert_eq!(of("k*(x^2 + 1)^2"), [("1 + x²".to_string(), 2)], "once, and without k");
        assert!(of("x^2 + v^2").is_empty() && of("exp(x)*v").is_empty());
    }
}
