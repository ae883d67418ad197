//! Points of a surface over a rectangle of coordinates, in balls of many bits.
//!
//! The equations L (x - o) = z, (n, x - o) = 0, F(x) = c have one solution X(z) in a box for each z
//! of the rectangle, by Krawczyk's operator for all z at once.

use super::data::CoveringSet;
use crate::validated::functions::Functions;
use crate::validated::krawczyk::Inverse;
use crate::validated::replay::matrix::{self, Columns, combined};
use crate::validated::replay::number::{ReplayNumber, Wide};
use crate::validated::replay::segment;

/// Limit on the boxes tried, and the growth from one to the next.
const MOST_BOXES: usize = 6;
const GROWTH: f64 = 1.2;
/// First radius of a box against the one expected, and the least, relative to the state.
const ROOM: f64 = 1.05;
const LEAST: f64 = 4e-16;

/// Part of a surface over a rectangle, enclosed.
pub struct ReplayedPatch {
    /// Box that contains exactly one point for each pair of coordinates.
    pub states: Vec<Wide>,
    /// Derivatives of the points by each coordinate.
    pub slopes: [Vec<Wide>; 2],
    /// Point of the middle of the rectangle, less the centre.
    pub middle: Vec<Wide>,
}

impl CoveringSet {
    /// Derivative of the equations of the surface over a box, by rows.
    fn rows(&self, functions: &Functions, states: &[Wide]) -> Vec<Vec<Wide>> {
        let known = [&self.rows[0], &self.rows[1], &self.normal];
        let exact = |row: &Vec<f64>| row.iter().map(|x| Wide::exact(*x)).collect();
        let mut rows: Vec<Vec<Wide>> = known.into_iter().map(exact).collect();
        let gradients = segment::functions(functions, states, true).1;
        rows.extend(gradients.into_iter().map(|mut row| {
            row.truncate(states.len());
            row
        }));
        rows
    }

    fn columns(&self, functions: &Functions, states: &[Wide]) -> Columns {
        let rows = self.rows(functions, states);
        let column =
            |column: usize| rows.iter().map(|row| row[column].clone()).enumerate().collect();
        (0..states.len()).map(column).collect()
    }

    /// Whether points of two boxes on this surface are equal where their coordinates are.
    pub fn joins(&self, functions: &Functions, ends: &[Wide], states: &[Wide]) -> bool {
        let hull: Vec<Wide> = ends.iter().zip(states).map(|(x, y)| x.hull(y)).collect();
        matrix::is_regular(&self.rows(functions, &hull))
    }

    /// Encloses the points of the rectangle. `None` where it is not proved that each pair of
    /// coordinates has one point.
    pub fn patch(&self, functions: &Functions, values: &[Wide]) -> Option<ReplayedPatch> {
        let n = self.centre.len();
        let centre: Vec<Wide> = self.centre.iter().map(|x| Wide::exact(*x)).collect();
        let off: Vec<Wide> =
            centre.iter().zip(&self.origin).map(|(x, o)| x.minus(&Wide::exact(*o))).collect();
        let place = |k: usize| combined(&self.rows[k], &off).minus(&Wide::exact(self.middle[k]));
        let mut residual = vec![place(0), place(1), combined(&self.normal, &off)];
        let at = segment::functions(functions, &centre, false).0;
        residual.extend(at.iter().zip(values).map(|(f, c)| f.minus(c)));
        let order: Vec<usize> = (0..n).collect();
        let inverse = matrix::inverse(&self.columns(functions, &centre), &order)?;
        let shift = matrix::products(&inverse, &residual);
        let reach = |row: usize| {
            let side = |k: usize| {
                let weight = Wide::exact(inverse.row(row)[k]).magnitude();
                weight.mul(&Wide::exact(self.half[k]))
            };
            shift[row].add(&side(0)).add(&side(1))
        };
        let reaches: Vec<Wide> = (0..n).map(reach).collect();
        let floor = |x: f64| LEAST * x.abs().max(1.0);
        let radius = |factor: f64, sizes: &[Wide]| -> Vec<f64> {
            let sizes = sizes.iter().zip(&self.centre);
            sizes.map(|(size, x)| factor * size.enclosure().magnitude() + floor(*x)).collect()
        };
        let mut radii = radius(ROOM, &reaches);
        for _ in 0..MOST_BOXES {
            let pairs = self.centre.iter().zip(&radii);
            let states: Vec<Wide> = pairs.map(|(x, rad)| Wide::about(*x, *rad)).collect();
            let columns = self.columns(functions, &states);
            let defects = matrix::defects(&inverse, &columns, &radii);
            let images: Vec<Wide> =
                reaches.iter().zip(&defects).map(|(reach, (moved, _))| reach.add(moved)).collect();
            if !images.iter().all(Wide::is_known) {
                return None;
            }
            let is_inside = |(image, rad): (&Wide, &f64)| image.is_below(&Wide::exact(*rad));
            if images.iter().zip(&radii).all(is_inside) {
                return solved(&centre, &images, &inverse, &columns, &shift);
            }
            radii = radius(GROWTH, &images);
        }
        None
    }
}

/// Gathers the enclosures. With R = 1 - C G', ‖R‖ < 1, each vector v has
/// (1 - R)⁻¹ v - v = R v + R (1 - R)⁻¹ R v.
fn solved(
    centre: &[Wide],
    images: &[Wide],
    inverse: &Inverse,
    columns: &Columns,
    shift: &[Wide],
) -> Option<ReplayedPatch> {
    let n = centre.len();
    let rests = matrix::defects(inverse, columns, &vec![1.0; n]);
    let norm = rests.iter().fold(Wide::zero(), |largest, (_, sum)| largest.larger(sum));
    let room = Wide::exact(1.0).minus(&norm);
    if !room.is_positive() {
        return None;
    }
    let errors = |sizes: &[f64]| -> Vec<Wide> {
        let first = matrix::defects(inverse, columns, sizes);
        let largest = first.iter().fold(Wide::zero(), |largest, (x, _)| largest.larger(x));
        let rest = largest.mul(&room.recip());
        let rows = first.iter().zip(&rests);
        rows.map(|((moved, _), (_, sum))| moved.add(&sum.mul(&rest))).collect()
    };
    let slopes = |k: usize| -> Vec<Wide> {
        let column: Vec<f64> = (0..n).map(|row| inverse.row(row)[k]).collect();
        let sizes: Vec<f64> = column.iter().map(|x| x.abs()).collect();
        let around = |(x, error): (&f64, &Wide)| Wide::exact(*x).plus(&Wide::within(error));
        column.iter().zip(&errors(&sizes)).map(around).collect()
    };
    let sizes: Vec<f64> = shift.iter().map(|x| x.enclosure().magnitude()).collect();
    let off = errors(&sizes);
    Some(ReplayedPatch {
        states: centre.iter().zip(images).map(|(x, r)| x.plus(&Wide::within(r))).collect(),
        slopes: [slopes(0), slopes(1)],
        middle: shift.iter().zip(&off).map(|(x, more)| Wide::within(&x.add(more))).collect(),
    })
}
