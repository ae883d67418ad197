//! Sections of motions: surfaces, coordinates on them, crossings.

pub(crate) mod andoyer;
pub(crate) mod axis;
pub(crate) mod coordinate;
pub(crate) mod crossings;
pub(crate) mod diagram;
pub(crate) mod launch;
pub(crate) mod portrait;
pub(crate) mod request;
pub(crate) mod rolling;
pub(crate) mod surface;
