//! All points of a period in a box, by halves of it.
//!
//! ```text
//! box ─ image apart from it ─▶ none
//!     ─ DΦⁿ − 1 regular all over it, and a point that is proved next to it ─▶ this one alone
//!     ─ otherwise ─▶ two halves
//! ```

use std::collections::VecDeque;

use liouville::order::StableOrder;

use super::newton::{PointBox, PointSearch};
use crate::halt::Halt;

/// Limit on the images of boxes that are enclosed.
const MOST_IMAGES: usize = 4_000_000;
/// Limit on the parts that are left: where points fill curves or areas there are ever more.
const MOST_PARTS: usize = 100_000;
/// Side of the smallest boxes, in that of the whole.
const SMALLEST: f64 = 1e-9;
/// Reach of a box in which a point next to it may lie, in its side.
const ROOM: f64 = 2.0;
/// Share of a box's side at which it is halved: off the middle, where points often lie.
const CUT: f64 = 0.4957;

/// Points of a box that are proved, and the parts of it that are open.
#[derive(Clone, Debug, Default)]
pub struct Found {
    /// Boxes with one point each.
    pub points: Vec<PointBox>,
    /// Boxes about which nothing is known: middles and radii.
    pub open: Vec<(Vec<f64>, Vec<f64>)>,
    /// Number of boxes that were looked at.
    pub looked_at: usize,
}

enum Outcome {
    None,
    Point(PointBox),
    Unknown,
}

/// Finds all points of a period in a box with these ends.
pub fn all(search: &mut PointSearch<'_>, ends: &[[f64; 2]]) -> Found {
    let halt = Halt::current();
    let most = MOST_IMAGES / search.period.max(1);
    let mut is_stopped = false;
    let sides: Vec<f64> = ends.iter().map(|[low, high]| high - low).collect();
    let mut found = Found::default();
    let mut rest = VecDeque::from([boxed(ends)]);
    while let Some((middle, radii)) = rest.pop_front() {
        is_stopped |= found.looked_at >= most || rest.len() >= MOST_PARTS || halt.is_raised();
        if is_stopped {
            found.open.push((middle, radii));
            continue;
        }
        found.looked_at += 1;
        match outcome(search, (&middle, &radii)) {
            Outcome::None => {}
            Outcome::Point(point) => {
                let is_new = !found.points.iter().any(|own| are_one(search, own, &point));
                found.points.extend(is_new.then_some(point));
            }
            Outcome::Unknown => {
                let share = |place: usize| 2.0 * radii[place] / sides[place];
                let longest = (0..radii.len()).max_by(|a, b| share(*a).total_cmp(&share(*b)));
                match longest.filter(|place| share(*place) > SMALLEST) {
                    Some(place) => rest.extend(halves((&middle, &radii), place)),
                    None => found.open.push((middle, radii)),
                }
            }
        }
    }
    let by_place = |a: &PointBox, b: &PointBox| {
        let pairs = a.middle.iter().zip(&b.middle).map(|(x, y)| x.total_cmp(y));
        pairs.fold(std::cmp::Ordering::Equal, |order, own| order.then(own))
    };
    found.points.order_by(by_place);
    found
}

/// Box with these ends at least.
fn boxed(ends: &[[f64; 2]]) -> (Vec<f64>, Vec<f64>) {
    let middle = |[low, high]: &[f64; 2]| low + (high - low) / 2.0;
    let radius = |ends: &[f64; 2]| {
        let own = middle(ends);
        let reach = (ends[1] - own).max(own - ends[0]);
        reach + 2.0 * f64::EPSILON * (reach + own.abs())
    };
    (ends.iter().map(middle).collect(), ends.iter().map(radius).collect())
}

/// Two boxes that cover one, cut across an axis.
fn halves((middle, radii): (&[f64], &[f64]), place: usize) -> [(Vec<f64>, Vec<f64>); 2] {
    let (low, high) = (middle[place] - radii[place], middle[place] + radii[place]);
    let cut = low + (high - low) * CUT;
    [[low, cut], [cut, high]].map(|part| {
        let (own, radius) = boxed(&[part]);
        let (mut middle, mut radii) = (middle.to_vec(), radii.to_vec());
        (middle[place], radii[place]) = (own[0], radius[0]);
        (middle, radii)
    })
}

/// Least box that holds two, and some rounding.
fn hull((a, r): (&[f64], &[f64]), (b, s): (&[f64], &[f64])) -> (Vec<f64>, Vec<f64>) {
    let ends = |k: usize| [(a[k] - r[k]).min(b[k] - s[k]), (a[k] + r[k]).max(b[k] + s[k])];
    boxed(&(0..a.len()).map(ends).collect::<Vec<_>>())
}

/// Whether two boxes have no point in common.
fn are_apart((a, r): (&[f64], &[f64]), (b, s): (&[f64], &[f64])) -> bool {
    (0..a.len()).any(|k| {
        let rounding = 4.0 * f64::EPSILON * (a[k].abs() + b[k].abs());
        (a[k] - b[k]).abs() > r[k] + s[k] + rounding
    })
}

/// Whether two boxes hold the same point.
pub fn are_one(search: &mut PointSearch<'_>, a: &PointBox, b: &PointBox) -> bool {
    let (a, b) = ((&a.middle[..], &a.radii[..]), (&b.middle[..], &b.radii[..]));
    if are_apart(a, b) {
        return false;
    }
    let (middle, radii) = hull(a, b);
    search.is_single((&middle, &radii))
}

fn outcome(search: &mut PointSearch<'_>, at: (&[f64], &[f64])) -> Outcome {
    let Some(iterated) = search.iterated(at) else { return Outcome::Unknown };
    let last = iterated.hulls.last().into_iter().flatten();
    let leaves = |((x, middle), radius): ((&crate::Enclosure, &f64), &f64)| {
        let rounding = 4.0 * f64::EPSILON * (x.mid.abs() + middle.abs() + x.rad);
        (x.mid - middle).abs() > radius + x.rad + rounding
    };
    if last.zip(at.0).zip(at.1).any(leaves) {
        return Outcome::None;
    }
    let Some(moved) = search.moved(at, iterated) else { return Outcome::Unknown };
    // A zero lies in the image of the box.
    let misses = |((step, spread), radius): ((&crate::Enclosure, &f64), &f64)| {
        let bound = step.rad + spread + radius;
        step.mid.abs() > bound + 4.0 * f64::EPSILON * (bound + step.mid.abs())
    };
    if moved.step.iter().zip(&moved.spread).zip(at.1).any(misses) {
        return Outcome::None;
    }
    if moved.norm >= 1.0 {
        return Outcome::Unknown;
    }
    let Some(near) = search.improved(at.0) else { return Outcome::Unknown };
    let is_near = |((x, middle), radius): ((&f64, &f64), &f64)| (x - middle).abs() <= ROOM * radius;
    if !near.iter().zip(at.0).zip(at.1).all(is_near) {
        return Outcome::Unknown;
    }
    let Some((point, _)) = search.proved(&near) else { return Outcome::Unknown };
    // One point at most in the box and the one that is proved together.
    let (middle, radii) = hull(at, (&point.middle, &point.radii));
    match search.is_single((&middle, &radii)) {
        false => Outcome::Unknown,
        true if are_apart(at, (&point.middle, &point.radii)) => Outcome::None,
        true => Outcome::Point(point),
    }
}
