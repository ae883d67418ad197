//! The divergence of the motion by a formula: v(ln ρ) + div v = F.
//!
//! F is the divergence relative to the volume ρ dx, or ρσ on a level set with the volume σ of
//! [`Density`](super::Density), which is invariant exactly when F = 0.

use super::{Condition, Objection, Reader, ResidualContext, Statement};
use crate::formula::{Formula, Type};
use crate::graph::Expr;
use crate::mechanics::Model;
use crate::mechanics::calculus::DualPoint;
use crate::mechanics::elimination::dot;
use crate::scalar::Scalar;

/// The claim that the divergence relative to a volume is F.
#[derive(Clone, Debug)]
pub struct Divergence {
    divergence: Formula,
    /// Density ρ of the volume, 1 if there is none.
    volume: Option<Formula>,
}

impl Divergence {
    /// Computes v(ln ρ) + div v minus the cofactors of the level functions.
    fn growth<T: Scalar>(&self, jet: &DualPoint<'_, T>, kept: &[bool]) -> T {
        let growth = jet.divergence() - jet.level_cofactor(kept);
        let Some(volume) = &self.volume else { return growth };
        let moved = jet.along_field();
        growth + volume.logarithmic_derivative(&mut |symbol| moved.value(symbol))
    }
}

impl Statement for Divergence {
    const NAME: &'static str = "divergence";
    const COMPANIONS: &'static [&'static str] = &["volume"];

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        let divergence = from.required(Self::NAME, Some(Type::Scalar))?;
        Ok(Self { divergence, volume: from.formula("volume", Some(Type::Scalar))? })
    }

    fn formulas(&self) -> Vec<&Formula> {
        [&self.divergence].into_iter().chain(&self.volume).collect()
    }

    fn text(&self) -> Option<String> {
        let divergence = self.divergence.text().trim();
        Some(match &self.volume {
            Some(volume) => {
                let volume = volume.as_factor();
                format!("div({}*v)/{0} = {divergence}", volume.text().trim())
            }
            None => format!("div v = {divergence}"),
        })
    }

    fn divisors(&self) -> Vec<&Formula> {
        self.volume.iter().collect()
    }

    fn about(&self, divergence: Formula) -> Option<Self> {
        Some(Self { divergence, ..self.clone() })
    }

    fn objection(&self, model: &Model) -> Option<Objection> {
        let is_open = model.has_antiderivative(&self.divergence);
        is_open.then(|| Objection::open_constant("a divergence"))
    }

    fn residual<T: Scalar>(&self, jet: &DualPoint<'_, T>, kept: &[bool]) -> Vec<T> {
        vec![self.growth(jet, kept) - jet.phase.scalar(&self.divergence)]
    }

    fn conditions(&self, jet: &DualPoint<'_, Expr>, _: &[bool]) -> Vec<Condition> {
        let volume = self.volume.iter().map(|own| jet.phase.scalar(own)).collect::<Vec<Expr>>();
        match jet.phase.model().system.is_map() || volume.is_empty() {
            true => Vec::new(),
            false => vec![Condition::continuous(volume, "the volume")],
        }
    }

    /// The scale |v|/|x| and F itself, in squares.
    fn context(&self, jet: &DualPoint<'_, Expr>, _: &[bool]) -> ResidualContext {
        let (field, state) = (jet.phase.field(), jet.phase.state());
        let value = jet.phase.scalar(&self.divergence);
        ResidualContext {
            scale: Some(dot(field, field) / dot(&state, &state) + value * value),
            value: vec![value],
            ..ResidualContext::default()
        }
    }
}
