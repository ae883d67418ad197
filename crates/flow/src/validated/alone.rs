//! Boxes about a closed orbit that hold no other one which begins as near to a start.
//!
//! ```text
//! states nearer to the start than the orbit ─ to its phase ─▶ box of node 0 ─ steps ─▶ boxes of all nodes
//! ```
//!
//! A closed orbit that begins in the first box, with a period in its box, goes through the others. If
//! Krawczyk's operator maps all of them into their interior, there is one zero in them: the orbit found. Closed
//! orbits with other values of the energy or of an integral count, too: there is one for each of the values that
//! states in the first box have, and its period is bounded.

use liouville::order::StableOrder;

use super::course::Course;
use super::division::DIVISIONS;
use super::enclosure::{Enclosure, raised};
use super::forward::Cloud;
use super::functions::Functions;
use super::motion::{Boxed, EnclosedPassage};
use super::shooting::{combined, times};
use super::{LEAST_RADIUS, MOST_UNKNOWNS, Obstacle, OrbitSearch, Request, prepared};

/// Factors by which boxes are made wider than those that hold all orbits from the first: some have
/// room for Krawczyk's operator.
const WIDER: [f64; 4] = [1.5, 5.0, 30.0, 300.0];
/// Sides of further boxes, in what a motion covers in the doubt about the period.
const WIDE: [f64; 5] = [0.15, 0.5, 3.0, 30.0, 300.0];
/// Factors by which boxes that are foreseen to hold a tube are wider than its first one.
const ROOMS: [f64; 5] = [4.0, 30.0, 300.0, 3e3, 3e4];
/// Change of the velocity within the first box that is allowed for.
const TURN: f64 = 1.1;
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
    // Of orbits of a family with the period stated nothing else is known.
    let is_late = (found.1.mid - request.period).abs() > unit + found.1.rad;
    if !is_late && is_family(request, &shooting.functions) {
        return Ok(false);
    }
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
        let Some(reach) = search.reach(first, late) else { continue };
        let family = search.family(request, first);
        let others = family.as_ref().map(|column| search.inverse.bounds(column));
        let sum = |others: &Vec<f64>| -> Vec<f64> {
            offsets.iter().zip(others).map(|(a, b)| raised(a + b, 1)).collect()
        };
        let offsets = others.as_ref().map_or_else(|| offsets.clone(), sum);
        let course = Course { search: &search, offsets: &offsets, radii: &offsets };
        let shift = (nodes.period - request.period).abs();
        let differs = |image: f64| 1.01 * (image + unit + ROUNDING * nodes.period) < shift;
        let speed = search.frames.phase.iter().map(|x| x * x).sum::<f64>().sqrt();
        let sides = WIDER.iter().map(|wider| wider * reach);
        let sides = sides.chain(WIDE.iter().map(|share| share * speed * late));
        let mut sides: Vec<f64> = sides.filter(|side| *side >= reach).collect();
        sides.order_by(f64::total_cmp);
        let period = offsets.len() - 1;
        let mut alone = false;
        for side in sides {
            let mut radii = vec![side; offsets.len()];
            radii[period] = late;
            let Some(images) = course.images(&radii) else { break };
            let is_inside = images.iter().zip(&radii).all(|(image, radius)| image < radius);
            let is_other = || family.is_none() || differs(images[period]);
            if is_inside && is_other() {
                alone = true;
                break;
            }
            // What wider boxes add to themselves is more than what they are wider by.
            let grows =
                |(image, offset): (&f64, &f64)| (image - offset).is_nan() || image - offset >= side;
            if late <= side && images[..period].iter().zip(&offsets).any(grows) {
                break;
            }
        }
        if alone {
            return Ok(true);
        }
    }
    Ok(false)
}

/// Whether the value of a conserved function is the same for all orbits that count.
fn is_stated(request: &Request<'_>, functions: &Functions, index: usize) -> bool {
    index < functions.of_level
        || index == functions.of_level && request.keeps_energy && request.energy.is_some()
}

/// Whether orbits with other values of conserved functions count.
fn is_family(request: &Request<'_>, functions: &Functions) -> bool {
    !functions.used().iter().all(|index| is_stated(request, functions, *index))
}

impl OrbitSearch<'_> {
    /// Encloses by how much the equations change for the closed orbits that begin in a box of this radius about the
    /// first node, as conserved functions have other values on them; `None` where all values are stated.
    fn family(&self, request: &Request<'_>, first: f64) -> Option<Boxed> {
        let Self { shooting, nodes, .. } = self;
        let functions = &shooting.functions;
        if !is_family(request, functions) {
            return None;
        }
        let first: Boxed = nodes.states[0].iter().map(|x| Enclosure::about(*x, first)).collect();
        let gaps = functions.sharp(&nodes.states[0], &shooting.values);
        // With boxes of parameters the values change with these, too, each by a variable between −1 and 1.
        let sides = first.iter().map(|x| x.rad).chain(std::iter::repeat(1.0));
        let slopes = functions.gradients(&first);
        let change = |((index, gap), slope): ((&usize, &Enclosure), &Boxed)| {
            let across =
                slope.iter().zip(sides.clone()).map(|(slope, side)| slope.magnitude() * side);
            let size = gap.magnitude() + across.sum::<f64>();
            let size = if is_stated(request, functions, *index) {
                0.0
            } else {
                raised(size, slope.len() + 2)
            };
            Enclosure::about(0.0, size)
        };
        let changes: Boxed = functions.used().iter().zip(&gaps).zip(&slopes).map(change).collect();
        let still = shooting.motion.dimension - functions.len();
        let node = std::iter::repeat_n(Enclosure::ZERO, still).chain(changes);
        let rows = node.collect::<Boxed>().repeat(nodes.states.len());
        Some(rows.into_iter().chain([Enclosure::ZERO]).collect())
    }

    /// Radius of a box about the first node that holds all motions that begin no farther from the start
    /// than `gap`, the distance of this node, where they have its phase. `None` where the velocity is
    /// not nearly the same all over the box.
    fn first_radius(&self, gap: f64) -> Option<f64> {
        // Such a state x has |x - x̂₀| ≤ 2 gap, and comes to the phase in a time of |(v̂, x - x̂₀)|/(v̂, v).
        let radius = TURN * 2.0 * gap * (1.0 + TURN * self.slant());
        self.is_even(radius).then_some(radius)
    }

    /// Distance along the motion that the phase hides, against that of a state from the first node.
    fn slant(&self) -> f64 {
        let phase = &self.frames.phase;
        let norm = |power: i32| phase.iter().map(|x| x.abs().powi(power)).sum::<f64>();
        let largest = phase.iter().fold(0.0, |a: f64, x| a.max(x.abs()));
        TURN * norm(1) * largest / norm(2)
    }

    /// Whether the velocity is nearly that at the first node in a box of this radius about it.
    fn is_even(&self, radius: f64) -> bool {
        let phase = &self.frames.phase;
        let square = phase.iter().map(|x| x * x).sum::<f64>();
        let largest = phase.iter().fold(0.0, |a: f64, x| a.max(x.abs()));
        let node: Boxed =
            self.nodes.states[0].iter().map(|x| Enclosure::about(*x, radius)).collect();
        let Some(field) = self.shooting.motion.field(&[node]).pop() else { return false };
        let along = combined(phase, &field);
        let is_fast = (along - Enclosure::exact(square / TURN)).is_positive();
        is_fast && field.iter().all(|x| x.magnitude() <= TURN * largest)
    }

    /// Radius of boxes about all nodes through which all closed orbits go that begin in a box of this
    /// radius about the first, with periods within `late` of that of the nodes.
    ///
    /// After the period of the nodes their motions are in the tube of the box. Where the velocity is
    /// nearly constant they come back to the phase, and so to their beginning, in a time that crosses
    /// the tube; at each node they are no later than that.
    fn reach(&self, first: f64, late: f64) -> Option<f64> {
        let phase = &self.frames.phase;
        let largest = phase.iter().fold(0.0, |a: f64, x| a.max(x.abs()));
        let tube = self.tube(first)?;
        if !self.is_even(tube + TURN * largest * late) {
            return None;
        }
        let delay = self.slant() * (tube + first) / largest;
        let fastest_within = |radius: f64| {
            let about = |state: &Vec<f64>| -> Boxed {
                state.iter().map(|x| Enclosure::about(*x, radius)).collect()
            };
            let states: Vec<Boxed> = self.nodes.states.iter().map(about).collect();
            let fields = self.shooting.motion.field(&states);
            fields.iter().flatten().fold(0.0, |a: f64, x| a.max(x.magnitude()))
        };
        let fastest = TURN * fastest_within(tube);
        let reach = tube + fastest * delay;
        // Motions that leave the tube in that time are no faster where they come to.
        (reach.is_finite() && fastest_within(reach) <= fastest).then_some(reach)
    }

    /// Whether an orbit found before begins next to the first node and has a period that counts here.
    fn is_orbit(&self, (start, period): (&[Enclosure], Enclosure), first: f64, late: f64) -> bool {
        let near = |(x, node): (&Enclosure, &f64)| (x.mid - node).abs() <= NEXT * first + x.rad;
        (period.mid - self.nodes.period).abs() <= late + period.rad
            && start.iter().zip(&self.nodes.states[0]).all(near)
    }

    /// Largest radius of boxes about all nodes, and about the first one after the period, through which
    /// all motions go that begin in a box of this radius about the first.
    fn tube(&self, first: f64) -> Option<f64> {
        let Self { shooting, nodes, .. } = self;
        let motion = &shooting.motion;
        let steps = times(nodes, Enclosure::exact(nodes.period));
        let about = |side: f64| -> Vec<Boxed> {
            let boxed =
                |state: &Vec<f64>| state.iter().map(|x| Enclosure::about(*x, side)).collect();
            nodes.states.iter().map(boxed).collect()
        };
        let middles: Option<Vec<_>> = motion.passages(&about(0.0), &steps).into_iter().collect();
        let middles = middles?;
        let size = nodes.states.iter().flatten().fold(0.0, |a: f64, x| a.max(x.abs()));
        let least = first.max(LEAST_RADIUS * size);
        let gap = |index: usize| -> (Boxed, &Vec<f64>) {
            let target = &nodes.states[(index + 1) % nodes.states.len()];
            let ends = middles[index].end.iter().zip(target);
            (ends.map(|(x, y)| *x - Enclosure::exact(*y)).collect(), target)
        };
        let tube = |passages: &[EnclosedPassage], rooms: Option<&[Boxed]>| {
            let (mut cloud, mut largest) = (Cloud::about(&about(first)[0]), first);
            for (index, passage) in passages.iter().enumerate() {
                let hull = cloud.hull();
                let fits = |room: &Boxed| hull.iter().zip(room).all(|(x, room)| x.is_within(*room));
                if rooms.is_some_and(|rooms| !fits(&rooms[index])) {
                    return None;
                }
                let (gap, target) = gap(index);
                cloud = cloud.moved(passage, &gap, target)?;
                largest = cloud.hull().iter().fold(largest, |a, x| a.max(x.rad));
            }
            Some(largest)
        };
        // By the derivatives at the nodes alone, what no room can do without.
        let foreseen = tube(&middles, None)?;
        // Passages from boxes that are foreseen to hold the tube, all at once.
        let rooms = ROOMS.iter().map(|room| room * least).filter(|room| *room >= foreseen);
        rooms.into_iter().find_map(|room| {
            let starts = about(room);
            let passages: Option<Vec<_>> = motion.passages(&starts, &steps).into_iter().collect();
            tube(&passages?, Some(&starts))
        })
    }
}
