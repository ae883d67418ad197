//! Iterates of a map enclosed over boxes, with their derivatives.
//!
//! ```text
//! box, its middle ─ n times Φ and DΦ in balls ─▶ Φⁿ(middle), DΦⁿ over the box, hulls of all iterates
//! ```

use super::matrix::{Matrix, product};
use crate::error::FlowError;
use crate::motion::recorded::point;
use crate::validated::Enclosure;
use liouville::graph::{Evaluator, Expr, Tape, record};
use liouville::mechanics::Model;
use liouville::number::ball::Ball;
use liouville::number::rational::Rational;
use liouville::scalar::Scalar;

/// A map with fixed parameters on a tape: images, the columns of its derivative, and the operations as
/// written that these do without.
pub struct EnclosedMap {
    tape: Tape,
    pub dimension: usize,
}

/// Iterates of a box.
pub struct Iterated {
    /// Image of the middle after all iterates.
    pub middle: Vec<Enclosure>,
    /// Derivative after all iterates, row by row, if there is one all over the box.
    pub slopes: Option<Matrix>,
    /// Boxes that hold all iterates, the first one among them.
    pub hulls: Vec<Vec<Enclosure>>,
}

impl EnclosedMap {
    pub fn new(model: &Model, parameters: &[Rational]) -> Result<Self, FlowError> {
        let dimension = model.dimension();
        let own = model.equations_of_motion();
        let all: Vec<_> = model.parameter_formulas_of(&own).into_iter().chain(own).collect();
        let (graph, (mut images, written)) = record(dimension, |state| {
            let phase = point(model, parameters, state);
            let written = phase.literal_values(all.iter().copied());
            let mut images = phase.field().to_vec();
            for column in 0..dimension {
                let unit = |row| Expr::rational(&Rational::from(i64::from(row == column)));
                let vector: Vec<Expr> = (0..dimension).map(unit).collect();
                images.extend(phase.lift(&vector).field().iter().map(|image| image.eps));
            }
            (images, written)
        })?;
        if graph.inputs() > dimension {
            return Err(FlowError::Antiderivative);
        }
        images.extend(graph.left_out(&images, &written));
        Ok(Self { tape: Tape::new(&graph, &images), dimension })
    }

    /// Evaluator of the map, for many boxes.
    pub fn evaluator(&self) -> Evaluator<'_, Ball<1>> {
        Evaluator::new(&self.tape, Ball::<1>)
    }

    /// Encloses the image of a box and the derivative over it, if there is one all over it and what is written has
    /// values; `None` where the image may have none.
    fn image(
        &self,
        evaluator: &mut Evaluator<'_, Ball<1>>,
        state: &[Enclosure],
    ) -> Option<(Vec<Enclosure>, Option<Matrix>)> {
        evaluator.run(&state.iter().map(|x| x.block()).collect::<Vec<_>>());
        let all: Vec<Enclosure> = evaluator.outputs().map(Enclosure::first).collect();
        let n = self.dimension;
        let (image, rest) = all.split_at(n);
        if !image.iter().all(|x| x.is_finite()) {
            return None;
        }
        let row = |row: usize| (0..n).map(|column| rest[column * n + row]).collect();
        let is_smooth = rest.iter().all(|x| x.is_finite());
        Some((image.to_vec(), is_smooth.then(|| (0..n).map(row).collect())))
    }

    /// Encloses iterates of a box with this middle and these radii.
    ///
    /// Φᵏ(x) − Φᵏ(c) is (x − c) times a mean of DΦᵏ over the segment, and DΦᵏ a product of the derivatives at the
    /// iterates, which lie in their hulls.
    pub fn iterated(
        &self,
        evaluator: &mut Evaluator<'_, Ball<1>>,
        (middle, radii): (&[f64], &[f64]),
        count: usize,
    ) -> Option<Iterated> {
        let n = self.dimension;
        let side: Vec<Enclosure> = radii.iter().map(|r| Enclosure::about(0.0, *r)).collect();
        let mut hull: Vec<Enclosure> =
            middle.iter().zip(radii).map(|(x, r)| Enclosure::about(*x, *r)).collect();
        let mut at: Vec<Enclosure> = middle.iter().map(|x| Enclosure::exact(*x)).collect();
        let unit = |row, column| Enclosure::exact(if row == column { 1.0 } else { 0.0 });
        let first = (0..n).map(|row| (0..n).map(|column| unit(row, column)).collect()).collect();
        let mut slopes: Option<Matrix> = Some(first);
        let mut hulls = vec![hull.clone()];
        for _ in 0..count {
            let (natural, own) = self.image(evaluator, &hull)?;
            at = self.image(evaluator, &at)?.0;
            let is_finite = |all: &Matrix| all.iter().flatten().all(|x| x.is_finite());
            slopes = own.zip(slopes).map(|(own, slopes)| product(&own, &slopes)).filter(is_finite);
            hull = natural;
            for (row, (x, at)) in hull.iter_mut().zip(&at).enumerate() {
                let Some(slopes) = &slopes else { break };
                let terms = slopes[row].iter().zip(&side);
                let mean = terms.fold(*at, |sum, (slope, side)| sum + *slope * *side);
                // Either encloses the image; the narrower one counts.
                *x = if mean.rad < x.rad { mean } else { *x };
            }
            if !hull.iter().all(|x| x.is_finite()) {
                return None;
            }
            hulls.push(hull.clone());
        }
        Some(Iterated { middle: at, slopes, hulls })
    }
}
