//! States on a level set that has no parametrisation: Newton's method in f64.
//!
//! The state found lies near the level, not on it. It is handed on as a ball whose radius is an
//! estimate of its distance from the level: verdicts from such states are no proofs.

use nalgebra::{DMatrix, DVector};

use super::sampler::LANES;
use crate::graph::{Evaluator, Fault, Tape, record};
use crate::mechanics::calculus::Jet;
use crate::mechanics::{LevelFunction, Model, Phase};
use crate::number::ball::{Ball, Balls};
use crate::number::float::Float;

/// Quadratic convergence needs far fewer; a start that takes more is given up.
const MAX_STEPS: usize = 60;
/// The distance |J⁺||F| to first order, with room for the curvature of the level.
const SAFETY: f64 = 4.0;

/// The level functions and their gradients on a tape.
#[derive(Clone)]
pub struct Newton {
    tape: Tape,
    parameters: usize,
    dimension: usize,
    equations: usize,
}

impl Newton {
    /// Prepares the equations that `kept` selects.
    pub fn new(model: &Model, kept: &[bool]) -> Result<Self, Fault> {
        let (parameters, dimension) = (model.free_components(), model.dimension());
        let functions: Vec<&LevelFunction> = model
            .level
            .iter()
            .zip(kept)
            .filter(|(_, kept)| **kept)
            .map(|(equation, _)| &equation.function)
            .collect();
        let (graph, outputs) = record(parameters + dimension, |inputs| {
            let (parameters, state) = inputs.split_at(parameters);
            let jet = Jet::new(Phase::new(model, parameters, state));
            let values = functions.iter().map(|f| jet.phase.level_function(f));
            let slopes = functions.iter().flat_map(|f| jet.gradient(|at| at.level_function(f)));
            values.chain(slopes).collect::<Vec<_>>()
        })?;
        let tape = Tape::new(&graph, &outputs);
        Ok(Self { tape, parameters, dimension, equations: functions.len() })
    }

    /// Moves the states in `values` (after the parameters) to the level; lanes where that fails
    /// become undefined.
    pub fn project(&self, values: &mut [Balls<LANES>]) {
        for lane in 0..LANES {
            let column: Vec<f64> = values.iter().map(|block| block.mid[lane]).collect();
            let found = self.solve(&column);
            for (k, block) in values[self.parameters..].iter_mut().enumerate() {
                (block.mid[lane], block.rad[lane]) = match &found {
                    Some((state, radius)) => (state[k], *radius),
                    None => (f64::NAN, f64::NAN),
                };
            }
        }
    }

    /// A point of the level near `start`, with an estimate of its distance from it.
    fn solve(&self, start: &[f64]) -> Option<(Vec<f64>, f64)> {
        let mut point = start.to_vec();
        let mut evaluator = Evaluator::new(&self.tape, Float::<1>);
        let mut last = f64::INFINITY;
        for _ in 0..MAX_STEPS {
            evaluator.run(&point.iter().map(|x| [*x]).collect::<Vec<_>>());
            let outputs: Vec<f64> = evaluator.outputs().map(|block| block[0]).collect();
            let (inverse, step) = self.step(&outputs)?;
            let size = step.norm();
            for (x, dx) in point[self.parameters..].iter_mut().zip(step.iter()) {
                *x -= dx;
            }
            // Steps shrink until rounding stops them.
            if size == 0.0 || (size >= last && size < f64::EPSILON.sqrt() * self.norm(&point)) {
                return Some((point[self.parameters..].to_vec(), self.distance(&point, &inverse)));
            }
            last = size;
        }
        None
    }

    fn norm(&self, point: &[f64]) -> f64 {
        DVector::from_column_slice(&point[self.parameters..]).norm()
    }

    /// J⁺ and the step J⁺F.
    fn step(&self, outputs: &[f64]) -> Option<(DMatrix<f64>, DVector<f64>)> {
        let (values, slopes) = outputs.split_at(self.equations);
        let jacobian = DMatrix::from_row_slice(self.equations, self.dimension, slopes);
        let square = &jacobian * jacobian.transpose();
        let inverse = jacobian.transpose() * square.lu().try_inverse()?;
        let step = &inverse * DVector::from_column_slice(values);
        step.iter().all(|x| x.is_finite()).then_some((inverse, step))
    }

    fn distance(&self, point: &[f64], inverse: &DMatrix<f64>) -> f64 {
        let balls: Vec<Balls<1>> = point.iter().map(|x| Balls::new([*x], [0.0])).collect();
        let mut evaluator = Evaluator::new(&self.tape, Ball::<1>);
        evaluator.run(&balls);
        let defect: f64 = (0..self.equations)
            .map(|k| evaluator.output(k))
            .map(|ball| (ball.mid[0].abs() + ball.rad[0]).powi(2))
            .sum();
        SAFETY * inverse.norm() * defect.sqrt()
    }
}
