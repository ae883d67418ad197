//! Operations of formulas as written, where recording leaves them out: 0·ln x is recorded as 0, and
//! has a value for x > 0 alone.

use num_dual::DualNum;

use crate::claim::ClaimKind;
use crate::formula::Formula;
use crate::graph::{Expr, literally};
use crate::mechanics::{LevelFunction, ParameterOrigin, Phase};

/// Records the components of formulas so that they are defined exactly where everything written is;
/// components that are defined everywhere are omitted.
pub fn literal_values<'f>(
    phase: &Phase<'_, Expr>,
    formulas: impl IntoIterator<Item = &'f Formula>,
) -> Vec<Expr> {
    let values = formulas.into_iter().flat_map(|f| phase.evaluate_literally(f).components());
    values.filter(|value| !value.is_always_defined()).collect()
}

/// The same for some formulas of a case, and for the parameters that are formulas. Formulas with an
/// ∫ are left out: as written they could have an antiderivative of their own.
pub fn of_formulas<'f>(
    phase: &'f Phase<'f, Expr>,
    formulas: impl IntoIterator<Item = &'f Formula>,
) -> Vec<Expr> {
    let model = phase.model();
    let parameters = model.parameters.iter().filter_map(|parameter| match &parameter.origin {
        ParameterOrigin::Formula(formula) => Some(formula),
        _ => None,
    });
    let all = parameters.chain(formulas);
    literal_values(phase, all.filter(|formula| !model.has_antiderivative(formula)))
}

/// The same for the equations of motion.
pub fn of_system(phase: &Phase<'_, Expr>) -> Vec<Expr> {
    let model = phase.model();
    of_formulas(phase, model.system.functions().into_iter().chain(&model.extension))
}

/// The same for the level equations.
pub fn of_level(phase: &Phase<'_, Expr>) -> Vec<Expr> {
    let formulas = phase.model().level.iter().filter_map(|own| match &own.function {
        LevelFunction::Formula(formula) => Some(formula),
        _ => None,
    });
    of_formulas(phase, formulas)
}

/// The same for the residual of a claim, in a system with this requirement.
pub fn of_claim(phase: &Phase<'_, Expr>, claim: &ClaimKind, system: &[Expr]) -> Vec<Expr> {
    let mut values = of_formulas(phase, claim.formulas());
    // Where ρ is 0, v(ln ρ) has no value.
    for divisor in claim.divisors() {
        let divisor = phase.evaluate_literally(divisor).components();
        values.extend(divisor.iter().map(|value| literally(|| value.recip())));
    }
    values.extend(system);
    values
}
