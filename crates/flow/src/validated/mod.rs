//! Motions enclosed by Taylor steps in balls: from a state, by Lohner's method, and closed orbits
//! proved by Krawczyk's method on multiple shooting.
//!
//! ```text
//! start, period ─ follow ─▶ nodes ─ Newton ─▶ nodes ─ boxes, K(Y) ⊂ Y ─▶ one closed orbit, ∮ div v
//! ```
//!
//! docs/closed-orbits.md has the theorem, and its conditions on the numbers computed here.

mod alone;
mod band;
mod coefficients;
mod course;
mod division;
mod enclosure;
mod forward;
mod functions;
mod guess;
mod horseshoe;
mod krawczyk;
mod laws;
mod least;
mod motion;
mod multipliers;
mod nearby;
mod obstacle;
mod plan;
mod replay;
mod request;
mod sharp;
mod shooting;
mod tail;
#[cfg(test)]
mod tests;

pub use alone::is_alone;
pub use enclosure::Enclosure;
pub(crate) use enclosure::raised as raised_sum;
pub use forward::{Reached, follow};
pub use horseshoe::{HorseshoeTrace, Margin, ProvedHorseshoe, prove as prove_horseshoe};
pub(crate) use krawczyk::Inverse;
pub use least::Doubt;
pub use obstacle::Obstacle;
pub use replay::{CoveringSet, HorseshoeData, ProofData, replay, replay_horseshoe};
pub use request::Request;
pub(crate) use shooting::combined;

use course::Course;
use division::DIVISIONS;
use functions::Functions;
use guess::Nodes;
use krawczyk::is_regular;
use motion::{Boxed, EnclosedMotion, EnclosedPassage, ORDER};
use nearby::Nearby;
use request::moved;
use shooting::{Frames, Shooting, boxes, times};

/// Largest number of unknowns; the inverse has its square of entries.
const MOST_UNKNOWNS: usize = 6000;
/// Limit on the iterations of Newton's method, and the step after which it has converged.
const MOST_ITERATIONS: usize = 12;
const CONVERGED: f64 = 1e-8;
/// Step, relative to the unknowns, from which on the next nodes may be near no orbit.
const FAR: f64 = 1e-2;
/// Limit on the boxes tried, and the growth from one to the next.
const MOST_BOXES: usize = 6;
const GROWTH: f64 = 1.3;
/// Least radius of a box, relative to the unknown.
const LEAST_RADIUS: f64 = 1e-15;

/// A closed orbit that is proved to exist.
#[derive(Clone, Debug)]
pub struct ProvedOrbit {
    /// Box that contains exactly one point of such an orbit with the phase of the start.
    pub start: Vec<Enclosure>,
    /// Time after which the orbit closes.
    pub period: Enclosure,
    /// Number of times that the orbit is run through in the period; 1 if that is the least one.
    pub turns: Result<usize, Doubt>,
    /// Integral of the divergence on the level along it.
    pub volume: Enclosure,
    /// Number of multipliers on the level of all conserved functions.
    pub multipliers: usize,
    /// Sum of two multipliers, where asked for and enclosed.
    pub sum: Option<Enclosure>,
    /// Number of segments.
    pub segments: usize,
    /// Largest radius of the boxes of its nodes.
    pub radius: f64,
    /// Bound of ‖1 - C G'‖ over the boxes.
    pub contraction: f64,
    /// Distance between the state given and the orbit's node, relative to the state.
    pub moved: f64,
    /// Number of conserved functions, the level's among them.
    pub kept: usize,
    /// Whether the field is proved analytic near the orbit for all parameters near those of the case,
    /// so that the orbit persists.
    pub persists: bool,
    /// Numbers by which the proof can be replayed.
    pub data: ProofData,
}

/// Prepares proofs about motions near a state, with the conserved functions that are independent
/// there; returns the numbers that say which values these have, too.
fn prepared(request: &Request<'_>, state: &[f64]) -> Result<(Shooting, Vec<f64>), Obstacle> {
    let mut functions = Functions::new(&request.laws())?;
    let numbers = functions.choose(state);
    if functions.of_level_in_use() < functions.of_level {
        return Err(Obstacle::Level);
    }
    let values = request.values(&functions, &numbers)?;
    let motion = EnclosedMotion::new(&request.laws())?;
    Ok((Shooting { motion, functions, values }, numbers))
}

/// Proves that there is a closed orbit near a state, with enclosures.
pub fn prove(request: &Request<'_>) -> Result<ProvedOrbit, Obstacle> {
    let Request { model, start, .. } = request;
    let state = request.state();
    let (shooting, numbers) = prepared(request, &state)?;
    let mut obstacle = Obstacle::NoOrbit;
    let most = MOST_UNKNOWNS / model.dimension().max(1);
    for division in DIVISIONS {
        let nodes = division.nodes(&shooting.motion, model, start, request.period, most);
        match nodes
            .and_then(|nodes| OrbitSearch::new(&shooting, nodes.ok_or(Obstacle::TooLong)?))
            .and_then(|search| search.prove(request.wants_multipliers))
        {
            Ok(mut found) => {
                found.moved = moved(&found.start, &state, found.data.nodes.iter());
                found.data.values = numbers;
                let nearby = Nearby::new(&request.laws());
                found.persists = nearby.is_some_and(|nearby| nearby.is_analytic_along(&found.data));
                return Ok(found);
            }
            // Shorter segments have better chances.
            Err(problem @ (Obstacle::NoStep(_) | Obstacle::Strays)) => obstacle = problem,
            Err(Obstacle::TooLong) if !matches!(obstacle, Obstacle::NoOrbit) => break,
            Err(problem) => return Err(problem),
        }
    }
    Err(obstacle.of_field(&shooting.motion))
}

/// Nodes near a closed orbit, with an approximate inverse of the derivative there.
struct OrbitSearch<'s> {
    shooting: &'s Shooting,
    nodes: Nodes,
    frames: Frames,
    inverse: Inverse,
}

impl<'s> OrbitSearch<'s> {
    /// Moves the nodes to a closed orbit by Newton's method.
    fn new(shooting: &'s Shooting, mut nodes: Nodes) -> Result<Self, Obstacle> {
        let order = shooting::folded(shooting.motion.dimension, nodes.states.len());
        let size = nodes.states.iter().flatten().fold(nodes.period, |a, b| a.max(b.abs()));
        let mut last = f64::INFINITY;
        for _ in 0..MOST_ITERATIONS {
            // The first nodes are those of a motion; later ones, far from an orbit, may be none.
            let strays = |problem| match problem {
                Obstacle::NoStep(_) if last > FAR * size && last.is_finite() => Obstacle::Strays,
                other => other,
            };
            let frames = shooting.frames(&nodes).ok_or(Obstacle::NoOrbit)?;
            let starts = boxes(&nodes, None);
            let passages = passages(shooting, &nodes, &starts, Enclosure::exact(nodes.period))
                .map_err(strays)?;
            let columns = shooting.derivative(&nodes, &frames, &starts, &passages);
            let inverse = Inverse::new(&columns, &order).ok_or(Obstacle::Degenerate)?;
            let step = inverse.times(&residual(shooting, &nodes, &frames).map_err(strays)?);
            let length = step.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
            if !length.is_finite() || length > size {
                return Err(Obstacle::NoOrbit);
            }
            nodes.move_by(&step.iter().map(|x| -x).collect::<Vec<_>>());
            if nodes.period <= 0.0 {
                return Err(Obstacle::NoOrbit);
            }
            if length <= CONVERGED * size {
                return Ok(Self { shooting, nodes, frames, inverse });
            }
            if length > 2.0 * last {
                return Err(Obstacle::NoOrbit);
            }
            last = length;
        }
        Err(Obstacle::NoOrbit)
    }

    /// Bounds of ‖C G‖ at the nodes, unknown by unknown, for all values of the parameters.
    fn offsets(&self) -> Result<Vec<f64>, Obstacle> {
        let Self { shooting, nodes, frames, inverse } = self;
        let mut offsets = inverse.bounds(&residual(shooting, nodes, frames)?);
        if shooting.motion.loose > 0 {
            // By the mean value theorem in the parameters, at the nodes.
            let starts = boxes(nodes, None);
            let passages = passages(shooting, nodes, &starts, Enclosure::exact(nodes.period))?;
            for column in shooting.by_parameters(frames, &starts, &passages) {
                let moved = inverse.bounds(&column);
                offsets = offsets.iter().zip(&moved).map(|(a, b)| raised(a, b)).collect();
            }
        }
        Ok(offsets)
    }

    /// Finds boxes that Krawczyk's operator maps into their interior.
    fn prove(mut self, wants_multipliers: bool) -> Result<ProvedOrbit, Obstacle> {
        // To the last digit of f64: the residual has twice as many.
        let step = self.inverse.times(&residual(self.shooting, &self.nodes, &self.frames)?);
        self.nodes.move_by(&step.iter().map(|x| -x).collect::<Vec<_>>());
        let Self { shooting, nodes, frames, inverse } = &self;
        let offsets = self.offsets()?;
        let unknowns: Vec<f64> =
            nodes.states.iter().flatten().copied().chain([nodes.period]).collect();
        let floor = |x: &f64| LEAST_RADIUS * x.abs().max(1.0);
        let mut radii: Vec<f64> =
            offsets.iter().zip(&unknowns).map(|(z, x)| 2.0 * z + floor(x)).collect();
        let mut contraction = f64::NAN;
        for _ in 0..MOST_BOXES {
            let starts = boxes(nodes, Some(&radii));
            let period = Enclosure::about(nodes.period, radii[radii.len() - 1]);
            let passages = match passages(shooting, nodes, &starts, period) {
                // What is not contracted grows until no step is proved.
                Err(Obstacle::NoStep(_)) if contraction >= 1.0 => break,
                found => found?,
            };
            let columns = shooting.derivative(nodes, frames, &starts, &passages);
            let (moved, norm) = inverse.defects(&columns, &radii);
            contraction = norm;
            let images: Vec<f64> = offsets.iter().zip(&moved).map(|(z, d)| raised(z, d)).collect();
            if images.iter().zip(&radii).all(|(image, radius)| image < radius) {
                let mut found = self.proved(&starts, &passages, &images, norm)?;
                found.data.radii = radii;
                let course = Course { search: &self, offsets: &offsets, radii: &images };
                found.turns = least::turns(&course);
                if wants_multipliers && found.multipliers == 2 {
                    found.sum = multipliers::sum(shooting, frames, &starts, &passages);
                }
                return Ok(found);
            }
            if !images.iter().all(|x| x.is_finite()) {
                break;
            }
            radii = images.iter().zip(&unknowns).map(|(k, x)| GROWTH * k + floor(x)).collect();
        }
        Err(match shooting.motion.loose {
            0 => Obstacle::NoContraction(contraction),
            _ => Obstacle::TooWide(contraction),
        })
    }

    /// Checks that the segments fit together, and gathers the enclosures. The zero lies in the image
    /// of the boxes, which is narrower.
    fn proved(
        &self,
        starts: &[Boxed],
        passages: &[EnclosedPassage],
        radii: &[f64],
        contraction: f64,
    ) -> Result<ProvedOrbit, Obstacle> {
        let Self { shooting, nodes, frames, .. } = self;
        for (index, passage) in passages.iter().enumerate() {
            let next = (index + 1) % starts.len();
            let hull: Boxed =
                passage.end.iter().zip(&starts[next]).map(|(x, y)| x.hull(*y)).collect();
            let directions = frames.across[next].iter();
            let mut rows: Vec<Boxed> = directions
                .map(|direction| direction.iter().map(|x| Enclosure::exact(*x)).collect())
                .collect();
            rows.extend(shooting.functions.slopes(&hull));
            if !is_regular(&rows) {
                return Err(Obstacle::Gradients);
            }
        }
        let shares = nodes.shares.iter();
        let share = shares.fold(Enclosure::ZERO, |sum, share| sum + Enclosure::exact(*share));
        let period = Enclosure::about(nodes.period, radii[radii.len() - 1]);
        let volumes = passages.iter().map(|passage| passage.volume);
        Ok(ProvedOrbit {
            start: boxes(nodes, Some(radii)).swap_remove(0),
            period: share * period,
            turns: Err(Doubt::Start),
            volume: volumes.fold(Enclosure::ZERO, |sum, volume| sum + volume),
            multipliers: shooting.motion.dimension.saturating_sub(shooting.functions.len() + 1),
            sum: None,
            segments: starts.len(),
            radius: radii.iter().copied().fold(0.0, f64::max),
            contraction,
            moved: 0.0,
            kept: shooting.functions.len(),
            persists: false,
            data: ProofData {
                order: ORDER,
                functions: shooting.functions.used().to_vec(),
                values: Vec::new(),
                nodes: nodes.states.clone(),
                shares: nodes.shares.clone(),
                period: nodes.period,
                radii: Vec::new(),
                tails: passages.iter().map(|passage| passage.radius).collect(),
            },
        })
    }
}

/// Upper bound of a sum of two bounds.
fn raised(a: &f64, b: &f64) -> f64 {
    enclosure::raised(a + b, 1)
}

fn passages(
    shooting: &Shooting,
    nodes: &Nodes,
    starts: &[Boxed],
    period: Enclosure,
) -> Result<Vec<EnclosedPassage>, Obstacle> {
    all(nodes, shooting.motion.passages(starts, &times(nodes, period)))
}

fn residual(
    shooting: &Shooting,
    nodes: &Nodes,
    frames: &Frames,
) -> Result<Vec<Enclosure>, Obstacle> {
    shooting.residual(nodes, frames).map_err(|index| Obstacle::NoStep(time(nodes, index)))
}

/// Approximate time of a node.
fn time(nodes: &Nodes, index: usize) -> f64 {
    nodes.shares[..index].iter().fold(0.0, |sum, share| sum + share) * nodes.period
}

/// Results of all segments, or the time of the first that has none.
fn all<T>(nodes: &Nodes, found: Vec<Option<T>>) -> Result<Vec<T>, Obstacle> {
    let failed = found.iter().position(Option::is_none);
    match failed {
        Some(index) => Err(Obstacle::NoStep(time(nodes, index))),
        None => Ok(found.into_iter().flatten().collect()),
    }
}
