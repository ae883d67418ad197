//! Points of a branch: Newton's method for the section map, in f64 and then in double-double.

use nalgebra::{DMatrix, DVector};

use super::family::{Family, Frame, Place, norm};
use super::linear::{Linear, Plane};
use crate::closed::cycle::SUPPORTED;
use crate::error::FlowError;
use crate::taylor::stepper::Accuracy;
use liouville::number::double_double::DoubleDouble;
use liouville::order::StableOrder;

/// Iteration limit of Newton's method.
const MOST_ITERATIONS: usize = 9;
/// Residual, relative to the state, below which only rounding may be left, and below which it is.
const CONVERGED: f64 = 1e-8;
const ROUNDING: f64 = 1e-13;
/// Smallest singular value of a regular point, relative to the largest.
const DEGENERATE: f64 = 1e-11;

/// Reason why there is no point.
#[derive(Clone, Debug)]
pub enum Trouble {
    /// Newton's method does not converge.
    Lost,
    /// The equations are singular.
    Singular,
    /// A motion could not be followed.
    Flow(FlowError),
}

impl From<FlowError> for Trouble {
    fn from(error: FlowError) -> Self {
        Trouble::Flow(error)
    }
}

/// Direction of a branch: the derivative of the point by its length.
#[derive(Clone, Debug)]
pub struct Tangent {
    /// Derivatives of the state, and of λ.
    pub row: Vec<f64>,
    /// Derivative of the time.
    pub time: f64,
}

impl Tangent {
    /// Derivative of λ.
    pub fn lambda(&self) -> f64 {
        self.row.last().copied().unwrap_or(0.0)
    }

    /// The opposite direction.
    pub fn reversed(&self) -> Self {
        Self { row: self.row.iter().map(|x| -x).collect(), time: -self.time }
    }
}

/// A point with the map there.
#[derive(Clone, Debug)]
pub struct Solved {
    pub place: Place,
    pub frame: Frame,
    pub linear: Linear,
    pub iterations: usize,
}

/// Solver with a scale of the state.
pub struct Solver<'f> {
    pub family: &'f Family,
    /// Size of the state, by which lengths are measured.
    pub size: f64,
}

impl Solver<'_> {
    /// Finds the point of the branch in a plane, near a guess.
    pub fn point(&self, guess: Place, plane: &Plane) -> Result<Solved, Trouble> {
        let family = self.family;
        let mut place = guess;
        let mut last = f64::INFINITY;
        for iterations in 0..MOST_ITERATIONS {
            family.project(&mut place)?;
            let frame = family.frame(&place)?;
            if place.time.hi.is_nan() || place.time.hi <= 0.0 {
                return Err(Trouble::Lost);
            }
            let linear = family.linear::<f64>(&place, &frame, Accuracy::FLOAT)?;
            let off = plane.value(&place);
            let residual = linear.defect.norm() / self.size + off.abs();
            if !residual.is_finite() {
                return Err(Trouble::Lost);
            }
            let stalls = residual <= CONVERGED && residual >= last / 4.0;
            if residual <= ROUNDING || stalls {
                return Ok(Solved { place, frame, linear, iterations });
            }
            if iterations > 2 && residual > last {
                return Err(Trouble::Lost);
            }
            last = residual;
            let step = step(&linear, &plane.row(&frame), off).ok_or(Trouble::Singular)?;
            moved(&mut place, &frame, &linear, &step);
        }
        Err(Trouble::Lost)
    }

    /// Repeats steps with the residual in double-double until rounding stops them. Returns the
    /// distance of the image that is left.
    pub fn refine(&self, solved: &mut Solved, plane: &Plane) -> Result<f64, Trouble> {
        let mut best: Option<(f64, Place)> = None;
        let mut place = solved.place.clone();
        loop {
            self.family.project(&mut place)?;
            let (defect, late, gap) =
                self.family.image::<DoubleDouble>(&place, &solved.frame, Accuracy::PAIR)?;
            let off = plane.value(&place);
            let residual = gap + off.abs() * self.size;
            let last = best.as_ref().map_or(f64::INFINITY, |(residual, _)| *residual);
            if residual.is_nan() || residual > last / 2.0 {
                break;
            }
            best = Some((residual, place.clone()));
            if residual == 0.0 {
                break;
            }
            let linear = Linear { defect, late: late.hi, ..solved.linear.clone() };
            let row = plane.row(&solved.frame);
            let step = step(&linear, &row, off).ok_or(Trouble::Singular)?;
            moved(&mut place, &solved.frame, &linear, &step);
        }
        let (residual, place) = best.ok_or(Trouble::Lost)?;
        solved.place = place;
        Ok(residual)
    }

    /// Whether the distance of the image is so small that there seems to be an orbit in a plane, by the
    /// singular values of the equations there.
    pub fn is_supported(&self, solved: &Solved, plane: &Plane, residual: f64) -> bool {
        let mut matrix = solved.linear.bordered(&plane.row(&solved.frame));
        let last = matrix.ncols() - 1;
        matrix.column_mut(last).scale_mut(1.0 / self.size);
        let mut row = matrix.row_mut(last);
        let length = row.norm();
        row.unscale_mut(length);
        let least = matrix.singular_values().min().min(1.0);
        residual / self.size <= SUPPORTED * least * least
    }

    /// Unit direction of the branch at a point, on the side of a plane's normal.
    pub fn tangent(&self, frame: &Frame, linear: &Linear, plane: &Plane) -> Option<Tangent> {
        let matrix = linear.bordered(&plane.row(frame));
        let mut right = DVector::zeros(matrix.nrows());
        right[matrix.nrows() - 1] = 1.0;
        let found = solved(matrix, &right)?;
        self.scaled(frame, linear, &found)
    }

    /// Unit direction of the branch at its first point, along which λ grows; `None` where there is
    /// more than one.
    pub fn first_tangent(&self, frame: &Frame, linear: &Linear) -> Option<Tangent> {
        let count = linear.map.nrows();
        let row = vec![0.0; count + 1];
        let mut matrix = linear.bordered(&row);
        for i in 0..count {
            matrix[(i, count)] /= self.size;
        }
        let parts = matrix.svd(false, true);
        let right = parts.v_t?;
        let mut order: Vec<usize> = (0..=count).collect();
        order.order_by(|a, b| parts.singular_values[*b].total_cmp(&parts.singular_values[*a]));
        let (largest, least) = (parts.singular_values[order[0]], order.get(count.wrapping_sub(1)));
        let least = least.filter(|_| count > 0).map(|k| parts.singular_values[*k]);
        if least.is_some_and(|least| least <= DEGENERATE * largest.max(1.0)) {
            return None;
        }
        let mut found: DVector<f64> = right.row(order[count]).transpose();
        found[count] /= self.size;
        let tangent = self.scaled(frame, linear, &found)?;
        Some(if tangent.lambda() < 0.0 { tangent.reversed() } else { tangent })
    }

    fn scaled(&self, frame: &Frame, linear: &Linear, found: &DVector<f64>) -> Option<Tangent> {
        let count = frame.basis.len();
        let lambda = found[count];
        let mut row: Vec<f64> = frame.drift.iter().map(|x| x * lambda).collect();
        for (e, u) in frame.basis.iter().zip(found.iter()) {
            row.iter_mut().zip(e).for_each(|(x, e)| *x += u * e.hi);
        }
        let time = linear.time_by.iter().zip(found.iter()).map(|(t, u)| t * u).sum::<f64>()
            + linear.time_by_lambda * lambda;
        let length = libm::hypot(norm(row.iter().copied()) / self.size, lambda);
        row.push(lambda);
        let tangent =
            Tangent { row: row.into_iter().map(|x| x / length).collect(), time: time / length };
        tangent.row.iter().all(|x| x.is_finite()).then_some(tangent)
    }

    /// Plane across a direction at a distance from a point.
    pub fn plane(&self, place: &Place, tangent: &Tangent, distance: f64) -> Plane {
        let last = tangent.row.len() - 1;
        let weight = |k: usize| if k < last { 1.0 / (self.size * self.size) } else { 1.0 };
        let normal = tangent.row.iter().enumerate().map(|(k, x)| x * weight(k)).collect();
        let through = place
            .row()
            .iter()
            .zip(&tangent.row)
            .map(|(x, d)| *x + DoubleDouble::from_f64(d * distance))
            .collect();
        Plane { normal, through }
    }

    /// Distance between two points.
    pub fn distance(&self, a: &Place, b: &Place) -> f64 {
        let apart = a.state.iter().zip(&b.state).map(|(x, y)| (*x - *y).hi);
        libm::hypot(norm(apart) / self.size, (a.lambda - b.lambda).hi)
    }
}

/// Point at a distance along a direction.
pub fn ahead(place: &Place, tangent: &Tangent, distance: f64) -> Place {
    let along = |x: &DoubleDouble, d: f64| *x + DoubleDouble::from_f64(d * distance);
    Place {
        state: place.state.iter().zip(&tangent.row).map(|(x, d)| along(x, *d)).collect(),
        lambda: along(&place.lambda, tangent.lambda()),
        time: along(&place.time, tangent.time),
    }
}

/// Point between two others.
pub fn between(a: &Place, b: &Place, share: f64) -> Place {
    let share = DoubleDouble::from_f64(share);
    let mix = |x: &DoubleDouble, y: &DoubleDouble| *x + (*y - *x) * share;
    Place {
        state: a.state.iter().zip(&b.state).map(|(x, y)| mix(x, y)).collect(),
        lambda: mix(&a.lambda, &b.lambda),
        time: mix(&a.time, &b.time),
    }
}

/// Step of Newton's method in the coordinates of a frame, λ last.
fn step(linear: &Linear, row: &[f64], off: f64) -> Option<DVector<f64>> {
    let count = linear.defect.len();
    let right =
        DVector::from_fn(count + 1, |k, _| if k < count { -linear.defect[k] } else { -off });
    solved(linear.bordered(row), &right)
}

fn solved(matrix: DMatrix<f64>, right: &DVector<f64>) -> Option<DVector<f64>> {
    let found = matrix.lu().solve(right)?;
    found.iter().all(|x| x.is_finite()).then_some(found)
}

/// Moves a point by a step.
fn moved(place: &mut Place, frame: &Frame, linear: &Linear, step: &DVector<f64>) {
    let count = frame.basis.len();
    let lambda = step[count];
    let pair = DoubleDouble::from_f64;
    for (k, x) in place.state.iter_mut().enumerate() {
        let along = frame.basis.iter().zip(step.iter()).map(|(e, u)| e[k].hi * u).sum::<f64>();
        *x = *x + pair(along + frame.drift[k] * lambda);
    }
    place.lambda = place.lambda + pair(lambda);
    let time = linear.time_by.iter().zip(step.iter()).map(|(t, u)| t * u).sum::<f64>();
    place.time = place.time + pair(linear.late + time + linear.time_by_lambda * lambda);
}
