//! Existence of a density by the criterion (γ, rot χ) = 0 and its forms on the sphere and for a
//! flat base.
//!
//! Zero on the whole level: a density of the configuration exists, by quadrature, for every
//! potential and gyrostat. Not zero: no density of the configuration exists; and, when the motion
//! is free (ω' quadratic in ω), none that is positive and C¹ near ω = 0, since dividing Liouville's
//! equation by |ω| at ω → 0 leaves the same condition on ρ(γ,0).

use super::{Context, Reader, Statement};
use crate::graph::Expr;
use crate::mechanics::calculus::Jet;
use crate::mechanics::{Model, Phase};
use crate::scalar::Scalar;

/// A density that is positive and analytic near ω = 0 exists.
#[derive(Clone, Debug)]
pub struct AnalyticDensity;

/// A density of the configuration alone, ρ(γ) or ρ(r₁,r₂), exists.
#[derive(Clone, Debug)]
pub struct PositionDensity;

impl Statement for AnalyticDensity {
    const NAME: &'static str = "analytic-density";
    const WIDENS: bool = false;

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        from.word(Self::NAME, "exists").map(|()| Self)
    }

    fn residual<T: Scalar>(&self, jet: &Jet<'_, T>, _: &[bool]) -> Vec<T> {
        residual(&jet.phase)
    }

    fn context(&self, jet: &Jet<'_, Expr>, _: &[bool]) -> Context {
        context(&jet.phase)
    }

    fn objection(&self, model: &Model) -> Option<String> {
        objection(model, Self::NAME)
    }

    fn limit_of_refutation(&self, model: &Model) -> Option<&'static str> {
        (!model.system.is_free()).then_some(
            "the criterion is not zero, which excludes every density of the configuration alone; with \
             a potential or a gyrostat one that depends on ω as well stays open",
        )
    }
}

impl Statement for PositionDensity {
    const NAME: &'static str = "position-density";
    const WIDENS: bool = false;

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        from.word(Self::NAME, "exists").map(|()| Self)
    }

    fn residual<T: Scalar>(&self, jet: &Jet<'_, T>, _: &[bool]) -> Vec<T> {
        residual(&jet.phase)
    }

    fn context(&self, jet: &Jet<'_, Expr>, _: &[bool]) -> Context {
        context(&jet.phase)
    }

    fn objection(&self, model: &Model) -> Option<String> {
        objection(model, Self::NAME)
    }
}

fn residual<T: Scalar>(phase: &Phase<'_, T>) -> Vec<T> {
    phase.model().system.criterion(phase).into_iter().collect()
}

fn context(phase: &Phase<'_, Expr>) -> Context {
    Context { scale: Some(phase.model().system.criterion_scale(phase)), ..Context::default() }
}

fn objection(model: &Model, name: &str) -> Option<String> {
    (!model.system.has_criterion()).then(|| {
        format!(
            "`{name}` is decided by a criterion that is known for the rubber systems and the flat \
             base only; state a density instead"
        )
    })
}
