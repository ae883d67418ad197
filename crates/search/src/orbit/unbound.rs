//! Darboux polynomials with sines and cosines, which satisfy sin² + cos² = 1.
//!
//! The extended field is a polynomial field on the space of all its variables, whether or not they
//! satisfy these relations. A Darboux polynomial there is one on the level as well. Those of which
//! this holds only where sin² + cos² = 1 are not found.

use super::super::{SearchError, SearchReport};
use super::claims::{self, OrbitStatement};
use super::darboux::DarbouxSearch;
use super::factor::RatedPolynomial;
use super::part::DARBOUX;
use super::setting::{ExtendedCase, OrbitSetting};
use super::{RoundLimits, blocks, degree_of_field, monomials};

/// Searches the extended field without its level; what is proved about the case itself is added to
/// the factors.
pub fn search(
    setting: &OrbitSetting<'_>,
    limits: RoundLimits,
    factors: &mut Vec<RatedPolynomial>,
    report: &mut SearchReport,
    progress: &mut dyn FnMut(&str),
) -> Result<(), SearchError> {
    let Some(ExtendedCase { extension, .. }) = setting.origin else { return Ok(()) };
    let Some(case) = extension.unbound() else { return Ok(()) };
    let Ok(unbound) = OrbitSetting::of(&case, setting.effort)? else { return Ok(()) };
    let Some(degree) = degree_of_field(&unbound)? else { return Ok(()) };
    let (mut all, mut pairs) = (Vec::new(), Vec::new());
    let mut own = SearchReport::default();
    for variables in blocks::closed(&case)? {
        let search = DarbouxSearch { setting: &unbound, variables: &variables, degree };
        let fits = |next: &u32| monomials::steps(variables.len(), *next, degree) <= limits.steps;
        for next in (1..=DARBOUX).take_while(fits) {
            progress(&format!("Darboux polynomials of degree {next}, with functions as variables"));
            search.of_degree(next, &mut all, &mut pairs, &mut own)?;
        }
    }
    for found in &own.found {
        let Some(cofactor) = found.with.iter().find(|(what, _)| *what == "cofactor") else {
            continue;
        };
        let (Ok(formula), Ok(cofactor)) =
            (setting.case.formula(&found.formula), setting.case.formula(&cofactor.1))
        else {
            continue;
        };
        if extension.exponent(&formula).is_none() {
            let rate = (cofactor.bracketed() * &formula.bracketed())?;
            let statement = OrbitStatement::Rate { function: formula.clone(), rate };
            let with = vec![("cofactor", &cofactor)];
            let kind = "darboux-polynomial";
            if !claims::other(setting, kind, &formula, &statement, with, report)? {
                continue;
            }
        }
        let degree = all.iter().find(|own| own.formula.text() == found.formula);
        let degree = degree.map_or(1, |own| own.degree);
        let is_known = factors.iter().any(|own| own.formula.text() == formula.text());
        if !is_known {
            factors.extend(RatedPolynomial::of(setting, &formula, degree)?);
        }
    }
    Ok(())
}
