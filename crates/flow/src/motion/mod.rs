//! Motions of a case: starts, single orbits and their samples, tangent vectors.

pub(crate) mod carry;
pub(crate) mod columns;
pub(crate) mod conserved;
pub(crate) mod extent;
pub(crate) mod iterates;
pub(crate) mod kept;
pub(crate) mod lexicon;
pub(crate) mod lyapunov;
pub(crate) mod map_exponents;
pub(crate) mod one_sided;
pub(crate) mod open;
pub(crate) mod orbit;
pub(crate) mod presence;
pub(crate) mod recorded;
pub(crate) mod samples;
pub(crate) mod start;
pub(crate) mod track;
pub(crate) mod trend;
pub(crate) mod variational;
