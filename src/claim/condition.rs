//! Conditions that a claim presupposes in addition to its residual.

use crate::graph::Expr;

/// A condition without which a claim that holds says less than it seems to.
#[derive(Clone, Debug)]
pub struct Condition {
    /// Required property.
    pub need: Need,
    /// Message if the property is not known to hold; ranks are added.
    pub otherwise: String,
    /// Whether the claim is meaningless without the condition; otherwise the failure is a remark.
    pub is_essential: bool,
}

/// A property that can be required.
#[derive(Clone, Debug)]
pub enum Need {
    /// A matrix, by rows, has this rank at almost every state.
    Rank {
        /// Rows of the matrix.
        rows: Vec<Vec<Expr>>,
        /// Required rank.
        rank: usize,
    },
    /// A value is not 0 at any state.
    NotZero {
        /// The value.
        value: Expr,
    },
    /// A value is above 0 at every state.
    Positive {
        /// The value.
        value: Expr,
    },
    /// A factor has a value at almost every zero of a function.
    ValueOnZeros {
        /// Function whose zeros are considered.
        function: Expr,
        /// Factor, recorded literally.
        factor: Expr,
        /// Reciprocal of the factor.
        inverse: Expr,
    },
}
