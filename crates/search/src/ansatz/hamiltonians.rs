//! Functions that claims about brackets read: energies written out, and the functions of a level.

use super::super::ask::{judged_alone, proved_energy};
use super::super::{Effort, SearchError};
use liouville::case::Case;
use liouville::claim::Claim;
use liouville::formula::{Formula, FormulaError};
use liouville::mechanics::{LevelFunction, System};
use liouville::verdict::Verdict;

/// Writes the energy of a Lagrangian system as T + U, where it is this and is conserved: claims about
/// brackets cannot read it by its name.
pub(super) fn written_energy(case: &Case, effort: &Effort) -> Result<Option<Formula>, SearchError> {
    let System::Lagrangian(own) = &case.model.system else { return Ok(None) };
    let Some(energy) = proved_energy(case, effort)? else { return Ok(None) };
    let sum = match &own.potential {
        None => own.kinetic.clone(),
        Some(potential) => match potential.text().trim().strip_prefix(['-', '−']) {
            Some(rest) => case.formula(&format!("{} − {}", own.kinetic.text(), rest.trim()))?,
            None => (&own.kinetic + potential)?,
        },
    };
    let judged = judged_alone(case, Claim::identity(&energy, &sum), effort)?;
    Ok(judged.filter(|own| own.verdict == Verdict::Proved).map(|_| sum))
}

/// Writes functions that are constant on the level: the left sides of its equations where the right
/// ones are numbers.
pub(super) fn level_functions(case: &Case) -> Result<Vec<Formula>, FormulaError> {
    let mut functions = Vec::new();
    for equation in &case.model.level {
        let sides = equation.text.split_once('=');
        let sides = sides.map(|(left, right)| (case.formula(left.trim()), right.trim()));
        functions.push(match (&equation.function, sides) {
            (LevelFunction::UnitNormal, _) => case.formula("(γ,γ)")?,
            (LevelFunction::NoSpin, _) => case.formula("(ω,γ)")?,
            (LevelFunction::Formula(_), Some((Ok(left), right)))
                if case.formula(right).is_ok_and(|right| right.constant().is_some()) =>
            {
                left
            }
            (LevelFunction::Formula(formula), _) => formula.clone(),
        });
    }
    Ok(functions)
}
