//! Periodic points of maps, proved by Krawczyk's test, and all of them in a box.

mod boxes;
mod enclosed;
mod matrix;
mod newton;

use crate::closed::multiplier::{self, CycleKind, Multiplier};
use crate::closed::through::MeasuredNumber;
use crate::error::FlowError;
use crate::validated::Enclosure;
use enclosed::EnclosedMap;
use liouville::mechanics::Model;
use liouville::number::rational::Rational;
use matrix::{determinant, trace};
use nalgebra::DMatrix;
use newton::{Moved, PointBox, PointSearch};

/// Largest dimension of which a determinant is enclosed.
const MOST_ROWS: usize = 6;
/// Distance, relative to the state, below which a point counts as back.
const BACK: f64 = 1e-9;

/// A periodic point of a map.
#[derive(Clone, Debug)]
pub struct MapPoint {
    /// Period: the least one, as far as is known.
    pub period: usize,
    /// Points of the cycle, from this one on.
    pub cycle: Vec<Vec<f64>>,
    /// Radii of a box about the point that holds no other one of the period, or the reason why nothing is proved.
    pub proof: Result<Vec<f64>, PointDoubt>,
    /// Whether the period is proved to be the least one.
    pub is_least: bool,
    /// Multipliers: eigenvalues of DΦⁿ.
    pub multipliers: Vec<Multiplier>,
    /// Kind of the cycle, where the errors of the multipliers leave no other.
    pub kind: Option<CycleKind>,
    /// Determinant of DΦⁿ, in few dimensions.
    pub determinant: Option<MeasuredNumber>,
}

/// Reason why there is no periodic point, or none is proved.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PointDoubt {
    /// The map cannot be recorded.
    #[error(transparent)]
    Map(#[from] FlowError),
    /// Newton's method fails.
    #[error("Newton's method finds no point of period {0} from the start")]
    NotFound(usize),
    /// No box is mapped into itself.
    #[error(
        "no box about it is contracted: a multiplier is 1 or nearly so, as where periodic points fill curves, \
         or the map has no derivative there"
    )]
    NoContraction,
}

/// A box of states, with what was asked of it.
#[derive(Clone, Debug)]
pub struct MapBox {
    /// Ends of each component.
    pub ends: Vec<[f64; 2]>,
    /// Period of the points; those of its divisors have it too.
    pub period: usize,
}

/// Periodic points in a box.
#[derive(Clone, Debug)]
pub struct MapPoints {
    /// Points, each with its own least period.
    pub points: Vec<MapPoint>,
    /// Parts of the box in which there may be others: middles and radii.
    pub open: Vec<(Vec<f64>, Vec<f64>)>,
    /// Number of boxes that were looked at.
    pub looked_at: usize,
}

/// Finds the periodic point near a state, and proves it.
pub fn map_point(
    model: &Model,
    parameters: &[Rational],
    start: &[f64],
    period: usize,
) -> Result<MapPoint, PointDoubt> {
    let map = EnclosedMap::new(model, parameters)?;
    let not_found = || PointDoubt::NotFound(period);
    let mut search = PointSearch::new(&map, period);
    let at = search.improved(start).ok_or_else(not_found)?;
    let own = search.proved(&at);
    let found = own.as_ref().map(|(point, _)| point);
    described(&map, (&at, found), period).ok_or_else(not_found)
}

/// Finds all periodic points in a box, as far as it can be divided.
pub fn map_points(
    model: &Model,
    parameters: &[Rational],
    of: &MapBox,
) -> Result<MapPoints, PointDoubt> {
    let map = EnclosedMap::new(model, parameters)?;
    let found = boxes::all(&mut PointSearch::new(&map, of.period), &of.ends);
    let (mut points, mut open) = (Vec::new(), found.open);
    for point in &found.points {
        match described(&map, (&point.middle, Some(point)), of.period) {
            Some(own) => points.push(own),
            None => open.push((point.middle.clone(), point.radii.clone())),
        }
    }
    Ok(MapPoints { points, open, looked_at: found.looked_at })
}

/// The point near a state, or the one in a box that holds no other, with its cycle, its least period, its multipliers and
/// its proof.
fn described(
    map: &EnclosedMap,
    (at, found): (&[f64], Option<&PointBox>),
    period: usize,
) -> Option<MapPoint> {
    let mut search = PointSearch::new(map, period);
    let still = vec![0.0; at.len()];
    let size = at.iter().fold(1.0, |a: f64, x| a.max(x.abs()));
    let iterates = search.iterated((at, &still))?.hulls;
    let is_back = |count: &usize| {
        let pairs = iterates[*count].iter().zip(at);
        period.is_multiple_of(*count)
            && pairs.clone().all(|(x, y)| (x.mid - y).abs() <= BACK * size)
    };
    // A point of a smaller period is this one if it lies in its box, however near others are.
    let mut shorter = (1..period).filter(is_back).filter_map(|count| {
        let mut part = PointSearch::new(map, count);
        let near = part.improved(at)?;
        let proved = part.proved(&near);
        let is_same = match (found, &proved) {
            (Some(own), Some((point, _))) => boxes::are_one(&mut search, own, point),
            (Some(_), None) => false,
            (None, _) => true,
        };
        is_same.then_some((count, near, proved))
    });
    let shorter = shorter.next();
    let (period, at, proved) = match shorter {
        Some(own) => own,
        None => {
            let proved = search.proved(at);
            if proved.is_none() && !is_back(&period) {
                return None;
            }
            (period, at.to_vec(), proved)
        }
    };
    search.period = period;
    let is_least = proved.as_ref().is_some_and(|(_, moved)| is_least(moved, period));
    let slopes = match &proved {
        Some((_, moved)) => moved.iterated.slopes.clone()?,
        None => search.iterated((&at, &still))?.slopes?,
    };
    let (multipliers, kind) = multipliers(&slopes);
    let measured = |x: Enclosure| MeasuredNumber { value: x.mid, error: x.rad };
    let hulls = search.iterated((&at, &still))?.hulls;
    let middle = |hull: &Vec<Enclosure>| hull.iter().map(|x| x.mid).collect();
    Some(MapPoint {
        period,
        cycle: hulls[..period].iter().map(middle).collect(),
        proof: match &proved {
            Some((point, _)) => Ok(point.radii.clone()),
            None => Err(PointDoubt::NoContraction),
        },
        is_least,
        multipliers,
        kind,
        determinant: (slopes.len() <= MOST_ROWS).then(|| measured(determinant(&slopes))),
    })
}

/// Whether no smaller part of a period brings the box back: the least period divides this one.
fn is_least(moved: &Moved, period: usize) -> bool {
    let hulls = &moved.iterated.hulls;
    let is_prime = |p: &usize| (2..*p).all(|d| !p.is_multiple_of(d));
    let primes = (2..=period).filter(|p| period.is_multiple_of(*p)).filter(is_prime);
    primes.into_iter().all(|prime| {
        let mut pairs = hulls[period / prime].iter().zip(&hulls[0]);
        pairs.any(|(x, y)| (*x - *y).is_positive() || (*y - *x).is_positive())
    })
}

/// Eigenvalues of DΦⁿ, with what their errors leave to say of the kind.
fn multipliers(slopes: &[Vec<Enclosure>]) -> (Vec<Multiplier>, Option<CycleKind>) {
    let measured = |x: Enclosure| MeasuredNumber { value: x.mid, error: x.rad };
    match slopes.len() {
        1 => multiplier::one(measured(slopes[0][0])),
        2 => multiplier::two(measured(trace(slopes)), measured(determinant(slopes))),
        n => {
            let middle = DMatrix::from_fn(n, n, |row, column| slopes[row][column].mid);
            multiplier::all(&middle, &middle, &[])
        }
    }
}
