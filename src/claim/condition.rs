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

impl Condition {
    /// Requires that the values of a claim are not all 0 identically, or it says nothing.
    pub fn nonzero(values: Vec<Expr>, otherwise: &str) -> Self {
        let need = Need::Nonzero { values };
        Self { need, otherwise: otherwise.to_string(), is_essential: false }
    }

    /// Requires that values do not jump, or the claim does not cover motions across the jump.
    pub fn continuous(values: Vec<Expr>, what: &str) -> Self {
        let need = Need::Continuous { values };
        let otherwise = format!("{what} jumps: motions across the jump are not covered");
        Self { need, otherwise, is_essential: false }
    }

    /// Requires that a density is finite, or the measure may be infinite there.
    pub fn finite(value: Expr, field: &[Expr]) -> Self {
        let need = Need::Finite { value, field: field.to_vec() };
        let otherwise = "ρ is infinite: it is a measure only where it is finite".to_string();
        Self { need, otherwise, is_essential: false }
    }
}

impl Need {
    /// Returns the values on which it depends whether the property holds.
    pub fn values(&self) -> Vec<Expr> {
        match self {
            Self::Rank { rows, .. } => rows.concat(),
            Self::NotZero { value } | Self::Positive { value } => vec![*value],
            Self::Nonzero { values } | Self::Continuous { values } => values.clone(),
            Self::Zeros { function } => vec![*function],
            Self::OneToOne { moved } => vec![*moved],
            Self::Finite { value, field } => [&[*value], &field[..]].concat(),
            Self::ValueOnZeros { function, factor, inverse, .. } => {
                [*function, *factor].into_iter().chain(*inverse).collect()
            }
        }
    }
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
        /// Number of rows that are given by the level, and count as no dimension.
        fixed: usize,
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
    /// Some of these values is not 0 identically.
    Nonzero {
        /// The values.
        values: Vec<Expr>,
    },
    /// A function is 0 at some state.
    Zeros {
        /// The function.
        function: Expr,
    },
    /// The map takes no two states to one image.
    OneToOne {
        /// Density at the image, times the factor of the volume.
        moved: Expr,
    },
    /// No value jumps at states that motions can cross.
    Continuous {
        /// The values.
        values: Vec<Expr>,
    },
    /// A value is infinite at no state at which the field has a value.
    Finite {
        /// The value.
        value: Expr,
        /// Components of the field.
        field: Vec<Expr>,
    },
    /// A factor has a value at almost every zero of a function.
    ValueOnZeros {
        /// Function whose zeros are considered.
        function: Expr,
        /// Functions whose common zeros these are.
        components: Vec<Expr>,
        /// Factor, recorded literally.
        factor: Expr,
        /// Reciprocal of the factor; none of an entry of a matrix.
        inverse: Option<Expr>,
    },
}
