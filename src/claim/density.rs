//! Invariant densities: Liouville's equation v(ln ρ) + div v = 0.
//!
//! On a level set {F_i = c_i} the density refers to the volume σ with dx = dF_1∧…∧dF_k∧σ, and the
//! equation is v(ln ρ) + div v - Σ d(L_vF_i)(n_i) = 0 with dF_i(n_j) = δ_ij. The logarithm is
//! differentiated through products and powers, so that roots and exponentials of ρ drop out.

use num_dual::DualNum;

use super::Context;
use crate::formula::Formula;
use crate::graph::Expr;
use crate::mechanics::calculus::{Jet, dot};
use crate::scalar::Scalar;

/// v(ln ρ) + div v less the cofactors of the level functions.
pub(super) fn residual<T: Scalar>(jet: &Jet<'_, T>, formula: &Formula, kept: &[bool]) -> Vec<T> {
    let moved = jet.along_field();
    let along = formula.logarithmic_derivative(&mut |symbol| moved.value(symbol));
    vec![along + jet.divergence() - jet.level_cofactor(kept)]
}

/// The scale |v|(|∇ln ρ| + 1/|x|), in squares, and ρ itself for its sign.
pub(super) fn context(jet: &Jet<'_, Expr>, formula: &Formula) -> Context {
    let slope = slope(jet, formula);
    let (field, state) = (jet.phase.field(), jet.phase.state());
    let rate = dot(&slope, &slope) + dot(&state, &state).recip();
    Context {
        scale: Some(dot(field, field) * rate),
        value: Some(jet.phase.scalar(formula)),
        ..Context::default()
    }
}

/// ∇ln ρ
pub(super) fn slope(jet: &Jet<'_, Expr>, formula: &Formula) -> Vec<Expr> {
    jet.along_axes()
        .iter()
        .map(|moved| formula.logarithmic_derivative(&mut |symbol| moved.value(symbol)))
        .collect()
}
