//! Closed orbits through periodic points of a section, in f64 and in double-double.
//!
//! On the level set the derivative M of the flow along a closed orbit has the eigenvalues λ₁, λ₂ of
//! the section map, 1 along the orbit, and 1 across the levels of the energy, so that
//!
//! ```text
//! tr M = λ₁ + λ₂ + 2      λ₁ λ₂ = det M = exp ∫ div v dt
//! ```
//!
//! (Liouville's formula), with tr M = Σ (e_i, M e_i) over an orthonormal basis of the tangent space.

use nalgebra::Matrix2;

use crate::closed::cycle::SUPPORTED;
use crate::closed::periodic::{ComputedPeriodicPoint, Multipliers, SectionMap, newton_step};
use crate::error::FlowError;
use crate::motion::start::{Start, level_basis};
use crate::motion::variational::variational_program;
use crate::section::andoyer::displacement;
use crate::taylor::number::SeriesNumber;
use crate::taylor::stepper::{Accuracy, Stepper};
use liouville::number::double_double::DoubleDouble;

/// A number with an estimate of its error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasuredNumber {
    /// Measured value.
    pub value: f64,
    /// Error estimate; never below the rounding of `value`.
    pub error: f64,
}

impl MeasuredNumber {
    /// Combines the values in f64 and in double-double: the second is the value, their difference
    /// the error.
    pub fn twice(float: f64, pair: f64) -> Self {
        Self { value: pair, error: (float - pair).abs().max(f64::EPSILON * pair.abs()) }
    }
}

/// A closed orbit computed in f64 and in double-double.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ComputedClosedOrbit {
    float: ComputedPeriodicPoint,
    pair: ComputedPeriodicPoint,
}

impl ComputedClosedOrbit {
    /// Measures a number of the orbit, with its error.
    pub fn measure(&self, number: impl Fn(&ComputedPeriodicPoint) -> f64) -> MeasuredNumber {
        MeasuredNumber::twice(number(&self.float), number(&self.pair))
    }

    /// Measures a number that depends on the kind of the multipliers. `None` where the two
    /// precisions disagree on the kind, or `number` does not apply to it.
    pub fn measure_multipliers(
        &self,
        number: impl Fn(Multipliers) -> Option<f64>,
    ) -> Option<MeasuredNumber> {
        let of = |point: &ComputedPeriodicPoint| number(point.multipliers());
        Some(MeasuredNumber::twice(of(&self.float)?, of(&self.pair)?))
    }

    /// Whether the multipliers are of the same kind, real or complex, in both precisions.
    pub fn has_decided_multipliers(&self) -> bool {
        let is_real =
            |point: &ComputedPeriodicPoint| matches!(point.multipliers(), Multipliers::Real(..));
        is_real(&self.float) == is_real(&self.pair)
    }

    /// Whether the distance that Newton's method leaves is so small that there seems to be a point, by
    /// the least singular value of its equations.
    pub fn is_supported(&self) -> bool {
        let [[a, b], [c, d]] = self.pair.derivative;
        let matrix = Matrix2::new(a - 1.0, b, c, d - 1.0);
        let least = matrix.singular_values().min().min(1.0);
        self.pair.residual <= SUPPORTED * least * least
    }

    /// The periodic point, computed in double-double and rounded to f64.
    pub fn point(&self) -> &ComputedPeriodicPoint {
        &self.pair
    }
}

impl SectionMap<'_> {
    /// Finds the closed orbit through the periodic point near `near`.
    pub fn closed(&self, near: [f64; 2], period: usize) -> Result<ComputedClosedOrbit, FlowError> {
        let found = self.periodic(near, period)?;
        let none = FlowError::NoPeriodicPoint { l: near[0], z: near[1], period };
        let derivative = self.derivative(found.at, period, 1.0)?;
        let mut at = found.at.map(DoubleDouble::from_f64);
        let mut best: Option<(ComputedPeriodicPoint, Start, DoubleDouble)> = None;
        loop {
            let start = self.chart.start_at(at)?;
            let back = self.passage_from::<DoubleDouble>(&start, period, Accuracy::PAIR)?;
            let (defect, time) = (displacement(&start.state, &back.arrival.state), back.time);
            let residual = libm::hypot(defect[0], defect[1]);
            // With a derivative of eight digits each step gains eight digits, until rounding stops
            // them.
            let last = best.as_ref().map_or(f64::INFINITY, |(point, ..)| point.residual);
            if residual.is_nan() || residual > last / 2.0 {
                break;
            }
            let point =
                ComputedPeriodicPoint { at: at.map(|x| x.hi), time: time.hi, residual, ..found };
            best = Some((point, start, time));
            if residual == 0.0 {
                break;
            }
            let step = newton_step(derivative, defect);
            at = [0, 1].map(|k| at[k] + DoubleDouble::from_f64(step[k]));
        }
        let (mut pair, start, time) = best.ok_or(none)?;
        (pair.trace, pair.determinant) =
            self.monodromy::<DoubleDouble>(&start, time, Accuracy::PAIR)?;
        let (start, time) = (self.chart.start(found.at)?, DoubleDouble::from_f64(found.time));
        let mut float = found;
        (float.trace, float.determinant) = self.monodromy::<f64>(&start, time, Accuracy::FLOAT)?;
        Ok(ComputedClosedOrbit { float, pair })
    }

    /// Distance between the images in f64 and in double-double after `crossings` crossings.
    pub fn blur(&self, at: [f64; 2], crossings: usize) -> Result<f64, FlowError> {
        let start = self.chart.start(at)?;
        let float = self.passage_from::<f64>(&start, crossings, Accuracy::FLOAT)?.arrival;
        let pair = self.passage_from::<DoubleDouble>(&start, crossings, Accuracy::PAIR)?.arrival;
        let [dl, dz] = displacement(&pair.state, &float.state);
        Ok(libm::hypot(dl, dz))
    }

    /// λ₁ + λ₂ and λ₁ λ₂ of the closed orbit with this start and this period.
    fn monodromy<T: SeriesNumber<One = T>>(
        &self,
        start: &Start,
        time: DoubleDouble,
        accuracy: Accuracy,
    ) -> Result<(f64, f64), FlowError> {
        let (model, dimension) = (self.chart.model, self.chart.model.dimension());
        let basis = level_basis(model, start)?;
        let program = variational_program(model, &start.parameters, basis.len())?;
        let mut begin = start.state.clone();
        begin.extend(basis.iter().flatten());
        begin.push(DoubleDouble::default());
        let mut stepper = Stepper::<T>::new(&program, accuracy);
        stepper.start(0, &begin, time);
        while !stepper.is_done(0) {
            stepper.expand();
            stepper.check(0)?;
            stepper.advance();
        }
        let end = stepper.pairs(0);
        let moved = end[dimension..].chunks(dimension);
        let trace = basis.iter().zip(moved).flat_map(|(e, moved)| e.iter().zip(moved));
        let trace = trace.fold(DoubleDouble::from_f64(-2.0), |sum, (e, x)| sum + *e * *x);
        let volume = end.last().map_or(0.0, |volume| volume.hi);
        Ok((trace.hi, libm::exp(volume)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_near_return_is_no_point() {
        let with = |residual: f64, slope: f64| {
            let derivative = [[1.0 + slope, 0.0], [0.0, 0.5]];
            let at = [1.0, 0.2];
            let (time, trace, determinant) = (1.0, 1.5 + slope, 0.5 + slope / 2.0);
            let point = ComputedPeriodicPoint {
                at,
                period: 1,
                time,
                residual,
                derivative,
                trace,
                determinant,
            };
            ComputedClosedOrbit { float: point, pair: point }.is_supported()
        };
        assert!(with(1e-28, 0.5) && with(1e-28, 1e-6), "closed to rounding");
        assert!(!with(1e-10, 1e-4), "as near as beyond a fold");
        assert!(!with(f64::NAN, 0.5), "no distance");
    }
}
