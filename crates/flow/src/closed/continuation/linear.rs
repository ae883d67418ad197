//! The section map with its derivatives at a point, and the functions that vanish at bifurcations.
//!
//! With the derivative M of the flow over the time T, velocity v and section s at the image,
//! Π = 1 - v ds/ds(v) takes a vector to the section along the flow. In a basis B of the section on
//! what is kept, and the drift w of its points with λ,
//!
//! ```text
//! P' = BᵀΠMB     ∂P/∂λ = Bᵀ(Π(Mw + ∂φ/∂λ) - v s_λ/ds(v))     T' = -ds(MB)/ds(v)
//! ```

use nalgebra::{DMatrix, DVector};

use super::family::{Family, Frame, Place, norm};
use crate::error::FlowError;
use crate::motion::carry::carried;
use crate::motion::start::dot;
use crate::taylor::number::SeriesNumber;
use crate::taylor::stepper::Accuracy;
use liouville::number::double_double::DoubleDouble;

/// The section map at a point.
#[derive(Clone, Debug)]
pub struct Linear {
    /// Derivative P' of the map.
    pub map: DMatrix<f64>,
    /// Derivative of the image by λ.
    pub by_lambda: DVector<f64>,
    /// Image less the point.
    pub defect: DVector<f64>,
    /// Change of the time that brings the image to the section, and its derivatives.
    pub late: f64,
    pub time_by: DVector<f64>,
    pub time_by_lambda: f64,
    /// Integral of the divergence along the motion.
    pub volume: f64,
    /// Velocity at the image, and the rate of the section's function there.
    pub velocity: Vec<f64>,
    pub rate: f64,
    /// Distance of the image.
    pub gap: f64,
}

/// Image of a point with what takes vectors there to the section.
struct Arrival {
    end: Vec<DoubleDouble>,
    velocity: Vec<DoubleDouble>,
    /// Gradient of the section's function, by the state and λ.
    slope: Vec<DoubleDouble>,
    value: DoubleDouble,
    rate: DoubleDouble,
}

impl Arrival {
    fn new(family: &Family, end: &[DoubleDouble], lambda: DoubleDouble) -> Self {
        let row: Vec<DoubleDouble> = end.iter().copied().chain([lambda]).collect();
        let (mut values, mut gradients) = family.functions(&row);
        let velocity = family.velocity(&row);
        let slope = gradients.pop().unwrap_or_default();
        let value = values.pop().unwrap_or(DoubleDouble::NAN);
        let rate = dot(&slope, &velocity);
        Self { end: end.to_vec(), velocity, slope, value, rate }
    }

    /// Time to the section along the flow for a vector, and the vector on the section.
    fn taken(
        &self,
        vector: &[DoubleDouble],
        more: DoubleDouble,
    ) -> (DoubleDouble, Vec<DoubleDouble>) {
        let zero = DoubleDouble::default();
        let time = (zero - dot(&self.slope, vector) - more) * self.rate.recip();
        let moved = vector.iter().zip(&self.velocity).map(|(x, v)| *x + *v * time);
        (time, moved.collect())
    }
}

impl Family {
    /// Image of a point, as in [`Linear`], without derivatives: defect, delay, and distance.
    pub fn image<T: SeriesNumber<One = T>>(
        &self,
        place: &Place,
        frame: &Frame,
        accuracy: Accuracy,
    ) -> Result<(DVector<f64>, DoubleDouble, f64), FlowError> {
        let end = carried::<T>(self.flow(), &place.row(), place.time, accuracy)?;
        let arrival = Arrival::new(self, &end[..self.dimension()], place.lambda);
        let (late, defect, gap) = arrival.defect(place, frame);
        Ok((defect, late, gap))
    }

    /// The section map at a point.
    pub fn linear<T: SeriesNumber<One = T>>(
        &self,
        place: &Place,
        frame: &Frame,
        accuracy: Accuracy,
    ) -> Result<Linear, FlowError> {
        let dimension = self.dimension();
        let mut begin = place.row();
        begin.extend(frame.basis.iter().flatten());
        begin.extend(frame.drift.iter().map(|x| DoubleDouble::from_f64(*x)));
        begin.push(DoubleDouble::default());
        let end = carried::<T>(self.bundle(), &begin, place.time, accuracy)?;
        let arrival = Arrival::new(self, &end[..dimension], place.lambda);
        let (late, defect, gap) = arrival.defect(place, frame);
        let count = frame.basis.len();
        let vectors: Vec<&[DoubleDouble]> =
            end[dimension + 1..].chunks(dimension).take(count + 1).collect();
        let zero = DoubleDouble::default();
        let mut map = DMatrix::zeros(count, count);
        let mut time_by = DVector::zeros(count);
        for (column, vector) in vectors.iter().take(count).enumerate() {
            let (time, moved) = arrival.taken(vector, zero);
            time_by[column] = time.hi;
            for (row, e) in frame.basis.iter().enumerate() {
                map[(row, column)] = dot(e, &moved).hi;
            }
        }
        let more = arrival.slope.get(dimension).copied().unwrap_or(zero);
        let (time, moved) = arrival.taken(vectors.get(count).copied().unwrap_or_default(), more);
        let by_lambda =
            DVector::from_iterator(count, frame.basis.iter().map(|e| dot(e, &moved).hi));
        Ok(Linear {
            map,
            by_lambda,
            defect,
            late: late.hi,
            time_by,
            time_by_lambda: time.hi,
            volume: end.last().map_or(f64::NAN, |volume| volume.hi),
            velocity: arrival.velocity.iter().map(|x| x.hi).collect(),
            rate: arrival.rate.hi,
            gap,
        })
    }
}

impl Arrival {
    /// Delay to the section, the image there less the point, and the distance before.
    fn defect(&self, place: &Place, frame: &Frame) -> (DoubleDouble, DVector<f64>, f64) {
        let apart: Vec<DoubleDouble> =
            self.end.iter().zip(&place.state).map(|(x, y)| *x - *y).collect();
        let gap = norm(apart.iter().map(|x| x.hi));
        let late = (DoubleDouble::default() - self.value) * self.rate.recip();
        let moved: Vec<DoubleDouble> =
            apart.iter().zip(&self.velocity).map(|(x, v)| *x + *v * late).collect();
        let parts = frame.basis.iter().map(|e| dot(e, &moved).hi);
        (late, DVector::from_iterator(frame.basis.len(), parts), gap)
    }
}

/// Linear condition on the state and λ that singles out a point of a branch.
#[derive(Clone, Debug)]
pub struct Plane {
    /// Normal by the state and λ.
    pub normal: Vec<f64>,
    /// Point of the plane.
    pub through: Vec<DoubleDouble>,
}

impl Plane {
    /// Points with this λ.
    pub fn of_lambda(dimension: usize, lambda: DoubleDouble) -> Self {
        let mut normal = vec![0.0; dimension + 1];
        normal[dimension] = 1.0;
        let mut through = vec![DoubleDouble::default(); dimension + 1];
        through[dimension] = lambda;
        Self { normal, through }
    }

    /// Value of the condition at a point.
    pub fn value(&self, place: &Place) -> f64 {
        let row = place.row();
        let apart = row.iter().zip(&self.through).map(|(x, y)| *x - *y);
        let zero = DoubleDouble::default();
        let sum =
            apart.zip(&self.normal).fold(zero, |sum, (d, n)| sum + d * DoubleDouble::from_f64(*n));
        sum.hi
    }

    /// Coefficients of the condition in the coordinates of a frame, λ last.
    pub fn row(&self, frame: &Frame) -> Vec<f64> {
        let of = |e: &Vec<DoubleDouble>| e.iter().zip(&self.normal).map(|(x, n)| x.hi * n).sum();
        let mut row: Vec<f64> = frame.basis.iter().map(of).collect();
        let drift: f64 = frame.drift.iter().zip(&self.normal).map(|(x, n)| x * n).sum();
        row.push(drift + self.normal.last().copied().unwrap_or(0.0));
        row
    }
}

impl Linear {
    /// Matrix of [P' - 1, ∂P/∂λ] with a further row.
    pub fn bordered(&self, row: &[f64]) -> DMatrix<f64> {
        let count = self.map.nrows();
        DMatrix::from_fn(count + 1, count + 1, |i, j| match (i < count, j < count) {
            (true, true) => self.map[(i, j)] - if i == j { 1.0 } else { 0.0 },
            (true, false) => self.by_lambda[i],
            (false, _) => row[j],
        })
    }

    /// Sum of the multipliers.
    pub fn trace(&self) -> f64 {
        self.map.trace()
    }

    /// Product of the multipliers.
    pub fn product(&self) -> f64 {
        libm::exp(self.volume)
    }

    /// det(P' + 1), which vanishes where a multiplier is −1.
    pub fn flip(&self) -> f64 {
        match self.map.nrows() {
            0 => 1.0,
            1 => 1.0 + self.product(),
            // The product of both is known better by the volume.
            2 => 1.0 + self.trace() + self.product(),
            count => (&self.map + DMatrix::identity(count, count)).determinant(),
        }
    }

    /// Product of λᵢλⱼ - 1 over pairs of multipliers, which vanishes where two complex ones cross the
    /// unit circle.
    pub fn torus(&self) -> f64 {
        match self.map.nrows() {
            0 | 1 => 1.0,
            2 => libm::expm1(self.volume),
            _ => {
                let all = self.map.complex_eigenvalues();
                let pairs = (0..all.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
                let one = nalgebra::Complex::new(1.0, 0.0);
                pairs.fold(one, |product, (i, j)| product * (all[i] * all[j] - one)).re
            }
        }
    }

    /// Whether the pair of multipliers whose product is nearest to 1 is complex.
    pub fn turns(&self) -> bool {
        match self.map.nrows() {
            0 | 1 => return false,
            2 => return self.trace() * self.trace() < 4.0 * self.product(),
            _ => {}
        }
        let all = self.map.complex_eigenvalues();
        let pairs = (0..all.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
        let off = |(i, j): &(usize, usize)| {
            let gap = all[*i] * all[*j] - nalgebra::Complex::new(1.0, 0.0);
            libm::hypot(gap.re, gap.im)
        };
        let nearest = pairs.min_by(|a, b| off(a).total_cmp(&off(b)));
        nearest.is_some_and(|(i, _)| all[i].im != 0.0)
    }
}
