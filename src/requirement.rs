//! Operations of formulas as written, where recording leaves them out: 0·ln x is recorded as 0, and
//! has a value for x > 0 alone.

use crate::claim::ClaimKind;
use crate::formula::Formula;
use crate::graph::Expr;
use crate::mechanics::Phase;
use crate::mechanics::calculus::DualPoint;

/// Records some formulas of a case as written, with the parameters in them. Formulas with an
/// ∫ are left out: as written they could have an antiderivative of their own.
pub fn of_formulas<'f>(
    phase: &'f Phase<'f, Expr>,
    formulas: impl IntoIterator<Item = &'f Formula>,
) -> Vec<Expr> {
    let model = phase.model();
    phase.literal_values(formulas.into_iter().filter(|formula| !model.has_antiderivative(formula)))
}

/// Records the equations of motion as written.
pub fn of_system(phase: &Phase<'_, Expr>) -> Vec<Expr> {
    let model = phase.model();
    let mut values = of_formulas(phase, model.equations_of_motion());
    values.extend(phase.existence_of_motion());
    values
}

/// Records the level equations as written.
pub fn of_level(phase: &Phase<'_, Expr>) -> Vec<Expr> {
    of_formulas(phase, phase.model().level_formulas())
}

/// Records what the residual of a claim requires, in a system with this requirement.
pub fn of_claim(jet: &DualPoint<'_, Expr>, claim: &ClaimKind, system: &[Expr]) -> Vec<Expr> {
    let mut values = of_formulas(&jet.phase, claim.formulas());
    values.extend(claim.further_requirement(jet));
    values.extend(system);
    values
}
