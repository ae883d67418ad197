//! Proofs of closed orbits and of horseshoes replayed in balls of integers from the numbers of a
//! first proof.
//!
//! Nodes, boxes, step sizes and radii of tails are those recorded; all that is proved about them is
//! computed anew. Shared with the first proof are the recorded equations, as plans, and an
//! approximate inverse in f64, about which nothing is assumed.

mod course;
mod horseshoe;
mod matrix;
mod multipliers;
mod number;
mod segment;
mod series;
mod short;
mod tails;
#[cfg(test)]
mod tests;

pub use horseshoe::{CoveringSet, HorseshoeData, replay_horseshoe};

use super::enclosure::Enclosure;
use super::functions::Functions;
use super::least;
use super::motion::EnclosedMotion;
use super::nearby::Nearby;
use super::request::moved;
use super::{MOST_UNKNOWNS, Obstacle, ProvedOrbit, Request};
use course::ReplayedCourse;
use matrix::{Columns, combined};
use number::{ReplayNumber, Wide};
use rayon::prelude::*;
use segment::{ReplayedPassage, Scripts};

/// Largest order of the series of a replay.
const MOST_ORDER: usize = 60;

/// Numbers of a proof: whatever they are, the replay decides whether they prove an orbit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ProofData {
    /// Order of the series.
    pub order: usize,
    /// Indices of the conserved functions in use: the level's, the energy, further integrals.
    pub functions: Vec<usize>,
    /// Values of these functions on the orbit; not read where the case fixes them.
    pub values: Vec<f64>,
    /// Nodes of the orbit.
    pub nodes: Vec<Vec<f64>>,
    /// Time of each segment, as a share of the period.
    pub shares: Vec<f64>,
    /// Period over the sum of the shares, approximately.
    pub period: f64,
    /// Radii of the boxes: of the nodes' components one after another, then of the period.
    pub radii: Vec<f64>,
    /// Radii ρ of the norms in which the tails of the segments are bounded.
    pub tails: Vec<f64>,
}

/// One segment with all that the equations need of it.
struct Segment {
    /// Left sides of its equations at the nodes.
    residual: Vec<Wide>,
    /// Passage from the box of its first node.
    passage: ReplayedPassage,
    /// Field over the end of the passage.
    field: Vec<Wide>,
    /// Gradients of the conserved functions over the box.
    gradients: Vec<Vec<Wide>>,
    /// Derivatives of its left sides by the loose parameters at the node, a column each.
    shifts: Vec<Vec<Wide>>,
}

/// Data with the equations that they are to solve.
struct Replay<'r> {
    data: &'r ProofData,
    functions: Functions,
    values: Vec<Wide>,
    scripts: Scripts<'r>,
    /// Directions across the conserved functions at each node.
    across: Vec<Vec<Vec<f64>>>,
    boxes: Vec<Vec<Wide>>,
    /// Time of a period in units of the shares.
    period: Wide,
}

/// Proves the closed orbit of some data again.
///
/// # Errors
/// The data do not belong to the equations, or do not prove that there is an orbit.
pub fn replay(request: &Request<'_>, data: &ProofData) -> Result<ProvedOrbit, Obstacle> {
    check(data, request.model.dimension())?;
    let functions = Functions::new(&request.laws())?
        .using(&data.functions)
        .ok_or(Obstacle::Data("the conserved functions are others"))?;
    if functions.len() >= request.model.dimension() {
        return Err(Obstacle::Data("there are too many conserved functions"));
    }
    if data.values.len() != functions.len() {
        return Err(Obstacle::Data("each conserved function has one value"));
    }
    let values = request.values(&functions, &data.values)?.iter().map(Wide::of).collect();
    let motion = EnclosedMotion::new(&request.laws())?;
    let nearby = Nearby::new(&request.laws());
    let (last, radii) = data.radii.split_last().ok_or(Obstacle::Data("there are no radii"))?;
    let n = motion.dimension;
    let boxed = |(node, radii): (&Vec<f64>, &[f64])| {
        node.iter().zip(radii).map(|(x, rad)| Wide::about(*x, *rad)).collect()
    };
    let replay = Replay {
        across: data.nodes.iter().map(|node| functions.complement(node)).collect(),
        boxes: data.nodes.iter().zip(radii.chunks(n)).map(boxed).collect(),
        period: Wide::about(data.period, *last),
        scripts: Scripts::new(&motion, nearby.as_ref(), data.order, data.order),
        data,
        functions,
        values,
    };
    replay.prove(request)
}

/// Checks that numbers are finite and lists as long as they have to be.
fn check(data: &ProofData, n: usize) -> Result<(), Obstacle> {
    let count = data.nodes.len();
    let is_whole = count > 0
        && data.nodes.iter().all(|node| node.len() == n)
        && data.shares.len() == count
        && data.tails.len() == count
        && data.radii.len() == n * count + 1;
    if !is_whole {
        return Err(Obstacle::Data("the lists have other lengths"));
    }
    if n * count > MOST_UNKNOWNS {
        return Err(Obstacle::TooLong);
    }
    if !(2..=MOST_ORDER).contains(&data.order) {
        return Err(Obstacle::Data("the order is out of range"));
    }
    let positive = [&data.shares, &data.tails, &data.radii];
    let is_good = data.nodes.iter().flatten().all(|x| x.is_finite())
        && positive.iter().all(|list| list.iter().all(|x| x.is_finite() && *x > 0.0))
        && data.values.iter().all(|x| x.is_finite())
        && data.period.is_finite()
        && data.period > 0.0;
    is_good.then_some(()).ok_or(Obstacle::Data("numbers are not finite, or not positive"))
}

impl Replay<'_> {
    fn next(&self, index: usize) -> usize {
        (index + 1) % self.data.nodes.len()
    }

    /// Approximate time of a node.
    fn time(&self, index: usize) -> f64 {
        self.data.shares[..index].iter().sum::<f64>() * self.data.period
    }

    fn segment(&self, index: usize) -> Result<Segment, Obstacle> {
        let (data, next) = (self.data, self.next(index));
        let (share, radius) = (Wide::exact(data.shares[index]), data.tails[index]);
        let late = || Obstacle::NoStep(self.time(index));
        let node: Vec<Wide> = data.nodes[index].iter().map(|x| Wide::exact(*x)).collect();
        let h = share.times(&Wide::exact(data.period));
        let end = self.scripts.end(&node, &h, radius).ok_or_else(late)?;
        let target = data.nodes[next].iter();
        let gap: Vec<Wide> =
            end.iter().zip(target).map(|(x, y)| x.minus(&Wide::exact(*y))).collect();
        let directions = self.across[next].iter();
        let mut residual: Vec<Wide> =
            directions.map(|direction| combined(direction, &gap)).collect();
        let (values, _) = segment::functions(&self.functions, &node, false);
        residual.extend(values.iter().zip(&self.values).map(|(f, c)| f.minus(c)));
        let passage = self
            .scripts
            .passage(&self.boxes[index], &share.times(&self.period), radius)
            .ok_or_else(late)?;
        let shifts = match self.scripts.motion.loose {
            0 => Vec::new(),
            loose => {
                let moved = self.scripts.passage(&node, &h, radius).ok_or_else(late)?;
                let gradients = segment::functions(&self.functions, &node, true).1;
                (0..loose)
                    .map(|parameter| self.shift(&moved, &gradients, next, parameter))
                    .collect()
            }
        };
        Ok(Segment {
            residual,
            field: self.scripts.field(&passage.end),
            gradients: segment::functions(&self.functions, &self.boxes[index], true).1,
            passage,
            shifts,
        })
    }

    /// Whether the field is analytic about a segment for all parameters near those of the case.
    fn persists(&self, index: usize) -> bool {
        let h = Wide::exact(self.data.shares[index]).times(&self.period);
        self.scripts.persists(&self.boxes[index], &h, self.data.tails[index])
    }

    /// Derivatives of the left sides of a segment by a loose parameter.
    fn shift(
        &self,
        moved: &ReplayedPassage,
        gradients: &[Vec<Wide>],
        next: usize,
        parameter: usize,
    ) -> Vec<Wide> {
        let place = self.scripts.motion.dimension + parameter;
        let column: Vec<Wide> = moved.derivative.iter().map(|row| row[place].clone()).collect();
        let directions = self.across[next].iter();
        let gaps = directions.map(|direction| combined(direction, &column));
        gaps.chain(gradients.iter().map(|gradient| gradient[place].clone())).collect()
    }

    /// Derivative of all equations over the boxes; the phase has these slopes at the first node.
    fn derivative(&self, segments: &[Segment], phase: &[f64]) -> Columns {
        let (n, count) = (self.scripts.motion.dimension, segments.len());
        let mut columns: Columns = vec![Vec::new(); n * count + 1];
        for (index, segment) in segments.iter().enumerate() {
            let next = self.next(index);
            let directions = &self.across[next];
            for (place, direction) in directions.iter().enumerate() {
                let row = n * index + place;
                for (component, along) in direction.iter().enumerate() {
                    let column: Vec<Wide> =
                        segment.passage.derivative.iter().map(|r| r[component].clone()).collect();
                    let moved = combined(direction, &column);
                    if count == 1 {
                        columns[component].push((row, moved.minus(&Wide::exact(*along))));
                    } else {
                        columns[n * index + component].push((row, moved));
                        columns[n * next + component].push((row, Wide::exact(-along)));
                    }
                }
                let share = Wide::exact(self.data.shares[index]);
                let rate = share.times(&combined(direction, &segment.field));
                columns[n * count].push((row, rate));
            }
            for (place, gradient) in segment.gradients.iter().enumerate() {
                let row = n * index + directions.len() + place;
                for (component, slope) in gradient[..n].iter().enumerate() {
                    columns[n * index + component].push((row, slope.clone()));
                }
            }
        }
        for (component, slope) in phase.iter().enumerate() {
            columns[component].push((n * count, Wide::exact(*slope)));
        }
        columns
    }

    /// Whether the ends of a segment and the next node lie on one level, along directions that the
    /// equations compare.
    fn fits(&self, index: usize, segment: &Segment) -> bool {
        let next = self.next(index);
        let pairs = segment.passage.end.iter().zip(&self.boxes[next]);
        let hull: Vec<Wide> = pairs.map(|(x, y)| x.hull(y)).collect();
        let exact = |direction: &Vec<f64>| direction.iter().map(|x| Wide::exact(*x)).collect();
        let mut rows: Vec<Vec<Wide>> = self.across[next].iter().map(exact).collect();
        let gradients = segment::functions(&self.functions, &hull, true).1;
        let n = self.scripts.motion.dimension;
        rows.extend(gradients.into_iter().map(|gradient| gradient[..n].to_vec()));
        matrix::is_regular(&rows)
    }

    fn prove(&self, request: &Request<'_>) -> Result<ProvedOrbit, Obstacle> {
        let (data, n) = (self.data, self.scripts.motion.dimension);
        let count = data.nodes.len();
        let found: Vec<Result<Segment, Obstacle>> =
            (0..count).into_par_iter().map(|index| self.segment(index)).collect();
        let segments = found.into_iter().collect::<Result<Vec<Segment>, Obstacle>>()?;
        let first: Vec<Wide> = data.nodes[0].iter().map(|x| Wide::exact(*x)).collect();
        let phase: Vec<f64> = self.scripts.field(&first).iter().map(Wide::mid).collect();
        let columns = self.derivative(&segments, &phase);
        let order = super::shooting::folded(n, count);
        let inverse = matrix::inverse(&columns, &order).ok_or(Obstacle::Degenerate)?;
        let whole = |parts: &dyn Fn(&Segment) -> Vec<Wide>| {
            let mut vector: Vec<Wide> = segments.iter().flat_map(parts).collect();
            vector.push(Wide::zero());
            matrix::products(&inverse, &vector)
        };
        let mut offsets = whole(&|segment| segment.residual.clone());
        for parameter in 0..self.scripts.motion.loose {
            let moved = whole(&|segment| segment.shifts[parameter].clone());
            offsets = offsets.iter().zip(&moved).map(|(a, b)| a.add(b)).collect();
        }
        let defects = matrix::defects(&inverse, &columns, &data.radii);
        let images: Vec<Wide> =
            offsets.iter().zip(&defects).map(|(offset, (moved, _))| offset.add(moved)).collect();
        let norm = defects.iter().fold(Wide::zero(), |largest, (_, norm)| largest.larger(norm));
        let contraction = norm.enclosure();
        let is_inside = |(image, radius): (&Wide, &f64)| image.is_below(&Wide::exact(*radius));
        if !images.iter().zip(&data.radii).all(is_inside) {
            return Err(Obstacle::NoContraction(contraction.mid));
        }
        if !(0..count).into_par_iter().all(|index| self.fits(index, &segments[index])) {
            return Err(Obstacle::Gradients);
        }
        let radius = |image: &Wide| image.enclosure().magnitude();
        let around = |(x, image): (&f64, &Wide)| Enclosure::about(*x, radius(image));
        let start: Vec<Enclosure> = data.nodes[0].iter().zip(&images).map(around).collect();
        let hold = |(node, images): (&Vec<f64>, &[Wide])| {
            node.iter().zip(images).map(|(x, image)| Wide::about(*x, radius(image))).collect()
        };
        let sum = |parts: &dyn Fn(usize) -> Wide| {
            (0..count).fold(Wide::zero(), |sum, index| sum.plus(&parts(index)))
        };
        let share = sum(&|index| Wide::exact(data.shares[index]));
        let period = Wide::exact(data.period).plus(&Wide::within(&images[n * count]));
        let course = ReplayedCourse {
            replay: self,
            phase: &phase,
            states: data.nodes.iter().zip(images.chunks(n)).map(hold).collect(),
            period: period.clone(),
        };
        let others = n.saturating_sub(self.functions.len() + 1);
        let passages = segments.iter().map(|segment| &segment.passage).collect::<Vec<_>>();
        Ok(ProvedOrbit {
            moved: moved(&start, &request.state(), data.nodes.iter()),
            start,
            period: share.times(&period).enclosure(),
            turns: least::turns(&course),
            volume: sum(&|index| segments[index].passage.volume.clone()).enclosure(),
            multipliers: others,
            sum: match request.wants_multipliers && others == 2 {
                true => multipliers::sum(&self.across[0], &segments[0].gradients, &passages),
                false => None,
            },
            segments: count,
            radius: images.iter().map(radius).fold(0.0, f64::max),
            contraction: contraction.magnitude(),
            kept: self.functions.len(),
            persists: (0..count).into_par_iter().all(|index| self.persists(index)),
            data: data.clone(),
        })
    }
}
