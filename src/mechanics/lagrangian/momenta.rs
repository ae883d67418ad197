//! Momenta p = ∂L/∂q' of a Lagrangian without constraints, and gradients with respect to (q,p).
//!
//! With A = ∂p/∂q' and B = ∂p/∂q a function F(q,q') has the gradient
//!
//! ```text
//! ∂F/∂p = A⁻¹ ∂F/∂q',   ∂F/∂q at constant p = ∂F/∂q − Bᵀ ∂F/∂p
//! ```

use super::{Algebra, Lagrangian, VariableRole};
use crate::mechanics::calculus::MANY;
use crate::mechanics::elimination::dot;
use crate::mechanics::{Configuration, Variable};
use crate::scalar::Scalar;

/// Derivatives of the momenta by the velocities and by the coordinates, by rows.
struct MomentumSlopes<T> {
    by_velocities: Vec<Vec<T>>,
    by_coordinates: Vec<Vec<T>>,
}

impl Lagrangian {
    /// Whether coordinates and momenta are canonical variables of the motion: it has no constraints,
    /// forces or multipliers, each velocity is the rate of a coordinate, and time is no variable.
    pub fn has_canonical_momenta(&self) -> bool {
        let is_plain = |role: &VariableRole| {
            matches!(role, VariableRole::Coordinate(_) | VariableRole::Velocity)
        };
        let coordinates = |role: &&VariableRole| matches!(role, VariableRole::Coordinate(_));
        let pairs = 2 * self.roles.iter().filter(coordinates).count();
        !self.vakonomic
            && self.constraints.is_empty()
            && self.forces.is_empty()
            && self.algebra == Algebra::Commuting
            && self.roles.iter().all(is_plain)
            && pairs == self.roles.len()
    }

    /// Turns gradients with respect to the state into those with respect to (q,p), the coordinates first
    /// and in the order of their velocities.
    pub fn in_momenta<T: Scalar>(
        &self,
        at: &Configuration<'_, T>,
        gradients: &[Vec<T>],
    ) -> Vec<Vec<T>> {
        let state: &[Variable] = &at.model.state;
        let pairs = self.coordinates(state);
        let slopes = self.momentum_slopes(at, &pairs);
        let of_velocities = |gradient: &Vec<T>| pairs.iter().map(|(_, w)| gradient[*w]).collect();
        let masses = &slopes.by_velocities;
        let sides: Vec<Vec<T>> = gradients.iter().map(of_velocities).collect();
        let by_momenta = self.solved(masses, sides);
        let whole = |(gradient, by_momenta): (&Vec<T>, Vec<T>)| {
            let by_coordinates = pairs.iter().enumerate().map(|(j, (q, _))| {
                let column: Vec<T> = slopes.by_coordinates.iter().map(|row| row[j]).collect();
                gradient[*q] - dot(&column, &by_momenta)
            });
            by_coordinates.chain(by_momenta.iter().copied()).collect()
        };
        gradients.iter().zip(by_momenta).map(whole).collect()
    }

    fn momentum_slopes<T: Scalar>(
        &self,
        at: &Configuration<'_, T>,
        pairs: &[(usize, usize)],
    ) -> MomentumSlopes<T> {
        let rows = self.swept_slopes(at, pairs).unwrap_or_else(|| self.lifted_slopes(at, pairs));
        let part = |place: &dyn Fn(&(usize, usize)) -> usize| {
            rows.iter().map(|row| pairs.iter().map(|pair| row[place(pair)]).collect()).collect()
        };
        MomentumSlopes { by_velocities: part(&|(_, w)| *w), by_coordinates: part(&|(q, _)| *q) }
    }

    /// Derivatives of the momenta by the state, by sweeps of the recording where there are many.
    fn swept_slopes<T: Scalar>(
        &self,
        at: &Configuration<'_, T>,
        pairs: &[(usize, usize)],
    ) -> Option<Vec<Vec<T>>> {
        let dimension = at.model.dimension();
        if dimension < MANY {
            return None;
        }
        let filled = |row: &Vec<(usize, T)>| {
            let mut all = vec![T::zero(); dimension];
            row.iter().for_each(|(place, slope)| all[*place] = *slope);
            all
        };
        let state = at.components();
        let gradient = filled(&T::gradients_of(&[self.lagrangian(at, false)], &state)?.pop()?);
        let momenta: Vec<T> = pairs.iter().map(|(_, w)| gradient[*w]).collect();
        Some(T::gradients_of(&momenta, &state)?.iter().map(filled).collect())
    }

    /// Derivatives of the momenta by the state, by a lift along each pair of directions.
    fn lifted_slopes<T: Scalar>(
        &self,
        at: &Configuration<'_, T>,
        pairs: &[(usize, usize)],
    ) -> Vec<Vec<T>> {
        let dimension = at.model.dimension();
        let row = |velocity: usize| {
            let mut unit = vec![T::zero(); dimension];
            unit[velocity] = T::one();
            let moved = at.lift_state(&unit);
            let slope = |place: usize| {
                let mut unit = vec![num_dual::Dual::from_re(T::zero()); dimension];
                unit[place] = num_dual::Dual::from_re(T::one());
                self.lagrangian(&moved.lift_state(&unit), false).eps.eps
            };
            (0..dimension).map(slope).collect()
        };
        pairs.iter().map(|(_, velocity)| row(*velocity)).collect()
    }
}
