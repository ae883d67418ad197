//! Darboux polynomials with functions that satisfy relations, as sin² + cos² = 1.
//!
//! The extended field is a polynomial field on the space of all its variables, whether or not they
//! satisfy these relations. A Darboux polynomial there is one on the level as well. Those of which
//! this holds only where the relations hold are not found. Where the relations are sin² + cos² = 1 and
//! e^u e^(−u) = 1 alone, conics on the level take the place of lines, and these are found too.

use super::super::{FoundKind, Given, SearchError, SearchReport};
use super::claims::{self, OrbitStatement};
use super::darboux::DarbouxSearch;
use super::factor::RatedPolynomial;
use super::part::MOST_DARBOUX_DEGREE;
use super::setting::{ExtendedCase, OrbitSetting};
use super::{RoundLimits, blocks, degree_of_field, monomials};

/// Number of points at which a polynomial must not vanish, and must change.
const POINTS: u64 = 2;
/// Largest number of coefficients of a cofactor.
const MOST_COFACTOR: usize = 60;
/// Share of the steps of other searches on a line.
const SHARE: f64 = 0.25;

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
    let Some(case) = extension.unbound()? else { return Ok(()) };
    let Ok(unbound) = OrbitSetting::of(&case, setting.effort)? else { return Ok(()) };
    let Some(degree) = degree_of_field(&unbound)? else { return Ok(()) };
    if setting.conic.is_some() {
        return on_conics(setting, degree, limits, factors, report, progress);
    }
    let (mut all, mut pairs) = (found_before(setting, &unbound)?, Vec::new());
    let mut own = SearchReport::default();
    for variables in blocks::closed(&case)? {
        if monomials::count(variables.len(), degree.saturating_sub(1) as u32) > MOST_COFACTOR {
            continue;
        }
        let search = DarbouxSearch { setting: &unbound, variables: &variables, degree };
        let fits =
            |next: &u32| monomials::steps(variables.len(), *next, degree) <= SHARE * limits.steps;
        for next in (1..=MOST_DARBOUX_DEGREE).take_while(fits) {
            progress(&format!("Darboux polynomials of degree {next}, with functions as variables"));
            search.of_degree(next, &mut all, &mut pairs, &mut own)?;
        }
    }
    for found in &own.found {
        let (Some(own), Some(cofactor)) = (found.function(), found.cofactor()) else { continue };
        let [formula, cofactor] = [own, cofactor].map(|own| setting.case.formula(own.text()));
        let (Ok(formula), Ok(cofactor)) = (formula, cofactor) else { continue };
        let degree = all.iter().find(|own| own.formula.text() == found.text());
        let degree = degree.map_or(1, |own| own.degree);
        let Some(rated) = RatedPolynomial::of(setting, &formula, degree)? else { continue };
        if extension.has_inverse(&formula) || !changes(setting, &rated) {
            continue;
        }
        if extension.exponent(&formula).is_none() {
            let rate = (cofactor.bracketed() * &formula.bracketed())?;
            let statement = OrbitStatement::Rate { function: formula.clone(), rate };
            let with = Some(Given::Cofactor(cofactor.clone()));
            let kind = FoundKind::DarbouxPolynomial;
            if !claims::other(setting, kind, &formula, &statement, with, report)? {
                continue;
            }
        }
        if factors.iter().all(|own| own.formula.text() != formula.text()) {
            factors.push(rated);
        }
    }
    Ok(())
}

/// Searches the extended field, of this degree, on its level.
fn on_conics(
    setting: &OrbitSetting<'_>,
    degree: usize,
    limits: RoundLimits,
    factors: &mut Vec<RatedPolynomial>,
    report: &mut SearchReport,
    progress: &mut dyn FnMut(&str),
) -> Result<(), SearchError> {
    let (mut all, mut pairs) = (found_before(setting, setting)?, Vec::new());
    for variables in blocks::closed(setting.case)? {
        let count = |degree: u32| {
            let all = monomials::up_to(&variables, setting.dimension(), degree);
            setting.standard(all).len()
        };
        if count(degree.saturating_sub(1) as u32) > MOST_COFACTOR {
            continue;
        }
        let search = DarbouxSearch { setting, variables: &variables, degree };
        // A polynomial has twice as many zeros on a conic.
        let fits =
            |next: &u32| monomials::steps_of(count(*next), *next, degree) <= SHARE * limits.steps;
        for next in (1..=MOST_DARBOUX_DEGREE).take_while(fits) {
            progress(&format!("Darboux polynomials of degree {next}, with functions as variables"));
            search.of_degree(next, &mut all, &mut pairs, report)?;
        }
    }
    // They have no zeros.
    for name in setting.origin.iter().flat_map(|origin| origin.extension.exponentials()) {
        if let Ok(formula) = setting.case.formula(name) {
            all.extend(RatedPolynomial::of(setting, &formula, 1)?);
        }
    }
    for own in all {
        let is_new = factors.iter().all(|other| other.formula.text() != own.formula.text());
        if is_new && changes(setting, &own) {
            factors.push(own);
        }
    }
    Ok(())
}

/// Darboux polynomials of the case that were found with other functions.
fn found_before(
    setting: &OrbitSetting<'_>,
    along: &OrbitSetting<'_>,
) -> Result<Vec<RatedPolynomial>, SearchError> {
    let mut all = Vec::new();
    for (formula, degree) in setting.origin.iter().flat_map(|own| &own.extension.curves) {
        if let Ok(formula) = along.case.formula(formula.text()) {
            all.extend(RatedPolynomial::of(along, &formula, *degree)?);
        }
    }
    Ok(all)
}

/// Whether a polynomial is not 0 on the level, and no integral there.
pub fn changes(setting: &OrbitSetting<'_>, rated: &RatedPolynomial) -> bool {
    let Some(at) = setting.at(0, 0) else { return false };
    let values = (0..POINTS).filter_map(|number| rated.at(&at, &setting.point(&at, number)?));
    values.into_iter().any(|(value, rate)| value != 0 && rate != 0)
}
