//! What is recorded about a case before any state is drawn.

use std::ops::Range;

use super::physics;
use crate::case::{Claim, Expect};
use crate::claim::{Context, Kind, Place};
use crate::graph::Expr;
use crate::mechanics::calculus::Jet;

/// A claim with everything recorded about it.
pub struct Recorded<'c> {
    pub claim: &'c Claim,
    pub residual: Vec<Expr>,
    pub context: Context,
    /// Wider places with the residual there.
    pub wider: Vec<(Place, Vec<Expr>)>,
}

impl<'c> Recorded<'c> {
    /// Records the residual of a claim, there and in wider places, and its context.
    pub fn new(claim: &'c Claim, jet: &Jet<'_, Expr>) -> Self {
        let residual = |place: &Place| claim.kind.residual(jet, &place.kept);
        let wider = match claim.kind {
            Kind::Integral(_) | Kind::Density(_) if claim.expect != Expect::Fails => {
                claim.place.wider(jet.phase.model())
            }
            _ => Vec::new(),
        };
        Self {
            claim,
            residual: residual(&claim.place),
            context: claim.kind.context(jet, &claim.place.kept),
            wider: wider.into_iter().map(|place| (place.clone(), residual(&place))).collect(),
        }
    }
}

/// What is asked of every case, whatever it claims.
pub struct Common {
    pub field: Vec<Expr>,
    pub level_rates: Vec<Expr>,
    pub physics: Vec<Expr>,
}

impl Common {
    /// Records it.
    pub fn of(jet: &Jet<'_, Expr>) -> Self {
        let rate = |function| jet.lie_derivative(|at| at.level_function(function));
        let phase = &jet.phase;
        Self {
            field: phase.field().to_vec(),
            level_rates: phase.model().level.iter().map(|e| rate(&e.function)).collect(),
            physics: physics::outputs(phase),
        }
    }
}

/// Where a claim's outputs stand in a tape.
pub struct Span {
    pub residual: Range<usize>,
    pub scale: Option<usize>,
    pub off_level: Option<usize>,
    pub off_general: Option<usize>,
    pub defects: Range<usize>,
}

impl Span {
    /// Appends a claim's outputs, with its context where that is asked for.
    pub fn lay_out(item: &Recorded<'_>, with_context: bool, outputs: &mut Vec<Expr>) -> Self {
        let mut extend = |some: &[Expr]| {
            let start = outputs.len();
            outputs.extend_from_slice(some);
            start..outputs.len()
        };
        let residual = extend(&item.residual);
        let mut one = |some: Option<Expr>| {
            let some = some.filter(|_| with_context)?;
            Some(extend(&[some]).start)
        };
        let context = &item.context;
        let (scale, off_level, off_general) =
            (one(context.scale), one(context.off_level), one(context.off_general));
        let defects = if with_context { &context.quadrature_defects[..] } else { &[] };
        Self { residual, scale, off_level, off_general, defects: extend(defects) }
    }
}
