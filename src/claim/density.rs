//! Invariant densities: Liouville's equation v(ln ρ) + div v = 0.
//!
//! On a level set {F_i = c_i} the density refers to the volume σ with dx = dF_1∧…∧dF_k∧σ, and the
//! equation is v(ln ρ) + div v - Σ d(L_vF_i)(n_i) = 0 with dF_i(n_j) = δ_ij. The logarithm is
//! differentiated through products and powers, so that roots and exponentials of ρ drop out.

use num_dual::DualNum;

use super::{Context, Reader, Statement};
use crate::formula::{Formula, Type};
use crate::graph::Expr;
use crate::mechanics::calculus::{Jet, dot};
use crate::scalar::Scalar;

/// The claim that ρ is an invariant density: v(ln ρ) + div v = 0 on the level.
#[derive(Clone, Debug)]
pub struct Density(pub Formula);

impl Statement for Density {
    const NAME: &'static str = "density";

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        from.required(Self::NAME, Some(Type::Scalar)).map(Self)
    }

    fn formulas(&self) -> Vec<&Formula> {
        vec![&self.0]
    }

    fn about(&self, formula: Formula) -> Option<Self> {
        Some(Self(formula))
    }

    /// Computes v(ln ρ) + div v minus the cofactors of the level functions.
    fn residual<T: Scalar>(&self, jet: &Jet<'_, T>, kept: &[bool]) -> Vec<T> {
        let moved = jet.along_field();
        let along = self.0.logarithmic_derivative(&mut |symbol| moved.value(symbol));
        vec![along + jet.divergence() - jet.level_cofactor(kept)]
    }

    /// Returns the square of the scale |v|(|∇ln ρ| + 1/|x|), and ρ itself for its sign.
    fn context(&self, jet: &Jet<'_, Expr>, _: &[bool]) -> Context {
        let slope = self.slope(jet);
        let (field, state) = (jet.phase.field(), jet.phase.state());
        let rate = dot(&slope, &slope) + dot(&state, &state).recip();
        Context {
            scale: Some(dot(field, field) * rate),
            value: vec![jet.phase.scalar(&self.0)],
            ..Context::default()
        }
    }

    fn slopes(&self, jet: &Jet<'_, Expr>) -> Vec<Vec<Expr>> {
        vec![self.slope(jet)]
    }
}

impl Density {
    /// Computes ∇ln ρ.
    fn slope(&self, jet: &Jet<'_, Expr>) -> Vec<Expr> {
        jet.along_axes()
            .iter()
            .map(|moved| self.0.logarithmic_derivative(&mut |symbol| moved.value(symbol)))
            .collect()
    }
}
