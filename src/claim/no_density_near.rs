//! Absence of a density near a fixed point at which the flow changes volumes.
//!
//! Where v(x₀) = 0, the derivative of the flow is exp(tA), with det exp(tA) = exp(t div v). A measure
//! with a continuous density ρ is invariant only if ρ(x₀) = ρ(x₀) exp(t div v). So div v(x₀) ≠ 0
//! excludes every ρ that is positive at x₀. On a level, div v refers to the level's volume.
//!
//! Let Φ(x₀) = x₀ for a map Φ, B be a ball about x₀, and μ = ρ dx be invariant: μ(B) ≤ μ(Φ⁻¹(Φ(B))) =
//! μ(Φ(B)), and Φ(B) has at most q times the volume of B, where q is near |det DΦ(x₀)|. So |det DΦ(x₀)| < 1
//! excludes every ρ that is positive at x₀; |det DΦ(x₀)| > 1 does not, where Φ is not one-to-one.

use super::clock::never_rests;
use super::components::Components;
use super::elsewhere::{inside, level_at, system_at_point};
use super::point::read_point;
use super::statement::Objection;
use super::{Condition, Need, Reader, ResidualContext, Statement, ValueShape, difference};
use crate::graph::Expr;
use crate::mechanics::Model;
use crate::mechanics::calculus::DualPoint;
use crate::scalar::Scalar;

/// The claim that no measure with a continuous density, positive at a fixed point, is invariant
/// near it.
#[derive(Clone, Debug)]
pub struct NoDensityNear(Components);

impl NoDensityNear {
    fn jet<'m, T: Scalar>(&self, jet: &DualPoint<'m, T>) -> DualPoint<'m, T> {
        DualPoint::new(jet.phase.with(&[], &self.0.at(&jet.phase)))
    }

    /// Computes the divergence at the point, or 1 - (det DΦ)² of a map.
    fn growth(&self, jet: &DualPoint<'_, Expr>, kept: &[bool]) -> Expr {
        let at = self.jet(jet);
        if jet.phase.model().system.is_map() {
            let factor = at.expansion(kept);
            return Expr::from(1.0) - factor * factor;
        }
        at.divergence() - at.level_cofactor(kept)
    }
}

impl Statement for NoDensityNear {
    const NAME: &'static str = "no-density-near";
    const SHAPES: &'static [(&'static str, ValueShape)] = &[(Self::NAME, ValueShape::Table)];
    const WIDENS: bool = false;
    const OF_MAPS: bool = true;

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        read_point(from, Self::NAME)?.map(Self).ok_or_else(|| from.missing(Self::NAME))
    }

    fn text(&self) -> Option<String> {
        Some(match self.0.text.as_str() {
            "" => "no density near 0".to_string(),
            point => format!("no density near {point}"),
        })
    }

    fn objection(&self, model: &Model) -> Option<Objection> {
        never_rests(model, Self::NAME)
    }

    /// Computes the field at the point and the level functions there.
    fn residual<T: Scalar>(&self, jet: &DualPoint<'_, T>, kept: &[bool]) -> Vec<T> {
        let at = self.jet(jet);
        let mut residual = match at.phase.model().system.is_map() {
            true => difference(at.phase.field().to_vec(), at.phase.state()),
            false => at.phase.field().to_vec(),
        };
        residual.extend(jet.level_at(&at.phase, kept));
        residual
    }

    fn written_elsewhere(&self, jet: &DualPoint<'_, Expr>) -> Vec<Expr> {
        self.0.written(&jet.phase)
    }

    fn presence(&self, jet: &DualPoint<'_, Expr>, kept: &[bool]) -> Vec<Expr> {
        let at = jet.phase.with(&[], &self.0.at(&jet.phase));
        let mut values = inside(system_at_point(&at));
        values.extend(level_at(&at, kept));
        values
    }

    fn context(&self, jet: &DualPoint<'_, Expr>, kept: &[bool]) -> ResidualContext {
        ResidualContext { value: vec![self.growth(jet, kept)], ..ResidualContext::default() }
    }

    fn conditions(&self, jet: &DualPoint<'_, Expr>, kept: &[bool]) -> Vec<Condition> {
        let value = self.growth(jet, kept);
        let (need, otherwise) = match jet.phase.model().system.is_map() {
            true => (
                Need::Positive { value },
                "it is not known that |det DΦ| is below 1 at the point for all parameters; above 1 it \
                 excludes no density of a map that may not be one-to-one",
            ),
            false => (
                Need::NotZero { value },
                "it is not known that the divergence differs from 0 at the point for all parameters",
            ),
        };
        vec![Condition { need, otherwise: otherwise.to_string(), is_essential: true }]
    }

    fn remark(&self, _: &Model, _: &[bool]) -> Option<String> {
        Some("this excludes densities that are continuous, and positive at the point".to_string())
    }
}
