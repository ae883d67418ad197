//! First integrals: L_vF = 0.

use num_traits::Zero;

use super::{Context, level_gradients};
use crate::formula::Formula;
use crate::graph::Expr;
use crate::mechanics::Phase;
use crate::mechanics::calculus::{distance_from_span, dot, gradient, lie_derivative};

/// L_vF
pub(super) fn residual(phase: &Phase<'_, Expr>, formula: &Formula) -> Vec<Expr> {
    vec![lie_derivative(phase, |at| at.scalar(formula))]
}

/// The scale |∇F||v|, and whether F is more than a function of what every case conserves.
pub(super) fn context(phase: &Phase<'_, Expr>, formula: &Formula, kept: &[bool]) -> Context {
    let slope = gradient(phase, |at| at.scalar(formula));
    let field = phase.field();
    let mut known = level_gradients(phase, kept);
    let off_level = distance_from_span(&slope, &known);
    let system = &phase.model().system;
    let off_general = system.energy(phase).map(|_| {
        known.push(gradient(phase, |at| system.energy(at).unwrap_or_else(Zero::zero)));
        distance_from_span(&slope, &known)
    });
    Context {
        scale: Some(dot(&slope, &slope) * dot(field, field)),
        off_level: Some(off_level),
        off_general,
        ..Context::default()
    }
}
