//! Motions from an exact state, enclosed by Lohner's method.
//!
//! ```text
//! x(t_i) ∈ p_i + Q_i [-r_i, r_i]        p_i a point, Q_i nearly orthogonal
//! x(t_{i+1}) - p_{i+1} = φ(h, p_i) - p_{i+1} + D Q_i w,  |w| ≤ r_i,  D ∈ ∂φ over the box
//! ```
//!
//! The columns of the middle of D Q_i, the longest first, become Q_{i+1} by the Gram–Schmidt method,
//! so that the box turns with the flow. Every rounding is counted; that Q is only nearly orthogonal
//! as well.

use super::enclosure::{Enclosure, raised};
use super::functions::norm;
use super::guess::Nodes;
use super::motion::{Boxed, Motion, Passage};
use super::{KAPPAS, Obstacle};
use crate::start::Start;
use liouville::mechanics::Model;
use liouville::number::pair::Pair;
use liouville::number::rational::Rational;

/// Limit on the steps of a motion.
pub const MOST_STEPS: usize = 100_000;

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
    let motion = Motion::new(model, parameters, false, &[])?;
    let state = start.iter().map(|x| Pair::from_f64(x.mid)).collect();
    let begin = Start { parameters: parameters.to_vec(), state, moved: 0.0 };
    let mut obstacle = Obstacle::NoStep(0.0);
    for kappa in KAPPAS {
        let nodes = Nodes::along(model, &begin, time.mid, kappa, MOST_STEPS)?;
        match along(&motion, &nodes.ok_or(Obstacle::TooManySteps)?, start, time) {
            Err(problem @ Obstacle::NoStep(_)) => obstacle = problem,
            other => return other,
        }
    }
    Err(obstacle)
}

fn along(
    motion: &Motion,
    nodes: &Nodes,
    start: &[Enclosure],
    time: Enclosure,
) -> Result<Reached, Obstacle> {
    let mut cloud = Cloud::about(start);
    let mut elapsed = Enclosure::ZERO;
    for index in 0..nodes.states.len() {
        let next = nodes.states.get(index + 1);
        let h = match next {
            Some(_) => Enclosure::exact(nodes.shares[index] * time.mid),
            None => time - elapsed,
        };
        let problem = || Obstacle::NoStep(elapsed.mid);
        let mut found = motion.passages(&[cloud.hull()], &[h]);
        let passage = found.pop().flatten().ok_or_else(problem)?;
        let end: Vec<f64> = passage.end.iter().map(|x| x.mid).collect();
        let target = next.unwrap_or(&end);
        let gap = gap(motion, &cloud.centre, h, target, &passage).ok_or_else(problem)?;
        cloud = cloud.moved(&passage, &gap, target).ok_or(Obstacle::Wide(elapsed.mid))?;
        elapsed = elapsed + h;
    }
    Ok(Reached { state: cloud.hull(), steps: nodes.states.len() })
}

/// Encloses φ(h, centre) - target for all h of an enclosure.
fn gap(
    motion: &Motion,
    centre: &[f64],
    h: Enclosure,
    target: &[f64],
    passage: &Passage,
) -> Option<Boxed> {
    let gaps = motion.gaps(&[centre.to_vec()], &[h.mid], 1.0, &[target]).pop()??;
    if h.rad == 0.0 {
        return Some(gaps);
    }
    // the ends of all these steps lie in the end of the passage
    let field = motion.field(std::slice::from_ref(&passage.end)).pop()?;
    let late = Enclosure::about(0.0, h.rad);
    Some(gaps.iter().zip(field).map(|(gap, rate)| *gap + rate * late).collect())
}

/// All points p + Q w with |w| ≤ r, component by component.
struct Cloud {
    centre: Vec<f64>,
    /// Q by columns.
    frame: Vec<Vec<f64>>,
    radii: Vec<f64>,
}

impl Cloud {
    fn about(state: &[Enclosure]) -> Self {
        let n = state.len();
        let axis = |k: usize| (0..n).map(|j| if j == k { 1.0 } else { 0.0 }).collect();
        Self {
            centre: state.iter().map(|x| x.mid).collect(),
            frame: (0..n).map(axis).collect(),
            radii: state.iter().map(|x| x.rad).collect(),
        }
    }

    /// Box around all points.
    fn hull(&self) -> Boxed {
        let n = self.centre.len();
        let reach = |k: usize| {
            let parts = self.frame.iter().zip(&self.radii);
            raised(parts.map(|(column, radius)| column[k].abs() * radius).sum(), n)
        };
        self.centre.iter().enumerate().map(|(k, x)| Enclosure::about(*x, reach(k))).collect()
    }

    /// Points after a step, around a target. `None` where they are too many to be of use.
    fn moved(&self, passage: &Passage, gap: &[Enclosure], target: &[f64]) -> Option<Self> {
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
    columns.sort_by(|a, b| b.0.total_cmp(&a.0));
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
