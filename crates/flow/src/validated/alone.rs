//! Boxes about a closed orbit that hold no other one: they are as wide as a claim about it is vague.

use super::course::Course;
use super::division::DIVISIONS;
use super::{MOST_UNKNOWNS, Obstacle, OrbitSearch, Request, prepared};

/// Sides of the boxes of states against those that hold the start, or what the motion covers in the
/// doubt about the period: some have room for both.
const WIDER: [f64; 5] = [1.5, 5.0, 30.0, 300.0, 3000.0];
/// Share of a period by which its sum over segments may be off.
const ROUNDING: f64 = 1e-13;

/// Whether boxes are proved to hold a single closed orbit that contain the start of a request, and all
/// periods within `unit` of its period.
///
/// What is true of that orbit is then true of each that begins in the box of the start, goes through
/// those of the nodes, and has such a period.
pub fn is_alone(request: &Request<'_>, unit: f64) -> Result<bool, Obstacle> {
    let state = request.state();
    let (shooting, _) = prepared(request, &state)?;
    let most = MOST_UNKNOWNS / request.model.dimension().max(1);
    let Request { model, start, period, .. } = request;
    for division in DIVISIONS {
        let nodes = division.nodes(&shooting.motion, model, start, *period, most);
        let search = match nodes
            .and_then(|nodes| OrbitSearch::new(&shooting, nodes.ok_or(Obstacle::TooLong)?))
        {
            Err(Obstacle::NoStep(_)) => continue,
            found => found?,
        };
        let nodes = &search.nodes;
        let offsets = search.offsets()?;
        let gaps = nodes.states[0].iter().zip(&state).map(|(x, y)| (x - y).abs());
        let gap = gaps.fold(0.0, f64::max);
        let late = (nodes.period - request.period).abs() + unit;
        let late = late + ROUNDING * (nodes.period + request.period);
        let speed = search.frames.phase.iter().map(|x| x * x).sum::<f64>().sqrt();
        let course = Course { search: &search, offsets: &offsets, radii: &offsets };
        let count = offsets.len();
        let alone = WIDER.iter().any(|wider| {
            let mut radii = vec![wider * gap.max(0.1 * speed * late); count];
            radii[count - 1] = 1.01 * late;
            gap < radii[0] && course.is_unique(&radii)
        });
        if alone {
            return Ok(true);
        }
    }
    Ok(false)
}
