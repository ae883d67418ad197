//! Values beside a residual, by which its vanishing is interpreted.

use crate::graph::Expr;

/// Auxiliary values for the interpretation of a vanishing residual.
#[derive(Clone, Debug, Default)]
pub struct ResidualContext {
    /// Square of the residual's scale; a residual is resolved when its error bound is far below the
    /// root of this.
    pub scale: Option<Expr>,
    /// Value of F or ρ; a claim is void where its formula is undefined.
    pub value: Vec<Expr>,
    /// Values that are zero exactly when the integrand of each ∫ is a function of its variable, on
    /// the level.
    pub quadrature_defects: Vec<Expr>,
    /// Value that an inequality says is never positive.
    pub excess: Option<Excess>,
}

/// Value that an inequality says is never positive.
#[derive(Clone, Copy, Debug)]
pub struct Excess {
    /// The value.
    pub value: Expr,
    /// Sum of the moduli of its terms.
    pub scale: Expr,
}

/// Values that relate an integral to those common to all cases.
#[derive(Clone, Debug, Default)]
pub struct Novelty {
    /// Square of the gradient, |∇F|².
    pub slope: Option<Expr>,
    /// Values that are zero exactly when the integral is constant on the level.
    pub off_level: Vec<Expr>,
    /// Values that are zero exactly when the integral depends on the level functions and the
    /// energy.
    pub off_general: Vec<Expr>,
}
