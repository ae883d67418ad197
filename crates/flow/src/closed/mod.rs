//! Closed orbits and periodic points, their multipliers, and branches of them.

pub(crate) mod area;
pub(crate) mod continuation;
pub(crate) mod cycle;
mod cyclic;
pub(crate) mod multiplier;
pub(crate) mod periodic;
pub(crate) mod returns;
pub(crate) mod separatrix;
pub(crate) mod symmetric;
pub(crate) mod through;
pub(crate) mod turns;
