//! Motion: trajectories by Taylor series, to rounding, on the recorded field of any case.
//!
//! ```text
//! case, start ─ record ─▶ graph of the field ─ compile ─▶ Program ─ expand at a state ─▶ Series ─ step ─▶ trajectory
//! ```
//!
//! A program gives the coefficients of order n of every intermediate result from those of lower
//! orders (Moore 1966; Jorba, Zou 2005). It is run over f64, over several orbits at once, or over
//! double-double.

mod advice;
mod chaos;
mod closed;
mod error;
mod halt;
mod map_cycles;
mod motion;
pub mod observe;
mod record;
mod section;
mod taylor;
mod told;
mod validated;

pub use chaos::basins::{Attractor, BasinRequest, Basins, Destiny, StateAxis, basins};
pub use chaos::plane::{PlaneRequest, plane, plane_part};
pub use chaos::rotation::RotationNumber;
pub use chaos::spectrum::{Spectrum, spectra};
pub use closed::area::{AreaForm, area_forms};
pub use closed::continuation::{
    Bifurcation, Branch, BranchEnd, BranchPoint, BranchRequest, BranchSection, branch,
    declared_range,
};
pub use closed::cycle::Cycle;
pub use closed::multiplier::{CycleKind, Multiplier};
pub use closed::periodic::{ComputedPeriodicPoint, Multipliers, SectionMap};
pub use closed::returns::{closed_orbit, crossing_time};
pub use closed::separatrix::{Separatrices, separatrices};
pub use closed::symmetric::{
    SymmetricOrbit, SymmetricOrbits, SymmetricRequest, line_name, symmetric_orbits,
};
pub use closed::through::{ComputedClosedOrbit, MeasuredNumber};
pub use error::FlowError;
pub use halt::{stop_request, stoppable};
pub use map_cycles::{MapBox, MapPoint, MapPoints, PointDoubt, map_point, map_points};
pub use motion::columns::Columns;
pub use motion::conserved::{Conserved, Fixed};
pub use motion::iterates::{IterateError, MapOrbit, MapSampling, SampledMapOrbit, iterates};
pub use motion::kept::check_level;
pub use motion::lexicon::{FormulaMistake, Lexicon};
pub use motion::lyapunov::{Alignment, Character, Estimate, Exponents};
pub use motion::map_exponents::{MapExponents, map_exponents};
pub use motion::one_sided::{Contact, ContactEvent};
pub use motion::orbit::{Followed, Orbit, Precision, QuantityRole, orbit, value_at};
pub use motion::recorded::Loose;
pub use motion::samples::{SampledOrbit, Sampling, orbits};
pub use motion::start::{Start, fixed_parameters, two_sided};
pub use motion::track::{RollingSamples, Track, track};
pub use motion::variational::Variational;
pub use section::andoyer::{applies as has_andoyer_section, spread};
pub use section::axis::{AxisMistake, number_with_pi};
pub use section::coordinate::{ChartAxis, Coordinate, Launch};
pub use section::diagram::{DiagramOrbit, DiagramRequest, DiagramSection, diagram};
pub use section::launch::{Begin, Launches, Launchpad};
pub use section::portrait::{Portrait, portrait};
pub use section::request::{ChoiceError, SectionChoice};
pub use section::rolling::{
    Crossing, SectionOrbit, SectionRequest, section, section_starts, values_at_starts,
};
pub use section::surface::{
    CrossingSurface, SurfaceCrossing, SurfaceOrbit, SurfaceRequest, surface_section,
};
pub use validated::{
    CoveringSet, Doubt, Enclosure, HorseshoeData, HorseshoeTrace, Margin, Obstacle, ProofData,
    ProvedHorseshoe, ProvedOrbit, Reached, Request, follow, prove, prove_horseshoe, replay,
    replay_horseshoe,
};
