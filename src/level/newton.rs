//! States on a level set without parametrisation: Newton's method in f64.
//!
//! The state found lies near the level, not on it. It is passed on as a box in which Krawczyk's
//! operator proves that there is a point of the level; if it does not, there is no state. A claim
//! refuted on such boxes is refuted; a claim that holds on all of them is not thereby proved.

use nalgebra::{DMatrix, DVector};

use crate::graph::{Evaluator, Expr, Fault, Graph, Step, Tape, record};
use crate::mechanics::calculus::DualPoint;
use crate::mechanics::{LevelFunction, Model, Phase};
use crate::number::ball::{Ball, Balls};
use crate::number::float::Float;
use crate::proof::has_flat_factor;

/// Largest number of Newton steps; quadratic convergence needs far fewer.
const MAX_STEPS: usize = 60;
/// Number of boxes tried around a point, each wider than the last.
const BOXES: usize = 6;
const WIDER: f64 = 8.0;
/// A positive radius for points that are on the level to the last digit.
const SMALLEST: f64 = 1e-300;

/// Level functions and their gradients on a tape.
#[derive(Clone)]
pub struct Newton {
    tape: Tape,
    parameters: usize,
    dimension: usize,
    equations: usize,
    has_corners: bool,
    has_flat_factors: bool,
}

impl Newton {
    /// Prepares the equations selected by `kept`.
    pub fn new(model: &Model, kept: &[bool]) -> Result<Self, Fault> {
        let (parameters, dimension) = (model.free_components(), model.dimension());
        let functions: Vec<&LevelFunction> = model
            .level
            .iter()
            .zip(kept)
            .filter(|(_, kept)| **kept)
            .map(|(equation, _)| &equation.function)
            .collect();
        let (graph, (values, slopes)) = record(parameters + dimension, |inputs| {
            let (parameters, state) = inputs.split_at(parameters);
            let jet = DualPoint::new(Phase::new(model, parameters, state));
            let values: Vec<Expr> = functions.iter().map(|f| jet.phase.level_function(f)).collect();
            let slopes = functions.iter().flat_map(|f| jet.gradient(|at| at.level_function(f)));
            (values, slopes.collect::<Vec<Expr>>())
        })?;
        let has_flat_factors = values.iter().any(|value| has_flat_factor(&graph, *value));
        Ok(Self { has_flat_factors, ..Self::of(&graph, &values, &slopes, parameters) })
    }

    /// Prepares equations by their values and, row by row, their slopes along the coordinates; the
    /// inputs of the graph are parameters, then coordinates.
    pub fn of(graph: &Graph, values: &[Expr], slopes: &[Expr], parameters: usize) -> Self {
        let tape = Tape::new(graph, &[values, slopes].concat());
        let equations = values.len();
        let dimension = slopes.len().checked_div(equations).unwrap_or_default();
        let has_corners = has_moduli(graph, values);
        Self { tape, parameters, dimension, equations, has_corners, has_flat_factors: false }
    }

    /// Whether some equation contains a modulus.
    pub fn has_corners(&self) -> bool {
        self.has_corners
    }

    /// Whether some equation of the level has a factor whose zeros have no slopes, and so are not found.
    pub fn has_flat_factors(&self) -> bool {
        self.has_flat_factors
    }

    /// Encloses a point of the level near `start`, in a box.
    pub fn enclose(&self, parameters: &[Balls<1>], start: &[f64]) -> Option<Vec<Balls<1>>> {
        let middles = parameters.iter().map(|one| one.mid[0]);
        let state = self.solve(&middles.chain(start.iter().copied()).collect::<Vec<_>>())?;
        let radii = self.box_about(parameters, &state)?;
        Some(state.iter().zip(radii).map(|(x, r)| Balls::new([*x], [r])).collect())
    }

    /// Moves the states in `values` (after the parameters) to the level; lanes where that fails
    /// become undefined.
    pub fn project<const N: usize>(&self, values: &mut [Balls<N>]) {
        for lane in 0..N {
            let column: Vec<f64> = values.iter().map(|block| block.mid[lane]).collect();
            let found = self.solve(&column);
            let parameters: Vec<Balls<1>> = values[..self.parameters]
                .iter()
                .map(|block| Balls::new([block.mid[lane]], [block.rad[lane]]))
                .collect();
            let boxed = found.and_then(|state| {
                let radii = self.box_about(&parameters, &state)?;
                Some((state, radii))
            });
            for (k, block) in values[self.parameters..].iter_mut().enumerate() {
                (block.mid[lane], block.rad[lane]) = match &boxed {
                    Some((state, radii)) => (state[k], radii[k]),
                    None => (f64::NAN, f64::NAN),
                };
            }
        }
    }

    /// Finds a point near the level, from `start`.
    fn solve(&self, start: &[f64]) -> Option<Vec<f64>> {
        let mut point = start.to_vec();
        let mut evaluator = Evaluator::new(&self.tape, Float::<1>);
        let mut last = f64::INFINITY;
        for _ in 0..MAX_STEPS {
            evaluator.run(&point.iter().map(|x| [*x]).collect::<Vec<_>>());
            let outputs: Vec<f64> = evaluator.outputs().map(|block| block[0]).collect();
            let step = self.step(&outputs)?;
            let size = step.norm();
            for (x, dx) in point[self.parameters..].iter_mut().zip(step.iter()) {
                *x -= dx;
            }
            // Steps shrink until they reach rounding errors.
            if size == 0.0 || (size >= last && size < f64::EPSILON.sqrt() * self.norm(&point)) {
                return Some(point[self.parameters..].to_vec());
            }
            last = size;
        }
        None
    }

    fn norm(&self, point: &[f64]) -> f64 {
        DVector::from_column_slice(&point[self.parameters..]).norm()
    }

    /// Computes the step J⁺F.
    fn step(&self, outputs: &[f64]) -> Option<DVector<f64>> {
        let (values, slopes) = outputs.split_at(self.equations);
        let jacobian = DMatrix::from_row_slice(self.equations, self.dimension, slopes);
        let square = &jacobian * jacobian.transpose();
        let inverse = jacobian.transpose() * square.lu().try_inverse()?;
        let step = &inverse * DVector::from_column_slice(values);
        step.iter().all(|x| x.is_finite()).then_some(step)
    }

    /// Finds the radii of a box around a state that contains exactly one point of the level with
    /// the same remaining coordinates; the number of coordinates that move is the number of
    /// equations.
    ///
    /// With C ≈ J⁻¹ for the coordinates that move, −C F(x) + (1 − C J(X)) (X − x) lies inside X −
    /// x.
    fn box_about(&self, parameters: &[Balls<1>], state: &[f64]) -> Option<Vec<f64>> {
        let mut evaluator = Evaluator::new(&self.tape, Ball::<1>);
        let mut at = |radii: &[f64]| -> Option<Vec<Balls<1>>> {
            let point = state.iter().zip(radii).map(|(x, r)| Balls::new([*x], [*r]));
            evaluator.run(&parameters.iter().cloned().chain(point).collect::<Vec<_>>());
            let values: Vec<Balls<1>> = evaluator.outputs().cloned().collect();
            values.iter().all(|value| value.is_defined(0)).then_some(values)
        };
        let here = at(&vec![0.0; state.len()])?;
        let (functions, slopes) = here.split_at(self.equations);
        let middle = DMatrix::from_row_iterator(
            self.equations,
            self.dimension,
            slopes.iter().map(|slope| slope.mid[0]),
        );
        let moved = leading_columns(&middle)?;
        let inverse = middle.select_columns(&moved).try_inverse()?;
        let magnitude = |i: usize, of: &dyn Fn(usize) -> f64| -> f64 {
            (0..self.equations).map(|k| inverse[(i, k)].abs() * of(k)).sum()
        };
        // Twice the rounding error of a sum of this many products.
        let slack = 1.0 + 4.0 * (self.equations + 4) as f64 * f64::EPSILON;
        let offset: Vec<f64> = (0..self.equations)
            .map(|i| magnitude(i, &|k| functions[k].mid[0].abs() + functions[k].rad[0]) * slack)
            .collect();
        // A coordinate that is exact is reached by the rounding errors of the others.
        let largest = offset.iter().copied().fold(SMALLEST, f64::max);
        let least = 2.0 * (self.equations + 1) as f64 * (slack - 1.0) * largest;
        let mut radii = vec![0.0; state.len()];
        let mut factor = 2.0;
        for _ in 0..BOXES {
            for (i, k) in moved.iter().enumerate() {
                radii[*k] = factor * offset[i].max(least).max(SMALLEST);
            }
            let there = at(&radii)?;
            let slope = |k: usize, j: usize| &there[self.equations + k * self.dimension + moved[j]];
            let reach = |i: usize| -> f64 {
                let along = |j: usize| {
                    let sum: f64 =
                        (0..self.equations).map(|k| inverse[(i, k)] * slope(k, j).mid[0]).sum();
                    let one = if i == j { 1.0 } else { 0.0 };
                    let size = magnitude(i, &|k| slope(k, j).mid[0].abs());
                    let blur = magnitude(i, &|k| slope(k, j).rad[0]) + (slack - 1.0) * (size + 1.0);
                    ((one - sum).abs() + blur) * radii[moved[j]]
                };
                (offset[i] + (0..self.equations).map(along).sum::<f64>()) * slack
            };
            if (0..self.equations).all(|i| reach(i) < radii[moved[i]]) {
                return Some(radii);
            }
            factor *= WIDER;
        }
        None
    }
}

/// Whether some value contains a modulus.
pub fn has_moduli(graph: &Graph, values: &[Expr]) -> bool {
    let reached = graph.reached(values.iter().copied());
    let is_modulus = |step: Step<'_>| step.is_modulus();
    (0..reached.len()).any(|k| reached[k] && is_modulus(graph.step(k)))
}

/// Selects one column for each row, each the largest after elimination of the earlier ones.
fn leading_columns(matrix: &DMatrix<f64>) -> Option<Vec<usize>> {
    let mut rest = matrix.clone();
    let mut chosen = Vec::new();
    for _ in 0..matrix.nrows() {
        let size = |k: usize| rest.column(k).norm_squared();
        let open = (0..rest.ncols()).filter(|k| !chosen.contains(k));
        let best = open.max_by(|a, b| size(*a).total_cmp(&size(*b)))?;
        let direction = rest.column(best).clone_owned();
        let length = direction.norm();
        if length == 0.0 || !length.is_finite() {
            return None;
        }
        let direction = direction / length;
        let along = direction.transpose() * &rest;
        rest -= &direction * along;
        chosen.push(best);
    }
    Some(chosen)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn leading_columns_are_independent() {
        let matrix = DMatrix::from_row_slice(2, 3, &[1.0, 2.0, 0.1, 2.0, 4.0, 0.0]);
        assert_eq!(leading_columns(&matrix), Some(vec![1, 2]));
        assert_eq!(leading_columns(&DMatrix::zeros(1, 2)), None);
    }
}
