//! Surface of a body as a wireframe: points of contact for meridians and parallels of normals.

use std::f64::consts::PI;

use super::sphere::{BodyOnSphere, point};
use liouville::case::Case;
use liouville::verdict::{JudgeError, Options};

/// Curves on the surface of a body.
#[derive(Clone, Debug, PartialEq)]
pub struct Wireframe {
    /// Points with the outward normals, curve by curve.
    pub lines: Vec<Vec<([f64; 3], [f64; 3])>>,
}

const MERIDIANS: usize = 16;
const PARALLELS: usize = 9;
/// Number of steps of a curve; even, so that it passes through the middle.
const STEPS: usize = 48;

/// Draws the curves for a body whose surface is defined on the whole sphere of normals.
pub fn of(case: &Case, options: &Options) -> Result<Option<Wireframe>, JudgeError> {
    let Some((body, _)) = BodyOnSphere::first(case, options)? else { return Ok(None) };
    let at = |latitude: f64, longitude: f64| {
        let gamma = point(latitude, longitude);
        (body.contact(gamma), gamma.map(|x| -x))
    };
    let mut lines = Vec::new();
    for k in 0..MERIDIANS {
        let longitude = 2.0 * PI * k as f64 / MERIDIANS as f64;
        // The poles are left out: the normal of a disk has no unique point there.
        let latitude = |step: usize| PI * (0.998 * step as f64 / STEPS as f64 - 0.499);
        lines.push((0..=STEPS).map(|step| at(latitude(step), longitude)).collect());
    }
    for k in 1..=PARALLELS {
        let latitude = PI * (k as f64 / (PARALLELS + 1) as f64 - 0.5);
        let longitude = |step: usize| 2.0 * PI * step as f64 / STEPS as f64;
        lines.push((0..=STEPS).map(|step| at(latitude, longitude(step))).collect());
    }
    let lines: Vec<Vec<([f64; 3], [f64; 3])>> = lines;
    let is_defined = lines.iter().flatten().all(|(r, _)| r.iter().all(|x| x.is_finite()));
    Ok(is_defined.then_some(Wireframe { lines }))
}
