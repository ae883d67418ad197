//! Solution of the equations of motion for the accelerations, by elimination or by minors of the masses ∂²L/∂w².
//!
//! Elimination divides by leading minors, of the masses and of the matrix a M⁻¹ aᵀ of the reactions. Where they are
//! 0 on no open set, it has a value at almost every state at which the determinant is not 0; and at all of them where
//! the matrix is definite, as its determinant then vanishes with a leading minor. Others need minors, as
//! [[0, 1], [1, 0]].

use super::Lagrangian;
use super::equations::{EquationTerms, LagrangianEquations};
use super::recorded_masses::RecordedMasses;
use crate::graph::{Expr, Fault, Step, divisors_of, literally, record};
use crate::mechanics::blocks::{block_determinants, blocks};
use crate::mechanics::dynamics::Dynamics;
use crate::mechanics::elimination::{solve_by_minors, solve_positive};
use crate::mechanics::{Chart, Configuration, Draw, LevelEquation, LevelFunction, Model, Phase};
use crate::scalar::Scalar;

/// Largest number of coupled velocities and constraints that are solved for by minors because a divisor may be 0
/// somewhere: more lose digits.
const MOST_BY_MINORS: usize = 6;

/// Method by which the equations of motion are solved for the accelerations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AccelerationSolver {
    /// Whether minors are used, which divide by determinants alone, rather than elimination.
    pub by_minors: bool,
    /// Whether M + aᵀa stands for M.
    pub with_slopes: bool,
    /// Whether what is divided by is known to be 0 on no open set of states at which the equations of motion have one
    /// solution.
    pub is_known: bool,
    /// Whether it is known to be 0 at none of these states.
    pub is_exact: bool,
}

impl AccelerationSolver {
    /// Elimination of the masses alone.
    pub const ELIMINATION: Self =
        Self { by_minors: false, with_slopes: false, is_known: true, is_exact: true };
    const MINORS: Self = Self { by_minors: true, ..Self::ELIMINATION };
}

impl Lagrangian {
    /// Chooses how the equations of motion are solved. Elimination is taken where what it divides by is known to be
    /// nowhere 0, on the level, in all of space and where one of several equations holds. Minors are taken elsewhere if few
    /// velocities and constraints are coupled, or if the matrix has eigenvalues of both signs at some of the first drawn
    /// states, with one choice of listed values or another. Many are eliminated, with M + aᵀa in the place of M where
    /// there are constraints and nothing is known of the leading minors of M.
    pub fn acceleration_solver(
        &self,
        model: &Model,
        chart: &Chart,
        free: &[Draw],
    ) -> AccelerationSolver {
        let velocities = self.velocities(&model.state);
        if velocities.is_empty() {
            return AccelerationSolver::ELIMINATION;
        }
        let level = vec![true; model.level.len()];
        let mut places = vec![level.clone()];
        if !level.is_empty() {
            places.push(vec![false; level.len()]);
        }
        // A claim may stand where one of several equations holds.
        if level.len() > 1 {
            places.extend((0..level.len()).map(|own| (0..level.len()).map(|k| k == own).collect()));
        }
        let is_given = |kept: &[bool]| matches!(chart, Chart::Given(_)) && !kept.contains(&false);
        let is_regular = |own: &RecordedMasses| {
            let is_regular_at = |kept: &Vec<bool>| {
                let at = (model, chart, &kept[..]);
                match kept.contains(&true) && !is_given(kept) {
                    true => {
                        self.lies_over_positions(own, (model, kept), &velocities)
                            || own.are_definite(at, free)
                            || own.are_nowhere_zero(at, free)
                    }
                    false => own.are_regular_at(at, free),
                }
            };
            places.iter().rev().all(is_regular_at)
        };
        let own = self.symbolic_masses(model, &velocities);
        let is_nowhere_singular = |own: &RecordedMasses| {
            let is_nowhere_singular_at = |kept: &[bool]| {
                let at = (model, chart, kept);
                own.are_definite(at, free) || own.are_nowhere_zero(at, free)
            };
            // What holds in all of space holds on the level, but that a chart of the file leaves the ranges.
            let space = vec![false; level.len()];
            own.is_small()
                && is_nowhere_singular_at(&space)
                && (!matches!(chart, Chart::Given(_)) || is_nowhere_singular_at(&level))
        };
        let is_indefinite = |own: &RecordedMasses| {
            own.are_indefinite((model, chart, &level), free, velocities.len())
        };
        if own.as_ref().is_ok_and(|own| is_nowhere_singular(own) && !is_indefinite(own)) {
            return AccelerationSolver::ELIMINATION;
        }
        let are_few = velocities.len() + self.constraints.len() <= MOST_BY_MINORS;
        let are_small = || own.as_ref().is_ok_and(|own| own.largest_block <= MOST_BY_MINORS);
        if are_few || own.as_ref().is_ok_and(is_indefinite) || are_small() {
            return AccelerationSolver::MINORS;
        }
        let is_known = own.as_ref().is_ok_and(is_regular);
        let of_many = AccelerationSolver { is_exact: false, ..AccelerationSolver::ELIMINATION };
        let elimination = AccelerationSolver { is_known, ..of_many };
        if is_known || self.constraints.is_empty() {
            return elimination;
        }
        let solver = AccelerationSolver { with_slopes: true, ..of_many };
        let with_slopes = Self { solver, ..self.clone() };
        let is_known_with_slopes =
            with_slopes.symbolic_masses(model, &velocities).is_ok_and(|own| is_regular(&own));
        AccelerationSolver { is_known: is_known_with_slopes, ..solver }
    }

    /// Records masses and divisors in the symbols of parameters and state, as the equations of motion are: a mass that
    /// is 0 for a listed value, or on the level, is eliminated nevertheless.
    fn symbolic_masses(
        &self,
        model: &Model,
        velocities: &[usize],
    ) -> Result<RecordedMasses, Fault> {
        let free = model.free_components();
        let (graph, (masses, [pivots, divisors], level, largest_block)) =
            record(free + model.dimension(), |inputs| {
                let (parameters, state) = inputs.split_at(free);
                let phase = Phase::new(model, parameters, state);
                let divisors = divisors_of(|| {
                    self.field(&phase);
                });
                let level = model.level.iter().map(|own| phase.level_function(&own.function));
                let level = level.flat_map(|own| [own, -own]).collect();
                let masses = self.masses(&phase.configuration, velocities);
                let pivots = divisors_of(|| {
                    solve_positive(
                        masses.clone(),
                        vec![<Expr as num_traits::Zero>::zero(); masses.len()],
                    );
                });
                let bordered = self.equations(&phase).bordered();
                let largest = blocks(&bordered).iter().map(Vec::len).max().unwrap_or_default();
                (masses.concat(), [pivots, divisors], level, largest)
            })?;
        Ok(RecordedMasses { graph, masses, pivots, divisors, level, largest_block })
    }

    /// Whether what holds on an open set of a place holds on one of positions: it has no other equations than
    /// constraints on velocities, and the divisors contain no velocities. Where the equations of motion have one
    /// solution, the slopes of the constraints by the velocities are independent, so that the level is projected to the
    /// positions by a submersion.
    fn lies_over_positions(
        &self,
        own: &RecordedMasses,
        (model, kept): (&Model, &[bool]),
        velocities: &[usize],
    ) -> bool {
        let is_constraint = |equation: &LevelEquation| match &equation.function {
            LevelFunction::Formula(function) => {
                self.constraints.iter().any(|constraint| constraint.text() == function.text())
            }
            _ => false,
        };
        let free = model.free_components();
        let reached = own.graph.reached(own.divisors.iter().copied());
        let mut steps = own.graph.steps().zip(reached);
        let is_velocity =
            |input: usize| input.checked_sub(free).is_some_and(|k| velocities.contains(&k));
        let mut equations = model.level.iter().zip(kept).filter(|(_, kept)| **kept);
        equations.all(|(equation, _)| is_constraint(equation))
            && !steps.any(|(step, reached)| match step {
                Step::Input(input) => reached && is_velocity(input),
                _ => false,
            })
    }

    /// Computes D = det [[M, aᵀ], [a, 0]] by factors: the equations of motion have one solution where none is 0.
    pub fn determinants<T: Scalar>(&self, phase: &Phase<'_, T>) -> Vec<T> {
        block_determinants(&self.equations(phase).bordered())
    }

    /// Records all slopes in the equations of motion literally, before these are solved: there are accelerations only
    /// where all of them have values.
    pub fn slopes_as_written(&self, phase: &Phase<'_, Expr>) -> Vec<Expr> {
        let LagrangianEquations { terms, carried, .. } = literally(|| self.equations(phase));
        let EquationTerms { mass, drive, slopes } = terms;
        let all = [mass.concat(), drive, slopes.concat(), carried].concat();
        all.into_iter().filter(|own| !own.is_always_defined()).collect()
    }

    fn masses(&self, at: &Configuration<'_, Expr>, velocities: &[usize]) -> Vec<Vec<Expr>> {
        let drift = self.drift(at);
        let none = |_: usize| <Expr as num_traits::Zero>::zero();
        let terms = self
            .swept_terms(at, velocities, &drift, none)
            .unwrap_or_else(|| self.lifted_terms(at, velocities, &drift, none));
        terms.mass
    }

    /// Solves M x = b with the masses M.
    pub(super) fn solved<T: Scalar>(&self, mass: &[Vec<T>], sides: Vec<Vec<T>>) -> Vec<Vec<T>> {
        match self.may_be_eliminated(mass) {
            true => eliminated(mass, sides),
            false => solve_by_minors(mass, &sides),
        }
    }

    /// Whether these masses may be eliminated: an entry of the diagonal that is 0 by its form excludes it.
    pub(super) fn may_be_eliminated<T: Scalar>(&self, mass: &[Vec<T>]) -> bool {
        let is_present =
            |(i, row): (usize, &Vec<T>)| row.get(i).is_some_and(|own| !own.is_absent());
        !self.solver.by_minors && mass.iter().enumerate().all(is_present)
    }
}

/// Solves A x = b by elimination.
pub(super) fn eliminated<T: Scalar>(matrix: &[Vec<T>], sides: Vec<Vec<T>>) -> Vec<Vec<T>> {
    sides.into_iter().map(|side| solve_positive(matrix.to_vec(), side)).collect()
}
