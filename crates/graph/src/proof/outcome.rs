//! Outcomes for groups of values, and the parts of the inputs that they are about.

use std::sync::Arc;

use super::domain;
use super::extent::Extent;
use super::trial::Certificate;
use crate::graph::{Expr, Graph};

/// The outcome for a group.
#[derive(Clone, Debug)]
pub enum GroupOutcome {
    /// All values are zero wherever they exist.
    Zero(Certificate),
    /// One value is not identically zero on the given parts of the real inputs, and hence at some
    /// real inputs if one of the parts is not empty.
    NonZero(InputRegions),
    /// Undecided, with the reason.
    Silent(String),
    /// The values are zero wherever they exist, but do not exist on a part of the inputs at which
    /// the required values do.
    Partial,
    /// The values exist for no real inputs.
    Void,
}

/// Parts of the real inputs.
#[derive(Clone, Debug, Default)]
pub struct InputRegions(pub(super) Option<Vec<Arc<InputRegion>>>);

/// A part of the real inputs on which some inputs have given signs and some values are positive.
pub struct InputRegion {
    /// Graph of the computation.
    pub graph: Graph,
    /// Values that are positive on the part.
    pub positive: Vec<Expr>,
    /// Sign inputs, and whether each is 1.
    pub signs: Vec<(usize, bool)>,
}

impl std::fmt::Debug for InputRegion {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(out, "{} signs, {} of inputs", self.positive.len(), self.signs.len())
    }
}

impl InputRegion {
    /// Searches for a point of the part inside the extents of the inputs.
    pub fn point(&self, extents: &[Extent]) -> Option<Vec<f64>> {
        let mut inputs = extents.to_vec();
        for (input, positive) in &self.signs {
            if let Some(extent) = inputs.get_mut(*input) {
                *extent = extent.within(*positive);
            }
        }
        domain::point(&self.graph, &inputs, &self.positive)
    }
}

impl InputRegions {
    /// Returns the parts; `None` if they are all real inputs.
    pub fn proper(&self) -> Option<&[Arc<InputRegion>]> {
        self.0.as_deref()
    }
}

impl GroupOutcome {
    /// Whether all values were proved zero.
    pub fn is_zero(&self) -> bool {
        matches!(self, GroupOutcome::Zero(_))
    }

    /// Whether one value was proved not to vanish identically.
    pub fn is_nonzero(&self) -> bool {
        matches!(self, GroupOutcome::NonZero(_))
    }
}
