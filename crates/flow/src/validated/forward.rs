//! Motions from an exact state, enclosed by Lohner's method.
//!
//! ```text
//! x(t_i) ∈ p_i + Q_i [-r_i, r_i]        p_i a point, Q_i nearly orthogonal
//! x(t_{i+1}) - p_{i+1} = φ(h, p_i) - p_{i+1} + D Q_i w,  |w| ≤ r_i,  D ∈ ∂φ over the box
//! ```
//!
//! The columns of the middle of D Q_i, the longest first, become Q_{i+1} by the Gram–Schmidt method,
//! so that the box turns with the flow. Every rounding is counted, and so is the deviation of Q from
//! an orthogonal matrix.

use super::coefficients::BOXES;
use super::division::DIVISIONS;
use super::enclosure::{Enclosure, raised};
use super::functions::norm;
use super::guess::Nodes;
use super::laws::Laws;
use super::motion::{Boxed, EnclosedMotion, EnclosedPassage};
use super::{LEAST_RADIUS, Obstacle};
use crate::motion::start::Start;
use liouville::mechanics::Model;
use liouville::number::double_double::DoubleDouble;
use liouville::number::rational::Rational;
use liouville::order::StableOrder;

/// Limit on the steps of a motion.
pub const MOST_STEPS: usize = 100_000;

/// Expected growth of the box in a step; boxes that are wider are computed again.
const GROWTH: f64 = 4.0;

/// State after a time, enclosed.
#[derive(Clone, Debug)]
pub struct Reached {
    /// Box that contains the state.
    pub state: Vec<Enclosure>,
    /// Number of steps.
    pub steps: usize,
}

/// Encloses the state that a motion reaches after a time, from a state in a box.
///
/// # Errors
/// The field cannot be expanded, a step is not proved, or the box becomes too wide.
pub fn follow(
    model: &Model,
    parameters: &[Rational],
    start: &[Enclosure],
    time: Enclosure,
) -> Result<Reached, Obstacle> {
    let laws = Laws { model, parameters, loose: &[], energy: false, integrals: &[] };
    let motion = EnclosedMotion::new(&laws)?;
    let state = start.iter().map(|x| DoubleDouble::from_f64(x.mid)).collect();
    let begin = Start { parameters: parameters.to_vec(), state, moved: 0.0 };
    let mut obstacle = Obstacle::NoStep(0.0);
    for division in DIVISIONS {
        let nodes = division.nodes(&motion, model, &begin, time.mid, MOST_STEPS);
        match nodes
            .and_then(|nodes| along(&motion, &nodes.ok_or(Obstacle::TooManySteps)?, start, time))
        {
            Err(problem @ Obstacle::NoStep(_)) => obstacle = problem,
            other => return other,
        }
    }
    Err(obstacle.of_field(&motion))
}

fn along(
    motion: &EnclosedMotion,
    nodes: &Nodes,
    start: &[Enclosure],
    time: Enclosure,
) -> Result<Reached, Obstacle> {
    let count = nodes.states.len();
    let mut steps: Vec<Enclosure> =
        nodes.shares.iter().map(|share| Enclosure::exact(share * time.mid)).collect();
    // the steps before the last are exact in f64, their sum is not
    let before = &steps[..count.saturating_sub(1)];
    let elapsed = before.iter().fold(Enclosure::ZERO, |sum, h| sum + *h);
    if let Some(last) = steps.last_mut() {
        *last = time - elapsed;
    }
    let mut cloud = Cloud::about(start);
    let mut index = 0;
    while index < count {
        let group = index..count.min(index + BOXES);
        let starts: Vec<Boxed> =
            group.clone().map(|k| cloud.foreseen(k - index, nodes, k)).collect();
        let found = motion.passages(&starts, &steps[group.clone()]);
        let now = nodes.shares[..index].iter().sum::<f64>() * time.mid;
        let first = index;
        let known: Vec<EnclosedPassage> = found.into_iter().map_while(|passage| passage).collect();
        let gaps = gaps(motion, nodes, &cloud.centre, first, &steps, &known);
        for ((passage, gap), start) in known.iter().zip(gaps).zip(&starts) {
            let Some((target, gap)) = gap else { break };
            if !is_inside(&cloud.hull(), start) {
                break;
            }
            cloud = cloud.moved(passage, &gap, &target).ok_or(Obstacle::Wide(now))?;
            index += 1;
        }
        if index == first {
            return Err(Obstacle::NoStep(now));
        }
    }
    Ok(Reached { state: cloud.hull(), steps: count })
}

/// Encloses φ(h, p) - p' for some steps from their nodes p, where p' is the next node, or near the
/// end of the last step. Returns p' with it.
fn gaps(
    motion: &EnclosedMotion,
    nodes: &Nodes,
    centre: &[f64],
    first: usize,
    steps: &[Enclosure],
    passages: &[EnclosedPassage],
) -> Vec<Option<(Vec<f64>, Boxed)>> {
    let mut centres = nodes.states[first..][..passages.len()].to_vec();
    if let Some(own) = centres.first_mut() {
        own.copy_from_slice(centre);
    }
    let end = |passage: &EnclosedPassage| passage.end.iter().map(|x| x.mid).collect::<Vec<f64>>();
    let targets: Vec<Vec<f64>> = (first + 1..)
        .zip(passages)
        .map(|(next, passage)| nodes.states.get(next).cloned().unwrap_or_else(|| end(passage)))
        .collect();
    let wanted: Vec<&[f64]> = targets.iter().map(Vec::as_slice).collect();
    let middles: Vec<f64> = steps[first..][..passages.len()].iter().map(|h| h.mid).collect();
    let found = motion.gaps(&centres, &middles, 1.0, &wanted);
    let late = |index: usize| -> Option<Boxed> {
        let (passage, h) = (&passages[index], &steps[first + index]);
        // the ends of all these steps lie in the end of the passage
        let field = match h.rad == 0.0 {
            true => return Some(vec![Enclosure::ZERO; centre.len()]),
            false => motion.field(std::slice::from_ref(&passage.end)).pop()?,
        };
        Some(field.into_iter().map(|rate| rate * Enclosure::about(0.0, h.rad)).collect())
    };
    let whole = |(index, gap): (usize, Option<Boxed>)| {
        let gap = gap?.iter().zip(late(index)?).map(|(gap, late)| *gap + late).collect();
        Some((targets[index].clone(), gap))
    };
    found.into_iter().enumerate().map(whole).collect()
}

/// Whether a box lies in another.
fn is_inside(inner: &[Enclosure], outer: &[Enclosure]) -> bool {
    inner.iter().zip(outer).all(|(x, y)| x.is_within(*y))
}

/// The set of points p + Q w with |w| ≤ r, component by component.
pub(super) struct Cloud {
    centre: Vec<f64>,
    /// Q by columns.
    frame: Vec<Vec<f64>>,
    radii: Vec<f64>,
}

impl Cloud {
    /// All points of a box.
    pub(super) fn about(state: &[Enclosure]) -> Self {
        let n = state.len();
        let axis = |k: usize| (0..n).map(|j| if j == k { 1.0 } else { 0.0 }).collect();
        Self {
            centre: state.iter().map(|x| x.mid).collect(),
            frame: (0..n).map(axis).collect(),
            radii: state.iter().map(|x| x.rad).collect(),
        }
    }

    /// Box around all points.
    pub(super) fn hull(&self) -> Boxed {
        let n = self.centre.len();
        let reach = |k: usize| {
            let parts = self.frame.iter().zip(&self.radii);
            raised(parts.map(|(column, radius)| column[k].abs() * radius).sum(), n)
        };
        self.centre.iter().enumerate().map(|(k, x)| Enclosure::about(*x, reach(k))).collect()
    }

    /// Box in which the points are expected after some steps, around a node; after none, the
    /// present box.
    fn foreseen(&self, steps: usize, nodes: &Nodes, node: usize) -> Boxed {
        let own = self.hull();
        if steps == 0 {
            return own;
        }
        let wide = own.iter().map(|x| x.rad).fold(0.0, f64::max);
        let growth = GROWTH.powi(i32::try_from(steps).unwrap_or(i32::MAX));
        let floor = |x: f64| LEAST_RADIUS * x.abs().max(1.0);
        let around = |x: &f64| Enclosure::about(*x, growth * (wide + floor(*x)));
        nodes.states[node].iter().map(around).collect()
    }

    /// Set of points after a step, around a target. `None` if it is too large to be of use.
    pub(super) fn moved(
        &self,
        passage: &EnclosedPassage,
        gap: &[Enclosure],
        target: &[f64],
    ) -> Option<Self> {
        let product = |row: &Boxed, column: &[f64]| {
            let terms = row.iter().zip(column);
            terms.fold(Enclosure::ZERO, |sum, (x, y)| sum + *x * Enclosure::exact(*y))
        };
        let images: Vec<Boxed> = self
            .frame
            .iter()
            .map(|column| passage.derivative.iter().map(|row| product(row, column)).collect())
            .collect();
        let frame = frame(&images, &self.radii);
        let along = |column: &[f64], vector: &[Enclosure]| {
            let terms = column.iter().zip(vector);
            terms.fold(Enclosure::ZERO, |sum, (x, y)| sum + Enclosure::exact(*x) * *y)
        };
        let n = target.len();
        let defect = defect(&frame, &along).filter(|_| frame.len() == n)?;
        let sizes: Vec<f64> = frame
            .iter()
            .map(|column| {
                let of_images = images.iter().zip(&self.radii);
                let spread: f64 =
                    of_images.map(|(image, r)| along(column, image).magnitude() * r).sum();
                raised(spread + along(column, gap).magnitude(), n + 1)
            })
            .collect();
        let largest = sizes.iter().copied().fold(0.0, f64::max);
        let radii: Vec<f64> = sizes.iter().map(|size| raised(size + defect * largest, 2)).collect();
        let is_known = radii.iter().all(|r| r.is_finite());
        is_known.then(|| Self { centre: target.to_vec(), frame, radii })
    }
}

/// Bound of ‖(QᵀQ)⁻¹ - 1‖, by ‖QᵀQ - 1‖ < 1/2.
fn defect(frame: &[Vec<f64>], along: &dyn Fn(&[f64], &[Enclosure]) -> Enclosure) -> Option<f64> {
    let exact = |column: &Vec<f64>| column.iter().map(|x| Enclosure::exact(*x)).collect();
    let columns: Vec<Boxed> = frame.iter().map(exact).collect();
    let mut largest: f64 = 0.0;
    for (i, row) in frame.iter().enumerate() {
        let unit = |j: usize| Enclosure::exact(if i == j { 1.0 } else { 0.0 });
        let entries = columns.iter().enumerate();
        let sum: f64 = entries.map(|(j, column)| (along(row, column) - unit(j)).magnitude()).sum();
        // a maximum would pass over NaN
        let sum = raised(sum, frame.len());
        largest = if sum <= largest { largest } else { sum };
    }
    (largest < 0.5).then(|| raised(largest / (1.0 - largest), 2))
}

/// Orthonormal basis from the middles of some vectors, the one that spreads most first.
fn frame(images: &[Boxed], radii: &[f64]) -> Vec<Vec<f64>> {
    let n = images.len();
    let middle = |image: &Boxed| image.iter().map(|x| x.mid).collect::<Vec<f64>>();
    let mut columns: Vec<(f64, Vec<f64>)> = images
        .iter()
        .zip(radii)
        .map(|(image, r)| (norm(&middle(image)) * r, middle(image)))
        .collect();
    columns.order_by(|a, b| b.0.total_cmp(&a.0));
    let axes = (0..n).map(|k| (0..n).map(|j| if j == k { 1.0 } else { 0.0 }).collect());
    let mut units: Vec<Vec<f64>> = Vec::new();
    for vector in columns.into_iter().map(|(_, vector)| vector).chain(axes) {
        if units.len() == n {
            break;
        }
        let size = norm(&vector);
        let mut rest: Vec<f64> = vector.iter().map(|x| x / size).collect();
        // two passes are enough against rounding
        for unit in units.iter().chain(&units) {
            let along: f64 = rest.iter().zip(unit).map(|(x, y)| x * y).sum();
            rest.iter_mut().zip(unit).for_each(|(x, y)| *x -= along * y);
        }
        let length = norm(&rest);
        if length > 1e-8 {
            units.push(rest.iter().map(|x| x / length).collect());
        }
    }
    units
}
