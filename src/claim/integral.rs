//! First integrals: L_vF = 0, for scalars, vectors and matrices.

use super::{Context, Reader, Statement};
use crate::formula::Formula;
use crate::graph::Expr;
use crate::mechanics::calculus::{Jet, dot, rejection};
use crate::scalar::Scalar;

/// F is a first integral: L_vF = 0.
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

    /// L_vF
    fn residual<T: Scalar>(&self, jet: &Jet<'_, T>, _: &[bool]) -> Vec<T> {
        jet.rates(&self.0)
    }

    /// The scale |∇F||v|, and whether F is more than a function of what every case conserves.
    fn context(&self, jet: &Jet<'_, Expr>, kept: &[bool]) -> Context {
        let slopes = self.slopes(jet);
        let field = jet.phase.field();
        let mut known = jet.level_gradients(kept);
        let beside = |known: &[Vec<Expr>]| -> Vec<Expr> {
            slopes.iter().flat_map(|slope| rejection(slope, known)).collect()
        };
        let off_level = beside(&known);
        let off_general = jet.energy_gradient().map(|energy| {
            known.push(energy.clone());
            beside(&known)
        });
        let steepness: Expr = slopes.iter().map(|slope| dot(slope, slope)).sum();
        Context {
            scale: Some(steepness * dot(field, field)),
            value: jet.phase.evaluate(&self.0).components(),
            slope: Some(steepness),
            off_level,
            off_general: off_general.unwrap_or_default(),
            ..Context::default()
        }
    }

    fn slopes(&self, jet: &Jet<'_, Expr>) -> Vec<Vec<Expr>> {
        jet.gradients(&self.0)
    }
}
