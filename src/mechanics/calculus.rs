//! Derivatives along the field and of it, all by num-dual: gradients, Lie derivatives,
//! divergences, and what a level set takes from a divergence.

use num_dual::Dual;

use super::model::{LevelFunction, Phase};
use crate::scalar::Scalar;

/// L_v f, the derivative of f along the field.
pub fn lie_derivative<T: Scalar>(
    phase: &Phase<'_, T>,
    f: impl FnOnce(&Phase<'_, Dual<T>>) -> Dual<T>,
) -> T {
    f(&phase.lift(phase.field())).eps
}

/// The partial derivatives of f by the state's components.
pub fn gradient<T: Scalar>(
    phase: &Phase<'_, T>,
    f: impl Fn(&Phase<'_, Dual<T>>) -> Dual<T>,
) -> Vec<T> {
    (0..phase.model().dimension()).map(|index| f(&phase.lift_along(index)).eps).collect()
}

/// Σ ∂v_i/∂x_i over all components of the state.
pub fn divergence<T: Scalar>(phase: &Phase<'_, T>) -> T {
    (0..phase.model().dimension()).map(|index| phase.lift_along(index).field()[index].eps).sum()
}

/// Σ d(L_vF_i)(n_i) over the level functions that are kept, with dF_i(n_j) = δ_ij.
///
/// On a level set {F_i = c_i} with dx = dF_1∧…∧dF_k∧σ, L_v σ = (div v - this) σ. It vanishes
/// where the F_i are integrals near the level.
pub fn level_cofactor<T: Scalar>(phase: &Phase<'_, T>, kept: &[bool]) -> T {
    let functions: Vec<&LevelFunction> = kept_functions(phase, kept).collect();
    if functions.is_empty() || phase.model().system.conserves_level() {
        return T::zero();
    }
    let gradients: Vec<Vec<T>> =
        functions.iter().map(|f| gradient(phase, |at| at.level_function(f))).collect();
    let mut sum = T::zero();
    for (index, function) in functions.iter().enumerate() {
        let mut unit = vec![T::zero(); functions.len()];
        unit[index] = T::one();
        // n_i = Σ_l (G⁻¹)_il ∇F_l with the Gram matrix G of the gradients
        let weights = solve_positive(gram(&gradients), unit);
        let transversal: Vec<T> = (0..phase.model().dimension())
            .map(|k| weights.iter().zip(&gradients).map(|(w, g)| *w * g[k]).sum())
            .collect();
        let moved = phase.lift(&transversal);
        sum += lie_derivative(&moved, |at| at.level_function(function)).eps;
    }
    sum
}

/// The level functions that `kept` selects.
pub fn kept_functions<'a, T: Scalar>(
    phase: &Phase<'a, T>,
    kept: &'a [bool],
) -> impl Iterator<Item = &'a LevelFunction> + use<'a, T> {
    let level = phase.model().level.iter();
    level.zip(kept).filter(|(_, kept)| **kept).map(|(equation, _)| &equation.function)
}

/// |u|² less its part in the span of `others`: zero exactly when u depends on them.
pub fn distance_from_span<T: Scalar>(u: &[T], others: &[Vec<T>]) -> T {
    if others.is_empty() {
        return dot(u, u);
    }
    let projections: Vec<T> = others.iter().map(|other| dot(u, other)).collect();
    let weights = solve_positive(gram(others), projections.clone());
    dot(u, u) - dot(&projections, &weights)
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
    let n = b.len();
    for k in 0..n {
        for i in k + 1..n {
            let factor = a[i][k] / a[k][k];
            for j in k..n {
                let above = a[k][j];
                a[i][j] -= factor * above;
            }
            let above = b[k];
            b[i] -= factor * above;
        }
    }
    for k in (0..n).rev() {
        let known: T = (k + 1..n).map(|j| a[k][j] * b[j]).sum();
        b[k] = (b[k] - known) / a[k][k];
    }
    b
}
