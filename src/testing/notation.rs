//! What the user writes: fields, quantities, maps and levels, each generic over the scalar.
//!
//! A closure cannot be generic, so each is a trait with one generic method. A type of one's own
//! implements it; for a function that exists already there are the macros [`field!`](crate::field),
//! [`quantity!`](crate::quantity) and [`involution!`](crate::involution).

use super::claim::{Claim, Conserved, Density, LogDensity, Reversed, SymmetryField};
use crate::scalar::Scalar;

/// A vector field x' = v(x) on ℝᴺ.
///
/// `Scalar` is num-dual's `DualNum<Primitive = f64> + Copy` with exact rationals beside it, so that
/// any function generic over `DualNum` can be called from here. An f64 is the dyadic number it is;
/// [`Scalar::rational`] makes ⅓.
pub trait VectorField<const N: usize> {
    /// v(x)
    fn rates<T: Scalar>(&self, x: [T; N]) -> [T; N];

    /// What must vanish wherever the field is used; every claim about the field checks it too.
    fn conditions<T: Scalar>(&self, _x: [T; N]) -> Vec<T> {
        Vec::new()
    }

    /// F is a first integral: L_vF = 0.
    fn conserves<'a, Q: Quantity<N>>(
        &'a self,
        quantity: &'a Q,
    ) -> Claim<'a, Self, Conserved<'a, Q>, N>
    where
        Self: Sized,
    {
        Claim::new(self, Conserved(quantity))
    }

    /// ρ is an invariant density: v(ln ρ) + div v, less the cofactors of the level functions, is 0.
    fn has_density<'a, Q: Quantity<N>>(
        &'a self,
        density: &'a Q,
    ) -> Claim<'a, Self, Density<'a, Q>, N>
    where
        Self: Sized,
    {
        Claim::new(self, Density(density))
    }

    /// The same for a density that is given by ln ρ.
    fn has_log_density<'a, Q: Quantity<N>>(
        &'a self,
        logarithm: &'a Q,
    ) -> Claim<'a, Self, LogDensity<'a, Q>, N>
    where
        Self: Sized,
    {
        Claim::new(self, LogDensity(logarithm))
    }

    /// u is a symmetry field: \[v,u\] = 0, and u is tangent to the level.
    fn commutes_with<'a, U: VectorField<N>>(
        &'a self,
        other: &'a U,
    ) -> Claim<'a, Self, SymmetryField<'a, U>, N>
    where
        Self: Sized,
    {
        Claim::new(self, SymmetryField(other))
    }

    /// σ reverses time: dσ·v = -v∘σ and σ∘σ = id, and σ keeps the level.
    fn is_reversed_by<'a, S: Involution<N>>(
        &'a self,
        map: &'a S,
    ) -> Claim<'a, Self, Reversed<'a, S>, N>
    where
        Self: Sized,
    {
        Claim::new(self, Reversed(map))
    }
}

/// A function on ℝᴺ: an integral, a density, or the logarithm of one.
pub trait Quantity<const N: usize> {
    /// F(x)
    fn value<T: Scalar>(&self, x: [T; N]) -> T;
}

/// A map σ of ℝᴺ to itself with σ∘σ = id.
pub trait Involution<const N: usize> {
    /// σ(x)
    fn image<T: Scalar>(&self, x: [T; N]) -> [T; N];
}

/// A level set {F₁ = 0, …, F_k = 0} in ℝᴺ with a chart of K numbers, at least as many as the level
/// has dimensions.
pub trait Level<const K: usize, const N: usize> {
    /// The point of the level that belongs to the numbers u.
    fn point<T: Scalar>(&self, u: [T; K]) -> [T; N];

    /// F₁, …, F_k anywhere in ℝᴺ. A density refers to the volume σ with dx = dF₁∧…∧dF_k∧σ.
    fn functions<T: Scalar>(&self, x: [T; N]) -> Vec<T>;
}

/// A state of a property test: numbers, and how a point is made from them.
///
/// The point is made inside the arithmetic that an assertion uses, and so lies on its level exactly.
/// An array is a point of ℝᴺ, [`On`] a point of a level.
pub trait Place<const N: usize> {
    /// The numbers, exact as they stand.
    fn coordinates(&self) -> &[f64];

    /// The point made from as many numbers.
    fn point<T: Scalar>(&self, coordinates: &[T]) -> [T; N];

    /// The functions that vanish on the level, at any point; none in all of ℝᴺ.
    fn level<T: Scalar>(&self, x: [T; N]) -> Vec<T>;
}

impl<const N: usize> Place<N> for [f64; N] {
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

/// A point of a level, by its numbers in the level's chart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct On<L, const K: usize> {
    /// The level.
    pub level: L,
    /// The numbers.
    pub coordinates: [f64; K],
}

impl<L: Level<K, N>, const K: usize, const N: usize> Place<N> for On<L, K> {
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
