//! Densities that need no search, those that the file claims and 1: one of the class that is excluded
//! refutes a claim of absence.

use super::super::SearchError;
use super::super::ansatz::monomials::AnsatzVariables;
use super::super::ask::judged_alone;
use super::super::local::Coordinates;
use super::super::multipliers::WEIGHTS;
use super::super::products::{degree, degree_in_state, exponent_degree_in_state};
use super::super::terms::{numeric_exponent, one};
use super::AbsenceCase;
use liouville::claim::{Claim, ClaimKind, Density};
use liouville::formula::Formula;
use liouville::number::rational::Rational;
use liouville::verdict::Verdict;

/// Returns a density of the file, or 1, that is proved and belongs to the class with polynomials up to
/// a degree.
pub fn witness(asked: &AbsenceCase<'_>, most: u32) -> Result<Option<Formula>, SearchError> {
    let case = asked.case;
    let in_velocities = Coordinates::of(case).is_ok();
    let in_state = AnsatzVariables::of(case).is_some_and(|own| !own.have_velocities());
    let one = one();
    let claimed = case.claims.iter().filter_map(|claim| match &claim.kind {
        ClaimKind::Density(Density(formula)) => Some(formula),
        _ => None,
    });
    for formula in claimed.chain([&one]) {
        let is_of_class = match (in_velocities, in_state) {
            (true, _) => is_in_velocities(asked, formula, most)?,
            (false, true) => is_in_state(asked, formula, most)?,
            (false, false) => false,
        };
        // The claim itself may concern another domain, and thus another volume.
        if is_of_class
            && judged_alone(case, Claim::density(formula), &asked.effort)?
                .is_some_and(|report| report.verdict == Verdict::Proved)
        {
            return Ok(Some(formula.clone()));
        }
    }
    Ok(None)
}

/// Whether a density is P^(1/α), with P a polynomial up to this degree in the velocities, or a function
/// of the positions alone.
pub fn is_in_velocities(
    asked: &AbsenceCase<'_>,
    formula: &Formula,
    most: u32,
) -> Result<bool, SearchError> {
    let seed = asked.effort.options.seed;
    has_power(formula, &|power| Ok(degree(asked.case, power, seed)?.is_some_and(|n| n <= most)))
}

/// Whether a density is P^(1/α) or exp P, with P a polynomial up to this degree in all variables.
fn is_in_state(asked: &AbsenceCase<'_>, formula: &Formula, most: u32) -> Result<bool, SearchError> {
    let (case, seed) = (asked.case, asked.effort.options.seed);
    let is_low = |degree: Option<u32>| degree.is_some_and(|n| n <= most);
    Ok(is_low(exponent_degree_in_state(case, formula, seed)?)
        || has_power(formula, &|power| Ok(is_low(degree_in_state(case, power, seed)?)))?)
}

/// Whether ρ^α has a property for some α.
fn has_power(
    formula: &Formula,
    has: &dyn Fn(&Formula) -> Result<bool, SearchError>,
) -> Result<bool, SearchError> {
    for alpha in WEIGHTS {
        if has(&formula.bracketed().power(&numeric_exponent(Rational::from(alpha))?)?)? {
            return Ok(true);
        }
    }
    Ok(false)
}
