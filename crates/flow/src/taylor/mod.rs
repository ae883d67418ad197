//! Taylor series of a recorded field, and steps by them.

pub(crate) mod batch;
pub(crate) mod code;
pub(crate) mod compile;
pub(crate) mod defect;
pub(crate) mod ending;
pub(crate) mod event;
pub(crate) mod expand;
pub(crate) mod form;
pub(crate) mod lanes;
pub(crate) mod level;
pub(crate) mod machine;
pub(crate) mod merge;
pub(crate) mod number;
pub(crate) mod pace;
pub(crate) mod plain;
pub(crate) mod program;
pub(crate) mod quotients;
pub(crate) mod resolve;
pub(crate) mod rounding;
mod runaway;
pub(crate) mod saturating;
pub(crate) mod series;
pub(crate) mod shorten;
pub(crate) mod stepper;
mod turning;
pub(crate) mod watch;
