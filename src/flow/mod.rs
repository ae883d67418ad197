//! Motion: trajectories by Taylor series, to rounding, on the recorded field of any case.
//!
//! ```text
//! case, start ─ record ─▶ graph of the field ─ compile ─▶ Program ─ expand at a state ─▶ Series ─ step ─▶ trajectory
//! ```
//!
//! A program says how the coefficients of order n of every intermediate result follow from those
//! of lower orders (Moore 1966; Jorba, Zou 2005). It is run over f64, over several orbits at once, or
//! over double-double.

mod andoyer;
mod closed;
mod code;
mod compile;
mod error;
mod event;
mod expand;
mod form;
mod lyapunov;
mod merge;
mod motion;
mod number;
mod one_sided;
mod orbit;
mod periodic;
mod program;
mod section;
mod series;
mod start;
mod stepper;

pub use andoyer::spread;
pub use closed::{ClosedOrbit, Measured};
pub use error::FlowError;
pub use lyapunov::{Character, Estimate, Exponents, Variational};
pub use one_sided::{Contact, ContactEvent};
pub use orbit::{Followed, Orbit, Precision, Role, orbit, value_at};
pub use periodic::{Multipliers, PeriodicPoint, SectionMap};
pub use section::{
    Crossing, SectionOrbit, SectionRequest, section, section_starts, values_at_starts,
};
pub use start::{Start, fixed_parameters};
