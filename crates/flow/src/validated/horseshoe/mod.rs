//! Horseshoes proved by covering relations along a homoclinic orbit of a closed orbit.
//!
//! ```text
//! start, period ─ Newton ─▶ saddle ─ seek ─▶ homoclinic orbit ─ legs ─▶ N ⟹ N, N ⟹ M ⟹ … ⟹ N
//! ```
//!
//! docs/closed-orbits.md has the theorem, and its conditions on the numbers computed here.

mod chain;
mod chart;
mod cover;
mod legs;
mod path;
mod proved;
mod saddle;
mod seek;
mod sets;
mod strand;
mod vectors;

pub use cover::Margin;
pub use proved::{HorseshoeTrace, ProvedHorseshoe};
pub(super) use proved::{entropy, upper};

use super::enclosure::{Enclosure, raised};
use super::functions::norm;
use super::guess::Nodes;
use super::nearby::Nearby;
use super::replay::HorseshoeData;
use super::request::moved;
use super::shooting::{Shooting, combined};
use super::{Obstacle, Request, prepared};
use crate::motion::start::Start;
use chart::{Patch, SurfaceChart, are_joined};
use cover::{PlaneMap, Rectangle, is_hyperbolic, product};
use legs::{Crossed, Leg, LegFailure, crossed};
use path::{Path, joined};
use proved::relations;
use saddle::Saddle;
use seek::{Homoclinic, Seeker};
use sets::{chained, fitted};
use strand::{Strand, are_linked, bend, guessed, late, speeds};

/// Step size constants tried, and the order of the series: over wide boxes short steps of a low
/// order lose less.
const KAPPAS: [f64; 2] = [4.0, 4.6];
const ORDER: usize = 10;
/// Order of the series from points in a replay.
const REPLAY_ORDER: usize = 20;
/// Number of homoclinic orbits tried, and of sizes for each.
const MOST_PATHS: usize = 2;
const MOST_SIZES: usize = 2;
/// Limit on the nodes of a path.
const MOST_NODES: usize = 20_000;
/// Largest distance of a path's start from the saddle, against the saddle's state.
///
/// The enclosures of derivatives are wide by some hundred times the sides.
const LARGEST: f64 = 1e-6;
/// Side of the rectangle at the saddle, distance at which the path starts, and reach of the first
/// loop, as powers of the unstable multiplier: from one to the next.
const SHARE: f64 = 0.4;
const BEYOND: f64 = 0.2;
/// Largest share of the side at which a path ends.
const END: f64 = 0.5;

/// Proves that there is a horseshoe at a closed orbit near a state, with enclosures.
pub fn prove(request: &Request<'_>) -> Result<ProvedHorseshoe, Obstacle> {
    let Request { model, start, .. } = request;
    let state = request.state();
    let (mut shooting, numbers) = prepared(request, &state)?;
    let kept = shooting.functions.len();
    if state.len() != kept + 3 {
        return Err(Obstacle::Dimension(state.len() - kept));
    }
    shooting.motion.order = ORDER;
    let mut obstacle = Obstacle::NoOrbit;
    for kappa in KAPPAS {
        let saddle = match refined(request, &shooting, kappa) {
            Ok(saddle) => saddle,
            // Shorter segments have better chances.
            Err(problem @ Obstacle::NoStep(_)) => {
                obstacle = problem;
                continue;
            }
            Err(problem) => return Err(problem),
        };
        let seeker = Seeker::new(model, start, &shooting, &saddle)?;
        let found = seeker.find()?;
        if found.is_empty() {
            return Err(Obstacle::NoHomoclinic);
        }
        let search = HorseshoeSearch {
            request,
            shooting: &shooting,
            numbers: &numbers,
            saddle: &saddle,
            kappa,
        };
        let mut last = PathProblem::Path;
        for homoclinic in found.iter().take(MOST_PATHS) {
            let first = search.least_turns(homoclinic);
            for turns in first..first + MOST_SIZES {
                match search.along(&seeker, homoclinic, turns)? {
                    Ok(mut found) => {
                        let nodes = found.data.sets.iter().map(|set| &set.centre);
                        found.moved = moved(&found.start, &state, nodes);
                        return Ok(found);
                    }
                    Err(problem) => last = problem,
                }
            }
        }
        obstacle = Obstacle::NoCovering(last.text());
        if !matches!(last, PathProblem::Leg(LegFailure::Step)) {
            return Err(obstacle);
        }
    }
    Err(obstacle)
}

/// Saddle near the start, with nodes along the orbit that Newton's method finds: so they do not depend
/// on the digits to which the start and the period are given.
fn refined(request: &Request<'_>, shooting: &Shooting, kappa: f64) -> Result<Saddle, Obstacle> {
    let along = |start: &Start, period: f64| {
        let nodes = Nodes::along(request.model, start, period, kappa, MOST_NODES)?;
        Saddle::new(shooting, nodes.ok_or(Obstacle::TooLong)?)
    };
    let first = along(request.start, request.period)?;
    along(&request.start.with_state(&first.home.origin), first.period())
}

/// Reason why one homoclinic orbit proves nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
enum PathProblem {
    /// The path is too long.
    Size,
    /// The nodes are not found.
    Path,
    Leg(LegFailure),
    /// No sizes of rectangles fit.
    Fit,
    /// The rectangle at the saddle is not apart from that of the homoclinic orbit.
    Apart,
    /// The motion along the saddle is not proved hyperbolic.
    Cones,
    Relation,
}

impl PathProblem {
    fn text(self) -> &'static str {
        match self {
            PathProblem::Size => "it has too many nodes",
            PathProblem::Path => "Newton's method does not converge to one",
            PathProblem::Leg(LegFailure::Surface) => "a surface across it is not met in time",
            PathProblem::Leg(LegFailure::Step) => "a step is not proved",
            PathProblem::Fit => {
                "no rectangles have room: the stable and the unstable curves may touch"
            }
            PathProblem::Apart => "the rectangles are not apart",
            PathProblem::Cones => "the motion along the saddle is not proved hyperbolic",
            PathProblem::Relation => "an image of a rectangle does not cover the next",
        }
    }
}

struct HorseshoeSearch<'s, 'r> {
    request: &'s Request<'r>,
    shooting: &'s Shooting,
    /// Values of the conserved functions.
    numbers: &'s [f64],
    saddle: &'s Saddle,
    kappa: f64,
}

impl HorseshoeSearch<'_, '_> {
    /// Number of turns after which the path starts near enough to the saddle.
    fn least_turns(&self, homoclinic: &Homoclinic) -> usize {
        let most = LARGEST * norm(&self.saddle.home.origin);
        let growth = self.saddle.multipliers[0].abs();
        let turns = libm::log(homoclinic.start.abs() / most) / libm::log(growth);
        libm::ceil(turns).max(0.0) as usize
    }

    /// Tries the chain of a homoclinic orbit that takes some more turns along the saddle.
    fn along(
        &self,
        seeker: &Seeker<'_>,
        homoclinic: &Homoclinic,
        turns: usize,
    ) -> Result<Result<ProvedHorseshoe, PathProblem>, Obstacle> {
        let Self { request, shooting, saddle, kappa, .. } = self;
        let [out, back] = saddle.multipliers;
        let distance = homoclinic.start / libm::pow(out.abs(), turns as f64)
            * if turns.is_multiple_of(2) { 1.0 } else { out.signum() };
        let side = distance.abs() / libm::pow(out.abs(), SHARE);
        let mut arrivals = 0;
        let mut end = homoclinic.end.abs();
        while end > END * side && arrivals < 100 {
            arrivals += 1;
            end *= back.abs();
        }
        let start = request.start.with_state(&seeker.start(homoclinic.start));
        let most = MOST_NODES.saturating_sub((turns + arrivals) * saddle.len());
        let excursion = Nodes::along(request.model, &start, homoclinic.time, *kappa, most)?;
        let Some(excursion) = excursion else { return Ok(Err(PathProblem::Size)) };
        let guess = joined(saddle, (distance, turns), &excursion, (homoclinic.end, arrivals));
        let Some(path) = Path::new(shooting, saddle, guess) else {
            return Ok(Err(PathProblem::Path));
        };
        Ok(self.proved(&path, side))
    }

    /// Proves the covering relations of both loops.
    fn proved(&self, path: &Path, side: f64) -> Result<ProvedHorseshoe, PathProblem> {
        let Self { shooting, saddle, .. } = self;
        let home = &saddle.home;
        let square = Rectangle { middle: [0.0, 0.0], half: [side, side] };
        let first = &path.chain.states[0];
        let distance = home.coordinates(first)[0].abs();
        let own = &path.charts[0];
        let middle = own.coordinates(first);

        // Along the saddle, back to its surface.
        let ring = Strand {
            charts: saddle.charts.iter().collect(),
            centres: saddle.chain.states.iter().map(Vec::as_slice).collect(),
            middle: [0.0, 0.0],
            times: &saddle.chain.times,
            late: late(&saddle.links, &saddle.directions),
            speeds: speeds(shooting, &saddle.chain),
            last: home,
        };
        let reach = distance * libm::pow(saddle.multipliers[0].abs(), BEYOND);
        let wanted = Rectangle { middle: [0.0, 0.0], half: [reach, f64::INFINITY] };
        let guess = guessed(&saddle.directions, side, reach, 0.0);
        let (mut turn, mut halves) = ring.enclosed(shooting, guess, [side, side], &wanted)?;
        halves[0] = square.half;
        let Some(last_half) = halves.last() else { return Err(PathProblem::Path) };
        let place = halves.len() - 1;

        // One leg from the last set, over its final rectangle and within one window of times, leads
        // to the saddle's surface, on which the first set of the homoclinic orbit lies too: each
        // motion meets the plane once, and coordinates decide to which of the two it goes.
        let last_leg = |next| Leg {
            chart: ring.charts[place],
            centre: ring.centres[place],
            rectangle: Rectangle { middle: [0.0, 0.0], half: *last_half },
            time: ring.times[place],
            late: ring.late[place],
            speed: ring.speeds[place],
            next,
        };
        let both = crossed(shooting, &[last_leg(home), last_leg(own)]).map_err(PathProblem::Leg)?;
        let [back, onto] = both.as_slice() else { return Err(PathProblem::Path) };
        turn[place] = back.clone();
        let maps: Vec<PlaneMap> = turn.iter().map(|one| one.map).collect();
        let closing = |map: &PlaneMap, half: [f64; 2], other: &Rectangle| {
            map.covers(half, other).ok_or(PathProblem::Relation)
        };

        // Along the homoclinic orbit.
        let strand = Strand {
            charts: path.charts.iter().collect(),
            centres: path.chain.states.iter().map(Vec::as_slice).collect(),
            middle,
            times: &path.chain.times,
            late: late(&path.links, &path.directions),
            speeds: speeds(shooting, &path.chain),
            last: home,
        };
        let stable = 1.01 * (onto.map.extent(*last_half) + onto.map.off(middle)[1]);
        let guess = guessed(&path.directions, stable, side, bend(&maps, &halves));
        let (away, lengths) = strand.enclosed(shooting, guess, [0.0, stable], &square)?;
        let target = Rectangle { middle, half: lengths[0] };

        // Coordinates tell the states apart.
        let (Some(corner), Some(outset)) = (turn.first(), away.first()) else {
            return Err(PathProblem::Path);
        };
        let is_one = are_linked(shooting, &ring, &turn, &corner.states)
            && are_joined(shooting, own, &onto.ends, &outset.states)
            && are_linked(shooting, &strand, &away, &corner.states);
        if !is_one {
            return Err(PathProblem::Leg(LegFailure::Surface));
        }

        // All relations, over the final sizes.
        let returning = closing(&back.map, *last_half, &square)?;
        closing(&onto.map, *last_half, &target)?;
        let (inner, tail) = (&maps[..place], &halves[..place]);
        let next = Rectangle { middle: [0.0, 0.0], half: *last_half };
        if !inner.is_empty() {
            chained(inner, tail, &next).ok_or(PathProblem::Relation)?;
        }
        let outer: Vec<PlaneMap> = away.iter().map(|one| one.map).collect();
        chained(&outer, &lengths, &square).ok_or(PathProblem::Relation)?;
        let (Some(end_map), Some(end_half)) = (outer.last(), lengths.last()) else {
            return Err(PathProblem::Path);
        };
        let arrival = closing(end_map, *end_half, &square)?;

        // The rectangle of the homoclinic orbit lies beyond that at the saddle.
        let patch = Patch::new(shooting, own, first, middle, target.half)
            .ok_or(PathProblem::Leg(LegFailure::Surface))?;
        if !is_beyond(home, first, &patch, target.half, side) {
            return Err(PathProblem::Apart);
        }
        let unit = [[1.0, 0.0], [0.0, 1.0]].map(|row| row.map(Enclosure::exact));
        let whole = maps.iter().fold(unit, |whole, map| product(&map.slopes, &whole));
        if !is_hyperbolic(&whole) {
            return Err(PathProblem::Cones);
        }
        let sum = |legs: &[Crossed]| legs.iter().fold(Enclosure::ZERO, |sum, leg| sum + leg.time);
        let short = sum(&turn);
        let long = sum(&turn[..place]) + onto.time + sum(&away);
        let node = |state: &Vec<f64>| {
            let nodes = saddle.chain.states.iter();
            nodes.map(|other| chain::distance(state, other)).fold(f64::INFINITY, f64::min)
        };
        Ok(ProvedHorseshoe {
            start: corner.states.clone(),
            half: square.half,
            times: [short, long],
            entropy: entropy([upper(short), upper(long)]),
            relations: maps.len() + 1 + outer.len(),
            kept: shooting.functions.len(),
            persists: self.persists(turn.iter().chain([onto]).chain(&away)),
            moved: 0.0,
            trace: Some(HorseshoeTrace {
                margin: Margin {
                    unstable: side / lengths_needed(&maps, &halves, &wanted),
                    stable: returning.stable.min(arrival.stable),
                },
                multipliers: saddle.multipliers,
                away: path.chain.states.iter().map(node).fold(0.0, f64::max),
            }),
            data: HorseshoeData {
                orders: [REPLAY_ORDER, ORDER],
                functions: shooting.functions.used().to_vec(),
                values: self.numbers.to_vec(),
                relations: relations(maps.len(), outer.len()),
                sets: [ring.sets(&turn, &halves), strand.sets(&away, &lengths)].concat(),
            },
        })
    }

    /// Whether the field is analytic about legs for all parameters near those of the case.
    fn persists<'c>(&self, legs: impl Iterator<Item = &'c Crossed>) -> bool {
        let (starts, times): (Vec<_>, Vec<_>) =
            legs.map(|leg| (leg.states.clone(), leg.time)).unzip();
        let nearby = Nearby::new(&self.request.laws());
        nearby.is_some_and(|one| one.is_analytic(self.shooting.motion.order, &starts, &times))
    }
}

/// First unstable half side that a chain needs.
fn lengths_needed(maps: &[PlaneMap], halves: &[[f64; 2]], last: &Rectangle) -> f64 {
    let first = halves.first().map_or(0.0, |half| half[1]);
    fitted(maps, halves, first, last).first().map_or(f64::NAN, |half| half[0])
}

/// Whether a rectangle about a state lies beyond a side in the unstable coordinate of a chart.
fn is_beyond(
    home: &SurfaceChart,
    centre: &[f64],
    patch: &Patch,
    half: [f64; 2],
    side: f64,
) -> bool {
    let [row, _] = &home.rows;
    let off: Vec<Enclosure> = centre
        .iter()
        .zip(&home.origin)
        .zip(&patch.middle)
        .map(|((x, o), shift)| Enclosure::exact(*x) - Enclosure::exact(*o) + *shift)
        .collect();
    let at = combined(row, &off);
    let spread = [0, 1].map(|k: usize| {
        let slopes: Vec<Enclosure> = patch.slopes.iter().map(|slope| slope[k]).collect();
        combined(row, &slopes).magnitude() * half[k]
    });
    let reach = raised(spread[0] + spread[1] + at.rad, 4);
    let least = at.mid.abs() * (1.0 - 2.0 * f64::EPSILON);
    at.is_finite() && reach.is_finite() && least > raised(side + reach, 2)
}

#[cfg(test)]
mod tests;
