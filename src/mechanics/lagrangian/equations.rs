//! Second derivatives of 𝓛, the right sides of its equations, and the slopes of the constraints.

use num_dual::Dual;

use super::{Algebra, Lagrangian, LagrangianTerms, VariableRole};
use crate::formula::Formula;
use crate::mechanics::calculus::MANY;
use crate::mechanics::elimination::{dot, solve_by_cramer, solve_by_minors, solve_positive};
use crate::mechanics::{Configuration, Phase, Variable};
use crate::scalar::Scalar;

/// The equations of motion at a point, not yet solved: M w' = drive + Σ μ_k a_k with (a_k, w') = −carried_k.
pub struct LagrangianEquations<T> {
    /// Components of the state that are velocities.
    pub velocities: Vec<usize>,
    /// Rates of the coordinates, 0 in the other components.
    pub drift: Vec<T>,
    /// Masses, right sides and slopes.
    pub terms: EquationTerms<T>,
    /// Rates of the constraints while the velocities are kept.
    pub carried: Vec<T>,
}

/// Derivatives of 𝓛 and of the constraints at a point, by velocity.
pub struct EquationTerms<T> {
    /// Second derivatives M = ∂²𝓛/∂w_i∂w_j, by rows.
    pub mass: Vec<Vec<T>>,
    /// Right sides X_i(𝓛) + Q_i - c^b_ia w_a P_b - ∂P_i/∂q q', without reactions.
    pub drive: Vec<T>,
    /// Derivatives a_ki = ∂f_k/∂w_i, by rows.
    pub slopes: Vec<Vec<T>>,
}

/// A solver of A x = b for several b.
type Solver<'s, T> = dyn Fn(&[Vec<T>], Vec<Vec<T>>) -> Vec<Vec<T>> + 's;

/// Largest number of velocities and constraints of which determinants are written out.
pub const MOST_ROWS: usize = 8;

impl<T: Scalar> LagrangianEquations<T> {
    /// Whether there are few velocities and constraints.
    pub(super) fn is_small(&self) -> bool {
        self.terms.mass.len() + self.terms.slopes.len() <= MOST_ROWS
    }

    /// Returns the masses, bordered by the slopes: [[M, aᵀ], [a, 0]] (w', −μ) = (drive, −carried).
    pub(super) fn bordered(&self) -> Vec<Vec<T>> {
        let EquationTerms { mass, slopes, .. } = &self.terms;
        let upper = mass.iter().enumerate().map(|(i, row)| {
            row.iter().copied().chain(slopes.iter().map(|slope| slope[i])).collect()
        });
        let lower = slopes
            .iter()
            .map(|slope| slope.iter().copied().chain(slopes.iter().map(|_| T::zero())).collect());
        upper.chain(lower).collect()
    }

    /// Returns equations with the same solution and the masses M + aᵀa, which may be regular where M is not. With
    /// a w' = −carried the right sides get −aᵀ carried.
    pub(super) fn with_slopes(mut self) -> Self {
        let EquationTerms { mass, drive, slopes } = &mut self.terms;
        for (slope, carried) in slopes.iter().zip(&self.carried) {
            for (i, row) in mass.iter_mut().enumerate() {
                row.iter_mut().zip(slope).for_each(|(own, a)| *own += slope[i] * *a);
                drive[i] -= slope[i] * *carried;
            }
        }
        self
    }

    /// Solves the equations by their determinant, without pivots.
    pub(super) fn by_determinant(self) -> LagrangianTerms<T> {
        self.solved_whole(|matrix, side| solve_by_cramer(&matrix, &side))
    }

    /// Solves the equations by the determinants of their blocks, without pivots.
    pub(super) fn by_blocks(self) -> LagrangianTerms<T> {
        self.solved_whole(|matrix, side| solve_by_minors(&matrix, &[side]).remove(0))
    }

    fn solved_whole(self, solve: impl FnOnce(Vec<Vec<T>>, Vec<T>) -> Vec<T>) -> LagrangianTerms<T> {
        let opposite = self.carried.iter().map(|own| -*own);
        let side: Vec<T> = self.terms.drive.iter().copied().chain(opposite).collect();
        let mut acceleration = solve(self.bordered(), side);
        let reactions = acceleration.split_off(self.velocities.len());
        LagrangianTerms {
            velocities: self.velocities,
            acceleration,
            reactions: reactions.into_iter().map(|own| -own).collect(),
            drift: self.drift,
        }
    }
}

impl<T: Scalar> LagrangianEquations<T> {
    /// Solves for the free accelerations first, and then for the reactions, each by a solver.
    pub(super) fn solved_by(self, solve: &Solver<'_, T>) -> LagrangianTerms<T> {
        let LagrangianEquations { velocities, drift, terms, carried } = self;
        let EquationTerms { mass, drive, slopes } = terms;
        let sides = [drive].into_iter().chain(slopes.iter().cloned()).collect();
        let mut responses = solve(&mass, sides);
        let free = responses.remove(0);
        let gram: Vec<Vec<T>> =
            slopes.iter().map(|a| responses.iter().map(|b| dot(a, b)).collect()).collect();
        let defects = carried.iter().zip(&slopes).map(|(own, a)| -(*own + dot(a, &free))).collect();
        let reactions = solve(&gram, vec![defects]).remove(0);
        let acceleration = free
            .iter()
            .enumerate()
            .map(|(i, free)| {
                reactions.iter().zip(&responses).map(|(m, r)| *m * r[i]).sum::<T>() + *free
            })
            .collect();
        LagrangianTerms { velocities, acceleration, reactions, drift }
    }
}

impl Lagrangian {
    /// Returns the equations of motion at a point.
    pub fn equations<T: Scalar>(&self, phase: &Phase<'_, T>) -> LagrangianEquations<T> {
        let at = &phase.configuration;
        let velocities = self.velocities(&at.model.state);
        let drift = self.drift(at);
        let force = |i: usize| {
            let given = self.forces.iter().find(|(component, _)| *component == velocities[i]);
            given.map_or_else(T::zero, |(_, force)| phase.scalar(force))
        };
        let terms = self
            .swept_terms(at, &velocities, &drift, force)
            .unwrap_or_else(|| self.lifted_terms(at, &velocities, &drift, force));
        let moving = at.lift_state(&drift);
        let carried = self.constraints.iter().map(|f| moving.scalar(f).eps).collect();
        LagrangianEquations { velocities, drift, terms, carried }
    }

    /// Takes the derivatives by sweeps of the recording, in coordinates and where there are many;
    /// `None` elsewhere.
    pub(super) fn swept_terms<T: Scalar>(
        &self,
        at: &Configuration<'_, T>,
        velocities: &[usize],
        drift: &[T],
        force: impl Fn(usize) -> T,
    ) -> Option<EquationTerms<T>> {
        let dimension = at.model.dimension();
        let is_carried = |role: &VariableRole| matches!(role, VariableRole::Carried(_));
        if dimension < MANY
            || self.algebra != Algebra::Commuting
            || self.roles.iter().any(is_carried)
        {
            return None;
        }
        let state = at.components();
        let slopes = T::gradients_of(&[self.lagrangian(at, self.vakonomic)], &state)?.pop()?;
        let mut gradient = vec![T::zero(); dimension];
        slopes.iter().for_each(|(place, slope)| gradient[*place] = *slope);
        let momenta: Vec<T> = velocities.iter().map(|component| gradient[*component]).collect();
        let own: Vec<T> = velocities.iter().map(|component| state[*component]).collect();
        let rows = |values: &[T]| -> Option<Vec<Vec<T>>> {
            let rows = T::gradients_of(values, &own)?.into_iter();
            let written_out = rows.map(|row| {
                let mut all = vec![T::zero(); own.len()];
                row.iter().for_each(|(place, slope)| all[*place] = *slope);
                all
            });
            Some(written_out.collect())
        };
        let mut along = vec![T::zero(); dimension];
        for (coordinate, velocity) in self.coordinates(&at.model.state) {
            along[velocity] += gradient[coordinate];
        }
        let carried = T::derivatives_along(&momenta, &state, drift)?;
        let driven = velocities.iter().zip(carried).enumerate();
        let constraints: Vec<T> = self.constraints.iter().map(|f| at.scalar(f)).collect();
        Some(EquationTerms {
            drive: driven.map(|(i, (w, carried))| along[*w] + force(i) - carried).collect(),
            mass: rows(&momenta)?,
            slopes: rows(&constraints)?,
        })
    }

    /// Returns the components of the coordinates, each with that of its velocity.
    pub(super) fn coordinates(&self, state: &[Variable]) -> Vec<(usize, usize)> {
        let starts: Vec<usize> = state
            .iter()
            .scan(0, |next, variable| {
                *next += variable.len();
                Some(*next - variable.len())
            })
            .collect();
        let mut pairs = Vec::new();
        for (index, role) in self.roles.iter().enumerate() {
            if let VariableRole::Coordinate(velocity) = role {
                let own = starts[index]..starts[index] + state[index].len();
                pairs.extend(own.zip(starts[*velocity]..));
            }
        }
        pairs
    }

    /// Takes the derivatives by a lift along each velocity.
    pub(super) fn lifted_terms<T: Scalar>(
        &self,
        at: &Configuration<'_, T>,
        velocities: &[usize],
        drift: &[T],
        force: impl Fn(usize) -> T,
    ) -> EquationTerms<T> {
        let dimension = at.model.dimension();
        let units: Vec<Vec<T>> = velocities
            .iter()
            .map(|component| {
                let mut unit = vec![T::zero(); dimension];
                unit[*component] = T::one();
                unit
            })
            .collect();
        let moved: Vec<Configuration<'_, Dual<T>>> =
            units.iter().map(|unit| at.lift_state(unit)).collect();
        // ∂²𝓛 along w_i and a direction.
        let mixed = |i: usize, direction: &[T]| {
            let direction: Vec<Dual<T>> = direction.iter().map(|x| Dual::from_re(*x)).collect();
            self.lagrangian(&moved[i].lift_state(&direction), self.vakonomic).eps.eps
        };
        let momenta: Vec<T> =
            moved.iter().map(|at| self.lagrangian(at, self.vakonomic).eps).collect();
        let fields: Vec<Vec<T>> =
            moved.iter().map(|at| self.drift(at).iter().map(|x| x.eps).collect()).collect();
        let turning = self.turning(at, &moved, drift, &fields, &momenta);
        let drive = |i: usize| {
            let along = self.lagrangian(&at.lift_state(&fields[i]), self.vakonomic).eps;
            along + force(i) - turning[i] - mixed(i, drift)
        };
        let slopes = |f: &Formula| -> Vec<T> { moved.iter().map(|at| at.scalar(f).eps).collect() };
        EquationTerms {
            drive: (0..velocities.len()).map(drive).collect(),
            mass: (0..velocities.len())
                .map(|i| units.iter().map(|unit| mixed(i, unit)).collect())
                .collect(),
            slopes: self.constraints.iter().map(slopes).collect(),
        }
    }

    /// Computes c^b_ia w_a P_b = (p, [X_i, Y]) with Y = Σ w_a X_a and (p, X_i) = P_i.
    fn turning<T: Scalar>(
        &self,
        at: &Configuration<'_, T>,
        moved: &[Configuration<'_, Dual<T>>],
        drift: &[T],
        fields: &[Vec<T>],
        momenta: &[T],
    ) -> Vec<T> {
        let mut turning = vec![T::zero(); momenta.len()];
        match self.algebra {
            Algebra::Commuting => {}
            Algebra::Rotations(first) => {
                let w = &at.components()[first..first + 3];
                let velocities = self.velocities(&at.model.state);
                let Some(start) = velocities.iter().position(|own| *own == first) else {
                    return vec![T::undefined(); momenta.len()];
                };
                for k in 0..3 {
                    let (i, j) = ((k + 1) % 3, (k + 2) % 3);
                    let (p, q) = (momenta[start + i], momenta[start + j]);
                    turning[start + k] = q * w[i] - p * w[j];
                }
            }
            Algebra::Frame => {
                let gram = fields.iter().map(|a| fields.iter().map(|b| dot(a, b)).collect());
                let weights = solve_positive(gram.collect(), momenta.to_vec());
                let covector: Vec<T> = (0..drift.len())
                    .map(|k| weights.iter().zip(fields).map(|(w, x)| *w * x[k]).sum())
                    .collect();
                let direction: Vec<Dual<T>> = drift.iter().map(|x| Dual::from_re(*x)).collect();
                for (i, (field, moved)) in fields.iter().zip(moved).enumerate() {
                    let forward: Vec<T> =
                        self.drift(&at.lift_state(field)).iter().map(|x| x.eps).collect();
                    let back = self.drift(&moved.lift_state(&direction));
                    let back: Vec<T> = back.iter().map(|x| x.eps.eps).collect();
                    turning[i] = dot(&covector, &forward) - dot(&covector, &back);
                }
            }
        }
        turning
    }
}
