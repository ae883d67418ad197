//! Maps between the surfaces at neighbouring nodes, enclosed over rectangles of coordinates.
//!
//! ```text
//! P(z) = L' (φ(t(z), X(z)) - o'),  (n', φ(t(z), X(z)) - o') = 0
//! DP = L' (V W - f (n'ᵀ V W)/(n', f)),  W = X', V the derivative of the flow, f the field there
//! ```

use super::super::enclosure::{Enclosure, raised};
use super::super::motion::Boxed;
use super::super::shooting::{Shooting, combined};
use super::chart::{Patch, SurfaceChart};
use super::cover::{PlaneMap, Rectangle};
use rayon::prelude::*;

/// Room for the time of the passage, against the time expected, and besides as a share of the time
/// that the sides of the rectangle take.
const ROOM: f64 = 1.5;
const SHARE: f64 = 0.1;
const LEAST: f64 = 1e-14;
/// Number of legs enclosed on one thread; the tails of a leg begin with those of the leg before.
const STRETCH: usize = 256;

/// Leg of a motion from a surface to another.
#[derive(Clone, Copy)]
pub struct Leg<'l> {
    /// Chart and approximate point at the middle of the rectangle.
    pub chart: &'l SurfaceChart,
    pub centre: &'l [f64],
    pub rectangle: Rectangle,
    /// Time after which the centre meets the other surface, approximately.
    pub time: f64,
    /// Changes of that time with the coordinates, approximately.
    pub late: [f64; 2],
    /// Speed at the centre, approximately.
    pub speed: f64,
    pub next: &'l SurfaceChart,
}

/// Enclosed leg.
#[derive(Clone, Debug)]
pub struct Crossed {
    pub map: PlaneMap,
    /// Times of all motions that start in the rectangle.
    pub time: Enclosure,
    /// Radius ρ of the norm in which the tails are bounded.
    pub tail: f64,
    /// Box of all states over the rectangle.
    pub states: Boxed,
    /// Box of all states at the ends.
    pub ends: Boxed,
}

/// Reason why a leg is not enclosed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LegFailure {
    /// The points of the surface are not enclosed, or are not met in time.
    Surface,
    /// The step is not proved.
    Step,
}

/// Encloses legs; the failure of the first that fails.
pub fn crossed(shooting: &Shooting, legs: &[Leg<'_>]) -> Result<Vec<Crossed>, LegFailure> {
    let stretches = legs.par_chunks(STRETCH).map(|legs| stretch(shooting, legs));
    let stretches: Vec<Result<Vec<Crossed>, LegFailure>> = stretches.collect();
    stretches.into_iter().try_fold(Vec::new(), |mut all, found| {
        all.extend(found?);
        Ok(all)
    })
}

/// Encloses legs on one thread.
fn stretch(shooting: &Shooting, legs: &[Leg<'_>]) -> Result<Vec<Crossed>, LegFailure> {
    let mut patches = Vec::new();
    for leg in legs {
        let Rectangle { middle, half } = leg.rectangle;
        let patch = Patch::new(shooting, leg.chart, leg.centre, middle, half);
        patches.push(patch.ok_or(LegFailure::Surface)?);
    }
    let window = |leg: &Leg<'_>| {
        let half = leg.rectangle.half;
        let late = leg.late[0].abs() * half[0] + leg.late[1].abs() * half[1];
        ROOM * late + SHARE * (half[0] + half[1]) / leg.speed + LEAST
    };
    let times: Boxed = legs.iter().map(|leg| Enclosure::about(leg.time, window(leg))).collect();
    let starts: Vec<Boxed> = patches.iter().map(|patch| patch.states.clone()).collect();
    let passages = shooting.motion.passages(&starts, &times);
    let centres: Vec<Vec<f64>> = legs.iter().map(|leg| leg.centre.to_vec()).collect();
    let middles: Vec<f64> = legs.iter().map(|leg| leg.time).collect();
    let targets: Vec<&[f64]> = legs.iter().map(|leg| leg.next.origin.as_slice()).collect();
    let gaps = shooting.motion.gaps(&centres, &middles, 1.0, &targets);
    let mut ends = Vec::new();
    for passage in &passages {
        ends.push(passage.as_ref().ok_or(LegFailure::Step)?.end.clone());
    }
    let fields = shooting.motion.field(&ends);
    let mut found = Vec::new();
    for (index, (leg, patch)) in legs.iter().zip(&patches).enumerate() {
        let (Some(passage), Some(gap)) = (&passages[index], &gaps[index]) else {
            return Err(LegFailure::Step);
        };
        let flow = &passage.derivative;
        let map = mapped(leg, patch, flow, &fields[index], gap, times[index]);
        let map = map.ok_or(LegFailure::Surface)?;
        let (states, ends) = (patch.states.clone(), ends[index].clone());
        let tail = passage.radius;
        found.push(Crossed { map, time: times[index], tail, states, ends });
    }
    Ok(found)
}

/// Encloses the map of a leg from the derivative of the flow over its states and times, the field
/// over the ends, and the end from the centre less the origin of the next surface. `None` where not
/// every motion is proved to cross that surface, upwards and once, in these times.
fn mapped(
    leg: &Leg<'_>,
    patch: &Patch,
    flow: &[Boxed],
    field: &Boxed,
    gap: &Boxed,
    time: Enclosure,
) -> Option<PlaneMap> {
    let SurfaceChart { normal, rows, .. } = leg.next;
    let speed = combined(normal, field);
    if !speed.is_positive() {
        return None;
    }
    let per_speed = speed.recip();
    let product = |row: &Boxed, vector: &dyn Fn(usize) -> Enclosure| {
        let terms = row.iter().enumerate();
        terms.fold(Enclosure::ZERO, |sum, (k, x)| sum + *x * vector(k))
    };
    let moved = |k: usize| -> Boxed {
        flow.iter().map(|row| product(row, &|place| patch.slopes[place][k])).collect()
    };
    let axes = [moved(0), moved(1)];
    let shifts = flow.iter().map(|row| product(row, &|place| patch.middle[place]));
    let middle: Boxed = gap.iter().zip(shifts).map(|(x, shift)| *x + shift).collect();
    // The surface is met within the times if the height there is below speed times their radius.
    let height = |vector: &Boxed| combined(normal, vector).magnitude();
    let half = leg.rectangle.half;
    let high = raised(height(&middle) + height(&axes[0]) * half[0] + height(&axes[1]) * half[1], 4);
    let least = speed.mid - speed.rad;
    let room = time.rad * least;
    // time.mid is the time of the gap
    let is_met = high < room - 4.0 * f64::EPSILON * (room + time.rad * speed.magnitude());
    if !is_met || time.mid != leg.time {
        return None;
    }
    let turned = |vector: &Boxed, row: &[f64]| {
        let late = combined(normal, vector) * per_speed;
        combined(row, vector) - combined(row, field) * late
    };
    let map = PlaneMap {
        middle: [turned(&middle, &rows[0]), turned(&middle, &rows[1])],
        slopes: [0, 1].map(|row: usize| [0, 1].map(|k: usize| turned(&axes[k], &rows[row]))),
    };
    map.middle.iter().chain(map.slopes.iter().flatten()).all(|x| x.is_finite()).then_some(map)
}
