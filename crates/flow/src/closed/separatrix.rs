//! Stable and unstable curves of a hyperbolic periodic point of a section.
//!
//! A short piece of the straight line along an eigenvector, from s to λs, is a fundamental domain of
//! the curve up to s²: its images under the map are the curve.

use crate::closed::periodic::{ComputedPeriodicPoint, Multipliers, SectionMap};
use crate::error::FlowError;
use crate::section::rolling::{SectionOrbit, SectionRequest, section};
use liouville::case::{Case, Direction};

/// Distance at which the piece begins; its square is far below a pixel.
const BEGIN: f64 = 1e-4;
/// Length up to which the curves are followed, as if they were straight.
const LENGTH: f64 = 20.0;
/// Limit on the number of images, near multipliers of 1.
const MAX_IMAGES: f64 = 300.0;
/// Number of points of the piece on each side.
const PIECE_POINTS: usize = 300;

/// Stable and unstable curves of a hyperbolic point.
pub struct Separatrices {
    /// Periodic point.
    pub point: ComputedPeriodicPoint,
    /// Orbits on the unstable curve.
    pub unstable: Vec<SectionOrbit>,
    /// Orbits on the stable curve.
    pub stable: Vec<SectionOrbit>,
}

/// Computes the curves of the periodic point near `near`.
pub fn separatrices(
    case: &Case,
    request: &SectionRequest,
    near: [f64; 2],
    period: usize,
    threads: usize,
) -> Result<Separatrices, FlowError> {
    let map = SectionMap::new(case, &request.g0, &request.energy, request.seed)?;
    let point = map.periodic(near, period)?;
    let (outward, inward) = match point.multipliers() {
        Multipliers::Real(a, b) if point.kind() == "hyperbolic" => (a, b),
        _ => {
            let ([l, z], kind) = (point.at, point.kind());
            return Err(FlowError::NotHyperbolic { l, z, kind });
        }
    };
    let curve = |multiplier: f64, backwards: bool| {
        let growth = if backwards { 1.0 / multiplier.abs() } else { multiplier.abs() };
        let images = (libm::log(LENGTH / BEGIN) / libm::log(growth)).ceil().min(MAX_IMAGES);
        let request = SectionRequest {
            starts: domain(&point, point.direction(multiplier), growth),
            crossings: images as usize * period,
            skip: 0,
            direction: Direction::Both,
            backwards,
            ..request.clone()
        };
        section(case, &request, threads, &|_| ())
    };
    let (unstable, stable) = (curve(outward, false)?, curve(inward, true)?);
    Ok(Separatrices { point, unstable, stable })
}

/// Points of the line on both sides, from `BEGIN` to the first image.
fn domain(point: &ComputedPeriodicPoint, [dl, dz]: [f64; 2], growth: f64) -> Vec<[f64; 2]> {
    let side = |sign: f64| {
        (0..PIECE_POINTS).map(move |k| {
            let s = sign * BEGIN * libm::pow(growth, k as f64 / PIECE_POINTS as f64);
            [point.at[0] + s * dl, point.at[1] + s * dz]
        })
    };
    side(1.0).chain(side(-1.0)).collect()
}
