//! Formulas for a browser and for LaTeX, from the boxes of their trees.

pub mod claim;
pub mod latex;
pub mod mathml;
