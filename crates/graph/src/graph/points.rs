//! Points at which the inputs of a graph satisfy relations.

use super::{Expr, Graph};

/// Inputs as functions of free numbers, so that all points made from these lie in a subset: the
/// level set of a motion.
#[derive(Clone, Debug)]
pub struct Points<'p> {
    /// Graph of the free numbers.
    pub graph: &'p Graph,
    /// First inputs as functions of the free numbers; further inputs are free.
    pub inputs: &'p [Expr],
    /// Whether each free number is a sign, 1 or -1.
    pub signs: Vec<bool>,
}
