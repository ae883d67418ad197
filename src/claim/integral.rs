//! First integrals: L_vF = 0.

use num_traits::Zero;

use super::Context;
use crate::formula::Formula;
use crate::graph::Expr;
use crate::mechanics::calculus::{Jet, distance_from_span, dot};

/// L_vF
pub(super) fn residual(jet: &Jet<'_, Expr>, formula: &Formula) -> Vec<Expr> {
    vec![jet.lie_derivative(|at| at.scalar(formula))]
}

/// The scale |∇F||v|, and whether F is more than a function of what every case conserves.
pub(super) fn context(jet: &Jet<'_, Expr>, formula: &Formula, kept: &[bool]) -> Context {
    let slope = jet.gradient(|at| at.scalar(formula));
    let field = jet.phase.field();
    let mut known = jet.level_gradients(kept);
    let off_level = distance_from_span(&slope, &known);
    let system = &jet.phase.model().system;
    let off_general = system.energy(&jet.phase).map(|_| {
        known.push(jet.gradient(|at| system.energy(at).unwrap_or_else(Zero::zero)));
        distance_from_span(&slope, &known)
    });
    Context {
        scale: Some(dot(&slope, &slope) * dot(field, field)),
        off_level: Some(off_level),
        off_general,
        ..Context::default()
    }
}
