//! Densities that need no search, those that the file claims, 1, and the determinant of the masses: one of
//! the class that is excluded refutes a claim of absence.

use super::super::SearchError;
use super::super::ansatz::monomials::AnsatzVariables;
use super::super::ask::judged_alone;
use super::super::multipliers::WEIGHTS;
use super::super::products::{degree_in, degree_in_state, exponent_degree_in_state};
use super::super::terms::{numeric_exponent, one};
use super::AbsenceCase;
use liouville::case::Case;
use liouville::claim::{Claim, ClaimKind, Density};
use liouville::formula::Formula;
use liouville::mechanics::{System, VariableRole};
use liouville::number::rational::Rational;
use liouville::verdict::Verdict;

/// Largest number of velocities for which the determinant of the masses is written.
const MOST_VELOCITIES: usize = 6;

/// Returns a density of the file, or a known one, that is proved and belongs to the class with polynomials
/// up to a degree.
pub fn witness(asked: &AbsenceCase<'_>, most: u32) -> Result<Option<String>, SearchError> {
    let case = asked.case;
    let known = [Some(one()), mass_determinant(case)];
    let claimed = case.claims.iter().filter_map(|claim| match &claim.kind {
        ClaimKind::Density(Density(formula)) => Some(formula),
        _ => None,
    });
    for formula in claimed.chain(known.iter().flatten()) {
        // The claim itself may concern another domain, and thus another volume.
        if is_of_class(asked, formula, most)?
            && let Some(exhibit) = exhibit(asked, formula)?
        {
            return Ok(Some(exhibit));
        }
    }
    Ok(None)
}

/// Writes a density that is proved, with what is remarked on it.
pub fn exhibit(asked: &AbsenceCase<'_>, formula: &Formula) -> Result<Option<String>, SearchError> {
    let report = judged_alone(asked.case, Claim::density(formula), &asked.effort)?;
    let proved = report.filter(|report| report.verdict == Verdict::Proved);
    Ok(proved.map(|report| match &report.evidence.remark {
        Some(remark) => format!("density, proved: {formula}; {remark}"),
        None => format!("density, proved: {formula}"),
    }))
}

/// The determinant of the second derivatives of the kinetic energy by the velocities, by which dq dp is
/// dq dq'; `None` if there is no kinetic energy, or if there are many velocities.
fn mass_determinant(case: &Case) -> Option<Formula> {
    let model = &case.model;
    let System::Lagrangian(lagrangian) = &model.system else { return None };
    let mut velocities = Vec::new();
    let mut start = 0;
    for (role, variable) in lagrangian.roles.iter().zip(&model.state) {
        if matches!(role, VariableRole::Velocity) {
            velocities.extend((start..start + variable.len()).map(|k| model.component_name(k)));
        }
        start += variable.len();
    }
    if velocities.is_empty() || velocities.len() > MOST_VELOCITIES {
        return None;
    }
    let kinetic = lagrangian.kinetic.text();
    let row = |a: &String| {
        let entry = |b: &String| format!("partial(partial({kinetic}, {a}), {b})");
        format!("[{}]", velocities.iter().map(entry).collect::<Vec<_>>().join(", "))
    };
    let text = match &velocities[..] {
        [only] => format!("partial(partial({kinetic}, {only}), {only})"),
        all => format!("det([{}])", all.iter().map(row).collect::<Vec<_>>().join(", ")),
    };
    case.formula(&text).ok()
}

/// Whether a density belongs to the class with polynomials up to this degree.
pub fn is_of_class(
    asked: &AbsenceCase<'_>,
    formula: &Formula,
    most: u32,
) -> Result<bool, SearchError> {
    match asked.coordinates.is_ok() {
        true => is_in_velocities(asked, formula, most),
        false => Ok(has_class(asked) && is_in_state(asked, formula, most)?),
    }
}

/// Whether a claim on a case speaks of a class of densities.
pub fn has_class(asked: &AbsenceCase<'_>) -> bool {
    let all = || AnsatzVariables::of(asked.case).is_some_and(|own| !own.have_velocities());
    asked.coordinates.is_ok() || all()
}

/// Whether a density is P^(1/α), with P a polynomial up to this degree in the velocities, or a function
/// of the positions alone.
fn is_in_velocities(
    asked: &AbsenceCase<'_>,
    formula: &Formula,
    most: u32,
) -> Result<bool, SearchError> {
    let seed = asked.effort.options.seed;
    let Ok(coordinates) = asked.coordinates else { return Ok(false) };
    has_power(formula, &|power| {
        Ok(degree_in(asked.case, power, coordinates, seed)?.is_some_and(|n| n <= most))
    })
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
