//! Motion: trajectories by Taylor series, to rounding, on the recorded field of any case.
//!
//! ```text
//! case, start ─ record ─▶ graph of the field ─ compile ─▶ Program ─ expand at a state ─▶ Series ─ step ─▶ trajectory
//! ```
//!
//! A program gives the coefficients of order n of every intermediate result from those of lower
//! orders (Moore 1966; Jorba, Zou 2005). It is run over f64, over several orbits at once, or over
//! double-double.

mod andoyer;
mod area;
mod attractors;
mod axis;
mod basins;
mod batch;
mod carry;
mod closed;
mod code;
mod columns;
mod compile;
mod continuation;
mod crossings;
mod cycle;
mod diagram;
mod error;
mod event;
mod expand;
mod form;
mod halt;
mod kept;
mod lanes;
mod late;
mod launch;
mod lexicon;
mod lyapunov;
mod machine;
mod merge;
mod motion;
mod multiplier;
mod number;
pub mod observe;
mod one_sided;
mod open;
mod orbit;
mod pace;
mod periodic;
mod plane;
mod portrait;
mod presence;
mod program;
mod record;
mod request;
mod returns;
mod rotation;
mod rounding;
mod samples;
mod section;
mod separatrix;
mod series;
mod shadow;
mod shorten;
mod spectrum;
mod start;
mod stepper;
mod surface;
mod symmetric;
mod track;
mod turns;
mod validated;
mod variational;
mod watch;

pub use andoyer::{applies as has_andoyer_section, spread};
pub use area::{AreaForm, area_forms};
pub use axis::{AxisMistake, number_with_pi};
pub use basins::{Attractor, BasinRequest, Basins, Destiny, StateAxis, basins};
pub use closed::{ComputedClosedOrbit, MeasuredNumber};
pub use columns::Columns;
pub use continuation::{
    Bifurcation, Branch, BranchEnd, BranchPoint, BranchRequest, BranchSection, branch,
    declared_range,
};
pub use cycle::Cycle;
pub use diagram::{DiagramOrbit, DiagramRequest, DiagramSection, diagram};
pub use error::FlowError;
pub use halt::{stop_request, stoppable};
pub use kept::check_level;
pub use launch::{Begin, Launches, Launchpad};
pub use lexicon::{FormulaMistake, Lexicon};
pub use lyapunov::{Alignment, Character, Estimate, Exponents};
pub use motion::Loose;
pub use multiplier::{CycleKind, Multiplier};
pub use one_sided::{Contact, ContactEvent};
pub use orbit::{Followed, Orbit, Precision, QuantityRole, orbit, value_at};
pub use periodic::{ComputedPeriodicPoint, Multipliers, SectionMap};
pub use plane::{ChartAxis, Coordinate, Launch, PlaneRequest, plane, plane_part};
pub use portrait::{Portrait, portrait};
pub use request::{ChoiceError, SectionChoice};
pub use returns::{closed_orbit, crossing_time};
pub use rotation::RotationNumber;
pub use samples::{SampledOrbit, Sampling, orbits};
pub use section::{
    Crossing, SectionOrbit, SectionRequest, section, section_starts, values_at_starts,
};
pub use separatrix::{Separatrices, separatrices};
pub use spectrum::{Spectrum, spectra};
pub use start::{Start, fixed_parameters};
pub use surface::{
    CrossingSurface, SurfaceCrossing, SurfaceOrbit, SurfaceRequest, surface_section,
};
pub use symmetric::{
    SymmetricOrbit, SymmetricOrbits, SymmetricRequest, line_name, symmetric_orbits,
};
pub use track::{RollingSamples, Track, track};
pub use validated::{
    CoveringSet, Doubt, Enclosure, HorseshoeData, HorseshoeTrace, Margin, Obstacle, ProofData,
    ProvedHorseshoe, ProvedOrbit, Reached, Request, follow, prove, prove_horseshoe, replay,
    replay_horseshoe,
};
pub use variational::Variational;
