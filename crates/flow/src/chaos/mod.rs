//! Exponents, attractors and classes of many motions.

pub(crate) mod attractors;
pub(crate) mod basins;
pub(crate) mod late;
mod order;
pub(crate) mod plane;
pub(crate) mod reach;
pub(crate) mod rotation;
pub(crate) mod shadow;
pub(crate) mod spectrum;
