//! Invariant measures in the variables of `[variables]`.

use super::of_bracket::{defects, of, scalar_in, variables};
use super::{Jets, Reader, Statement};
use crate::formula::Formula;
use crate::graph::Expr;
use crate::mechanics::calculus::{DualPoint, trace_of_quotient};
use crate::scalar::Scalar;

/// The claim that the measure ρ dy is invariant: v(ln ρ) + Σ ∂y'_i/∂y_i = 0.
#[derive(Clone, Debug)]
pub struct DensityInVariables(Formula);

impl Statement for DensityInVariables {
    const NAME: &'static str = "density-in-variables";
    const JETS: Jets = Jets::Twice;
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
        let moved = jet.phase.lift(jet.phase.field());
        let along = variables.point(&moved);
        let growth = self.0.logarithmic_derivative(&mut |symbol| along.value(symbol));
        let mut columns = Vec::new();
        let mut rates = Vec::new();
        for beside in jet.along_axes() {
            columns.push(variables.image(beside).iter().map(|y| y.eps).collect::<Vec<T>>());
            let further = variables.image(&beside.lift(beside.field()));
            rates.push(further.iter().map(|y| y.eps.eps).collect::<Vec<T>>());
        }
        vec![growth + trace_of_quotient(&columns, &rates) - jet.level_cofactor(kept)]
    }

    fn quadrature_defects_elsewhere(&self, jet: &DualPoint<'_, Expr>) -> Vec<Expr> {
        defects(jet, &[], [&self.0].into_iter())
    }
}
