//! First integrals: L_vF = 0.

use num_traits::Zero;

use super::Context;
use crate::formula::Formula;
use crate::graph::Expr;
use crate::mechanics::calculus::{Jet, dot, rejection};
use crate::scalar::Scalar;

/// L_vF
pub(super) fn residual<T: Scalar>(jet: &Jet<'_, T>, formula: &Formula) -> Vec<T> {
    vec![jet.lie_derivative(|at| at.scalar(formula))]
}

/// The scale |∇F||v|, and whether F is more than a function of what every case conserves.
pub(super) fn context(jet: &Jet<'_, Expr>, formula: &Formula, kept: &[bool]) -> Context {
    let slope = jet.gradient(|at| at.scalar(formula));
    let field = jet.phase.field();
    let mut known = jet.level_gradients(kept);
    let off_level = rejection(&slope, &known);
    let system = &jet.phase.model().system;
    let off_general = system.energy(&jet.phase).map(|_| {
        known.push(jet.gradient(|at| system.energy(at).unwrap_or_else(Zero::zero)));
        rejection(&slope, &known)
    });
    let steepness = dot(&slope, &slope);
    Context {
        scale: Some(steepness * dot(field, field)),
        value: Some(jet.phase.scalar(formula)),
        slope: Some(steepness),
        off_level,
        off_general: off_general.unwrap_or_default(),
        ..Context::default()
    }
}
