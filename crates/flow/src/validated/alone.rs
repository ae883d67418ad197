//! Boxes about a closed orbit that hold no other one which begins as near to a start.
//!
//! ```text
//! states nearer to the start than the orbit ─ to its phase ─▶ box of node 0 ─ steps ─▶ boxes of all nodes
//! ```
//!
//! A closed orbit that begins in the first box, with a period in its box, goes through the others. If
//! Krawczyk's operator maps all of them into their interior, there is one zero in them: the orbit found.

use super::course::Course;
use super::division::DIVISIONS;
use super::enclosure::{Enclosure, raised};
use super::forward::Cloud;
use super::motion::Boxed;
use super::shooting::{combined, times};
use super::{MOST_UNKNOWNS, Obstacle, OrbitSearch, Request, prepared};

/// Factors by which boxes are made wider than those that hold all motions from the first: some have
/// room for Krawczyk's operator.
const WIDER: [f64; 4] = [1.01, 5.0, 30.0, 300.0];
/// Change of the velocity within the first box that is allowed for.
const TURN: f64 = 1.1;
/// Shares of the doubt about the period within which closed orbits are sought; beyond them motions are
/// not back at the phase, in ranges of times from one end to a multiple of it.
const SHARES: [f64; 4] = [1e-4, 1e-2, 0.1, 1.0];
const STRETCH: f64 = 3.0;
/// Share of the first box within which an orbit begins that is the one in it.
const NEXT: f64 = 0.25;
/// Share of a period by which its sum over segments may be off.
const ROUNDING: f64 = 1e-13;

/// Whether a closed orbit that was found, from its start and period, is proved to be the only one that
/// begins as near to the start of a request and has a period within `unit` of that of the request.
pub fn is_alone(
    request: &Request<'_>,
    unit: f64,
    found: (&[Enclosure], Enclosure),
) -> Result<bool, Obstacle> {
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
        let late = 1.01 * (late + ROUNDING * (nodes.period + request.period));
        // With boxes of parameters each of them has its orbit.
        let gap = gap + offsets[..state.len()].iter().copied().fold(0.0, f64::max);
        let Some(first) = search.first_radius(gap) else { continue };
        if !search.is_orbit(found, first, late) {
            continue;
        }
        let course = Course { search: &search, offsets: &offsets, radii: &offsets };
        let is_alone = |share: &f64| {
            let near = share * late;
            search.closes_near(first, near, late) && course.is_unique_within(first, near)
        };
        if SHARES.iter().any(is_alone) {
            return Ok(true);
        }
    }
    Ok(false)
}

impl Course<'_> {
    /// Whether one closed orbit begins in a box of this radius about the first node, with a period within
    /// `late` of that of the nodes.
    fn is_unique_within(&self, first: f64, late: f64) -> bool {
        let nodes = &self.search.nodes;
        let period = Enclosure::about(nodes.period, late);
        let Some((tube, _)) = self.search.carried(first, period) else { return false };
        let largest = tube.iter().copied().fold(0.0, f64::max);
        let alike = vec![largest; tube.len()];
        let speed = self.search.frames.phase.iter().map(|x| x * x).sum::<f64>().sqrt();
        // Boxes about the period are as wide as those about the states, which change it.
        let period = late.max(largest / speed);
        WIDER.iter().any(|wider| {
            [&tube, &alike].into_iter().any(|radii| {
                let radii = radii.iter().chain([&period]).map(|radius| wider * radius);
                self.is_unique(&radii.collect::<Vec<f64>>())
            })
        })
    }
}

impl OrbitSearch<'_> {
    /// Radius of a box about the first node that holds all motions that begin no farther from the start
    /// than `gap`, the distance of this node, where they have its phase. `None` where the velocity is
    /// not nearly the same all over the box.
    fn first_radius(&self, gap: f64) -> Option<f64> {
        let phase = &self.frames.phase;
        let norm = |power: i32| phase.iter().map(|x| x.abs().powi(power)).sum::<f64>();
        let (sum, square) = (norm(1), norm(2));
        let largest = phase.iter().fold(0.0, |a: f64, x| a.max(x.abs()));
        // Such a state x has |x - x̂₀| ≤ 2 gap, and comes to the phase in a time of |(v̂, x - x̂₀)|/(v̂, v).
        let reach = 2.0 * gap * (1.0 + TURN * TURN * sum * largest / square);
        let radius = TURN * reach;
        let node: Boxed =
            self.nodes.states[0].iter().map(|x| Enclosure::about(*x, radius)).collect();
        let field = self.shooting.motion.field(&[node]).pop()?;
        let along = combined(phase, &field);
        let is_fast = (along - Enclosure::exact(square / TURN)).is_positive();
        let is_slow = field.iter().all(|x| x.magnitude() <= TURN * largest);
        (is_fast && is_slow).then_some(radius)
    }

    /// Whether an orbit found before begins next to the first node and has a period that counts here.
    fn is_orbit(&self, (start, period): (&[Enclosure], Enclosure), first: f64, late: f64) -> bool {
        let near = |(x, node): (&Enclosure, &f64)| (x.mid - node).abs() <= NEXT * first + x.rad;
        (period.mid - self.nodes.period).abs() <= late + period.rad
            && start.iter().zip(&self.nodes.states[0]).all(near)
    }

    /// Whether no motion from a box of this radius about the first node, at its phase, is back at the
    /// phase after a time that differs from the period by more than `near`, and less than `late`.
    fn closes_near(&self, first: f64, near: f64, late: f64) -> bool {
        let ends = std::iter::successors(Some(near), |end| Some(STRETCH * end));
        let ranges = ends.take_while(|end| *end < late).map(|end| [end, (STRETCH * end).min(late)]);
        ranges.flat_map(|range| [range, range.map(|end| -end)]).all(|[from, to]| {
            let (middle, half) = (0.5 * (from + to), 0.5 * (to - from).abs());
            let period = Enclosure::about(self.nodes.period + middle, 1.01 * half);
            let Some((_, end)) = self.carried(first, period) else { return false };
            let origin = self.nodes.states[0].iter().map(|x| Enclosure::exact(*x));
            let gap: Boxed = end.iter().zip(origin).map(|(x, o)| *x - o).collect();
            let height = combined(&self.frames.phase, &gap);
            height.is_positive() || (-height).is_positive()
        })
    }

    /// Radii of boxes about all nodes through which all motions go that begin in a box of this radius
    /// about the first, at the shares of these periods, and the box of their ends.
    fn carried(&self, first: f64, period: Enclosure) -> Option<(Vec<f64>, Boxed)> {
        let Self { shooting, nodes, .. } = self;
        let motion = &shooting.motion;
        let begin: Boxed = nodes.states[0].iter().map(|x| Enclosure::about(*x, first)).collect();
        let mut cloud = Cloud::about(&begin);
        let mut radii = Vec::new();
        for (h, node) in times(nodes, period).into_iter().zip(&nodes.states) {
            let hull = cloud.hull();
            let reach = |(x, node): (&Enclosure, &f64)| raised((x.mid - node).abs() + x.rad, 2);
            radii.extend(hull.iter().zip(node).map(reach));
            let centre: Boxed = hull.iter().map(|x| Enclosure::exact(x.mid)).collect();
            let passage = motion.passages(&[hull], &[h]).pop()??;
            let middle = motion.passages(&[centre], &[Enclosure::exact(h.mid)]).pop()??;
            let target: Vec<f64> = middle.end.iter().map(|x| x.mid).collect();
            let field = motion.field(std::slice::from_ref(&passage.end)).pop()?;
            let late = Enclosure::about(0.0, h.rad);
            let gap: Boxed = (middle.end.iter().zip(&target).zip(field))
                .map(|((x, y), rate)| *x - Enclosure::exact(*y) + rate * late)
                .collect();
            cloud = cloud.moved(&passage, &gap, &target)?;
        }
        Some((radii, cloud.hull()))
    }
}
