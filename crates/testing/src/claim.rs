//! Claims about a vector field, and their residuals.
//!
//! ```text
//! integral F         L_vF
//! density ρ          v(ln ρ) + div v - Σ d(L_vF_i)(n_i),   dF_i(n_j) = δ_ij
//! symmetry field u   [v,u],  dF_i(u)
//! reversor σ         dσ·v + v∘σ,  σ∘σ - id,  F_i∘σ
//! ```
//!
//! Derivatives are taken in the ambient space, and the chart is substituted afterwards;
//! docs/soundness.md.

use num_dual::Dual;

use super::notation::{Involution, Quantity, TestState, VectorField};
use liouville::mechanics::elimination::transversals;
use liouville::scalar::Scalar;

/// Values that must vanish, with the name shown on failure.
pub type Parts<T> = Vec<(&'static str, Vec<T>)>;

/// A claim about a vector field, to be tested by [`at`](FieldClaim::at) or proved by
/// [`prove`](FieldClaim::prove).
#[must_use = "nothing is checked before `at` or `prove`"]
pub struct FieldClaim<'a, V, S, const N: usize> {
    pub(super) field: &'a V,
    pub(super) statement: S,
}

impl<'a, V, S, const N: usize> FieldClaim<'a, V, S, N> {
    pub(super) fn new(field: &'a V, statement: S) -> Self {
        Self { field, statement }
    }
}

/// A property of a vector field that can be tested or proved.
pub trait FieldProperty<V, const N: usize> {
    /// Computes the values that vanish at x if the property holds on the level of a place.
    fn residual<T: Scalar>(&self, field: &V, place: &impl TestState<N>, x: [T; N]) -> Parts<T>;
}

/// Property tested by [`VectorField::conserves`].
pub struct Conserved<'a, Q>(pub(super) &'a Q);

/// Property tested by [`VectorField::has_density`].
pub struct HasDensity<'a, Q>(pub(super) &'a Q);

/// Property tested by [`VectorField::has_log_density`].
pub struct LogDensity<'a, Q>(pub(super) &'a Q);

/// Property tested by [`VectorField::commutes_with`].
pub struct CommutesWith<'a, U>(pub(super) &'a U);

/// Property tested by [`VectorField::is_reversed_by`].
pub struct Reversed<'a, S>(pub(super) &'a S);

impl<V: VectorField<N>, Q: Quantity<N>, const N: usize> FieldProperty<V, N> for Conserved<'_, Q> {
    fn residual<T: Scalar>(&self, field: &V, _: &impl TestState<N>, x: [T; N]) -> Parts<T> {
        vec![("L_vF", vec![self.0.value(lift(x, field.rates(x))).eps])]
    }
}

impl<V: VectorField<N>, Q: Quantity<N>, const N: usize> FieldProperty<V, N> for HasDensity<'_, Q> {
    fn residual<T: Scalar>(&self, field: &V, place: &impl TestState<N>, x: [T; N]) -> Parts<T> {
        let density = self.0.value(lift(x, field.rates(x)));
        vec![liouville(density.eps / density.re, field, place, x)]
    }
}

impl<V: VectorField<N>, Q: Quantity<N>, const N: usize> FieldProperty<V, N> for LogDensity<'_, Q> {
    fn residual<T: Scalar>(&self, field: &V, place: &impl TestState<N>, x: [T; N]) -> Parts<T> {
        let logarithm = self.0.value(lift(x, field.rates(x)));
        vec![liouville(logarithm.eps, field, place, x)]
    }
}

impl<V: VectorField<N>, U: VectorField<N>, const N: usize> FieldProperty<V, N>
    for CommutesWith<'_, U>
{
    fn residual<T: Scalar>(&self, field: &V, place: &impl TestState<N>, x: [T; N]) -> Parts<T> {
        let (v, u) = (field.rates(x), self.0.rates(x));
        let (along_v, along_u) = (self.0.rates(lift(x, v)), field.rates(lift(x, u)));
        let commutator = along_v.iter().zip(along_u).map(|(a, b)| a.eps - b.eps).collect();
        let tangent = place.level(lift(x, u)).into_iter().map(|f| f.eps).collect();
        vec![("[v,u]", commutator), ("dF(u), of the level function F", tangent)]
    }
}

impl<V: VectorField<N>, S: Involution<N>, const N: usize> FieldProperty<V, N> for Reversed<'_, S> {
    fn residual<T: Scalar>(&self, field: &V, place: &impl TestState<N>, x: [T; N]) -> Parts<T> {
        let pushed = self.0.image(lift(x, field.rates(x)));
        let there = pushed.map(|y| y.re);
        let reversed = pushed.iter().zip(field.rates(there)).map(|(y, v)| y.eps + v).collect();
        let twice = self.0.image(there).into_iter().zip(x).map(|(y, x)| y - x).collect();
        vec![
            ("dσ·v + v∘σ", reversed),
            ("σ∘σ - id", twice),
            ("F∘σ, of the level function F", place.level(there)),
        ]
    }
}

/// Computes the premises of any claim: the conditions of the field, and the invariance of the
/// level.
pub fn premises<V: VectorField<N>, T: Scalar, const N: usize>(
    field: &V,
    place: &impl TestState<N>,
    x: [T; N],
) -> Parts<T> {
    let moved = place.level(lift(x, field.rates(x)));
    vec![
        ("a condition of the field", field.conditions(x)),
        ("a level function at the point of the chart", moved.iter().map(|f| f.re).collect()),
        ("the rate of a level function", moved.iter().map(|f| f.eps).collect()),
    ]
}

/// Computes v(ln ρ) + div v minus the cofactors of the level functions.
fn liouville<V: VectorField<N>, T: Scalar, const N: usize>(
    along: T,
    field: &V,
    place: &impl TestState<N>,
    x: [T; N],
) -> (&'static str, Vec<T>) {
    let divergence: T = (0..N).map(|k| field.rates(lift(x, axis(k)))[k].eps).sum();
    let gradients = level_gradients(place, x);
    let cofactor: T = transversals(&gradients)
        .iter()
        .enumerate()
        .map(|(i, transversal)| {
            let beside = lift(x, std::array::from_fn(|k| transversal[k]));
            place.level(lift(beside, field.rates(beside)))[i].eps.eps
        })
        .sum();
    ("v(ln ρ) + div v", vec![along + divergence - cofactor])
}

/// Computes the gradients of the level functions.
pub fn level_gradients<T: Scalar, const N: usize>(
    place: &impl TestState<N>,
    x: [T; N],
) -> Vec<Vec<T>> {
    let columns: Vec<Vec<Dual<T>>> = (0..N).map(|k| place.level(lift(x, axis(k)))).collect();
    let count = columns.first().map_or(0, Vec::len);
    (0..count).map(|i| columns.iter().map(|column| column[i].eps).collect()).collect()
}

/// Adds derivative parts to x.
pub fn lift<T: Scalar, const N: usize>(x: [T; N], direction: [T; N]) -> [Dual<T>; N] {
    std::array::from_fn(|k| Dual::new(x[k], direction[k]))
}

fn axis<T: Scalar, const N: usize>(k: usize) -> [T; N] {
    std::array::from_fn(|j| if j == k { T::one() } else { T::zero() })
}
