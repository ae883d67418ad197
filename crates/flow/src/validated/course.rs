//! A proved orbit followed from its nodes, in f64: parts of its period that are none, or are.

use super::enclosure::{Enclosure, raised};
use super::least::{Followed, WINDOWS, place};
use super::motion::Boxed;
use super::shooting::{boxes, combined};
use super::{OrbitSearch, passages};

/// Factors by which boxes with one orbit alone are wider than those that hold it.
const WIDER: [f64; 4] = [5.0, 30.0, 1e3, 1e5];
/// Room about a time at which the phase is met, against that expected.
const ROOM: f64 = 4.0;

/// Closed orbit in boxes about its nodes.
pub struct Course<'s> {
    pub search: &'s OrbitSearch<'s>,
    /// Bounds of ‖C G‖ at the nodes, unknown by unknown.
    pub offsets: &'s [f64],
    /// Radii of boxes that hold the orbit.
    pub radii: &'s [f64],
}

impl Course<'_> {
    fn period(&self) -> Enclosure {
        Enclosure::about(self.search.nodes.period, self.radii.last().copied().unwrap_or(f64::NAN))
    }

    fn states(&self) -> Vec<Boxed> {
        boxes(&self.search.nodes, Some(self.radii))
    }

    /// Sum of the shares of some segments from the first on.
    fn elapsed(&self, count: usize) -> Enclosure {
        let shares = self.search.nodes.shares[..count].iter();
        shares.fold(Enclosure::ZERO, |sum, share| sum + Enclosure::exact(*share))
    }

    /// Encloses the share of the period that is one of `part` equal ones.
    fn share(&self, part: usize) -> Enclosure {
        let whole = self.elapsed(self.search.nodes.shares.len());
        whole * Enclosure::exact(part as f64).recip()
    }

    /// Encloses the motion after shares of the period, each with the error of its time.
    fn after(&self, shares: &[(Enclosure, f64)]) -> Vec<Option<Boxed>> {
        let states = self.states();
        let (mut starts, mut times) = (Vec::new(), Vec::new());
        for (share, late) in shares {
            let segment = place(&self.search.nodes.shares, share.mid);
            starts.push(states[segment].clone());
            let rest = (*share - self.elapsed(segment)) * self.period();
            times.push(rest + Enclosure::about(0.0, *late));
        }
        self.search.shooting.motion.ends(&starts, &times)
    }

    /// Radii of boxes to be tried, from narrow to wide: a state that is known best somewhere is
    /// known less after a return, so they are alike for all unknowns, or for all nodes.
    fn wider(&self) -> Vec<Vec<f64>> {
        let n = self.search.shooting.motion.dimension;
        let largest = |radii: &mut dyn Iterator<Item = &f64>| radii.copied().fold(0.0, f64::max);
        let alike = vec![largest(&mut self.radii.iter()); self.radii.len()];
        let last = self.radii.len().saturating_sub(1);
        let mut each = self.radii.to_vec();
        for (index, radius) in each[..last].iter_mut().enumerate() {
            *radius = largest(&mut self.radii[..last].iter().skip(index % n).step_by(n));
        }
        let times = |radii: &[f64], wider: f64| radii.iter().map(|r| wider * r).collect();
        WIDER.iter().flat_map(|wider| [times(&each, *wider), times(&alike, *wider)]).collect()
    }

    /// Whether Krawczyk's test proves that there is one orbit alone in wider boxes.
    pub fn is_unique(&self, radii: &[f64]) -> bool {
        let images = self.images(radii);
        images.is_some_and(|images| images.iter().zip(radii).all(|(image, radius)| image < radius))
    }

    /// Bounds by how much Krawczyk's operator moves each unknown of boxes from the nodes; `None` where a step is not
    /// proved.
    pub fn images(&self, radii: &[f64]) -> Option<Vec<f64>> {
        let OrbitSearch { shooting, nodes, frames, inverse } = self.search;
        let starts = boxes(nodes, Some(radii));
        let period = Enclosure::about(nodes.period, radii[radii.len() - 1]);
        let passages = passages(shooting, nodes, &starts, period).ok()?;
        let columns = shooting.derivative(nodes, frames, &starts, &passages);
        let (moved, _) = inverse.defects(&columns, radii);
        Some(self.offsets.iter().zip(&moved).map(|(z, d)| raised(z + d, 1)).collect())
    }

    /// Height (v̂, x - x̂₀) of a box over the surface of the phase.
    fn height(&self, state: &Boxed) -> Enclosure {
        let OrbitSearch { nodes, frames, .. } = self.search;
        let origin = nodes.states[0].iter().map(|x| Enclosure::exact(*x));
        let gap: Boxed = state.iter().zip(origin).map(|(x, o)| *x - o).collect();
        combined(&frames.phase, &gap)
    }
}

impl Followed for Course<'_> {
    fn shares(&self) -> &[f64] {
        &self.search.nodes.shares
    }

    fn leaves(&self, window: f64) -> usize {
        let OrbitSearch { shooting, frames, .. } = self.search;
        let starts = vec![self.states().swap_remove(0); WINDOWS];
        let times: Boxed = (0..WINDOWS)
            .map(|index| Enclosure::about((index as f64 + 0.5) * window, 0.501 * window))
            .map(|share| share * self.period())
            .collect();
        let found = shooting.motion.ends(&starts, &times);
        let states: Vec<Boxed> = found.into_iter().map_while(|state| state).collect();
        let fields = shooting.motion.field(&states);
        let rises = |field: &&Boxed| combined(&frames.phase, field).is_positive();
        fields.iter().take_while(rises).count()
    }

    fn are_apart(&self, parts: &[usize]) -> Vec<bool> {
        let start = self.states().swap_remove(0);
        let shares: Vec<_> = parts.iter().map(|part| (self.share(*part), 0.0)).collect();
        let is_apart = |state: &Option<Boxed>| {
            state.as_ref().is_some_and(|state| {
                let mut pairs = state.iter().zip(&start);
                pairs.any(|(x, y)| (*x - *y).is_positive() || (*y - *x).is_positive())
            })
        };
        self.after(&shares).iter().map(is_apart).collect()
    }

    fn closes(&self, part: usize, early: f64) -> bool {
        let nodes = &self.search.nodes;
        let (whole, turn) = (self.elapsed(nodes.shares.len()), self.share(part));
        let Some(state) = self.after(&[(turn, 0.0)]).pop().flatten() else { return false };
        let speed: f64 = self.search.frames.phase.iter().map(|x| x * x).sum();
        let late = ROOM * self.height(&state).magnitude() / speed + f64::EPSILON * nodes.period;
        // Times that differ by less than the least possible period.
        let is_early = late * part as f64 * ROOM <= early * nodes.period;
        if !is_early {
            return false;
        }
        // Before the time the phase is not reached, and after it is passed.
        let by = |late: f64| late / nodes.period;
        let shifted = |by: f64| (turn + Enclosure::exact(by), 0.0);
        let sides = self.after(&[shifted(-by(late)), shifted(by(late))]);
        let [Some(before), Some(behind)] = sides.as_slice() else { return false };
        if !(-self.height(before)).is_positive() || !self.height(behind).is_positive() {
            return false;
        }
        let shares: Vec<_> = (0..nodes.shares.len())
            .map(|index| {
                let share = self.elapsed(index) + turn;
                let share = if share.mid > whole.mid { share - whole } else { share };
                (share, ROOM * late)
            })
            .collect();
        let found = self.after(&shares);
        let Some(found) = found.into_iter().collect::<Option<Vec<Boxed>>>() else { return false };
        let holds = |radii: &Vec<f64>| {
            let own = boxes(nodes, Some(radii));
            found.iter().flatten().zip(own.iter().flatten()).all(|(x, y)| x.is_within(*y))
        };
        self.wider().iter().any(|radii| holds(radii) && self.is_unique(radii))
    }
}
