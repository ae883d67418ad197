//! Invariant densities: Liouville's equation v(ln ρ) + div v = 0.
//!
//! On a level set {F_i = c_i} the density refers to the volume σ with dx = dF_1∧…∧dF_k∧σ, and the
//! equation is v(ln ρ) + div v - Σ d(L_vF_i)(n_i) = 0 with dF_i(n_j) = δ_ij. The logarithm is
//! differentiated through products and powers, so that roots and exponentials of ρ drop out.
//!
//! A map keeps the measure |ρ| dx where (ρ∘Φ det DΦ)² = ρ²; a sign of ρ says nothing of a measure, and
//! a map that turns orientation around keeps one as well. In squares no modulus has to be settled.

use num_dual::DualNum;

use super::{Condition, Need, Reader, ResidualContext, Statement};
use crate::formula::{Formula, Type};
use crate::graph::Expr;
use crate::mechanics::calculus::DualPoint;
use crate::mechanics::elimination::dot;
use crate::scalar::Scalar;

/// ρ is an invariant density: v(ln ρ) + div v = 0 on the level, or |ρ∘Φ det DΦ| = |ρ|.
#[derive(Clone, Debug)]
pub struct Density(pub Formula);

impl Statement for Density {
    const NAME: &'static str = "density";
    const OF_MAPS: bool = true;
    const IS_OF_MEASURE: bool = true;
    const UNDEFINED: &'static str = ": ∇ln ρ is needed, which has no value where ρ is 0 or has no \
                                     gradient";

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        from.required(Self::NAME, Some(Type::Scalar)).map(Self)
    }

    fn at_images_of_maps(&self) -> Vec<&Formula> {
        vec![&self.0]
    }

    fn formulas(&self) -> Vec<&Formula> {
        vec![&self.0]
    }

    fn divisors(&self) -> Vec<&Formula> {
        vec![&self.0]
    }

    fn about(&self, formula: Formula) -> Option<Self> {
        Some(Self(formula))
    }

    /// Computes v(ln ρ) + div v minus the cofactors of the level functions.
    fn residual<T: Scalar>(&self, jet: &DualPoint<'_, T>, kept: &[bool]) -> Vec<T> {
        if jet.phase.model().system.is_map() {
            let [here, there] = self.squares(jet, kept);
            return vec![there - here];
        }
        let moved = jet.along_field();
        let along = self.0.logarithmic_derivative(&mut |symbol| moved.value(symbol));
        vec![along + jet.divergence() - jet.level_cofactor(kept)]
    }

    /// The scale |v|(|∇ln ρ| + 1/|x|), in squares, and ρ itself for its sign.
    fn context(&self, jet: &DualPoint<'_, Expr>, kept: &[bool]) -> ResidualContext {
        if jet.phase.model().system.is_map() {
            let squares = self.squares(jet, kept);
            return ResidualContext {
                scale: Some(dot(&squares, &squares)),
                value: vec![jet.phase.scalar(&self.0)],
                ..ResidualContext::default()
            };
        }
        let slope = self.slope(jet);
        let (field, state) = (jet.phase.field(), jet.phase.state());
        let rate = dot(&slope, &slope) + dot(&state, &state).recip();
        ResidualContext {
            scale: Some(dot(field, field) * rate),
            value: vec![jet.phase.scalar(&self.0)],
            ..ResidualContext::default()
        }
    }

    fn conditions(&self, jet: &DualPoint<'_, Expr>, kept: &[bool]) -> Vec<Condition> {
        if jet.phase.model().system.is_map() {
            let otherwise = "ρ dx is invariant only where Φ is one-to-one";
            let need = Need::OneToOne { moved: self.moved(jet, kept) };
            return vec![Condition { need, otherwise: otherwise.to_string(), is_essential: true }];
        }
        let value = jet.phase.scalar(&self.0);
        let field = jet.phase.field();
        vec![
            Condition::continuous(vec![value], "ρ"),
            Condition::continuous(field.to_vec(), "the field"),
            Condition::finite(value, field),
        ]
    }

    fn slopes(&self, jet: &DualPoint<'_, Expr>) -> Vec<Vec<Expr>> {
        vec![self.slope(jet)]
    }
}

impl Density {
    /// ρ² and (ρ∘Φ det DΦ)², with the factor of the level's volume on a level.
    fn squares<T: Scalar>(&self, jet: &DualPoint<'_, T>, kept: &[bool]) -> [T; 2] {
        let (here, moved) = (jet.phase.scalar(&self.0), self.moved(jet, kept));
        [here * here, moved * moved]
    }

    /// ρ∘Φ det DΦ, with the factor of the level's volume on a level.
    fn moved<T: Scalar>(&self, jet: &DualPoint<'_, T>, kept: &[bool]) -> T {
        jet.image().scalar(&self.0) * jet.expansion(kept)
    }

    /// Computes ∇ln ρ.
    fn slope(&self, jet: &DualPoint<'_, Expr>) -> Vec<Expr> {
        jet.logarithmic_gradient(&self.0)
    }
}
