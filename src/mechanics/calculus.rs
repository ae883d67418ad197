//! Derivatives of functions and of the field by automatic differentiation: gradients, Lie
//! derivatives, divergences, and the contribution of a level set to a divergence.

use std::cell::OnceCell;

use num_dual::Dual;

use super::model::{LevelFunction, Model};
use super::phase::Phase;
use super::variables::VariablesJet;
use crate::formula::Formula;
use crate::scalar::Scalar;

/// Dimension of phase space from which derivatives are taken by sweeps of the recording.
///
/// A lift along each coordinate repeats the whole computation, which for a few coordinates costs
/// nothing worth mention, and for n of them n times what it should.
pub(super) const MANY: usize = 20;

/// A point of phase space with its lifts to dual numbers, made once for all derivatives.
pub struct DualPoint<'m, T> {
    /// The point itself.
    pub phase: Phase<'m, T>,
    along_field: OnceCell<Phase<'m, Dual<T>>>,
    along_axes: OnceCell<Vec<Phase<'m, Dual<T>>>>,
    divergence: OnceCell<T>,
    level_gradients: OnceCell<Vec<Vec<T>>>,
    energy_gradient: OnceCell<Option<Vec<T>>>,
    pub(super) image: VariablesJet<'m, T>,
}

impl<'m, T: Scalar> DualPoint<'m, T> {
    /// Makes the jet at a point; nothing is computed yet.
    #[inline(never)]
    pub fn new(phase: Phase<'m, T>) -> Self {
        Self {
            phase,
            along_field: OnceCell::new(),
            along_axes: OnceCell::new(),
            divergence: OnceCell::new(),
            level_gradients: OnceCell::new(),
            energy_gradient: OnceCell::new(),
            image: VariablesJet::default(),
        }
    }

    /// Makes the jet at a point with the divergence by the system's closed formula, where there is
    /// one.
    #[inline(never)]
    pub fn short(phase: Phase<'m, T>) -> Self {
        let divergence = phase.model().system.divergence(&phase);
        let jet = Self::new(phase);
        if let Some(divergence) = divergence {
            jet.divergence.get_or_init(|| divergence);
        }
        jet
    }

    /// Returns the point with the field as its derivative part.
    #[inline(never)]
    pub fn along_field(&self) -> &Phase<'m, Dual<T>> {
        self.along_field.get_or_init(|| self.phase.lift(self.phase.field()))
    }

    /// Returns the point with a derivative part along each coordinate in turn.
    #[inline(never)]
    pub fn along_axes(&self) -> &[Phase<'m, Dual<T>>] {
        self.along_axes.get_or_init(|| {
            (0..self.phase.model().dimension()).map(|index| self.phase.lift_along(index)).collect()
        })
    }

    /// Computes L_v f, the derivative of f along the field.
    #[inline(never)]
    pub fn lie_derivative(&self, f: impl FnOnce(&Phase<'m, Dual<T>>) -> Dual<T>) -> T {
        f(self.along_field()).eps
    }

    /// Computes the gradients of values at the point by sweeps of the recording; `None` where lifts
    /// along the coordinates have to do it.
    #[inline(never)]
    fn swept(&self, values: impl FnOnce(&Phase<'m, T>) -> Vec<T>) -> Option<Vec<Vec<T>>> {
        let dimension = self.phase.model().dimension();
        if dimension < MANY {
            return None;
        }
        let rows = T::gradients_of(&values(&self.phase), &self.phase.state())?;
        Some(rows.iter().map(|row| filled(row, dimension)).collect())
    }

    /// Computes the partial derivatives of f with respect to the state's components.
    #[inline(never)]
    pub fn gradient(&self, f: impl Fn(&Phase<'m, Dual<T>>) -> Dual<T>) -> Vec<T> {
        self.along_axes().iter().map(|phase| f(phase).eps).collect()
    }

    /// Computes L_vF, component by component.
    #[inline(never)]
    pub fn rates(&self, formula: &Formula) -> Vec<T> {
        self.along_field().evaluate(formula).components().iter().map(|x| x.eps).collect()
    }

    /// Computes the gradients of the components of F.
    #[inline(never)]
    pub fn gradients(&self, formula: &Formula) -> Vec<Vec<T>> {
        if let Some(rows) = self.swept(|at| at.evaluate(formula).components()) {
            return rows;
        }
        let columns: Vec<Vec<T>> = self
            .along_axes()
            .iter()
            .map(|phase| phase.evaluate(formula).components().iter().map(|x| x.eps).collect())
            .collect();
        let count = formula.value_type().size();
        (0..count).map(|k| columns.iter().map(|column| column[k]).collect()).collect()
    }

    /// Computes the gradient of the logarithm of F, factor by factor.
    #[inline(never)]
    pub fn logarithmic_gradient(&self, formula: &Formula) -> Vec<T> {
        let dimension = self.phase.model().dimension();
        if dimension >= MANY {
            let state = self.phase.state();
            let gradients = |values: &[T]| T::gradients_of(values, &state);
            let found =
                formula.logarithmic_gradient(&mut |symbol| self.phase.value(symbol), &gradients);
            if let Some(row) = found {
                return filled(&row, dimension);
            }
        }
        self.along_axes()
            .iter()
            .map(|moved| formula.logarithmic_derivative(&mut |symbol| moved.value(symbol)))
            .collect()
    }

    /// Computes div v = Σ ∂v_i/∂x_i over all components of the state.
    #[inline(never)]
    pub fn divergence(&self) -> T {
        *self.divergence.get_or_init(|| {
            if self.phase.model().dimension() >= MANY
                && let Some(terms) = T::diagonal_of(self.phase.field(), &self.phase.state())
            {
                return terms.into_iter().sum();
            }
            let along = self.along_axes().iter().enumerate();
            along.map(|(i, phase)| phase.field()[i].eps).sum()
        })
    }

    /// Computes Σ d(L_vF_i)(n_i) over the kept level functions, with dF_i(n_j) = δ_ij.
    ///
    /// On a level set {F_i = c_i} with dx = dF_1∧…∧dF_k∧σ, L_v σ = (div v - this sum) σ. It
    /// vanishes where the F_i are integrals near the level.
    #[inline(never)]
    pub fn level_cofactor(&self, kept: &[bool]) -> T {
        let functions: Vec<&LevelFunction> = kept_functions(self.phase.model(), kept).collect();
        if functions.is_empty() || self.phase.model().system.conserves_level() {
            return T::zero();
        }
        let gradients = self.level_gradients(kept);
        let mut sum = T::zero();
        for (function, transversal) in functions.iter().zip(transversals(&gradients)) {
            let beside = self.phase.lift(&transversal);
            sum += beside.lift(beside.field()).level_function(function).eps.eps;
        }
        sum
    }

    /// Evaluates the kept level functions at another point.
    #[inline(never)]
    pub fn level_at(&self, there: &Phase<'m, T>, kept: &[bool]) -> Vec<T> {
        kept_functions(there.model(), kept).map(|f| there.level_function(f)).collect()
    }

    /// Computes the gradients of the kept level functions.
    #[inline(never)]
    pub fn level_gradients(&self, kept: &[bool]) -> Vec<Vec<T>> {
        let all = self.level_gradients.get_or_init(|| {
            let level = || self.phase.model().level.iter().map(|equation| &equation.function);
            let swept = self.swept(|at| level().map(|f| at.level_function(f)).collect());
            swept.unwrap_or_else(|| {
                level().map(|f| self.gradient(|at| at.level_function(f))).collect()
            })
        });
        all.iter().zip(kept).filter(|(_, kept)| **kept).map(|(g, _)| g.clone()).collect()
    }

    /// Computes the gradient of the energy, where there is one.
    #[inline(never)]
    pub fn energy_gradient(&self) -> Option<&Vec<T>> {
        let make = || {
            let energy = |at: &Phase<'m, T>| at.model().system.energy(at);
            if let Some(mut rows) = self.swept(|at| energy(at).into_iter().collect()) {
                return rows.pop();
            }
            let slope = |at: &Phase<'m, Dual<T>>| Some(at.model().system.energy(at)?.eps);
            self.along_axes().iter().map(slope).collect()
        };
        self.energy_gradient.get_or_init(make).as_ref()
    }
}

/// Writes a row of derivatives out, with 0 for those that it leaves out.
#[inline(never)]
fn filled<T: Scalar>(row: &[(usize, T)], dimension: usize) -> Vec<T> {
    let mut all = vec![T::zero(); dimension];
    row.iter().for_each(|(place, value)| all[*place] = *value);
    all
}

/// Selects the level functions given by `kept`.
#[inline(never)]
fn kept_functions<'a>(
    model: &'a Model,
    kept: &'a [bool],
) -> impl Iterator<Item = &'a LevelFunction> + use<'a> {
    let level = model.level.iter().zip(kept);
    level.filter(|(_, kept)| **kept).map(|(equation, _)| &equation.function)
}

/// Finds vectors n_i in the span of some gradients with dF_i(n_j) = δ_ij.
#[inline(never)]
pub fn transversals<T: Scalar>(gradients: &[Vec<T>]) -> Vec<Vec<T>> {
    let count = gradients.len();
    let unit = |i: usize, j: usize| if i == j { T::one() } else { T::zero() };
    let transversal = |i: usize| {
        // n_i = Σ_l (G⁻¹)_il ∇F_l with the Gram matrix G of the gradients
        let weights = solve_positive(gram(gradients), (0..count).map(|j| unit(i, j)).collect());
        let dimension = gradients.first().map_or(0, Vec::len);
        (0..dimension)
            .map(|k| weights.iter().zip(gradients).map(|(w, g)| *w * g[k]).sum())
            .collect()
    };
    (0..count).map(transversal).collect()
}

/// Computes u minus its projection on the span of `others`: zero exactly when u depends on them.
#[inline(never)]
pub fn rejection<T: Scalar>(u: &[T], others: &[Vec<T>]) -> Vec<T> {
    let projections = others.iter().map(|other| dot(u, other)).collect();
    let weights = solve_positive(gram(others), projections);
    let part = |k: usize| -> T { weights.iter().zip(others).map(|(w, g)| *w * g[k]).sum() };
    u.iter().enumerate().map(|(k, x)| if others.is_empty() { *x } else { *x - part(k) }).collect()
}

/// Computes the inner product Σ a_i b_i.
#[inline(never)]
pub fn dot<T: Scalar>(a: &[T], b: &[T]) -> T {
    a.iter().zip(b).map(|(a, b)| *a * *b).sum()
}

/// Largest size of a determinant computed by minors, of which there are 2ⁿ; larger ones are the
/// last coefficient of the characteristic polynomial.
const MOST_BY_MINORS: usize = 10;

/// Computes the Gram determinant of some vectors: zero exactly when they are dependent.
///
/// Expanded by minors of the first rows, since a pivot may vanish where the vectors are dependent.
#[inline(never)]
pub fn gram_determinant<T: Scalar>(vectors: &[Vec<T>]) -> T {
    let n = vectors.len();
    if vectors.first().is_some_and(|vector| vector.len() < n) {
        return T::zero();
    }
    determinant(&gram(vectors))
}

/// The determinant of a square matrix, without pivots.
#[inline(never)]
pub fn determinant<T: Scalar>(matrix: &[Vec<T>]) -> T {
    let n = matrix.len();
    if n > MOST_BY_MINORS {
        let last = characteristic_polynomial(matrix).pop().unwrap_or_else(T::one);
        return if n.is_multiple_of(2) { last } else { -last };
    }
    // minors[columns]: the determinant of the first rows with these columns
    let mut minors = vec![T::zero(); 1 << n];
    minors[0] = T::one();
    for columns in 1usize..1 << n {
        let row = columns.count_ones() as usize - 1;
        let mut sum = T::zero();
        let inside = (0..n).filter(|j| columns >> j & 1 == 1);
        for (place, j) in inside.enumerate() {
            let term = matrix[row][j] * minors[columns & !(1 << j)];
            sum = if (row + place).is_multiple_of(2) { sum + term } else { sum - term };
        }
        minors[columns] = sum;
    }
    minors[(1 << n) - 1]
}

/// Computes the coefficients of λ^(n-1), …, 1 in det(λE - A), A given by its columns, by the method
/// of Faddeev and LeVerrier.
#[inline(never)]
pub fn characteristic_polynomial<T: Scalar>(columns: &[Vec<T>]) -> Vec<T> {
    let n = columns.len();
    let mut coefficients = Vec::new();
    // power is A^k + c_1 A^(k-1) + … + c_k E, by columns
    let unit = |i: usize, j: usize| if i == j { T::one() } else { T::zero() };
    let mut power: Vec<Vec<T>> = (0..n).map(|j| (0..n).map(|i| unit(i, j)).collect()).collect();
    for k in 1..=n {
        let next: Vec<Vec<T>> = power
            .iter()
            .map(|column| (0..n).map(|i| (0..n).map(|l| columns[l][i] * column[l]).sum()).collect())
            .collect();
        let trace: T = (0..n).map(|i| next[i][i]).sum();
        let coefficient = -(trace / T::from(k as f64));
        coefficients.push(coefficient);
        power = next;
        for (i, column) in power.iter_mut().enumerate() {
            column[i] += coefficient;
        }
    }
    coefficients
}

/// Computes tr(B A⁻¹) for matrices given by their columns, by the normal equations of A.
#[inline(never)]
pub fn trace_of_quotient<T: Scalar>(a: &[Vec<T>], b: &[Vec<T>]) -> T {
    let solved = |j: usize| {
        let side = a.iter().map(|column| dot(column, &b[j])).collect();
        solve_positive(gram(a), side)[j]
    };
    (0..a.len()).map(solved).sum()
}

#[inline(never)]
fn gram<T: Scalar>(vectors: &[Vec<T>]) -> Vec<Vec<T>> {
    vectors.iter().map(|a| vectors.iter().map(|b| dot(a, b)).collect()).collect()
}

/// Solves A x = b for a positive definite A, by elimination without pivots.
#[inline(never)]
pub fn solve_positive<T: Scalar>(mut a: Vec<Vec<T>>, mut b: Vec<T>) -> Vec<T> {
    for k in 0..b.len() {
        let (above, below) = a.split_at_mut(k + 1);
        let (pivot_row, pivot_value) = (&above[k], b[k]);
        let present: Vec<usize> = (k..b.len()).filter(|j| !pivot_row[*j].is_absent()).collect();
        // A value that is defined nowhere makes all that it touches undefined, zeros too.
        let vanishes = |x: T| (x * T::zero()).is_absent();
        let is_plain = vanishes(pivot_row[k].recip())
            && vanishes(pivot_value)
            && present.iter().all(|j| vanishes(pivot_row[*j]));
        for (row, value) in below.iter_mut().zip(&mut b[k + 1..]) {
            if is_plain && row[k].is_absent() {
                continue;
            }
            let factor = row[k] / pivot_row[k];
            match vanishes(factor) {
                true => present.iter().for_each(|j| row[*j] -= factor * pivot_row[*j]),
                false => {
                    for (entry, pivot) in row.iter_mut().zip(pivot_row).skip(k) {
                        *entry -= factor * *pivot;
                    }
                }
            }
            *value -= factor * pivot_value;
        }
    }
    let mut are_plain = true;
    for k in (0..b.len()).rev() {
        let known: T = match are_plain {
            true => {
                let terms = a[k][k + 1..].iter().zip(&b[k + 1..]);
                terms.filter(|(entry, _)| !entry.is_absent()).map(|(a, b)| *a * *b).sum()
            }
            false => dot(&a[k][k + 1..], &b[k + 1..]),
        };
        b[k] = (b[k] - known) / a[k][k];
        are_plain = are_plain && (b[k] * T::zero()).is_absent();
    }
    b
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[inline(never)]
    fn elimination_solves() {
        let matrix = vec![vec![4.0, 1.0, 0.5], vec![1.0, 3.0, -1.0], vec![0.5, -1.0, 5.0]];
        let solution = solve_positive(matrix.clone(), vec![1.0, 2.0, 3.0]);
        for (row, expected) in matrix.iter().zip([1.0, 2.0, 3.0]) {
            assert!((dot(row, &solution) - expected).abs() < 1e-14, "A x = b");
        }
    }

    #[test]
    #[inline(never)]
    fn determinants_traces_and_characteristic_polynomials() {
        // A = [[2,1,0],[0,3,1],[1,0,1]] by columns: det A = 7, tr A = 6, second invariant 11.
        let a = vec![vec![2.0, 0.0, 1.0], vec![1.0, 3.0, 0.0], vec![0.0, 1.0, 1.0]];
        assert_eq!(gram_determinant(&a), 49.0, "det(AᵀA) = (det A)²");
        let dependent = vec![a[0].clone(), a[1].clone(), vec![3.0, 3.0, 1.0]];
        assert_eq!(gram_determinant(&dependent), 0.0, "the third is the sum of the others");
        assert_eq!(characteristic_polynomial(&a), [-6.0, 11.0, -7.0]);
        let axes = |n: usize| -> Vec<Vec<f64>> {
            let axis = |i: usize| (0..n).map(|j| if i == j { 2.0 } else { 0.0 }).collect();
            (0..n).map(axis).collect()
        };
        assert_eq!(gram_determinant(&axes(11)), 4f64.powi(11), "beyond minors");
        assert_eq!(gram_determinant(&[vec![1.0], vec![2.0]]), 0.0, "more vectors than dimensions");
        // B = A C with C = diag(1,2,4): tr(B A⁻¹) = tr C.
        let b: Vec<Vec<f64>> = [1.0, 2.0, 4.0]
            .iter()
            .zip(&a)
            .map(|(c, column)| column.iter().map(|x| c * x).collect())
            .collect();
        assert!((trace_of_quotient(&a, &b) - 7.0).abs() < 1e-12);
    }

    #[test]
    #[inline(never)]
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
