//! Existence of a density by the criterion (γ, rot χ) = 0 and its forms on the sphere and for a
//! flat base.
//!
//! Zero on the whole level: a density of the configuration exists, by quadrature, for every
//! potential and gyrostat. Not zero: no density of the configuration exists; and, when the motion
//! is free (ω' quadratic in ω), none that is positive and C¹ near ω = 0, since dividing Liouville's
//! equation by |ω| at ω → 0 leaves the same condition on ρ(γ,0).

use super::Context;
use crate::graph::Expr;
use crate::mechanics::Phase;
use crate::scalar::Scalar;

/// The criterion; systems without one were refused before.
pub(super) fn residual<T: Scalar>(phase: &Phase<'_, T>) -> Vec<T> {
    phase.model().system.criterion(phase).into_iter().collect()
}

pub(super) fn context(phase: &Phase<'_, Expr>) -> Context {
    Context { scale: Some(phase.model().system.criterion_scale(phase)), ..Context::default() }
}
