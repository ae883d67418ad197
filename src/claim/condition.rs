//! What a claim takes for granted beside the residual that vanishes where it holds.

use crate::graph::Expr;

/// What has to be so, lest a claim that holds says less than its words.
#[derive(Clone, Debug)]
pub struct Condition {
    /// What has to be so.
    pub need: Need,
    /// What a reader is told where it is not known to be so; ranks are added.
    pub otherwise: String,
    /// Does the claim mean nothing without it? Otherwise it is remarked.
    pub is_essential: bool,
}

/// What can be asked.
#[derive(Clone, Debug)]
pub enum Need {
    /// A matrix, by rows, has this rank at almost every state.
    Rank {
        /// The matrix.
        rows: Vec<Vec<Expr>>,
        /// Its rank.
        rank: usize,
    },
    /// A value is not 0 at any state.
    NotZero {
        /// The value.
        value: Expr,
    },
    /// A factor has a value at almost every zero of a function.
    ValueOnZeros {
        /// The function.
        function: Expr,
        /// The factor, recorded literally.
        factor: Expr,
        /// One over it.
        inverse: Expr,
    },
}
