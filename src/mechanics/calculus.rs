//! Derivatives along the field and of it, all by num-dual: gradients, Lie derivatives,
//! divergences, and what a level set takes from a divergence.

use std::cell::OnceCell;

use num_dual::Dual;

use super::model::{LevelFunction, Model};
use super::phase::Phase;
use crate::scalar::Scalar;

/// A point of phase space with the points next to it, made once for all derivatives that are taken.
pub struct Jet<'m, T> {
    /// The point itself.
    pub phase: Phase<'m, T>,
    along_field: OnceCell<Phase<'m, Dual<T>>>,
    along_axes: OnceCell<Vec<Phase<'m, Dual<T>>>>,
    divergence: OnceCell<T>,
}

impl<'m, T: Scalar> Jet<'m, T> {
    /// The jet at a point; nothing is computed yet.
    pub fn new(phase: Phase<'m, T>) -> Self {
        Self {
            phase,
            along_field: OnceCell::new(),
            along_axes: OnceCell::new(),
            divergence: OnceCell::new(),
        }
    }

    /// The point with the field as its derivative part.
    pub fn along_field(&self) -> &Phase<'m, Dual<T>> {
        self.along_field.get_or_init(|| self.phase.lift(self.phase.field()))
    }

    /// The point with a derivative part along each coordinate in turn.
    pub fn along_axes(&self) -> &[Phase<'m, Dual<T>>] {
        self.along_axes.get_or_init(|| {
            (0..self.phase.model().dimension()).map(|index| self.phase.lift_along(index)).collect()
        })
    }

    /// L_v f, the derivative of f along the field.
    pub fn lie_derivative(&self, f: impl FnOnce(&Phase<'m, Dual<T>>) -> Dual<T>) -> T {
        f(self.along_field()).eps
    }

    /// The partial derivatives of f by the state's components.
    pub fn gradient(&self, f: impl Fn(&Phase<'m, Dual<T>>) -> Dual<T>) -> Vec<T> {
        self.along_axes().iter().map(|phase| f(phase).eps).collect()
    }

    /// Σ ∂v_i/∂x_i over all components of the state.
    pub fn divergence(&self) -> T {
        let along = || self.along_axes().iter().enumerate();
        *self.divergence.get_or_init(|| along().map(|(i, phase)| phase.field()[i].eps).sum())
    }

    /// Σ d(L_vF_i)(n_i) over the level functions that are kept, with dF_i(n_j) = δ_ij.
    ///
    /// On a level set {F_i = c_i} with dx = dF_1∧…∧dF_k∧σ, L_v σ = (div v - this) σ. It vanishes
    /// where the F_i are integrals near the level.
    pub fn level_cofactor(&self, kept: &[bool]) -> T {
        let functions: Vec<&LevelFunction> = kept_functions(self.phase.model(), kept).collect();
        if functions.is_empty() || self.phase.model().system.conserves_level() {
            return T::zero();
        }
        let gradients = self.level_gradients(kept);
        let mut sum = T::zero();
        for (index, function) in functions.iter().enumerate() {
            let mut unit = vec![T::zero(); functions.len()];
            unit[index] = T::one();
            // n_i = Σ_l (G⁻¹)_il ∇F_l with the Gram matrix G of the gradients
            let weights = solve_positive(gram(&gradients), unit);
            let transversal: Vec<T> = (0..self.phase.model().dimension())
                .map(|k| weights.iter().zip(&gradients).map(|(w, g)| *w * g[k]).sum())
                .collect();
            let beside = self.phase.lift(&transversal);
            sum += beside.lift(beside.field()).level_function(function).eps.eps;
        }
        sum
    }

    /// The gradients of the level functions that are kept.
    pub fn level_gradients(&self, kept: &[bool]) -> Vec<Vec<T>> {
        kept_functions(self.phase.model(), kept)
            .map(|function| self.gradient(|at| at.level_function(function)))
            .collect()
    }
}

/// The level functions that `kept` selects.
fn kept_functions<'a>(
    model: &'a Model,
    kept: &'a [bool],
) -> impl Iterator<Item = &'a LevelFunction> + use<'a> {
    let level = model.level.iter().zip(kept);
    level.filter(|(_, kept)| **kept).map(|(equation, _)| &equation.function)
}

/// u less its part in the span of `others`: zero exactly when u depends on them.
pub fn rejection<T: Scalar>(u: &[T], others: &[Vec<T>]) -> Vec<T> {
    let projections = others.iter().map(|other| dot(u, other)).collect();
    let weights = solve_positive(gram(others), projections);
    let part = |k: usize| -> T { weights.iter().zip(others).map(|(w, g)| *w * g[k]).sum() };
    u.iter().enumerate().map(|(k, x)| if others.is_empty() { *x } else { *x - part(k) }).collect()
}

/// Σ a_i b_i
pub fn dot<T: Scalar>(a: &[T], b: &[T]) -> T {
    a.iter().zip(b).map(|(a, b)| *a * *b).sum()
}

fn gram<T: Scalar>(vectors: &[Vec<T>]) -> Vec<Vec<T>> {
    vectors.iter().map(|a| vectors.iter().map(|b| dot(a, b)).collect()).collect()
}

/// Solves A x = b for a positive definite A: elimination needs no pivots there.
fn solve_positive<T: Scalar>(mut a: Vec<Vec<T>>, mut b: Vec<T>) -> Vec<T> {
    for k in 0..b.len() {
        let (above, below) = a.split_at_mut(k + 1);
        let (pivot_row, pivot_value) = (&above[k], b[k]);
        for (row, value) in below.iter_mut().zip(&mut b[k + 1..]) {
            let factor = row[k] / pivot_row[k];
            for (entry, pivot) in row.iter_mut().zip(pivot_row).skip(k) {
                *entry -= factor * *pivot;
            }
            *value -= factor * pivot_value;
        }
    }
    for k in (0..b.len()).rev() {
        let known = dot(&a[k][k + 1..], &b[k + 1..]);
        b[k] = (b[k] - known) / a[k][k];
    }
    b
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elimination_solves() {
        let matrix = vec![vec![4.0, 1.0, 0.5], vec![1.0, 3.0, -1.0], vec![0.5, -1.0, 5.0]];
        let solution = solve_positive(matrix.clone(), vec![1.0, 2.0, 3.0]);
        for (row, expected) in matrix.iter().zip([1.0, 2.0, 3.0]) {
            assert!((dot(row, &solution) - expected).abs() < 1e-14, "A x = b");
        }
    }

    #[test]
    fn rejection_is_zero_in_the_span_only() {
        let plane = [vec![1.0, 2.0, 0.0], vec![0.0, 1.0, 1.0]];
        let inside = rejection(&[2.0, 5.0, 1.0], &plane);
        assert!(dot(&inside, &inside) < 1e-24, "2a + b is in it");
        let outside = rejection(&[0.0, 0.0, 1.0], &plane);
        assert!(dot(&outside, &outside) > 0.1, "e₃ is not");
        assert!(plane.iter().all(|g| dot(g, &outside).abs() < 1e-14), "and what is left is across");
        assert_eq!(rejection(&[3.0, 4.0], &[]), [3.0, 4.0], "nothing spans nothing");
    }
}
