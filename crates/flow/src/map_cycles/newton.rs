//! Newton's method for Φⁿ(x) = x, and Krawczyk's test for its result.

use super::enclosed::{EnclosedMap, Iterated};
use crate::validated::{Enclosure, Inverse, combined, raised_sum};
use liouville::graph::Evaluator;
use liouville::number::ball::Ball;

/// Limit on the iterations of Newton's method.
const MOST_ITERATIONS: usize = 60;
/// Step after which Newton's method has converged, relative to the state.
const CONVERGED: f64 = 1e-12;
/// Size below which a component is 0.
const FAINT: f64 = 1e-200;
/// Limit on the boxes tried, their growth, and the least radius, relative to the state.
const MOST_BOXES: usize = 12;
const GROWTH: f64 = 2.0;
const LEAST: f64 = 1e-15;
/// Boxes wider than this, relative to the state, are no proof of one point.
const WIDEST: f64 = 1e-3;

/// Search for points of one period.
pub struct PointSearch<'m> {
    map: &'m EnclosedMap,
    evaluator: Evaluator<'m, Ball<1>>,
    pub period: usize,
}

/// Krawczyk's operator on a box.
pub struct Moved {
    /// By how much the middle moves.
    pub step: Vec<Enclosure>,
    /// Bounds of what a box adds about it.
    pub spread: Vec<f64>,
    /// Bound of ‖1 − C (DΦⁿ − 1)‖.
    pub norm: f64,
    pub iterated: Iterated,
}

/// Box with one point of the period alone.
#[derive(Clone, Debug)]
pub struct PointBox {
    pub middle: Vec<f64>,
    pub radii: Vec<f64>,
}

impl<'m> PointSearch<'m> {
    pub fn new(map: &'m EnclosedMap, period: usize) -> Self {
        Self { map, evaluator: map.evaluator(), period }
    }

    pub fn iterated(&mut self, at: (&[f64], &[f64])) -> Option<Iterated> {
        self.map.iterated(&mut self.evaluator, at, self.period)
    }

    /// Applies Krawczyk's operator to a box; `None` where the map may have no value, or DΦⁿ − 1 no inverse.
    pub fn moved(&self, (middle, radii): (&[f64], &[f64]), iterated: Iterated) -> Option<Moved> {
        let n = middle.len();
        let slopes = iterated.slopes.as_ref()?;
        let one = |row, column| Enclosure::exact(if row == column { 1.0 } else { 0.0 });
        let column = |column: usize| {
            let entry = |row: usize| (row, slopes[row][column] - one(row, column));
            (0..n).map(entry).collect::<Vec<_>>()
        };
        let columns: Vec<_> = (0..n).map(column).collect();
        let inverse = Inverse::new(&columns, &(0..n).collect::<Vec<_>>())?;
        let gap: Vec<Enclosure> =
            iterated.middle.iter().zip(middle).map(|(x, c)| *x - Enclosure::exact(*c)).collect();
        let step = (0..n).map(|row| -combined(inverse.row(row), &gap)).collect::<Vec<_>>();
        let (spread, norm) = inverse.defects(&columns, radii);
        let is_known = step.iter().all(|x| x.is_finite()) && norm.is_finite();
        is_known.then_some(Moved { step, spread, norm, iterated })
    }

    /// Improves a point by Newton's method.
    pub fn improved(&mut self, start: &[f64]) -> Option<Vec<f64>> {
        let (mut at, still) = (start.to_vec(), vec![0.0; start.len()]);
        let mut last = f64::INFINITY;
        for _ in 0..MOST_ITERATIONS {
            let iterated = self.iterated((&at, &still))?;
            let moved = self.moved((&at, &still), iterated)?;
            let size = at.iter().fold(1.0, |a: f64, x| a.max(x.abs()));
            let length = moved.step.iter().fold(0.0, |a: f64, x| a.max(x.mid.abs()));
            if length <= CONVERGED * size && length >= last {
                return Some(at);
            }
            for (x, step) in at.iter_mut().zip(&moved.step) {
                *x += step.mid;
                *x = if x.abs() < FAINT { 0.0 } else { *x };
            }
            if length == 0.0 {
                return Some(at);
            }
            last = length;
        }
        (last <= CONVERGED.sqrt()).then_some(at)
    }

    /// Proves that a box about a point holds one point of the period.
    pub fn proved(&mut self, at: &[f64]) -> Option<(PointBox, Moved)> {
        let size = |x: f64| x.abs().max(1.0);
        let mut radii: Vec<f64> = at.iter().map(|x| LEAST * size(*x)).collect();
        for _ in 0..MOST_BOXES {
            let iterated = self.iterated((at, &radii))?;
            let moved = self.moved((at, &radii), iterated)?;
            let reach =
                |(step, spread): (&Enclosure, &f64)| raised_sum(step.magnitude() + spread, 2);
            let images: Vec<f64> = moved.step.iter().zip(&moved.spread).map(reach).collect();
            if images.iter().zip(&radii).all(|(image, radius)| image < radius) {
                return Some((PointBox { middle: at.to_vec(), radii }, moved));
            }
            let next = images.iter().zip(at).map(|(image, x)| GROWTH * image + LEAST * size(*x));
            radii = next.collect();
            if !radii.iter().zip(at).all(|(radius, x)| *radius <= WIDEST * size(*x)) {
                return None;
            }
        }
        None
    }

    /// Whether a box holds at most one point of the period, as DΦⁿ − 1 is regular all over it.
    pub fn is_single(&mut self, at: (&[f64], &[f64])) -> bool {
        let iterated = self.iterated(at);
        iterated.and_then(|own| self.moved(at, own)).is_some_and(|moved| moved.norm < 1.0)
    }
}
