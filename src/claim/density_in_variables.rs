//! Invariant measures in the variables of `[variables]`.

use num_dual::DualNum;

use super::of_bracket::{defects, images_as_written, of, scalar_in, variables};
use super::{Condition, Jets, Reader, Statement};
use crate::formula::Formula;
use crate::graph::{Expr, literally};
use crate::mechanics::calculus::DualPoint;
use crate::mechanics::elimination::determinant;
use crate::number::UnaryFunction;
use crate::scalar::Scalar;

/// The claim that the measure ρ dy is invariant: v(ln ρ) + Σ ∂y'_i/∂y_i = 0.
#[derive(Clone, Debug)]
pub struct DensityInVariables(Formula);

impl Statement for DensityInVariables {
    const NAME: &'static str = "density-in-variables";
    const JETS: Jets = Jets::Twice;
    const IS_OF_MEASURE: bool = true;
    const UNDEFINED: &'static str = ": the new variables may be dependent there, as N*(Ĩ*ω − (Ĩ*ω,γ)*γ) \
                                     is, to which + (ω,γ)*γ may be added";

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        let variables = variables(from, Self::NAME)?;
        let (old, new) = (from.model().dimension(), variables.model.dimension());
        if old != new {
            let message = format!("{new} new variables take the place of {old}");
            let remedy = "a density needs equal numbers of new and old variables";
            return Err(from.complaint(Self::NAME, message, remedy));
        }
        scalar_in(from, Self::NAME).map(Self)
    }

    /// Computes v(ln ρ∘φ) + tr(dφ⁻¹ d(L_vφ)): the divergence of the motion in the new variables.
    fn residual<T: Scalar>(&self, jet: &DualPoint<'_, T>, kept: &[bool]) -> Vec<T> {
        let variables = of(jet.phase.model());
        let along = jet.in_variables_along_field(variables);
        let growth = self.0.logarithmic_derivative(&mut |symbol| along.value(symbol));
        vec![growth + jet.divergence_in_variables(variables) - jet.level_cofactor(kept)]
    }

    fn conditions(&self, jet: &DualPoint<'_, Expr>, _: &[bool]) -> Vec<Condition> {
        let variables = of(jet.phase.model());
        let density = jet.in_variables(variables).phase.scalar(&self.0);
        // A fold of the new variables changes the sign of the determinant, and not the measure.
        let measure = density * determinant(&jet.slopes_of_variables(variables));
        vec![Condition::continuous(vec![measure.apply(UnaryFunction::Abs)], "the measure")]
    }

    /// 1/ρ, and 1/det dφ: dependent variables have no volume.
    fn written_elsewhere(&self, jet: &DualPoint<'_, Expr>) -> Vec<Expr> {
        let variables = of(jet.phase.model());
        let there = &jet.in_variables(variables).phase;
        let mut divisors = there.evaluate_literally(&self.0).components();
        divisors.push(literally(|| determinant(&jet.slopes_of_variables(variables))));
        let inverse = |value: Expr| literally(|| value.recip());
        let mut values: Vec<Expr> = divisors.into_iter().map(inverse).collect();
        values.extend(images_as_written(variables, &jet.phase));
        values
    }

    fn quadrature_defects_elsewhere(&self, jet: &DualPoint<'_, Expr>) -> Vec<Expr> {
        defects(jet, &[], [&self.0].into_iter())
    }
}
