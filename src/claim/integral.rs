//! First integrals: L_vF = 0, for scalars, vectors and matrices.

use super::{Context, Novelty, Reader, Statement};
use crate::formula::Formula;
use crate::graph::Expr;
use crate::mechanics::calculus::{Jet, dot, rejection};
use crate::scalar::Scalar;

/// The claim that F is a first integral: L_vF = 0.
#[derive(Clone, Debug)]
pub struct Integral(pub Formula);

impl Statement for Integral {
    const NAME: &'static str = "integral";

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        from.required(Self::NAME, None).map(Self)
    }

    fn formulas(&self) -> Vec<&Formula> {
        vec![&self.0]
    }

    fn about(&self, formula: Formula) -> Option<Self> {
        Some(Self(formula))
    }

    /// Computes L_vF.
    fn residual<T: Scalar>(&self, jet: &Jet<'_, T>, _: &[bool]) -> Vec<T> {
        jet.rates(&self.0)
    }

    /// Returns the square of the scale |∇F||v|.
    fn context(&self, jet: &Jet<'_, Expr>, _: &[bool]) -> Context {
        let field = jet.phase.field();
        let steepness: Expr = self.slopes(jet).iter().map(|slope| dot(slope, slope)).sum();
        Context {
            scale: Some(steepness * dot(field, field)),
            value: jet.phase.evaluate(&self.0).components(),
            ..Context::default()
        }
    }

    fn novelty(&self, jet: &Jet<'_, Expr>, kept: &[bool]) -> Novelty {
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

    fn slopes(&self, jet: &Jet<'_, Expr>) -> Vec<Vec<Expr>> {
        jet.gradients(&self.0)
    }
}
