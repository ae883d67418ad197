//! First integrals: L_vF = 0, or F∘Φ = F for a map; for scalars, vectors and matrices.

use super::statement::OfMotions;
use super::{Condition, Novelty, Reader, ResidualContext, Statement, difference};
use crate::formula::Formula;
use crate::graph::Expr;
use crate::mechanics::Phase;
use crate::mechanics::calculus::DualPoint;
use crate::mechanics::elimination::{dot, rejection};
use crate::scalar::Scalar;

/// F is a first integral: L_vF = 0, or F∘Φ = F.
#[derive(Clone, Debug)]
pub struct Integral(pub Formula);

impl Statement for Integral {
    const NAME: &'static str = "integral";
    const OF_MAPS: bool = true;
    const OF_MOTIONS: OfMotions = OfMotions::Constancy;

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        from.required(Self::NAME, None).map(Self)
    }

    fn at_images_of_maps(&self) -> Vec<&Formula> {
        vec![&self.0]
    }

    fn formulas(&self) -> Vec<&Formula> {
        vec![&self.0]
    }

    fn about(&self, formula: Formula) -> Option<Self> {
        Some(Self(formula))
    }

    /// L_vF, or F∘Φ - F.
    fn residual<T: Scalar>(&self, jet: &DualPoint<'_, T>, _: &[bool]) -> Vec<T> {
        if jet.phase.model().system.is_map() {
            let value = |at: &Phase<'_, T>| at.evaluate(&self.0).components();
            return difference(value(&jet.image()), value(&jet.phase));
        }
        jet.rates(&self.0)
    }

    /// The scale |∇F||v|, or |F|.
    fn context(&self, jet: &DualPoint<'_, Expr>, _: &[bool]) -> ResidualContext {
        if jet.phase.model().system.is_map() {
            let [value, there] =
                [&jet.phase, &jet.image()].map(|at| at.evaluate(&self.0).components());
            let scale = Some(dot(&value, &value) + dot(&there, &there));
            return ResidualContext { scale, value, ..ResidualContext::default() };
        }
        let field = jet.phase.field();
        let steepness: Expr = self.slopes(jet).iter().map(|slope| dot(slope, slope)).sum();
        ResidualContext {
            scale: Some(steepness * dot(field, field)),
            value: jet.phase.evaluate(&self.0).components(),
            ..ResidualContext::default()
        }
    }

    fn conditions(&self, jet: &DualPoint<'_, Expr>, _: &[bool]) -> Vec<Condition> {
        match jet.phase.model().system.is_map() {
            true => Vec::new(),
            false => vec![Condition::continuous(jet.phase.evaluate(&self.0).components(), "F")],
        }
    }

    fn novelty(&self, jet: &DualPoint<'_, Expr>, kept: &[bool]) -> Novelty {
        let slopes = self.slopes(jet);
        let mut known = jet.level_gradients(kept);
        let beside = |known: &[Vec<Expr>]| -> Vec<Expr> {
            slopes.iter().flat_map(|slope| rejection(slope, known)).collect()
        };
        let off_level = beside(&known);
        let off_general = jet.energy_gradient().map_or(Vec::new(), |energy| {
            known.push(energy.clone());
            beside(&known)
        });
        let slope = slopes.iter().map(|slope| dot(slope, slope)).sum();
        Novelty { slope: Some(slope), off_level, off_general }
    }

    fn slopes(&self, jet: &DualPoint<'_, Expr>) -> Vec<Vec<Expr>> {
        jet.gradients(&self.0)
    }
}
