//! Traits for user code: fields, quantities, maps and levels, each generic over the scalar.
//!
//! A closure cannot be generic, so each is a trait with one generic method. A user's type
//! implements it; existing functions are wrapped by the macros [`field!`](crate::field),
//! [`quantity!`](crate::quantity) and [`involution!`](crate::involution).

use super::claim::{CommutesWith, Conserved, FieldClaim, HasDensity, LogDensity, Reversed};
use liouville::scalar::Scalar;

/// A vector field x' = v(x) on ℝᴺ.
///
/// `Scalar` is num-dual's `DualNum<Primitive = f64> + Copy` extended by exact rationals, so that
/// any function generic over `DualNum` can be called. An f64 stands for its exact dyadic value;
/// [`Scalar::rational`] makes ⅓.
pub trait VectorField<const N: usize> {
    /// Computes v(x).
    fn rates<T: Scalar>(&self, x: [T; N]) -> [T; N];

    /// Returns values that must vanish wherever the field is used; every claim about the field
    /// checks them too.
    fn conditions<T: Scalar>(&self, _x: [T; N]) -> Vec<T> {
        Vec::new()
    }

    /// Claims that F is a first integral: L_vF = 0.
    fn conserves<'a, Q: Quantity<N>>(
        &'a self,
        quantity: &'a Q,
    ) -> FieldClaim<'a, Self, Conserved<'a, Q>, N>
    where
        Self: Sized,
    {
        FieldClaim::new(self, Conserved(quantity))
    }

    /// Claims that ρ is an invariant density: v(ln ρ) + div v, minus the cofactors of the level
    /// functions, is 0.
    fn has_density<'a, Q: Quantity<N>>(
        &'a self,
        density: &'a Q,
    ) -> FieldClaim<'a, Self, HasDensity<'a, Q>, N>
    where
        Self: Sized,
    {
        FieldClaim::new(self, HasDensity(density))
    }

    /// Claims an invariant density given by ln ρ.
    fn has_log_density<'a, Q: Quantity<N>>(
        &'a self,
        logarithm: &'a Q,
    ) -> FieldClaim<'a, Self, LogDensity<'a, Q>, N>
    where
        Self: Sized,
    {
        FieldClaim::new(self, LogDensity(logarithm))
    }

    /// Claims that u is a symmetry field: `[v,u] = 0`, and u is tangent to the level.
    fn commutes_with<'a, U: VectorField<N>>(
        &'a self,
        other: &'a U,
    ) -> FieldClaim<'a, Self, CommutesWith<'a, U>, N>
    where
        Self: Sized,
    {
        FieldClaim::new(self, CommutesWith(other))
    }

    /// Claims that σ reverses time: dσ·v = -v∘σ and σ∘σ = id, and σ preserves the level.
    fn is_reversed_by<'a, S: Involution<N>>(
        &'a self,
        map: &'a S,
    ) -> FieldClaim<'a, Self, Reversed<'a, S>, N>
    where
        Self: Sized,
    {
        FieldClaim::new(self, Reversed(map))
    }
}

/// A function on ℝᴺ: an integral, a density, or the logarithm of one.
pub trait Quantity<const N: usize> {
    /// Evaluates F(x).
    fn value<T: Scalar>(&self, x: [T; N]) -> T;
}

/// A map σ of ℝᴺ to itself with σ∘σ = id.
pub trait Involution<const N: usize> {
    /// Computes σ(x).
    fn image<T: Scalar>(&self, x: [T; N]) -> [T; N];
}

/// A level set {F₁ = 0, …, F_k = 0} in ℝᴺ with a chart of K coordinates, K at least the dimension
/// of the level.
pub trait Level<const K: usize, const N: usize> {
    /// Returns the point of the level with coordinates u.
    fn point<T: Scalar>(&self, u: [T; K]) -> [T; N];

    /// Evaluates F₁, …, F_k anywhere in ℝᴺ. A density refers to the volume σ with dx =
    /// dF₁∧…∧dF_k∧σ.
    fn functions<T: Scalar>(&self, x: [T; N]) -> Vec<T>;
}

/// A state of a property test: numbers, and the point made from them.
///
/// The point is made inside the arithmetic that an assertion uses, and so lies exactly on its
/// level. An array is a point of ℝᴺ, [`On`] a point of a level.
pub trait TestState<const N: usize> {
    /// Returns the numbers, exact as given.
    fn coordinates(&self) -> &[f64];

    /// Makes the point from these numbers.
    fn point<T: Scalar>(&self, coordinates: &[T]) -> [T; N];

    /// Evaluates the functions that vanish on the level, at any point; none in all of ℝᴺ.
    fn level<T: Scalar>(&self, x: [T; N]) -> Vec<T>;
}

impl<const N: usize> TestState<N> for [f64; N] {
    fn coordinates(&self) -> &[f64] {
        self
    }

    fn point<T: Scalar>(&self, coordinates: &[T]) -> [T; N] {
        std::array::from_fn(|k| coordinates[k])
    }

    fn level<T: Scalar>(&self, _: [T; N]) -> Vec<T> {
        Vec::new()
    }
}

/// A point of a level, by its coordinates in the level's chart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct On<L, const K: usize> {
    /// Level of the point.
    pub level: L,
    /// Coordinates in the chart.
    pub coordinates: [f64; K],
}

impl<L: Level<K, N>, const K: usize, const N: usize> TestState<N> for On<L, K> {
    fn coordinates(&self) -> &[f64] {
        &self.coordinates
    }

    fn point<T: Scalar>(&self, coordinates: &[T]) -> [T; N] {
        self.level.point(std::array::from_fn(|k| coordinates[k]))
    }

    fn level<T: Scalar>(&self, x: [T; N]) -> Vec<T> {
        self.level.functions(x)
    }
}
